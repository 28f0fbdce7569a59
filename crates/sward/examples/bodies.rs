//! Bodies come, move, jump and go while a world runs: `cargo run -p sward --example bodies`.

use sward::model::NoAssets;
use sward::scene::{Driven, Interactor, Path, Scene, Shape, Sphere};
use sward::world::World;

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut world = World::new(Scene::parse("(version: 1, stands: [(species: Meadow)])", "bodies.ron")?, &NoAssets)?;
    // ANCHOR: add
    let ball = Interactor {
        shape: Shape::Sphere(Sphere { radius: 0.6 }),
        path: Path::Driven(Driven { at: [0.0, 0.0], yaw: 0.0 }),
        ..Interactor::default()
    };
    let ball = world.add_body(ball, &NoAssets)?;
    // ANCHOR_END: add
    // ANCHOR: drive
    // Once per frame of a game: where it is, which way it looks, how high above the ground.
    for frame in 0..60 {
        world.drive(ball, [f64::from(frame) * 0.05, 0.0], 0.0, 0.0);
        world.advance(1.0 / 60.0);
    }
    // ANCHOR_END: drive
    let lean = |world: &World, x: f64| world.bend_at(0, [x, 0.1]).map_or(0.0, |[x, z]| x.hypot(z));
    println!("behind the ball grass leans by {:.2} rad", lean(&world, 2.3));
    assert!(lean(&world, 2.3) > 0.3);
    // ANCHOR: teleport
    // Elsewhere at once: nothing between is swept.
    world.teleport(ball, [20.0, 0.0], 0.0, 0.0);
    // ANCHOR_END: teleport
    (0..240).for_each(|_| world.step());
    println!("four seconds later there, {:.3} rad; on the way, {:.3} rad", lean(&world, 2.3), lean(&world, 12.0));
    assert!(lean(&world, 2.3) < 0.1 && lean(&world, 12.0) < 0.01);
    // ANCHOR: remove
    world.remove_body(ball);
    // ANCHOR_END: remove
    (0..600).for_each(|_| world.step());
    println!("without it {} patches are awake", world.state.stands[0].awake.len());
    assert!(world.state.stands[0].awake.is_empty());
    Ok(())
}
