//! How near the CPU step comes to the speed of memory: cells/s × 48 B against a triad (12 B an element) in the same process, on the
//! same threads, in ABBA order. 225 patches of 128 × 128 cells on slopes, no contact, no wind. `cargo bench --bench traffic`.

mod measure;

use std::hint::black_box;

use measure::{PAIRS, median, pair, seconds};
use rayon::prelude::*;
use sward::interaction::solid::Solids;
use sward::lanes::Lanes;
use sward::model::NoAssets;
use sward::plan::{PatchPlan, StandPlan};
use sward::response::continuum;
use sward::scene::Scene;
use sward::state::{Cells, NONE};
use sward::terrain::Terrain;
use sward::world::World;

const SIDE: i32 = 15;
const CELLS: usize = 128;
/// 64 MiB an array.
const TRIAD: usize = 1 << 24;

struct Field {
    world: World,
    cells: Cells,
    plan: StandPlan,
}

impl Field {
    fn new() -> Self {
        let text = "(version: 1, stands: [(species: Meadow, cells: 128)], budget: (patches: 225))";
        let mut world = World::new(Scene::parse(text, "bench.ron").expect("valid"), &NoAssets).expect("valid");
        let heights = (0..128 * 128).map(|k| ((k % 128) as f32 * 0.11).sin() * 4.0 + ((k / 128) as f32 * 0.07).cos() * 5.0).collect();
        world.model.terrain = Terrain::new(heights, 128, 128, [6.0, 6.0], [-200.0, -200.0]).expect("valid");
        let slot = |x: i32, z: i32| if (0..SIDE).contains(&x) && (0..SIDE).contains(&z) { (z * SIDE + x) as u32 } else { NONE };
        let patch = |k: i32| {
            let (x, z) = (k % SIDE, k / SIDE);
            PatchPlan {
                patch: [x, z],
                slot: slot(x, z),
                lag: NONE,
                neighbours: [slot(x - 1, z), slot(x + 1, z), slot(x, z - 1), slot(x, z + 1)],
                keep: 1.0,
                aired: false,
                woken: true,
                edited: false,
                lag_woken: false,
                pairs: 0..0,
                around: [NONE; 9],
                weights: [1.0; 4],
                solids: 0..0,
                pixels: 0.0,
                handing: false,
            }
        };
        let wind = world.wind(&world.model.stands[0]);
        let patches = (0..SIDE * SIDE).map(patch).collect();
        let plan = StandPlan {
            tile_wind: wind.clone(),
            wind,
            patches,
            contacts: Vec::new(),
            edges: Vec::new(),
            pairs: Vec::new(),
            solids: Solids::default(),
            touchers: Vec::new(),
            sheets: Default::default(),
            rebase: false,
        };
        let mut field = Self { world, cells: Cells::default(), plan };
        field.step(Lanes::default());
        field.plan.patches.iter_mut().for_each(|patch| patch.woken = false);
        // A smooth, moving field: nothing is at rest and nothing at its limit.
        for (level, old) in [&mut field.cells.now, &mut field.cells.old].into_iter().enumerate() {
            for (slot, patch) in old.iter_mut().enumerate() {
                for (k, value) in patch.iter_mut().enumerate() {
                    *value = 0.2 * ((k % CELLS) as f32 * 0.05 + slot as f32 + level as f32 * 0.1).sin();
                }
            }
        }
        field
    }

    fn step(&mut self, lanes: Lanes) {
        black_box(continuum::step(&self.world.model.terrain, &self.world.model.stands[0], &self.plan, &mut self.cells, lanes, &mut |_| ()));
    }
}

fn triad(a: &mut [f32], b: &[f32], c: &[f32]) {
    a.par_chunks_mut(1 << 16).zip(b.par_chunks(1 << 16)).zip(c.par_chunks(1 << 16)).for_each(|((a, b), c)| {
        for ((a, b), c) in a.iter_mut().zip(b).zip(c) {
            *a = b + 0.5 * c;
        }
    });
}

fn main() {
    let mut field = Field::new();
    let (mut a, b, c) = (vec![0.0_f32; TRIAD], vec![1.0_f32; TRIAD], vec![2.0_f32; TRIAD]);
    let cells = (SIDE * SIDE) as f64 * (CELLS * CELLS) as f64;
    for lanes in Lanes::available() {
        let (mut ratios, mut steps, mut triads) = (Vec::new(), Vec::new(), Vec::new());
        for number in 0..PAIRS {
            let bare = || seconds(|| triad(black_box(&mut a), &b, &c));
            let [step, bare] = pair(number, || seconds(|| field.step(lanes)), bare);
            let (step, bare) = (2.0 * 48.0 * cells / step, 2.0 * 12.0 * TRIAD as f64 / bare);
            ratios.push(step / bare);
            steps.push(step);
            triads.push(bare);
        }
        let ([low, middle, high], [_, step, _], [_, bare, _]) = (median(&mut ratios), median(&mut steps), median(&mut triads));
        println!(
            "{lanes:?}: {:.0} M cells/s, {:.1} GB/s against {:.1} GB/s of the triad; ratio {middle:.2} ({low:.2} to {high:.2}); {} threads",
            step / 48e6,
            step / 1e9,
            bare / 1e9,
            rayon::current_num_threads()
        );
    }
}
