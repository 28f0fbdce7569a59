//! What a player did is recorded, and happens again: `cargo run -p sward --example replay`.

use sward::model::NoAssets;
use sward::scene::Scene;
use sward::world::{Log, World};

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let text = "(version: 1, stands: [(species: Meadow)], wind: [Natural()], interactors: [(shape: Truck, path: Driven())])";
    let mut world = World::new(Scene::parse(text, "replay.ron")?, &NoAssets)?;
    // ANCHOR: record
    let mut again = world.clone();
    world.record();
    for step in 0..180_u32 {
        let turn = f64::from(step) * 0.02;
        world.drive(0, [4.0 * turn.sin(), 4.0 - 4.0 * turn.cos()], turn + 1.57, 0.0);
        world.step();
    }
    let log = world.log.take().ok_or("nothing was recorded")?.to_ron();
    // ANCHOR_END: record
    println!("{} kB of text tell it all, like {}", log.len() / 1000, log.lines().nth(4).unwrap_or_default().trim());
    // ANCHOR: again
    Log::parse(&log)?.replay(&mut again, &NoAssets, &mut |_| ())?;
    println!("{:016x} and {:016x}", world.hash(), again.hash());
    assert_eq!(world.hash(), again.hash());
    // ANCHOR_END: again
    Ok(())
}
