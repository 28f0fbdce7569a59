//! Billboards in a row, and a body that goes through them.

use glam::Vec3;
use sward::interaction::distance_map::{DistanceMap, DistanceMapHead};
use sward::response::springs::{CLEAR, HeldSheet, Maps, Sheet, SheetRoot, SpringsCoefficients, TRODDEN, moments, pose, step};

/// Step of the scenes, s.
pub(crate) const STEP: f32 = 1.0 / 60.0;

/// The meadow's coefficients for a sheet of so many columns and rows.
pub(crate) fn coefficients(columns: u32, rows: u32) -> SpringsCoefficients {
    SpringsCoefficients::new([columns, rows], 2, 1.0, 2.5, STEP)
}

/// A billboard of `length` m and 0.3 m width, turned by `yaw`.
pub(crate) fn root(x: f32, z: f32, yaw: f32, length: f32) -> SheetRoot {
    SheetRoot { at: [x, 0.0, z], length, half_width: [0.15 * yaw.cos(), 0.15 * yaw.sin()], ..SheetRoot::default() }
}

/// Billboards across the way of a body that is `wide` m to each side, in six directions.
pub(crate) fn row(wide: f32, length: f32) -> Vec<SheetRoot> {
    let reach = wide + length + 0.2;
    (0..40)
        .flat_map(|i| (0..6).map(move |turn| root(reach * (i as f32 / 19.53 - 1.0), 0.0, turn as f32 * std::f32::consts::PI / 6.0, length)))
        .collect()
}

/// A billboard with its state.
#[derive(Clone)]
pub(crate) struct Plant {
    pub(crate) root: SheetRoot,
    pub(crate) target: Sheet,
    pub(crate) held: HeldSheet,
    pub(crate) shown: Sheet,
}

impl Plant {
    pub(crate) fn new(co: &SpringsCoefficients, root: SheetRoot) -> Self {
        let target = pose(co, &root, [[0.0; 2]; 2]);
        Self { root, target, held: HeldSheet::new(&target), shown: target }
    }

    pub(crate) fn step(&mut self, co: &SpringsCoefficients, maps: &Maps, heading: [f32; 2]) {
        step(co, &self.root, maps, &self.target, heading, &mut self.held);
        self.shown = self.held.shown(co, &self.root, &self.target);
    }
}

/// Where the body's map is at a place on the ground, turned by `yaw`.
pub(crate) fn head(map: &DistanceMap, moment: u32, at: Vec3, yaw: f32) -> DistanceMapHead {
    let (s, c) = yaw.sin_cos();
    DistanceMapHead::new(map, 0, (moment, 0), at.to_array(), [[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]])
}

/// What happened to billboards; lengths in m, jumps in lengths of a column.
#[derive(Clone, Debug, Default)]
pub(crate) struct Seen {
    /// Deepest vertex by the map.
    pub(crate) deepest: f32,
    /// Deepest vertex by the body's own distance.
    pub(crate) truly: f32,
    /// Billboards times frames.
    pub(crate) frames: u32,
    /// Of them, those deeper than 5 and than 12 mm.
    pub(crate) over: [u32; 2],
    /// Most frames in a row a billboard was deeper than 5 mm.
    pub(crate) in_a_row: u32,
    /// Lowest vertex above the ground.
    pub(crate) lowest: f32,
    /// Largest move of a vertex in a frame.
    pub(crate) jump: f32,
    /// Largest change of a segment's length.
    pub(crate) stretch: f32,
    /// Frames with a billboard touched.
    pub(crate) touched: u32,
}

impl Seen {
    pub(crate) fn print(&self, name: &str) {
        println!(
            "{name}: deepest {:.1} mm ({:.1} truly), over 5 and 12 mm in {:?} of {} frames, {} in a row; lowest {:.2} mm, jump {:.2} L, lengths {:.0e}, touched {}",
            self.deepest * 1e3,
            self.truly * 1e3,
            self.over,
            self.frames,
            self.in_a_row,
            self.lowest * 1e3,
            self.jump,
            self.stretch,
            self.touched
        );
    }
}

/// Looks at one billboard after a step. `deep` is how long it has been too deep; `distance` the body's own.
pub(crate) fn look(
    seen: &mut Seen,
    co: &SpringsCoefficients,
    plant: &Plant,
    before: &Sheet,
    maps: &Maps,
    deep: &mut u32,
    distance: impl Fn(Vec3) -> f32,
) {
    let (columns, rows) = co.sides();
    let depth = maps.deepest(co, &plant.root, maps.last(), &plant.shown);
    seen.deepest = seen.deepest.max(depth);
    *deep = if depth > 0.005 { *deep + 1 } else { 0 };
    seen.in_a_row = seen.in_a_row.max(*deep);
    seen.over[0] += u32::from(depth > 0.005);
    seen.over[1] += u32::from(depth > 0.012);
    seen.frames += 1;
    seen.touched += u32::from(plant.held.steps == 0 && plant.shown != plant.target);
    seen.stretch = seen.stretch.max(plant.shown.stretch(co, &plant.root));
    for vertex in columns..columns * rows {
        let (at, was) = (Vec3::from(plant.shown.at[vertex]), Vec3::from(before.at[vertex]));
        let height = plant.root.height(at.to_array());
        seen.lowest = seen.lowest.min(height);
        seen.jump = seen.jump.max(at.distance(was) / plant.root.length);
        if height > TRODDEN {
            seen.truly = seen.truly.max((-distance(at)).min(height - CLEAR));
        }
    }
}

/// Lets a body go along z through a row of billboards at `speed` m/s, until all have recovered; `count` moments a step, or as many as the
/// method asks for.
pub(crate) fn pass(co: &SpringsCoefficients, body: &super::bodies::Body, roots: &[SheetRoot], speed: f32, count: Option<u32>) -> Seen {
    let mut seen = Seen { lowest: 1.0, ..Seen::default() };
    let start = -body.half_length - 1.0;
    let frames = ((2.0 * -start / speed + 1.2 * co.recover) / STEP) as u32;
    for root in roots {
        let mut plant = Plant::new(co, *root);
        let mut deep = 0;
        for frame in 0..frames {
            let count = count.unwrap_or_else(|| moments(speed * STEP, root.length));
            let at = |moment: u32| Vec3::Z * (start + speed * STEP * (frame as f32 + (moment + 1) as f32 / count as f32));
            let heads: Vec<DistanceMapHead> = (0..count).map(|moment| head(&body.map, moment, at(moment), 0.0)).collect();
            let maps = Maps { heads: &heads, texels: &body.map.texels };
            let before = plant.shown;
            plant.step(co, &maps, [0.0, 1.0]);
            look(&mut seen, co, &plant, &before, &maps, &mut deep, |p| (body.distance)(p - at(count - 1)));
        }
        assert!(plant.held.is_done(co), "{}: a billboard has not recovered", body.name);
    }
    seen
}
