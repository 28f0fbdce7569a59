//! Belyaev, Laevsky & Chukanov 2011, §4, Table 1: a million blades, still, in the wind, and with a car.

use sward::placement;
use sward::scene::Scene;
use sward::world::World;
use sward_scenes::shipped;

use super::film::{Machine, pairs};
use super::table::{Column, Line, Ratio, Table};
use crate::failure::Failure;

/// Not printed.
const SIZE: [u32; 2] = [1024, 768];
/// The field's patches along a side, and blades of a cell.
const PATCHES: u32 = 8;

/// Runs it.
pub(super) fn run(machine: &Machine<'_>, progress: &mut dyn FnMut()) -> Result<Table, Failure> {
    let size = machine.size(SIZE);
    let text = shipped("grassland").map_or("", |shipped| shipped.text);
    let world = |car: bool| -> Result<World, Failure> {
        let mut scene = Scene::parse(text, "grassland.ron")?;
        if machine.scale < 1.0 {
            scene.stands.iter_mut().for_each(|stand| stand.cells = Some((128.0 * machine.scale.sqrt() / 8.0).ceil() as u32 * 8));
        }
        if !car {
            scene.interactors.clear();
        }
        machine.world(scene)
    };
    let blades = blades(&world(false)?);
    let mut found = Vec::new();
    for car in [false, true] {
        let mut moving = machine.film(world(car)?, size)?;
        let mut frozen = moving.frozen(machine)?;
        found.push(pairs(machine.pairs, [&mut frozen, &mut moving], progress)?);
    }
    let rate = |seconds: f64| Some(1.0 / seconds);
    let printed = |on: &str, fps: [f64; 3]| Line::printed(on, fps.map(Some));
    Ok(Table {
        paper: "Belyaev, Laevsky & Chukanov 2011, Real-time Animation, Collision and Rendering of Grassland",
        place: "§4, Table 1",
        scene: format!("280 m by 280 m, {blades} blades, the paper's 1 000 000; no resolution is printed, here {}x{}", size[0], size[1]),
        columns: vec![Column::new("A: no motion", "fps"), Column::new("B: wind", "fps"), Column::new("C: wind and a car", "fps")],
        ratios: vec![Ratio { what: "B/A", of: [0, 1] }, Ratio { what: "C/A", of: [0, 2] }],
        lines: vec![
            printed("Pentium D, Radeon EAH5450", [28.0, 26.0, 24.0]),
            printed("Core 2 Duo E8500, GeForce 9600 GT", [60.0, 57.0, 54.0]),
            printed("Core 2 Duo E8500, Radeon HD 6870", [180.0, 165.0, 150.0]),
            Line::ours(
                machine.name(),
                vec![rate(found[0].seconds[0]), rate(found[0].seconds[1]), rate(found[1].seconds[1])],
                vec![found[0].ratio, found[1].ratio],
            ),
        ],
        notes: vec![format!(
            "here A is a moment of B, and of C, drawn over and over: the same blades bent as they are, without a step; ratios from {} pairs",
            machine.pairs
        )],
    })
}

/// Blades that stand in the field.
fn blades(world: &World) -> u64 {
    let half = PATCHES as i32 / 2;
    let (mut plants, mut each) = (0, 1);
    for stand in &world.model.stands {
        each = stand.species.blade.as_ref().map_or(1, |blade| blade.blades);
        for patch in (-half..half).flat_map(|z| (-half..half).map(move |x| [x, z])) {
            let cells = (0..stand.cells * stand.cells).map(|cell| [cell % stand.cells, cell / stand.cells]);
            plants += cells.filter(|cell| placement::plant(&stand.placement, patch, *cell).is_some()).count() as u64;
        }
    }
    plants * u64::from(each)
}
