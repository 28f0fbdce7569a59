//! Pictures drawn on the CPU by `sward_raster` against the GPU's; and the example that draws, which the guide shows.

#[path = "support/adapter.rs"]
mod adapter;
#[path = "../examples/draw.rs"]
#[allow(dead_code, clippy::print_stdout)]
mod draw;
#[path = "support/rastered.rs"]
mod rastered;

fn main() -> std::process::ExitCode {
    let tests: &[adapter::Test] = &[
        ("hello", rastered::hello),
        ("sparse", rastered::sparse),
        ("lawn", rastered::lawn),
        ("reed", rastered::reed),
        ("crossing", rastered::crossing),
        ("road", rastered::road),
        ("detail", rastered::detail),
        ("paper", rastered::paper),
        ("endless", rastered::endless),
        ("blades", rastered::blades),
        ("footsteps", rastered::footsteps),
        ("sheets", rastered::sheets),
        ("deformed_sheets", rastered::deformed_sheets),
        ("combed", rastered::combed),
        ("surroundings", rastered::surroundings),
        ("layers", rastered::layers),
        ("the_example_draws", |gpu| draw::run(gpu).map_err(|error| error.to_string().into())),
    ];
    adapter::run(tests, |_, _| None)
}
