//! A scene may change while it runs: what still fits goes on, what does not begins anew, and the same scene again changes no bit.

mod asked;
mod chance;
mod examples;
mod ground;
mod inputs;
mod kept;
mod matrix;
mod reactions;
mod shipped;

use sward::model::NoAssets;
use sward::scene::Scene;
use sward::world::{Fate, Kept, World};

/// Two stands of grass, some wind and a few bodies; `more` at the end. Patches are small, so that steps are fast.
struct Text {
    first: &'static str,
    second: &'static str,
    bodies: &'static str,
    more: &'static str,
}

const USUAL: Text = Text {
    first: "species: Meadow, cells: 16",
    second: "species: Tussock, cells: 8, response: Oscillator()",
    bodies: "(name: \"ball\", shape: Sphere(radius: 0.6), path: Circle(radius: 4, speed: 3)), (name: \"van\", shape: Truck, path: Driven(at: (3, 3)))",
    more: "",
};

impl Text {
    fn scene(&self) -> Scene {
        let Self { first, second, bodies, more } = self;
        let budget = if more.contains("budget") { "" } else { "budget: (patches: 9, focus_distance: 8)," };
        let text = format!(
            "(version: 1, field: (patch_side: 8), stands: [({first}), ({second})], wind: [Natural(velocity: (3, 1))],
             interactors: [{bodies}], {budget} {more})"
        );
        Scene::parse(&text, "live.ron").unwrap_or_else(|error| panic!("{error}\n{text}"))
    }

    fn world(&self) -> World {
        World::new(self.scene(), &NoAssets).unwrap()
    }
}

fn run(world: &mut World, steps: u32) -> u64 {
    (0..steps).for_each(|_| world.step());
    world.hash()
}

/// The usual world after some steps, and the same one with another scene in place of its own.
fn changed(text: &Text) -> (World, World, Kept) {
    let mut untouched = USUAL.world();
    run(&mut untouched, 60);
    let mut world = untouched.clone();
    let kept = world.rescene(text.scene(), &NoAssets).unwrap();
    (untouched, world, kept)
}

fn fates(fates: &[Fate]) -> Vec<bool> {
    fates.iter().map(|fate| fate.is_kept()).collect()
}
