//! Orthmann, Rezk-Salama & Kolb 2009, §7: 60 000 billboards that a body pushes through.

use sward::placement;
use sward::response::springs::pool;
use sward::scene::Scene;
use sward::world::World;

use super::film::{Machine, pairs};
use super::table::{Column, Line, Ratio, Table};
use crate::failure::Failure;

/// Billboards of the paper.
const BILLBOARDS: u32 = 60_000;
/// Not printed.
const SIZE: [u32; 2] = [1024, 768];
/// Seconds the body has been on its way when frames are timed: most of the field.
const ON_ITS_WAY: f64 = 6.0;

/// A meadow of 64 by 64 m, with a body 12 m wide that has gone through it, or without.
fn scene(cells: u32, cover: f64, body: bool) -> Result<Scene, Failure> {
    let bodies = if body {
        "[(shape: Ellipsoid(radii: (6, 2, 3)), path: Keyframes(keys: [(time: 0, at: (0, -30)), (time: 7, at: (0, 26))]))]"
    } else {
        "[]"
    };
    let text = format!(
        "(version: 1, field: (patch_side: 32, patches: (2, 2)),
        stands: [(species: Meadow, cells: {cells}, cover: {cover}, clumping: 0, response: Springs(recover: 20), representation: Sheet(width: 0.4))],
        wind: [Natural(velocity: (2, 1))], interactors: {bodies},
        camera: (eye: (-8, 7, -34), target: (0, 0, -6)), budget: (sheets: 65536))"
    );
    Ok(Scene::parse(&text, "billboards.ron")?)
}

/// Runs it.
pub(super) fn run(machine: &Machine<'_>, progress: &mut dyn FnMut()) -> Result<Table, Failure> {
    let size = machine.size(SIZE);
    let cells = ((128.0 * machine.scale.sqrt() / 8.0).ceil() as u32 * 8).max(8);
    let cover = f64::from(BILLBOARDS) * machine.scale / f64::from(4 * cells * cells);
    let mut still = machine.film(machine.world(scene(cells, cover, false)?)?, size)?;
    let mut pushed = machine.film(machine.world(scene(cells, cover, true)?)?, size)?;
    while pushed.world.time() < ON_ITS_WAY {
        pushed.step()?;
    }
    let deformed = pushed.world.state.stands.iter().map(|stand| stand.sheets.pool.taken().count()).sum::<usize>();
    let measured = pairs(machine.pairs, [&mut still, &mut pushed], progress)?;
    let [step, picture] = pushed.frames(1, progress)?;
    let billboards = billboards(&still.world);
    let words =
        pushed.world.model.stands.iter().filter_map(|stand| stand.springs.as_ref()).map(|springs| pool::words(&springs.coefficients));
    // A sheet of each, and where it is.
    let bytes = words.max().unwrap_or(0) as f64 * 4.0 * billboards as f64 + 4.0 * f64::from(4 * cells * cells);
    let [width, height] = size;
    Ok(Table {
        paper: "Orthmann, Rezk-Salama & Kolb 2009, GPU-based Responsive Grass",
        place: "§7",
        scene: format!(
            "{billboards} billboards, 4 samples a pixel, a body moves through them; no resolution is printed, here {width}x{height}"
        ),
        columns: vec![Column::new("fewest deformed", "fps"), Column::new("most deformed", "fps"), Column::new("all billboards", "MB")],
        ratios: vec![Ratio { what: "most/fewest", of: [0, 1] }],
        lines: vec![
            Line::printed("Athlon 64 3500+, GeForce 8800 GTX", [Some(80.0), Some(40.0), Some(12.0)]),
            Line::ours(
                machine.name(),
                vec![Some(1.0 / measured.seconds[0]), Some(1.0 / measured.seconds[1]), Some(bytes / 1e6)],
                vec![measured.ratio],
            ),
        ],
        notes: vec![
            format!(
                "the paper prints 40 to 80 fps and not how many were deformed; here none and {deformed}, which take {:.0} ms a step and {:.0} ms a picture",
                1e3 * step,
                1e3 * picture
            ),
            "its 12 MB are all it keeps of billboards; ours are sheets of all of them, which only deformed ones take".to_owned(),
        ],
    })
}

/// Billboards that stand in the field.
fn billboards(world: &World) -> u64 {
    let mut found = 0;
    for stand in &world.model.stands {
        for patch in [[-1, -1], [0, -1], [-1, 0], [0, 0]] {
            let cells = (0..stand.cells * stand.cells).map(|cell| [cell % stand.cells, cell / stand.cells]);
            found += cells.filter(|cell| placement::plant(&stand.placement, patch, *cell).is_some()).count() as u64;
        }
    }
    found
}
