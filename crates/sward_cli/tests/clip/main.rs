//! Clips: the file's boxes, what other programs make of it, interruption, and wrong input.
//!
//! What needs ffmpeg is ignored where that is missing, not passed; with `CI` set it fails.

mod boxes;
mod others;
#[path = "../support/mod.rs"]
mod support;
mod whole;

use libtest_mimic::{Arguments, Failed, Trial};

fn main() {
    let missing = !others::are_there() && std::env::var_os("CI").is_none();
    let tests: [(&str, fn(), bool); 9] = [
        ("the_boxes_tell_what_was_asked_for", whole::the_boxes_tell_what_was_asked_for, false),
        ("two_runs_write_the_same_bytes", whole::two_runs_write_the_same_bytes, false),
        ("a_clip_lasts_as_long_as_was_asked_for", whole::a_clip_lasts_as_long_as_was_asked_for, false),
        ("an_interrupted_clip_goes_on", whole::an_interrupted_clip_goes_on, false),
        ("a_damaged_frame_is_named", whole::a_damaged_frame_is_named, false),
        ("what_others_put_beside_the_frames_stays", whole::what_others_put_beside_the_frames_stays, false),
        ("contradictions_are_refused", whole::contradictions_are_refused, false),
        ("ffprobe_finds_what_was_asked_for", others::ffprobe_finds_what_was_asked_for, missing),
        ("ffmpeg_decodes_the_frames_that_were_drawn", others::ffmpeg_decodes_the_frames_that_were_drawn, missing),
    ];
    let trial = |(name, test, missing): (&str, fn(), bool)| Trial::test(name, move || ran(test)).with_ignored_flag(missing);
    libtest_mimic::run(&Arguments::from_args(), tests.map(trial).into()).exit();
}

fn ran(test: fn()) -> Result<(), Failed> {
    test();
    Ok(())
}
