//! Where plants stand: pure, uniform, continuous, and free (Chen & Johan 2010, §3).

use crate::common::world;
use sward::placement::{PlacementParameters, Plant, plant};

fn meadow(extra: &str) -> PlacementParameters {
    world(&format!("stands: [(species: Meadow, {extra})]")).model.stands[0].placement
}

#[test]
fn plants_do_not_depend_on_the_order_of_asking() {
    let p = meadow("cells: 32");
    let ask = |at: u32| plant(&p, [-3, 7], [at % 32, at / 32]);
    let forth: Vec<Option<Plant>> = (0..1024).map(ask).collect();
    let mut back: Vec<Option<Plant>> = (0..1024).rev().map(ask).collect();
    back.reverse();
    assert_eq!(forth, back);
    let other: Vec<Option<Plant>> = (0..1024).map(|at| plant(&p, [-3, 8], [at % 32, at / 32])).collect();
    assert_ne!(forth, other, "control: another patch has other plants");
}

#[test]
fn plants_stand_in_their_own_cell_within_their_ranges() {
    let p = meadow("cells: 64, cover: 0.9, height: (0.2, 0.7)");
    let mut count = 0;
    for patch in [[0, 0], [-1, 5], [8000, -8000], [i32::MIN, i32::MAX]] {
        for at in 0..4096_u32 {
            let cell = [at % 64, at / 64];
            let Some(plant) = plant(&p, patch, cell) else { continue };
            count += 1;
            for axis in 0..2 {
                let low = cell[axis] as f32 * p.spacing;
                assert!(plant.root[axis] >= low && plant.root[axis] <= low + p.spacing * 1.000001, "{plant:?} in {cell:?}");
            }
            assert!((0.2..=0.7).contains(&plant.height) && (0.0..=6.2831855).contains(&plant.yaw) && (0.0..1.0).contains(&plant.tint));
        }
    }
    assert!(count > 8000);
}

#[test]
fn cover_is_the_share_of_cells_with_a_plant() {
    let share = |cover: f64| {
        let p = meadow(&format!("cells: 128, clumping: 0.0, cover: {cover:?}"));
        let there = (0..16384_u32).filter(|at| plant(&p, [2, 3], [at % 128, at / 128]).is_some()).count();
        there as f64 / 16384.0
    };
    for cover in [0.0, 0.12, 0.5, 1.0] {
        assert!((share(cover) - cover).abs() < 0.015, "{cover}: {}", share(cover));
    }
    assert!((share(0.5) - 0.6).abs() > 0.015, "control");
}

#[test]
fn roots_and_heights_are_uniform() {
    let p = meadow("cells: 128, clumping: 0.0");
    // Chi-square over 32 bins, 31 degrees of freedom: 99.99 % of fair ones lie below 70.
    let score = |choice: &dyn Fn(&Plant, u32) -> f32| {
        let (mut bins, mut count) = ([0.0_f64; 32], 0.0);
        for at in 0..16384_u32 {
            if let Some(plant) = plant(&p, [0, 0], [at % 128, at / 128]) {
                bins[((choice(&plant, at) * 32.0) as usize).min(31)] += 1.0;
                count += 1.0;
            }
        }
        bins.iter().map(|n| (n - count / 32.0).powi(2) / (count / 32.0)).sum::<f64>()
    };
    let scores = [
        score(&|plant, at| plant.root[0] / p.spacing - (at % 128) as f32),
        score(&|plant, at| plant.root[1] / p.spacing - (at / 128) as f32),
        score(&|plant, _| (plant.height - 0.3) / 0.2),
        score(&|plant, _| plant.yaw / std::f32::consts::TAU),
        score(&|plant, _| plant.tint),
    ];
    assert!(scores.iter().all(|score| *score < 70.0), "{scores:?}");
    assert!(score(&|plant, _| plant.tint * plant.tint) > 1000.0, "control: a skewed choice is seen");
}

/// With clumping 1 the height is the clump noise alone: it must run on smoothly over the border of two patches.
#[test]
fn clumps_are_continuous_across_patches() {
    let p =
        meadow("cells: 128, clumping: 1.0, clump_size: 4.0, cover: 1.0, height: (0.0, 1.0)".replace("(0.0, 1.0)", "(0.01, 1.0)").as_str());
    let height = |x: i64, z: i64| {
        let patch = [x.div_euclid(128) as i32, z.div_euclid(128) as i32];
        plant(&p, patch, [x.rem_euclid(128) as u32, z.rem_euclid(128) as u32]).map(|plant| f64::from(plant.height))
    };
    let (mut inside, mut across, mut far) = (0.0_f64, [0.0_f64; 2], 0.0_f64);
    for z in -300..300 {
        for (x, inner) in [(-129, false), (-1, false), (127, false), (40, true), (70, true)] {
            let steps = [(height(x, z), height(x + 1, z)), (height(z, x), height(z, x + 1))];
            for (axis, step) in steps.into_iter().enumerate() {
                let (Some(a), Some(b)) = step else { continue };
                if inner { inside = inside.max((a - b).abs()) } else { across[axis] = across[axis].max((a - b).abs()) }
            }
            if let (Some(a), Some(b)) = (height(x, z), height(x + 16, z)) {
                far = far.max((a - b).abs());
            }
        }
    }
    println!("largest step inside {inside:.3}, across {across:.3?}, over a clump {far:.3}");
    // Value noise of 4 m steps at most 1.5 · 0.25/4 of its range from cell to cell.
    assert!(inside < 0.1 && across.iter().all(|step| *step < 0.1 && *step > 0.0));
    // A patch border is a line of the clumps' lattice, where the noise is level; joined by straight lines it would step by 0.06.
    assert!(across.iter().all(|step| *step < 0.02), "{across:?}");
    assert!(far > 0.3, "control: clumps do differ");
}

#[test]
fn a_field_as_large_as_a_country_holds_no_more_than_a_small_one() {
    let held = |patches: u32| {
        let mut world = world(&format!(
            "field: (patch_side: 54.864, patches: ({patches}, {patches})), stands: [(species: Meadow, cells: 120)],
             interactors: [(shape: Truck, path: Keyframes(keys: [(time: 0.0, at: (-6.0, 6.0)), (time: 1.0, at: (8.0, 10.0))]))]"
        ));
        (0..40).for_each(|_| world.step());
        let stand = &world.state.stands[0];
        let numbers: usize = stand.cells.now.iter().chain(&stand.cells.old).chain(&stand.cells.lag).map(|slot| slot.len()).sum();
        (numbers, world.model.terrain.heights().len(), stand.awake.len(), stand.counters, stand.free.len())
    };
    let small = held(88);
    assert_eq!(small, held(8800));
    assert!(small.3.patch_steps > 0, "control: something was stepped");
}
