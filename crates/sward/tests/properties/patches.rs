//! A field cut into patches is the same field as one grid, bit for bit, while all patches touched are awake.

use crate::common::{Dice, world};
use sward::interaction::solid::Solids;
use sward::interaction::{Contact, Footprint, Grid, Pose, pieces_of, swept};
use sward::lanes::Lanes;
use sward::model::{Model, StandModel};
use sward::plan::{ContactPair, PatchPlan, StandPlan};
use sward::response::continuum;
use sward::scene::{Shape, Sphere};
use sward::state::{Cells, NONE};
use sward::terrain::Terrain;
use sward::wind::WindField;

const STEPS: u64 = 40;

/// A square of 2 × 2 patches of N cells, or one patch of 2N, stepped by hand.
struct Sheet {
    model: Model,
    stand: StandModel,
    cells: Cells,
    patches: i32,
}

impl Sheet {
    fn new(side: u32, patches: i32, hilly: bool) -> Self {
        let metres = f64::from(side) * 0.25;
        let world = world(&format!(
            "field: (patch_side: {metres:.1}), stands: [(species: Meadow, cells: {side})],
             wind: [Natural(velocity: (5.0, 2.0), turbulence: 0.4)]"
        ));
        let mut model = world.model;
        if hilly {
            let height = |k: i32| 0.12 * ((k % 40) as f32 * 0.9).sin() + 0.15 * ((k / 40) as f32 * 0.7).cos();
            model.terrain = Terrain::new((0..1600).map(height).collect(), 40, 40, [2.3, 1.9], [-3.1, -4.7]).expect("valid");
        }
        Self { stand: model.stands[0].clone(), model, cells: Cells::default(), patches }
    }

    /// The plan of a step; `joined` = neighbours see each other.
    fn plan(&self, step: u64, footprints: &[Footprint], joined: bool) -> StandPlan {
        let wind = WindField::before(&self.model.sources, step, 0.0, self.model.dt, self.stand.spacing * f64::from(continuum::NODE_CELLS));
        let mut plan = StandPlan {
            tile_wind: wind.clone(),
            wind,
            patches: Vec::new(),
            contacts: Vec::new(),
            edges: Vec::new(),
            pairs: Vec::new(),
            solids: Solids::default(),
            touchers: Vec::new(),
            sheets: Default::default(),
            rebase: false,
        };
        for footprint in footprints {
            plan.contacts.push(Contact { edge_first: plan.edges.len() as u32, ..footprint.contact });
            plan.edges.extend(&footprint.edges);
        }
        let slot = |x: i32, z: i32| {
            let inside = (0..self.patches).contains(&x) && (0..self.patches).contains(&z);
            if inside { (z * self.patches + x) as u32 } else { NONE }
        };
        for z in 0..self.patches {
            for x in 0..self.patches {
                let first = plan.pairs.len();
                for (contact, footprint) in footprints.iter().enumerate() {
                    let corner = [0, 1].map(|axis| (footprint.corner[axis] - i64::from([x, z][axis]) * i64::from(self.stand.cells)) as i32);
                    plan.pairs.push(ContactPair { contact: contact as u32, corner });
                }
                let around = if joined { [slot(x - 1, z), slot(x + 1, z), slot(x, z - 1), slot(x, z + 1)] } else { [NONE; 4] };
                plan.patches.push(PatchPlan {
                    patch: [x, z],
                    slot: slot(x, z),
                    lag: NONE,
                    neighbours: around,
                    keep: 1.0,
                    aired: false,
                    woken: step == 0,
                    edited: false,
                    lag_woken: false,
                    pairs: first..plan.pairs.len(),
                    around: [NONE; 9],
                    weights: [1.0; 4],
                    solids: 0..0,
                    pixels: 0.0,
                    handing: false,
                });
            }
        }
        plan
    }

    /// Runs `STEPS` steps with two bodies that cross the middle; returns the whole square, plane by plane.
    fn run(mut self, joined: bool) -> Vec<f32> {
        let middle = f64::from(self.stand.cells) * f64::from(self.patches) * self.stand.spacing / 2.0;
        for step in 0..STEPS {
            let plan = self.plan(step, &bodies(step, middle), joined);
            continuum::step(&self.model.terrain, &self.stand, &plan, &mut self.cells, Lanes::default(), &mut |_| ());
        }
        let (n, side) = (self.stand.cells as usize, (self.stand.cells as i32 * self.patches) as usize);
        let mut square = Vec::with_capacity(4 * side * side);
        for plane in 0..4 {
            for at in 0..side * side {
                let (i, j) = (at % side, at / side);
                square.push(self.cells.now[(j / n) * self.patches as usize + i / n][(plane * n + j % n) * n + i % n]);
            }
        }
        square
    }
}

