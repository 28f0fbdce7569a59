//! At half precision grass recovers to rest and its patches sleep, in still air and in wind, as they do in f32.

use crate::common::{halve, round, world};
use sward::plan::Plan;
use sward::response::continuum;
use sward::world::World;

/// How a step's cells are rounded.
type Rounding = fn(&mut World, &Plan);

/// A ball has passed. The steps until all patches sleep; `None` where some are awake after 12 s.
fn asleep(species: &str, wind: &str, rounding: Rounding) -> Option<u64> {
    let mut world = world(&format!(
        "field: (patch_side: 8.0), stands: [(species: {species}, cells: 32)], wind: [Uniform(velocity: {wind})],
         interactors: [(shape: Sphere(radius: 0.6), path: Keyframes(keys: [(time: 0, at: (-3, 4)), (time: 1, at: (9, 5))]), until: 1.0)]"
    ));
    // In wind too nothing but rest counts as rest.
    world.model.stands[0].tolerance = continuum::REST;
    while world.state.step < 720 {
        let plan = world.plan();
        let reports = world.respond(&plan);
        rounding(&mut world, &plan);
        world.finish(reports);
        let stand = &world.state.stands[0];
        if stand.counters.woken > 0 && stand.awake.is_empty() {
            return Some(world.state.step);
        }
    }
    None
}

/// To the nearest of numbers with 11 bits of mantissa, as IEEE halves have.
fn ieee(world: &mut World, plan: &Plan) {
    round(world, plan, |cells, _| cells.iter().map(|value| f32::from_bits((value.to_bits() + 0x1000) & !0x1fff)).collect());
}

#[test]
fn tracks_recover_and_patches_sleep() {
    for species in ["Lawn", "Meadow", "Reed", "Tussock"] {
        for wind in ["(0.0, 0.0)", "(5.0, 2.0)"] {
            let (full, half) = (asleep(species, wind, |_, _| {}), asleep(species, wind, halve));
            println!("{species} in {wind}: asleep after {full:?} steps in f32, {half:?} at half precision");
            let apart = full.zip(half).map(|(full, half)| full.abs_diff(half));
            assert!(apart.is_some_and(|steps| steps <= 5), "{species} in {wind}: {full:?} and {half:?}");
        }
    }
    assert_eq!(asleep("Reed", "(5.0, 2.0)", ieee), None, "control: halves as IEEE has them stop short of rest");
}
