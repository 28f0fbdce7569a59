//! The same field with another response, for the other half of the window.

use sward::scene::{Response, Scene};

/// What menus say, and a response with its usual numbers.
type Named = (&'static str, fn() -> Response);

/// Responses that a stand of grass can have, with what menus say.
pub const RESPONSES: [Named; 5] = [
    ("continuum", || Response::Continuum(Default::default())),
    ("oscillator", || Response::Oscillator(Default::default())),
    ("springs", || Response::Springs(Default::default())),
    ("chain", || Response::Chain(Default::default())),
    ("virtual inertia", || Response::VirtualInertia(Default::default())),
];

/// The scene with response number `response` for each stand of grass; one that has it already keeps its numbers, and so does a blade that moves by
/// itself in either way: it is made of the same.
pub fn with_response(scene: &Scene, response: usize) -> Scene {
    let mut scene = scene.clone();
    let Some((_, response)) = RESPONSES.get(response) else { return scene };
    for stand in scene.stands.iter_mut().filter(|stand| !stand.species.is_mesh()) {
        stand.response = Some(match (stand.response.take(), response()) {
            (Some(Response::Chain(blade) | Response::VirtualInertia(blade)), Response::Chain(_)) => Response::Chain(blade),
            (Some(Response::Chain(blade) | Response::VirtualInertia(blade)), Response::VirtualInertia(_)) => {
                Response::VirtualInertia(blade)
            }
            (Some(own), other) if std::mem::discriminant(&own) == std::mem::discriminant(&other) => own,
            (_, other) => other,
        });
    }
    scene
}

/// Names of the responses of a scene's stands of grass, as menus say them.
pub fn names(scene: &Scene) -> String {
    let name = |stand: &sward::scene::Stand| {
        let own = stand.response.clone().unwrap_or_else(RESPONSES[0].1);
        RESPONSES.iter().find(|(_, other)| std::mem::discriminant(&other()) == std::mem::discriminant(&own)).map(|(name, _)| *name)
    };
    let mut names: Vec<&str> = scene.stands.iter().filter(|stand| !stand.species.is_mesh()).filter_map(name).collect();
    names.dedup();
    names.join(", ")
}

#[cfg(test)]
mod tests {
    use sward::world::World;

    use super::*;

    #[test]
    fn every_scene_of_grass_can_be_seen_with_every_response_it_has_room_for() {
        let mut refused = Vec::new();
        for shipped in
            sward_scenes::SHIPPED.iter().filter(|shipped| ["hello", "blades", "stamp", "footsteps", "grassland"].contains(&shipped.name))
        {
            let scene = Scene::parse(shipped.text, shipped.name).expect("valid");
            for (index, (name, _)) in RESPONSES.iter().enumerate() {
                let other = with_response(&scene, index);
                assert_eq!(names(&other), *name, "{}", shipped.name);
                if let Err(error) = World::new(other, &sward_scenes::Embedded) {
                    refused.push((shipped.name, *name, error.to_string()));
                }
            }
        }
        // Its lawn is so fine that not every blade can have a state of its own, and that is told.
        let names: Vec<_> = refused.iter().map(|(scene, response, _)| (*scene, *response)).collect();
        assert_eq!(names, [("footsteps", "chain"), ("footsteps", "virtual inertia")], "{refused:?}");
        assert!(refused.iter().all(|(_, _, words)| words.contains("can have a state")), "{refused:?}");
    }

    #[test]
    fn a_stand_that_has_the_response_keeps_its_numbers() {
        let text = "(version: 1, stands: [(species: Meadow, response: Continuum(c0: 0.8)), (species: Lawn, response: Oscillator())])";
        let scene = Scene::parse(text, "x").expect("valid");
        let other = with_response(&scene, 0);
        assert_eq!(other.stands[0], scene.stands[0]);
        assert_ne!(other.stands[1], scene.stands[1], "control");
    }
}
