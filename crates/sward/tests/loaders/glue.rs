//! What all loaders have in common: files in memory, and a world that is stepped.

use sward::model::Assets;
use sward::picture::subject::Frame;
use sward::response::springs::pool;
use sward::scene::{Grown, LayersOverrides, PlantMesh, Representation, Response, Scene};
use sward::world::World;

/// Files by name.
pub(crate) struct Files(pub(crate) Vec<(&'static str, Vec<u8>)>);

impl Assets for Files {
    fn read(&self, path: &str) -> Result<Vec<u8>, String> {
        let found = self.0.iter().find(|(name, _)| *name == path);
        found.map(|(_, bytes)| bytes.clone()).ok_or_else(|| format!("{path} is missing"))
    }
}

/// Compiles a scene, steps it twice, saves and restores it; whether it was taken.
pub(crate) fn used(scene: Scene, files: &Files) -> bool {
    let Ok(mut world) = World::new(scene, files) else { return false };
    stepped(&mut world);
    let saved = world.save();
    world.restore(&saved).expect("what was saved can be restored");
    true
}

/// Two steps, and what a picture asks for: all in bounds.
pub(crate) fn stepped(world: &mut World) {
    for _ in 0..2 {
        world.step();
    }
    for (stand, model) in world.state.stands.iter().zip(&world.model.stands) {
        if let Some(springs) = &model.springs {
            // Its cells are places of sheets.
            let (words, [columns, rows]) = (pool::words(&springs.coefficients), [springs.coefficients.columns, springs.coefficients.rows]);
            for (_, place) in stand.sheets.pool.taken() {
                let points = &stand.cells.sheets[place as usize * words..][..(3 * columns * (rows - 1)) as usize];
                assert!(points.iter().all(|word| f32::from_bits(*word).is_finite()), "a vertex is not a number");
            }
            continue;
        }
        for slot in stand.awake.values().map(|awake| awake.slot as usize) {
            assert!(stand.cells.now[slot].iter().all(|value| value.is_finite()), "a cell is not a number");
        }
    }
    let view = world.camera_before(0.5);
    assert!(view.focus().iter().all(|part| part.is_finite()), "the camera looks nowhere");
    for stand in 0..world.model.stands.len() {
        assert!(world.bend_at(stand, [1.5, -2.0]).is_some_and(|bend| bend.iter().all(|part| part.is_finite())));
    }
    for model in &world.model.stands {
        let map = model.growth_map(&world.model.terrain, [0, 0]);
        assert!(map.is_none_or(|map| map.len() as u32 == model.cells * model.cells));
    }
    let (frame, _) = Frame::of(world, &view, 0.5);
    let limits = frame.input(world, &view, &[]).growth;
    assert!(limits.records.iter().flat_map(|record| record.low.iter().chain(&record.high)).all(|part| part.is_finite()));
    world.advance(0.02);
}

/// The scene with less to do.
pub(crate) fn smaller(scene: &mut Scene) {
    scene.stands.truncate(3);
    scene.stands.iter_mut().for_each(|stand| stand.cells = Some(stand.cells().min(16)));
    for stand in &mut scene.stands {
        // A mesh of millions takes its time, and is no fault.
        let small = PlantMesh::Grown(Grown { triangles: 2000, ..Grown::default() });
        if stand.is_layered() {
            let own = match &stand.representation {
                Some(Representation::Layers(own)) => own.clone(),
                _ => Default::default(),
            };
            let mesh = match &own.mesh {
                Some(file @ PlantMesh::File(_)) => file.clone(),
                _ => small,
            };
            stand.representation = Some(Representation::Layers(LayersOverrides { mesh: Some(mesh), distance: Some(20.0), ..own }));
        }
        if let Some(Response::Harmonic(own)) = &mut stand.response {
            own.cells = Some(own.cells.unwrap_or(64).min(64));
        }
    }
    scene.budget.patches = scene.budget.patches.min(12);
    scene.budget.catch_up = scene.budget.catch_up.min(2);
}
