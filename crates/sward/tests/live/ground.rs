//! Edits of the ground from code outlive a change of the scene.

use super::{Text, USUAL, run};
use sward::model::NoAssets;
use sward::scene::{Change, Edit, Raise};
use sward::world::World;

const RAISED: Text = Text { more: "edits: [(time: 0.5, at: (2, 2), radius: 3, change: Raise(height: 1))]", ..USUAL };

fn height(world: &World, at: [f64; 2]) -> f64 {
    world.model.terrain.height_at(at[0], at[1])
}

/// A world that the scene and code have edited.
fn edited() -> World {
    let mut world = RAISED.world();
    run(&mut world, 40);
    let edit = Edit { at: [-6.0, 1.0], radius: 4.0, change: Change::Raise(Raise { height: 2.0 }), ..Edit::default() };
    world.edit(&edit).unwrap();
    run(&mut world, 5);
    world
}

#[test]
fn edits_from_code_stay_and_those_of_the_scene_are_the_new_ones() {
    let untouched = edited();
    let mut world = untouched.clone();
    let kept = world.rescene(RAISED.scene(), &NoAssets).unwrap();
    assert!(kept.is_all() && world.save() == untouched.save(), "the same edits: {kept:?}");
    let higher = Text { more: "edits: [(time: 0.5, at: (2, 2), radius: 3, change: Raise(height: 1.5))]", ..USUAL };
    let later = Text { more: "edits: [(time: 50, at: (2, 2), radius: 3, change: Raise(height: 1.5))]", ..USUAL };
    let hills = Text { more: "terrain: Flat(height: 3)", ..USUAL };
    for (text, expected) in [(higher, [1.5, 2.0]), (later, [0.0, 2.0]), (USUAL, [0.0, 2.0]), (hills, [3.0, 5.0])] {
        let mut world = untouched.clone();
        let changes = world.model.terrain.changes();
        let kept = world.rescene(text.scene(), &NoAssets).unwrap();
        assert!(kept.is_all(), "{}: {kept:?}", text.more);
        let heights = [height(&world, [2.0, 2.0]), height(&world, [-6.0, 1.0])];
        assert!((0..2).all(|at| (heights[at] - expected[at]).abs() < 1e-3), "{}: {heights:?}", text.more);
        assert_ne!(world.model.terrain.changes(), changes, "who follows the ground sees that it is another");
        let stand = &world.state.stands[0];
        let under = stand.cells.ground[stand.awake[&[0, 0]].slot as usize].height(16, 4 * 16 + 4);
        assert!((f64::from(under) - expected[0]).abs() < 0.2, "{}: {under} under the cells", text.more);
        run(&mut world, 10);
    }
    let mut world = untouched.clone();
    world.rescene(Text { more: "origin: (1, 0)", ..USUAL }.scene(), &NoAssets).unwrap();
    assert_eq!(height(&world, [-6.0, 1.0]), 0.0, "control: another origin begins anew");
}
