//! Outputs beside pictures drawn on the CPU: a car pass, followed from frame to frame.

#[path = "support/edited.rs"]
mod edited;
#[path = "support/exact.rs"]
mod exact;
#[allow(dead_code)]
#[path = "../../sward/tests/figures/glb.rs"]
mod glb;
#[path = "support/reprojection.rs"]
mod reprojection;
#[path = "support/verdicts.rs"]
mod verdicts;

use reprojection::{CAR_PASS, FRAMES, Pair, SIZE, blade_pass, deformed_pass, sheet_pass, world};
use sward::picture::past::Past;
use sward::world::World;
use sward_raster::Studio;

fn pair(text: &str) -> Pair {
    let mut moving = world(text);
    let studio = Studio::new(&moving);
    let mut drawn = FRAMES.map(|(step, behind)| {
        (moving.state.step..step).for_each(|_| moving.step());
        (moving.clone(), behind, None)
    });
    let past = Past::of(&drawn[0].0, drawn[0].1);
    for (world, behind, aov) in &mut drawn {
        *aov = Some(studio.draw_aov(world, &past, *behind, SIZE).1);
    }
    let [(first, _, before), (second, _, now)] = drawn;
    Pair::new([first, second], [before, now].map(|aov| aov.expect("drawn")))
}

#[test]
fn a_car_pass_is_followed() {
    verdicts::car_pass(&pair(CAR_PASS)).expect("the pass is followed");
}

#[test]
fn sheets_are_followed() {
    verdicts::sheet_pass(&pair(&sheet_pass())).expect("the pass is followed");
}

#[test]
fn deformed_sheets_are_followed() {
    verdicts::deformed_pass(&pair(&deformed_pass())).expect("the pass is followed");
}

#[test]
fn blades_are_followed() {
    verdicts::blade_pass(&pair(&blade_pass())).expect("the pass is followed");
}

#[test]
fn edited_ground_is_no_motion() {
    let worlds = edited::worlds();
    let studio = Studio::new(&worlds[0]);
    let draw = |k: usize, past: &World| studio.draw_aov(&worlds[k], &Past::of(past, 0.0), 0.0, SIZE).1;
    let [before, now] = &worlds;
    let frames = [draw(0, before), draw(1, before)];
    edited::verdict(&worlds, &frames, &draw(1, &edited::always(&worlds)), &draw(1, now)).expect("it has not moved");
}
