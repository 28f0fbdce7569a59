//! The hash hears of everything that changes the light, and of nothing else.

use sward::picture::volume::Inputs;
use sward::scene::LightVolume;
use sward::terrain::Terrain;
use sward::world::World;

use crate::Test;
use crate::scenes::{dome, small, surroundings, white, world};

pub(crate) const TESTS: &[Test] = &[
    ("the_hash_changes_with_each_input", scenes),
    ("the_hash_changes_with_each_number", numbers),
    ("the_hash_does_not_hear_of_what_is_no_light", others),
];

const TEXT: &str = "stands: [(species: Meadow)]";

fn key(world: &World) -> u128 {
    Inputs::of(world).expect("inputs").key()
}

fn other(text: &str) -> u128 {
    key(&world(text, white(), small()))
}

fn scenes() {
    let mut keys = vec![
        key(&world(TEXT, white(), small())),
        key(&world(TEXT, dome(), small())),
        key(&world(TEXT, surroundings(|[x, _, _]| [1.0 + x; 3]), small())),
        key(&world(TEXT, white(), LightVolume { voxel: 0.6, ..small() })),
        key(&world(TEXT, white(), LightVolume { reach: 9.0, ..small() })),
        key(&world(TEXT, white(), LightVolume { height: Some(0.7), ..small() })),
        key(&world(TEXT, white(), LightVolume { layers: 7, ..small() })),
        key(&world(TEXT, white(), LightVolume { samples: 32, ..small() })),
        other("stands: [(species: Tussock)]"),
        other("stands: [(species: Meadow, cover: 0.9)]"),
        other("stands: [(species: Meadow, clumping: 0.5)]"),
        other("stands: [(species: Meadow, cells: 64)]"),
        other("stands: [(species: Meadow, height: (0.3, 0.55))]"),
        other("stands: [(species: Meadow, representation: Blade())]"),
        other("stands: [(species: Meadow, representation: Billboard(width: 0.3))]"),
        other("stands: [(species: Meadow, representation: Billboard(colour_tip: (0.2, 0.3, 0.1)))]"),
        other("stands: [(species: Meadow)], seed: 2"),
        other("stands: [(species: Meadow)], camera: (eye: (9, 1.7, 0))"),
        other("stands: [(species: Meadow)], exclusions: [(area: Disc(at: (0, -4), radius: 2))]"),
        other("stands: [(species: Meadow)], edits: [(at: (0, -4), radius: 3, change: Raise(height: 1.0))]"),
        other("stands: [(species: Meadow)], detail: (amplitude: 0.2)"),
        other("stands: [(species: Meadow)], field: (patches: (1, 1), patch_side: 8)"),
    ];
    let mut hills = world(TEXT, white(), small());
    hills.model.terrain = Terrain::new((0..64).map(|at| at as f32).collect(), 8, 8, [4.0; 2], [-16.0; 2]).expect("a terrain");
    keys.push(key(&hills));
    let count = keys.len();
    keys.sort_unstable();
    keys.dedup();
    assert_eq!(keys.len(), count, "two different scenes have one key");
}

/// One bit of any number.
fn numbers() {
    let inputs = Inputs::of(&world("stands: [(species: Meadow)], detail: ()", white(), small())).expect("inputs");
    let key = inputs.key();
    let changed: [fn(&mut Inputs); 14] = [
        |inputs| inputs.room.corner[1] += 1e-9,
        |inputs| inputs.room.voxel[0] += 1e-12,
        |inputs| inputs.room.size[2] += 1,
        |inputs| inputs.room.height += 1e-7,
        |inputs| inputs.sphere.irradiance[3][2].x += 1e-6,
        |inputs| inputs.sphere.light[5].z += 1e-6,
        |inputs| inputs.sun.irradiance.y += 1e-6,
        |inputs| inputs.sun.direction.x += 1e-6,
        |inputs| inputs.ground[7] += 1e-6,
        |inputs| inputs.skyline[9] += 1e-6,
        |inputs| inputs.leaves[11] += 1e-6,
        |inputs| inputs.open[1] += 1e-5,
        |inputs| inputs.albedo[2] += 1e-6,
        |inputs| inputs.soil.swap(0, 2),
    ];
    for (number, change) in changed.into_iter().enumerate() {
        let mut other = inputs.clone();
        change(&mut other);
        assert_ne!(other.key(), key, "change {number}");
    }
    assert_eq!(inputs.clone().key(), key, "control");
}

fn others() {
    let plain = other(TEXT);
    for same in [
        "stands: [(species: Meadow)], wind: [Natural()]",
        "stands: [(species: Meadow)], interactors: [(shape: Sphere(radius: 1))]",
        "stands: [(species: Meadow)], light: (fog: 0.01, exposure: 1)",
        "stands: [(species: Meadow, response: Continuum(kappa: 50))], title: \"another\"",
        "stands: [(species: Meadow)], budget: (patches: 9)",
    ] {
        assert_eq!(other(same), plain, "{same}");
    }
}
