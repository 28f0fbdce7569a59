//! The examples run, and what they claim holds.

macro_rules! examples {
    ($($name:ident, $path:literal;)*) => {$(
        #[path = $path]
        #[allow(dead_code, clippy::print_stdout)]
        mod $name;

        #[test]
        fn $name() {
            $name::main().unwrap();
        }
    )*};
}

examples! {
    bodies, "../../examples/bodies.rs";
    wind, "../../examples/wind.rs";
    focus, "../../examples/focus.rs";
    tuning, "../../examples/tuning.rs";
    growth, "../../examples/growth.rs";
    feel, "../../examples/feel.rs";
    saving, "../../examples/saving.rs";
    replay, "../../examples/replay.rs";
    questions, "../../examples/questions.rs";
}
