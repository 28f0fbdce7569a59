//! What a world cares about where there is no camera: `cargo run -p sward --example focus`.

use sward::model::NoAssets;
use sward::scene::Scene;
use sward::world::World;

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let text = "(version: 1, stands: [(species: Meadow, cells: 64)], wind: [Natural(velocity: (4, 1))], budget: (focus_distance: 40, patches: 64))";
    let mut world = World::new(Scene::parse(text, "focus.ron")?, &NoAssets)?;
    // ANCHOR: focus
    // Two players, 300 m apart. Around them wind moves every cell; elsewhere plants stand as the wind of the moment has them, which costs nothing.
    world.state.pinned = vec![[0.0, 0.0], [300.0, 0.0]];
    world.step();
    // ANCHOR_END: focus
    let near = |x: f64| world.state.stands[0].awake.keys().filter(|patch| (f64::from(patch[0]) * 32.0 - x).abs() < 80.0).count();
    println!("{} patches around the one, {} around the other", near(0.0), near(300.0));
    assert!(near(0.0) > 2 && near(300.0) > 2);
    Ok(())
}
