//! All blades of a world's first stand, as a picture shows them.

use glam::{Mat4, Vec3};
use sward::picture::blade_plan::{self, BladePlan};
use sward::picture::blades::{Blade, Blades};
use sward::picture::plan::Seen;
use sward::picture::prepare::{PrepareUniform, Preparing};
use sward::picture::subject::{self, Frame};
use sward::response::continuum::NODE_CELLS;
use sward::scene::Scene;
use sward::world::World;

/// A blade with its level and the points of its strip, m in frame space.
pub(crate) type Solved = (Blade, usize, Vec<Vec3>);

/// A world of a scene's text; files come from the repository.
pub(crate) fn world(fields: &str) -> World {
    let root = std::path::PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    World::new(Scene::parse(&format!("(version: 1, {fields})"), "blades.ron").expect("valid"), &sward::model::Folder(root)).expect("valid")
}

/// The camera of a picture of 960 × 540 pixels, frame to clip space.
pub(crate) fn projection(world: &World) -> Mat4 {
    let view = world.camera();
    let (frame, _) = Frame::of(world, &view, 0.0);
    frame.view(&view).projection([960, 540])
}

/// What is decided of the first stand.
pub(crate) fn plan(world: &World) -> BladePlan {
    let view = world.camera();
    let (_, origin) = Frame::of(world, &view, 0.0);
    let seen = Seen { view: &view, origin, fullness: 1.0, near: 1.0, behind: 0.0 };
    blade_plan::plan(world, &seen, &subject::looks(world), &projection(world), false).swap_remove(0).expect("a stand of blades")
}

/// Its blades, patch by patch.
pub(crate) fn solve(world: &World, plan: &BladePlan) -> Vec<Solved> {
    let view = world.camera();
    let (_, origin) = Frame::of(world, &view, 0.0);
    let seen = Seen { view: &view, origin, fullness: 1.0, near: 1.0, behind: 0.0 };
    let (stand, wind) = (&world.model.stands[0], world.wind_before(&world.model.stands[0], 0.0));
    let uniform = PrepareUniform::new(world, stand, false, &seen, &subject::looks(world)[0]);
    let (cells, terrain, intervals) = (&world.state.stands[0].cells, &world.model.terrain, stand.cells / NODE_CELLS);
    let blades = Blades { preparing: Preparing { uniform, cells, terrain, stand, wind: &wind, intervals }, uniform: plan.uniform };
    let mut all = Vec::new();
    for (number, draw) in plan.draws.iter().enumerate() {
        blades.of_patch(number as u32, draw, |blade, level, points| all.push((*blade, level, points.to_vec())));
    }
    all
}
