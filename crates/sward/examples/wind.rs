//! Wind comes, changes and goes without a jump: `cargo run -p sward --example wind`.

use sward::model::NoAssets;
use sward::scene::{Footprint, Interactor, Natural, Scene, WindSource};
use sward::world::World;

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut world = World::new(Scene::parse("(version: 1, stands: [(species: Reed)])", "wind.ron")?, &NoAssets)?;
    // ANCHOR: add
    let breeze = WindSource::Natural(Natural { velocity: [3.0, 1.0], turbulence: 0.3 });
    let breeze = world.add_wind(breeze, 2.0, &NoAssets)?;
    // ANCHOR_END: add
    // ANCHOR: rotor
    // Wind that moves stays with a body, which may have no shape to touch with: here high above the ground.
    let rotor = Interactor { name: "rotor".to_owned(), clearance: 8.0, ..Interactor::default() };
    world.add_body(rotor, &NoAssets)?;
    let downwash = Footprint { follow: Some("rotor".to_owned()), radius: 8.0, speed: 20.0, ..Footprint::default() };
    world.add_wind(WindSource::Footprint(downwash), 1.0, &NoAssets)?;
    // ANCHOR_END: rotor
    for second in 0..4 {
        (0..60).for_each(|_| world.step());
        let ([x, z], lean) = (world.wind_at([4.0, 0.0]), world.bend_at(0, [4.0, 0.0]).unwrap_or_default());
        println!("after {} s: wind ({x:.1}, {z:.1}) m/s, reed leans by {:.2} rad", second + 1, lean[0].hypot(lean[1]));
    }
    // ANCHOR: change
    // Another breeze in place of the first: the one fades while the other grows.
    let gale = WindSource::Natural(Natural { velocity: [-9.0, 4.0], turbulence: 0.4 });
    world.change_wind(breeze, gale, 2.0, &NoAssets)?;
    // ANCHOR_END: change
    (0..180).for_each(|_| world.step());
    let [x, _] = world.wind_at([40.0, 0.0]);
    println!("far from the rotor the gale blows at {x:.1} m/s along x");
    assert!(x < -2.0);
    Ok(())
}
