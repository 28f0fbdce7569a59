//! Chen & Johan 2010, §7: the field of a racing game, 225 patches of it in memory.

use sward::scene::Scene;
use sward_scenes::shipped;

use super::film::Machine;
use super::table::{Column, Line, Table};
use crate::failure::Failure;

/// Patches that the paper keeps in memory.
const PATCHES: u32 = 225;
/// Cells along a side of a patch.
const CELLS: u32 = 120;
/// Bytes of a cell with both time levels, in f32 and at half precision.
const CELL_BYTES: [f64; 2] = [32.0, 16.0];
/// Not printed.
const SIZE: [u32; 2] = [1024, 768];
/// The paper's 63 M are 675 textures of 128 × 128 pixels of 6 bytes.
const MIB: f64 = 1_048_576.0;

/// Runs it.
pub(super) fn run(machine: &Machine<'_>, progress: &mut dyn FnMut()) -> Result<Table, Failure> {
    let size = machine.size(SIZE);
    let text = shipped("paper").map_or("", |shipped| shipped.text);
    let scene = |everywhere: bool| -> Result<Scene, Failure> {
        let mut scene = Scene::parse(text, "paper.ron")?;
        if machine.scale < 1.0 {
            scene.stands.iter_mut().for_each(|stand| stand.cells = Some((CELLS as f64 * machine.scale.sqrt() / 8.0).ceil() as u32 * 8));
        }
        scene.budget.patches = machine.count(PATCHES, 9);
        if everywhere {
            scene.budget.focus_distance = 1000.0;
        }
        Ok(scene)
    };
    let mut found = Vec::new();
    for everywhere in [true, false] {
        let mut film = machine.film(machine.world(scene(everywhere)?)?, size)?;
        let [step, picture] = film.frames(machine.pairs, progress)?;
        let awake = film.world.state.stands.iter().map(|stand| stand.awake.len()).sum::<usize>();
        let cells = film.world.model.stands.iter().map(|stand| stand.cells).max().unwrap_or(0);
        found.push((step, picture, awake, f64::from(cells) * f64::from(cells)));
    }
    let [(step, picture, awake, area), (own_step, own_picture, own_awake, _)] = [found[0], found[1]];
    let memory = CELL_BYTES.map(|bytes| bytes * area * awake as f64 / MIB);
    let fields = 88_u64 * 88 * u64::from(CELLS) * u64::from(CELLS);
    Ok(Table {
        paper: "Chen & Johan 2010, Real-Time Continuum Grass",
        place: "§7",
        scene: format!(
            "88 × 88 patches of {CELLS} × {CELLS} cells, {:.1} million clusters; a car and wind; no resolution is printed, here {}x{}",
            fields as f64 / 1e6,
            size[0],
            size[1]
        ),
        columns: vec![
            Column::new(format!("{awake} patches simulated"), "fps"),
            Column::new(format!("as many as are needed: {own_awake}"), "fps"),
            Column::new("their state", "MiB"),
            Column::new("at half precision", "MiB"),
        ],
        ratios: Vec::new(),
        lines: vec![
            Line::printed("GeForce 8600 GTS", [Some(40.0), None, None, Some(63.0)]),
            Line::printed("Radeon HD 4800", [Some(100.0), None, None, Some(63.0)]),
            Line::ours(
                machine.name(),
                vec![Some(1.0 / (step + picture)), Some(1.0 / (own_step + own_picture)), Some(memory[0]), Some(memory[1])],
                Vec::new(),
            ),
        ],
        notes: vec![
            format!(
                "here a step takes {:.0} ms with {awake} patches and {:.0} ms with {own_awake}, a picture {:.0} and {:.0} ms",
                1e3 * step,
                1e3 * own_step,
                1e3 * picture,
                1e3 * own_picture
            ),
            "the paper simulates wind in 4 patches and shows one of them everywhere else; here all patches feel their own".to_owned(),
            "the paper gives two figures of two cards, and so no ratio to be had on one".to_owned(),
        ],
    })
}
