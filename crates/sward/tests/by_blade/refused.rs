//! Blades that cannot be.

use sward::model::NoAssets;
use sward::scene::Scene;
use sward::world::World;

/// What is said of a stand that a scene cannot have.
fn said(stand: &str) -> String {
    let text = format!("(version: 1, stands: [{stand}])");
    let scene = Scene::parse(&text, "test.ron");
    let world = scene.and_then(|scene| World::new(scene, &NoAssets).map_err(|error| error.located(&text, "test.ron")));
    world.err().map(|error| error.to_string()).unwrap_or_default()
}

#[test]
fn blades_that_cannot_be_are_refused_with_what_to_write() {
    let cases = [
        ("(species: Reed, height: (4.0, 5.0), response: Chain())", "cannot stand"),
        ("(species: Meadow, response: VirtualInertia(mass: 5.0))", "cannot stand"),
        ("(species: Meadow, response: VirtualInertia(rigidity_root: 0.0))", "rigidity_root"),
        ("(species: Meadow, cells: 256, response: Chain(), representation: Blade(blades: 64))", "can have a state"),
        ("(species: Meadow, response: Chain(frequency: 0.0))", "frequency"),
        ("(species: Meadow, response: Chain(kappa: 3.0))", "kappa"),
    ];
    for (stand, word) in cases {
        let said = said(stand);
        assert!(said.contains(word) && said.contains("test.ron:1:"), "{stand}: {said:?}");
    }
    // Control.
    assert_eq!(said("(species: Meadow, cells: 64, response: Chain(frequency: 2.0, drag_power: Square))"), "");
}
