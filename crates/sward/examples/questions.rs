//! What a game asks: am I hidden, how does the wind blow, what grows here? `cargo run -p sward --example questions`.

use sward::model::NoAssets;
use sward::scene::Scene;
use sward::world::World;

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let text = "(version: 1, stands: [(species: Reed)], wind: [Natural(velocity: (2, 0))],
                 interactors: [(shape: Truck, path: Keyframes(keys: [(time: 0, at: (-8, 0)), (time: 3, at: (8, 0))]))])";
    let mut world = World::new(Scene::parse(text, "questions.ron")?, &NoAssets)?;
    (0..180).for_each(|_| world.step());
    // ANCHOR: cover
    for (what, place) in [("beside the track", [0.0, 6.0]), ("in the track", [5.0, 0.0])] {
        let cover = world.cover_height_at(place);
        let hidden = if cover > 0.7 { "hides" } else { "does not hide" };
        println!("{what} reed stands {cover:.2} m high, and {hidden} who crouches");
    }
    // ANCHOR_END: cover
    assert!(world.cover_height_at([5.0, 0.0]) < 0.6 * world.cover_height_at([0.0, 6.0]));
    // ANCHOR: ask
    let lean = world.bend_at(0, [5.0, 0.0]).unwrap_or_default();
    println!("there it leans by {:.2} rad, and the wind blows at {:.1} m/s", lean[0].hypot(lean[1]), world.wind_at([5.0, 0.0])[0]);
    let plants = world.plants_in([[4.0, -1.0], [6.0, 1.0]], 1000);
    println!("{} plants stand in 2 m × 2 m, up to {:.2} m long", plants.len(), plants.iter().map(|plant| plant.length).fold(0.0, f32::max));
    // ANCHOR_END: ask
    // ANCHOR: many
    // Of many places at once.
    let places: Vec<[f64; 2]> = (0..1000).map(|k| [f64::from(k % 40) * 0.5 - 10.0, f64::from(k / 40) * 0.5 - 6.0]).collect();
    let low = world.cover_heights_at(&places).into_iter().filter(|cover| *cover < 0.4).count();
    // ANCHOR_END: many
    println!("{low} of {} places give no cover", places.len());
    Ok(())
}
