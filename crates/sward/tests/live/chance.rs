//! Whatever a scene becomes while it runs: no panic, and finite numbers.

use super::{Text, USUAL, run};
use crate::kept::is_finite;
use sward::model::NoAssets;
use sward::world::World;

const STANDS: [&str; 14] = [
    "species: Meadow, cells: 16",
    "species: Meadow, cells: 16, cover: 0.3, height: (0.1, 0.9)",
    "species: Meadow, cells: 16, slope: (0, 0.02), lean: (0.3, 0.1)",
    "species: Reed, cells: 16, name: \"meadow\"",
    "species: Meadow, cells: 16, response: Continuum(lag: History, frequency: 0.5)",
    "species: Meadow, cells: 16, response: Springs()",
    "species: Meadow, cells: 16, response: Springs(stiffness: 0.2, recover: 0.3), cover: 0.4, height: (0.1, 0.2)",
    "species: Meadow, cells: 16, response: Chain(), representation: Blade(blades: 4)",
    "species: Meadow, cells: 16, response: Chain(frequency: 3), representation: Blade(blades: 4, lean: 0.6), cover: 0.5",
    "species: Meadow, cells: 16, response: VirtualInertia(), representation: Blade(blades: 4)",
    "species: Meadow, cells: 16, response: Oscillator()",
    "species: Meadow, cells: 16, response: Oscillator(frequency: 7, damping: 0.1), slope: (0, 0.02)",
    "species: Shrub, name: \"meadow\", cover: 0.3",
    "species: Shrub, name: \"meadow\", response: Harmonic(frequency: 2), places: [(at: (2, 2)), (at: (4, 1))]",
];

const MORE: [&str; 5] = [
    "",
    "edits: [(time: 0, at: (2, 2), radius: 3, change: Raise(height: 1))]",
    "exclusions: [(area: Disc(at: (3, 3), radius: 2))]",
    "seed: 5, detail: (amplitude: 0.2)",
    "budget: (patches: 20, focus_distance: 30, lag_distance: 20, stateful_blades: 40000, sheets: 64)",
];

/// Kinds of stands after other ones and after themselves, on changing ground.
#[test]
fn any_stand_may_follow_any_other() {
    let bodies = [USUAL.bodies, "(shape: Sphere(radius: 0.6), path: Circle(radius: 3, speed: -3))"];
    let mut world = USUAL.world();
    let (mut number, mut kept) = (0, [0, 0]);
    for stride in 1..STANDS.len() {
        // Twice the same stand, on other ground.
        for at in [0, 0, 1, 1] {
            number += 1;
            let text = Text {
                first: STANDS[(at * stride + stride) % STANDS.len()],
                bodies: bodies[number / 2 % 2],
                more: MORE[number % MORE.len()],
                ..USUAL
            };
            let fate = world.rescene(text.scene(), &NoAssets).unwrap().stands[0];
            kept[usize::from(fate.is_kept())] += 1;
            run(&mut world, 6);
            assert!(is_finite(&world), "{}, {}", text.first, text.more);
            let saved = world.save();
            let mut again = World::new(text.scene(), &NoAssets).unwrap();
            again.restore(&saved).unwrap_or_else(|error| panic!("{error}: {}, {}", text.first, text.more));
            assert_eq!(run(&mut again, 3), run(&mut world, 3), "a saved state goes on alike: {}, {}", text.first, text.more);
        }
    }
    assert!(kept.iter().all(|count| *count > 5), "{kept:?}");
}
