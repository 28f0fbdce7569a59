//! Chen & Johan 2010, §7: the field of a racing game, 225 patches of it in memory.

use sward::scene::Scene;
use sward::world::World;
use sward_scenes::shipped;

use super::super::measure::Interval;
use super::film::{Film, Machine, pairs};
use super::table::{Column, Line, Ratio, Table};
use crate::failure::Failure;

/// Patches that the paper keeps in memory, and along a side of the field.
const PATCHES: u32 = 225;
const FIELD: u32 = 88;
/// Cells along a side of a patch.
const CELLS: u32 = 120;
/// Bytes of a cell with both time levels, in f32 and at half precision.
const CELL_BYTES: [f64; 2] = [32.0, 16.0];
/// Not printed.
const SIZE: [u32; 2] = [1024, 768];
/// The paper's 63 M are 675 textures of 128 × 128 pixels of 6 bytes.
const MIB: f64 = 1_048_576.0;

/// What was found of one world.
struct Found {
    awake: usize,
    /// Median seconds of a frame, of its step and of its picture.
    frame: f64,
    step: f64,
    picture: f64,
}

/// The field with all patches that memory has room for awake, or with those that the car, the wind and the eye need.
fn world(machine: &Machine<'_>, all: bool) -> Result<World, Failure> {
    let mut scene = Scene::parse(shipped("paper").map_or("", |shipped| shipped.text), "paper.ron")?;
    if machine.scale < 1.0 {
        let cells = (f64::from(CELLS) * machine.scale.sqrt() / 8.0).ceil() as u32 * 8;
        scene.stands.iter_mut().for_each(|stand| stand.cells = Some(cells));
    }
    scene.budget.patches = machine.count(PATCHES, 9);
    if all {
        scene.budget.focus_distance = 1000.0;
    }
    machine.world(scene)
}

/// Runs it.
pub(super) fn run(machine: &Machine<'_>, progress: &mut dyn FnMut()) -> Result<Table, Failure> {
    let size = machine.size(SIZE);
    let mut films = [machine.film(world(machine, true)?, size)?, machine.film(world(machine, false)?, size)?];
    let [all, needed] = &mut films;
    let measured = pairs(machine.pairs, [all, needed], progress)?;
    let mut found = |film: &mut Film<'_>, frame: f64| -> Result<Found, Failure> {
        let [step, picture] = film.frames(machine.pairs, progress)?;
        let awake = film.world.state.stands.iter().map(|stand| stand.awake.len()).sum();
        Ok(Found { awake, frame, step, picture })
    };
    let found = [found(all, measured.seconds[0])?, found(needed, measured.seconds[1])?];
    let cells = all.world.model.stands.iter().map(|stand| f64::from(stand.cells)).fold(0.0, f64::max);
    let memory = CELL_BYTES.map(|bytes| bytes * cells * cells * found[0].awake as f64 / MIB);
    Ok(table(machine, size, &found, memory, measured.ratio))
}

fn table(machine: &Machine<'_>, size: [u32; 2], found: &[Found; 2], memory: [f64; 2], ratio: Option<Interval>) -> Table {
    let [all, needed] = found;
    let clusters = f64::from(FIELD * CELLS) * f64::from(FIELD * CELLS) / 1e6;
    let printed = |on: &str, fps: f64| Line::printed(on, [Some(fps), None, None, Some(63.0)]);
    let values = vec![Some(1.0 / all.frame), Some(1.0 / needed.frame), Some(memory[0]), Some(memory[1])];
    let [width, height] = size;
    Table {
        paper: "Chen & Johan 2010, Real-Time Continuum Grass",
        place: "§7",
        scene: format!(
            "{FIELD} × {FIELD} patches of {CELLS} × {CELLS} cells, {clusters:.1} million clusters; a car and wind; no resolution is printed, here {width}x{height}"
        ),
        columns: vec![
            Column::new(format!("{} patches simulated", all.awake), "fps"),
            Column::new(format!("as many as are needed: {}", needed.awake), "fps"),
            Column::new("their state", "MiB"),
            Column::new("at half precision", "MiB"),
        ],
        ratios: vec![Ratio { what: "needed/all", of: [0, 1] }],
        lines: vec![printed("GeForce 8600 GTS", 40.0), printed("Radeon HD 4800", 100.0), Line::ours(machine.name(), values, vec![ratio])],
        notes: vec![
            format!(
                "here a step takes {:.0} ms with {} patches and {:.0} ms with {}, a picture {:.0} and {:.0} ms",
                1e3 * all.step,
                all.awake,
                1e3 * needed.step,
                needed.awake,
                1e3 * all.picture,
                1e3 * needed.picture
            ),
            "the paper simulates wind in 4 patches and shows one of them everywhere else; here all patches feel their own".to_owned(),
            "the paper's two figures are of two cards: there is no ratio of them to be had on one".to_owned(),
        ],
    }
}
