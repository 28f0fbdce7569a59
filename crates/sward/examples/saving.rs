//! A world is saved and loaded, and goes on to the bit: `cargo run -p sward --example saving`.

use sward::model::NoAssets;
use sward::scene::{Change, Edit, Interactor, Scene};
use sward::world::World;

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let text =
        "(version: 1, stands: [(species: Meadow)], wind: [Natural()], interactors: [(shape: Truck, path: Circle(radius: 6, speed: 5))])";
    let mut world = World::new(Scene::parse(text, "saving.ron")?, &NoAssets)?;
    (0..60).for_each(|_| world.step());
    // What came while it ran is saved, too.
    world.add_body(Interactor::default(), &NoAssets)?;
    world.edit(&Edit { at: [3.0, 3.0], change: Change::Burn, ..Edit::default() })?;
    // ANCHOR: save
    let bytes = world.save_world();
    let mut loaded = World::load(&bytes, &NoAssets)?;
    // ANCHOR_END: save
    (0..60).for_each(|_| world.step());
    (0..60).for_each(|_| loaded.step());
    println!("{} kB; a second later {:016x} and {:016x}", bytes.len() / 1000, world.hash(), loaded.hash());
    assert_eq!(world.hash(), loaded.hash());
    Ok(())
}
