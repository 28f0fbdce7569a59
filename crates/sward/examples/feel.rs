//! What plants do to bodies: forces for physics, events for sound and particles: `cargo run -p sward --example feel`.

use sward::model::NoAssets;
use sward::scene::Scene;
use sward::state::Happening;
use sward::world::World;

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let text = "(version: 1, stands: [(species: Reed)],
        interactors: [(name: \"boar\", shape: Ellipsoid(radii: (0.3, 0.4, 0.7)), path: Driven(at: (0, 0)))])";
    let mut world = World::new(Scene::parse(text, "feel.ron")?, &NoAssets)?;
    let (mut speed, mut at, mut heard) = (6.0, 0.0, 0);
    // ANCHOR: feel
    // Without legs: thrown into the reed, and braked by it alone.
    while speed > 0.5 && at < 40.0 {
        at += speed / 60.0;
        world.drive(0, [at, 0.0], std::f64::consts::FRAC_PI_2, 0.0);
        world.step();
        if let Some(felt) = world.reaction(0) {
            // N over a mass of 60 kg, for a sixtieth of a second; a turn about the vertical would be felt.torque[1].
            speed += felt.force[0] / 60.0 / 60.0;
        }
        for event in world.take_events() {
            match event.what {
                Happening::Entered => println!("rustle at {:.1} m", event.at[0]),
                Happening::Crushed { plants, energy } => {
                    heard += plants;
                    println!("crackle: {plants} stems, {energy:.2} J");
                }
                Happening::Left => println!("silence"),
            }
        }
    }
    // ANCHOR_END: feel
    println!("it has come {at:.1} m far and broken {heard} stems; it still runs at {speed:.1} m/s");
    assert!(speed < 5.0 && heard > 10);
    Ok(())
}
