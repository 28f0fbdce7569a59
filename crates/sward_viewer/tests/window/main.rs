//! The window, as a person meets it: real keys and a real mouse in a display of its own, asked what it shows after every picture.
//!
//! Needs Xvfb, xdotool and ImageMagick's `import`, and an adapter; without them the tests are ignored, in CI they fail. Time advances by steps for
//! every picture, not by seconds. Screenshots go to `SWARD_SCREENSHOTS`, or to the target folder. `SWARD_SOAK=600` makes the soak ten minutes long.

#![forbid(unsafe_code)]

mod desk;
mod pictures;
#[path = "../../../sward_wgpu/tests/support/slope.rs"]
mod slope;
mod soak;
mod tales;

use libtest_mimic::{Arguments, Failed, Trial};

/// A test and its name.
type Tale = (&'static str, fn() -> Result<(), Failed>);

const TALES: [Tale; 9] = [
    ("a_truck_is_driven_and_leaves_a_track", tales::drive),
    ("sliders_and_presets_change_the_bend", tales::sliders),
    ("an_edited_file_is_opened_again_and_a_broken_one_says_where", tales::edits),
    ("a_body_follows_the_hand", tales::hand),
    ("two_responses_stand_side_by_side", tales::compare),
    ("everything_can_be_looked_at", tales::look),
    ("painted_wind_blows", tales::paint),
    ("a_clip_is_recorded", tales::record),
    ("letters_are_twice_as_large_on_a_fine_screen", tales::fine),
];

fn main() {
    let mut arguments = Arguments::from_args();
    // One window at a time: they share the processor, and what is measured is time.
    arguments.test_threads = Some(1);
    let missing = desk::missing();
    let fails = std::env::var_os("CI").is_some();
    if let Some(missing) = &missing {
        eprintln!("missing: {missing}");
    }
    let tales = TALES.iter().chain(&[("soak", soak::soak as fn() -> Result<(), Failed>)]);
    let trials = tales.map(|(name, tale)| Trial::test(*name, *tale).with_ignored_flag(missing.is_some() && !fails)).collect();
    libtest_mimic::run(&arguments, trials).exit();
}
