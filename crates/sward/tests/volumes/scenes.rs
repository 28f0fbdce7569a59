//! Small scenes and surroundings made here.

use std::sync::Arc;

use sward::model::NoAssets;
use sward::scene::{self, LightVolume, Scene};
use sward::shading::environment::Environment;
use sward::world::World;

/// Columns of surroundings made here.
pub(crate) const COLUMNS: u32 = 64;

/// Surroundings of which each pixel has the radiance that `of` gives for its direction.
pub(crate) fn surroundings(of: impl Fn([f32; 3]) -> [f32; 3]) -> Environment {
    let rows = COLUMNS / 2;
    let pixel = |at: u32| {
        let turn = ((at % COLUMNS) as f32 + 0.5) / COLUMNS as f32 * std::f32::consts::TAU - std::f32::consts::PI;
        let (level, up) = (((at / COLUMNS) as f32 + 0.5) / rows as f32 * std::f32::consts::PI).sin_cos();
        of([level * turn.cos(), up, level * turn.sin()])
    };
    Environment::new(COLUMNS, rows, (0..COLUMNS * rows).map(pixel).collect(), 1.0, 0.0)
}

/// White from everywhere.
pub(crate) fn white() -> Environment {
    surroundings(|_| [1.0; 3])
}

/// White above, black below the horizon.
pub(crate) fn dome() -> Environment {
    surroundings(|[_, up, _]| if up > 0.0 { [1.0; 3] } else { [0.0; 3] })
}

/// A small volume, so that tests are quick.
pub(crate) fn small() -> LightVolume {
    LightVolume { voxel: 0.5, reach: 8.0, layers: 6, ..Default::default() }
}

/// A scene in surroundings; `text` is what stands in it besides its version.
pub(crate) fn world(text: &str, environment: Environment, volume: LightVolume) -> World {
    let scene = Scene::parse(&format!("(version: 1, {text})"), "test.ron").expect("a scene");
    let mut world = World::new(scene, &NoAssets).expect("a world");
    let (strength, turn) = (environment.strength, environment.turn);
    world.scene.light.environment = Some(scene::Environment { file: "made here".to_owned(), strength, turn, volume });
    world.model.environment = Some(Arc::new(environment));
    world
}

/// Whether two numbers differ by at most `share` of the second.
pub(crate) fn near(found: f32, wanted: f32, share: f32) -> bool {
    (found - wanted).abs() <= share * wanted.abs()
}
