//! The state at one moment, as arrays.

use std::path::Path;

use npyz::{AutoSerialize, WriterBuilder};
use sward::response::StandModel;
use sward::response::chain::{ChainModel, loaded};
use sward::response::continuum::NODE_CELLS;
use sward::response::oscillator::Record;
use sward::response::springs::{SpringsModel, pool};
use sward::state::{BodyState, PatchKey, Root, StandState};
use sward::wind::WindField;
use sward::world::World;

use super::manifest::{Array, Column, Grid};
use crate::failure::Failure;
use crate::output;

/// Samples of the wind along each axis.
const WIND_SIDE: i32 = 65;
/// Distance of wind samples to aim at, m.
const WIND_SPACING: f64 = 2.0;

/// Columns of `bodies`. All but `present` are not a number (NaN) while a body is away.
const BODY_COLUMNS: [(&str, &str); 9] = [
    ("present", ""),
    ("x", "m"),
    ("height", "m"),
    ("z", "m"),
    ("yaw", "rad"),
    ("slope_x", ""),
    ("slope_z", ""),
    ("velocity_x", "m/s"),
    ("velocity_z", "m/s"),
];

/// Writes the arrays of this moment and adds them to `list`.
pub(super) fn write(world: &World, folder: &Path, list: &mut Vec<Array>) -> Result<(), Failure> {
    let mut writer = Writer { world, folder, list };
    for index in 0..world.model.stands.len() {
        writer.stand(index)?;
    }
    writer.bodies()?;
    writer.wind()
}

struct Writer<'a> {
    world: &'a World,
    folder: &'a Path,
    list: &'a mut Vec<Array>,
}