/// Footprints of a truck and a ball that cross the middle of the square at 12 and 7 m/s.
fn bodies(step: u64, middle: f64) -> Vec<Footprint> {
    let grid = Grid { spacing: 0.25, plant_height: 0.4 };
    let dt = 1.0 / 60.0;
    let mut footprints = Vec::new();
    let ways = [(Shape::Truck, [11.0, 4.8], 1.16), (Shape::Sphere(Sphere { radius: 0.7 }), [-2.0, 6.7], 0.0)];
    for (body, (shape, velocity, yaw)) in ways.iter().enumerate() {
        let pose = |step: u64| {
            let time = step as f64 * dt - 0.4;
            let yaw = yaw + 0.3 * time;
            Pose { ground: [middle + velocity[0] * time, middle + velocity[1] * time], yaw, height: 0.0, slope: [0.0; 2] }
        };
        for piece in pieces_of(shape) {
            footprints.extend(swept(&piece, &pose(step), &pose(step + 1), dt, &grid, body as u32));
        }
    }
    footprints
}

#[test]
fn two_by_two_patches_are_one_grid_bit_for_bit() {
    for (side, hilly) in [(120, false), (128, false), (120, true), (128, true)] {
        let whole = Sheet::new(2 * side, 1, hilly).run(true);
        let cut = Sheet::new(side, 2, hilly).run(true);
        let different = whole.iter().zip(&cut).filter(|(a, b)| a.to_bits() != b.to_bits()).count();
        let bent = whole.iter().filter(|value| value.abs() > 0.5).count();
        println!("{side}, hills {hilly}: {different} of {} numbers differ; {bent} above 0.5", whole.len());
        assert!(different == 0 && bent > 500);
        let apart = Sheet::new(side, 2, hilly).run(false);
        assert!(whole.iter().zip(&apart).any(|(a, b)| (a - b).abs() > 1e-3), "control: patches that do not see each other differ");
    }
}

#[test]
fn random_states_step_alike_in_one_grid_and_in_patches() {
    let value = |at: u64, plane: u64| (Dice(at * 4 + plane + 1).between(-1.0, 1.0) * if plane < 2 { 1.0 } else { 5.0 }) as f32;
    let stepped = |side: u32, patches: i32| {
        let mut sheet = Sheet::new(side, patches, false);
        let (n, whole) = (side as usize, (side as i32 * patches) as usize);
        let mut plan = sheet.plan(0, &[], true);
        plan.patches.iter_mut().for_each(|patch| patch.woken = false);
        for slot in 0..(patches * patches) as usize {
            let (x, z) = (slot % patches as usize, slot / patches as usize);
            let level = |shift: u64| {
                (0..4 * n * n).map(move |at| {
                    let (plane, i, j) = (at / (n * n), at % n + x * n, at / n % n + z * n);
                    value((j * whole + i) as u64 + shift, plane as u64)
                })
            };
            sheet.cells.now.push(level(0).collect());
            sheet.cells.old.push(level(1 << 20).collect());
            sheet.cells.ground.push(Default::default());
        }
        continuum::step(&sheet.model.terrain, &sheet.stand, &plan, &mut sheet.cells, Lanes::default(), &mut |_| ());
        let mut square = vec![0.0_f32; 4 * whole * whole];
        for (at, out) in square.iter_mut().enumerate() {
            let (plane, i, j) = (at / (whole * whole), at % whole, at / whole % whole);
            *out = sheet.cells.now[(j / n) * patches as usize + i / n][(plane * n + j % n) * n + i % n];
        }
        square
    };
    let (whole, cut) = (stepped(64, 1), stepped(32, 2));
    assert_eq!(whole.len(), cut.len());
    assert!(whole.iter().zip(&cut).all(|(a, b)| a.to_bits() == b.to_bits()));
    assert!(whole.iter().any(|value| value.abs() > 0.5), "control: something moves");
}
