//! A species is tuned while it moves, in hertz and damping ratio: `cargo run -p sward --example tuning`.

use sward::model::NoAssets;
use sward::scene::{Scene, response};
use sward::world::World;

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let text = "(version: 1, stands: [(species: Meadow)], interactors: [(shape: Sphere(radius: 0.6), path: Circle(radius: 3, speed: 4))])";
    let mut world = World::new(Scene::parse(text, "tuning.ron")?, &NoAssets)?;
    (0..120).for_each(|_| world.step());
    // ANCHOR: tune
    // Half a second from the one to the other: nobody sees a jump.
    world.tune(0, response("Continuum(frequency: 0.8, damping: 0.15)")?, 0.5)?;
    // ANCHOR_END: tune
    let mut largest = 0.0_f32;
    for _ in 0..30 {
        let before = world.bend_at(0, [-2.0, 2.2]).unwrap_or_default();
        world.step();
        let now = world.bend_at(0, [-2.0, 2.2]).unwrap_or_default();
        largest = largest.max((now[0] - before[0]).hypot(now[1] - before[1]));
    }
    println!("at most {largest:.3} rad a step; now it sways at {:.2} Hz", world.model.stands[0].species.continuum.frequency());
    assert!((0.001..0.2).contains(&largest));
    // ANCHOR: refused
    // Another method is another state: that is a change of the scene.
    let refused = world.tune(0, response("Oscillator(frequency: 2)")?, 0.5);
    // ANCHOR_END: refused
    println!("refused: {}", refused.err().ok_or("it was taken")?);
    Ok(())
}
