//! Grass is cut, burns and grows again: `cargo run -p sward --example growth`.

use sward::model::NoAssets;
use sward::scene::{Change, Cut, Edit, Regrow, Scene};
use sward::world::World;

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut world = World::new(Scene::parse("(version: 1, stands: [(species: Meadow)])", "growth.ron")?, &NoAssets)?;
    // ANCHOR: brush
    let brush = |at: [f64; 2], change: Change| Edit { at, radius: 2.0, change, ..Edit::default() };
    // ANCHOR_END: brush
    let height = |world: &World| world.cover_height_at([1.0, 1.0]);
    println!("it is {:.2} m high", height(&world));
    // ANCHOR: cut
    // A mower: a stroke every metre.
    for metre in 0..6 {
        world.edit(&brush([f64::from(metre), 1.0], Change::Cut(Cut { height: 0.06 })))?;
    }
    // ANCHOR_END: cut
    println!("cut: {:.2} m", height(&world));
    assert!(height(&world) < 0.08);
    // ANCHOR: regrow
    world.edit(&brush([1.0, 1.0], Change::Burn))?;
    println!("burnt: {:.2} m", height(&world));
    assert_eq!(height(&world), 0.0);
    world.edit(&brush([1.0, 1.0], Change::Regrow(Regrow { over: 3.0 })))?;
    // ANCHOR_END: regrow
    for _ in 0..3 {
        (0..60).for_each(|_| world.step());
        println!("a second later: {:.2} m", height(&world));
    }
    assert!(height(&world) > 0.2);
    Ok(())
}