impl Writer<'_> {
    /// An entry of the manifest; `stem` begins the file's name.
    fn entry(&self, name: &str, stem: &str, meaning: &'static str, unit: &'static str) -> Array {
        let step = self.world.state.step;
        Array {
            name: name.to_owned(),
            meaning,
            file: format!("{stem}_{step:06}.npy"),
            dtype: "",
            shape: Vec::new(),
            axes: Vec::new(),
            unit,
            step,
            time: self.world.time(),
            columns: Vec::new(),
            rows: Vec::new(),
            grid: None,
        }
    }

    fn save<T: AutoSerialize>(
        &mut self,
        entry: Array,
        dtype: &'static str,
        axes: &[(&'static str, u64)],
        data: impl Iterator<Item = T>,
    ) -> Result<(), Failure> {
        let shape: Vec<u64> = axes.iter().map(|(_, length)| *length).collect();
        output::write_whole(&self.folder.join(&entry.file), |file| {
            let mut writer = npyz::WriteOptions::new().default_dtype().shape(&shape).writer(file).begin_nd()?;
            writer.extend(data)?;
            writer.finish()
        })?;
        self.list.push(Array { dtype, shape, axes: axes.iter().map(|(axis, _)| *axis).collect(), ..entry });
        Ok(())
    }

    fn stand(&mut self, index: usize) -> Result<(), Failure> {
        let world = self.world;
        let (model, state) = (&world.model.stands[index], &world.state.stands[index]);
        let stem = format!("{index}_{}", plain(&model.name));
        let (patches, cells) = (state.awake.len() as u64, u64::from(model.cells));
        let entry =
            self.entry(&format!("{}/patches", model.name), &format!("{stem}_patches"), "coordinates of the awake patches", "patches");
        let keys = state.awake.keys().flatten().copied();
        self.save(entry, "<i4", &[("patch", patches), ("x, z", 2)], keys)?;
        if let Some(chain) = &model.chain {
            return self.blades(index, chain, &stem);
        }
        if model.oscillator.is_some() {
            return self.swings(index, &stem);
        }
        if let Some(springs) = &model.springs {
            return self.sheets(index, springs, &stem);
        }
        let fields =
            [("beta", "bend of each cell, as a vector over the ground", "rad"), ("omega", "bending velocity of each cell", "rad/s")];
        let axes = [("patch", patches), ("cell z", cells), ("cell x", cells), ("x, z", 2)];
        for (first_plane, (field, meaning, unit)) in [0, 2].into_iter().zip(fields) {
            let entry = self.entry(&format!("{}/{field}", model.name), &format!("{stem}_{field}"), meaning, unit);
            let awake = awake_cells(model, state)?;
            self.save(entry, "<f4", &axes, awake.into_iter().flat_map(|cells| pairs(cells, first_plane)))?;
        }
        Ok(())
    }

    /// Of a stand in which every plant swings by itself: how each leans, and how it was last left.
    fn swings(&mut self, index: usize, stem: &str) -> Result<(), Failure> {
        let world = self.world;
        let (model, state) = (&world.model.stands[index], &world.state.stands[index]);
        let (patches, cells) = (state.awake.len() as u64, u64::from(model.cells));
        let all = (0..model.cells).flat_map(|z| (0..model.cells).map(move |x| [x, z]));
        let bends = state.awake.keys().flat_map(|patch| all.clone().map(|cell| world.bend_of_plant(index, *patch, cell)));
        let bends: Vec<[f32; 2]> = bends.map(Option::unwrap_or_default).collect();
        let axes = [("patch", patches), ("cell z", cells), ("cell x", cells), ("x, z", 2)];
        let meaning = "bend of the plant of each cell, as a vector over the ground";
        let entry = self.entry(&format!("{}/beta", model.name), &format!("{stem}_beta"), meaning, "rad");
        self.save(entry, "<f4", &axes, bends.into_iter().flatten())?;
        let meaning = "how bodies last left each plant: deviation x and z from how it stands in the wind [rad], its rate [rad/s], seconds since then; \
            0, 0, 0 and not a number where none touched it";
        let entry = self.entry(&format!("{}/records", model.name), &format!("{stem}_records"), meaning, "see meaning");
        let awake = awake_cells(model, state)?;
        let area = (model.cells * model.cells) as usize;
        let rows = awake.into_iter().flat_map(|planes| (0..area).map(|cell| Record::load(planes, area, cell)));
        let rows = rows.flat_map(|record| {
            let steps = f64::from(record.steps_to(world.state.step as u32));
            let since = if record == Record::default() { f32::NAN } else { (steps * world.model.dt) as f32 };
            [record.deviation[0], record.deviation[1], record.rate, since]
        });
        self.save(entry, "<f4", &[("patch", patches), ("cell z", cells), ("cell x", cells), ("value", 4)], rows)
    }

    /// Of a stand whose billboards bodies deform: the sheets.
    fn sheets(&mut self, index: usize, springs: &SpringsModel, stem: &str) -> Result<(), Failure> {
        let world = self.world;
        let (model, state) = (&world.model.stands[index], &world.state.stands[index]);
        let (columns, rows) = springs.coefficients.sides();
        let (words, vertices) = (pool::words(&springs.coefficients), columns * (rows - 1));
        let taken: Vec<_> = state.sheets.pool.taken().collect();
        let count = taken.len() as u64;
        let meaning = "billboards that bodies have deformed: patch x and z, number of the cell there, steps since the last contact";
        let entry = self.entry(&format!("{}/deformed", model.name), &format!("{stem}_deformed"), meaning, "see meaning");
        let sheet = |place: u32| state.cells.sheets.get(place as usize * words..).and_then(|sheet| sheet.get(..words)).unwrap_or_default();
        let row = |((patch, cell), place): &(sward::state::Billboard, u32)| {
            [i64::from(patch[0]), i64::from(patch[1]), i64::from(*cell), sheet(*place).last().map_or(0, |steps| i64::from(*steps))]
        };
        self.save(entry, "<i8", &[("billboard", count), ("value", 4)], taken.iter().flat_map(row))?;
        let meaning = "vertices of their sheets above the root, as bodies left them: x and z from the patch's corner, y absolute";
        let entry = self.entry(&format!("{}/sheets", model.name), &format!("{stem}_sheets"), meaning, "m");
        let axes = [("billboard", count), ("row", rows as u64 - 1), ("column", columns as u64), ("x, y, z", 3)];
        let points = taken.iter().flat_map(|(_, place)| sheet(*place).iter().take(3 * vertices).map(|word| f32::from_bits(*word)));
        self.save(entry, "<f4", &axes, points)
    }

    /// Of a stand that moves blade by blade: its virtual blades, and its blades with a state.
    fn blades(&mut self, index: usize, chain: &ChainModel, stem: &str) -> Result<(), Failure> {
        let world = self.world;
        let (model, state) = (&world.model.stands[index], &world.state.stands[index]);
        let missing = || Failure::failed(format!("blades of the stand `{}` were not copied back", model.name));
        let (n, side) = (u64::from(chain.coefficients.segments), u64::from(chain.virtual_side));
        let slots = state.awake.values().map(|awake| state.cells.virtual_states.get(awake.slot as usize));
        let states: Vec<&[f32]> = slots.map(|states| states.map(|states| &states[..])).collect::<Option<_>>().ok_or_else(missing)?;
        let meaning = "joints of the virtual blades: bend \u{3c8} [rad] and rate \u{3c9} [rad/s], each across the segment below";
        let entry = self.entry(&format!("{}/virtual_blades", model.name), &format!("{stem}_virtual_blades"), meaning, "rad; rad/s");
        let axes = [("patch", states.len() as u64), ("segment", n), ("bend x, bend y, rate x, rate y", 4), ("z", side), ("x", side)];
        self.save(entry, "<f4", &axes, states.into_iter().flatten().copied())?;
        let held: Vec<BladeRow> = state.awake.iter().flat_map(|(patch, awake)| held(chain, state, *patch, awake.lag)).collect();
        let meaning = "blades with a state of their own: patch x and z; root x, height, z from the patch's corner [m]; length [m]; yaw, lean and curl [rad]; \
            hold; then of each segment bend x and y [rad], rate x and y [rad/s]";
        let entry = self.entry(&format!("{}/blades", model.name), &format!("{stem}_blades"), meaning, "see meaning");
        let axes = [("blade", held.len() as u64), ("value", 10 + 4 * n)];
        let row = |blade: &BladeRow| [&blade.0[..], &blade.1[..]].concat();
        self.save(entry, "<f4", &axes, held.iter().flat_map(row))
    }

    fn bodies(&mut self) -> Result<(), Failure> {
        let world = self.world;
        let mut entry = self.entry("bodies", "bodies", "poses of the bodies after the step", "see columns");
        entry.columns = BODY_COLUMNS.map(|(name, unit)| Column { name, unit }).into();
        let name = |(index, name): (usize, &String)| if name.is_empty() { format!("body {index}") } else { name.clone() };
        entry.rows = world.model.bodies.iter().map(|body| &body.name).enumerate().map(name).collect();
        let axes = [("body", world.state.bodies.len() as u64), ("column", BODY_COLUMNS.len() as u64)];
        self.save(entry, "<f8", &axes, world.state.bodies.iter().flat_map(|body| body_row(body, world.model.dt)))
    }

    /// On nodes of the first stand's own grid, so that these are the very numbers the plants feel.
    fn wind(&mut self) -> Result<(), Failure> {
        let world = self.world;
        let node = world.model.stands.first().map_or(WIND_SPACING, |stand| stand.spacing * f64::from(NODE_CELLS));
        let stride = (WIND_SPACING / node).round().max(1.0);
        let spacing = stride * node;
        let stand = world.model.stands.first();
        let still = || WindField::before(&world.model.sources, world.state.step, 0.0, world.model.dt, node);
        let wind = stand.map_or_else(still, |stand| world.wind(stand));
        let focus = world.state.focuses.first().copied().unwrap_or_else(|| world.camera().focus());
        let first = focus.map(|at| (at / spacing).round() as i32 - WIND_SIDE / 2);
        let phases = wind.patch_phases([0, 0], stand.map_or(1, |stand| stand.cells / NODE_CELLS));
        let sample = |k: i32, axis: usize| first[axis].saturating_add(k).saturating_mul(stride as i32);
        let nodes = (0..WIND_SIDE).flat_map(|z| (0..WIND_SIDE).map(move |x| [x, z]));
        let data = nodes.flat_map(|[x, z]| wind.velocity(&phases, [sample(x, 0), sample(z, 1)]));
        let mut entry = self.entry("wind", "wind", "velocity of the air around the focus", "m/s");
        entry.grid = Some(Grid { first: first.map(|k| f64::from(k) * spacing), spacing });
        self.save(entry, "<f4", &[("z", WIND_SIDE as u64), ("x", WIND_SIDE as u64), ("x, z", 2)], data)
    }
}

/// Where a blade stands and how, and its joints.
type BladeRow = ([f32; 10], Vec<f32>);

/// The blades of a patch with a state of their own.
fn held(chain: &ChainModel, state: &StandState, patch: PatchKey, lag: u32) -> Vec<BladeRow> {
    let n = chain.coefficients.segments as usize;
    let Some(values) = state.cells.blades(lag) else { return Vec::new() };
    let roots = &state.cells.roots[lag as usize];
    let row = |(index, root): (usize, &Root)| {
        let blade = loaded(values, roots.len(), index, n);
        let [x, y, z] = root.at;
        let stands = [patch[0] as f32, patch[1] as f32, x, y, z, root.length, root.yaw, root.lean, root.curl, blade.hold];
        (blade.hold > 0.0).then(|| (stands, blade.state.joints[..n].concat()))
    };
    roots.iter().enumerate().filter_map(row).collect()
}

/// Planes of each awake patch, in key order.
fn awake_cells<'a>(model: &StandModel, state: &'a StandState) -> Result<Vec<&'a [f32]>, Failure> {
    let length = 4 * (model.cells * model.cells) as usize;
    let cells = state.awake.values().map(|awake| state.cells.now.get(awake.slot as usize).map(|cells| &cells[..]));
    let whole = cells.map(|cells| cells.filter(|cells| cells.len() == length));
    whole.collect::<Option<_>>().ok_or_else(|| Failure::failed(format!("cells of the stand `{}` were not copied back", model.name)))
}

/// Two planes as pairs.
fn pairs(cells: &[f32], first_plane: usize) -> impl Iterator<Item = f32> {
    let area = cells.len() / 4;
    let (x, z) = (&cells[first_plane * area..][..area], &cells[(first_plane + 1) * area..][..area]);
    x.iter().zip(z).flat_map(|(x, z)| [*x, *z])
}

fn body_row(body: &BodyState, dt: f64) -> [f64; BODY_COLUMNS.len()] {
    let Some(pose) = &body.pose else {
        let mut row = [f64::NAN; BODY_COLUMNS.len()];
        row[0] = 0.0;
        return row;
    };
    let velocity = body.before.map_or([0.0; 2], |before| [0, 1].map(|axis| (pose.ground[axis] - before.ground[axis]) / dt));
    let [x, z] = pose.ground;
    [1.0, x, pose.height, z, pose.yaw, pose.slope[0], pose.slope[1], velocity[0], velocity[1]]
}

/// A stand's name as part of a file's name: letters, digits, `-` and `_`.
fn plain(name: &str) -> String {
    name.chars().take(40).map(|letter| if letter.is_ascii_alphanumeric() || letter == '-' { letter } else { '_' }).collect()
}
