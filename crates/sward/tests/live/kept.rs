//! What goes on when a scene changes, and what begins anew.

use super::{Text, USUAL, changed, fates, run};
use sward::model::NoAssets;
use sward::scene::Scene;
use sward::state::StandState;
use sward::world::{Fate, World};

fn same_cells(a: &StandState, b: &StandState) -> bool {
    a.awake == b.awake && a.cells.now == b.cells.now && a.cells.old == b.cells.old && a.cells.lag == b.cells.lag
}

pub(crate) fn is_finite(world: &World) -> bool {
    // Places of sheets are bits.
    let cells = world.state.stands.iter().zip(&world.model.stands).filter(|(_, model)| model.springs.is_none());
    let levels = cells.flat_map(|(stand, _)| stand.cells.now.iter().chain(&stand.cells.lag)).flatten();
    let planes = world.state.layered.iter().flat_map(|stand| &stand.waves.now).flatten();
    levels.chain(planes).all(|value| value.is_finite())
}

#[test]
fn another_stiffness_keeps_the_cells_and_moves_them_otherwise() {
    let (mut untouched, mut world, kept) =
        changed(&Text { first: "species: Meadow, cells: 16, response: Continuum(frequency: 3.0)", ..USUAL });
    assert!(kept.is_all(), "{kept:?}");
    assert!(world.save() == untouched.save() && world.model.stands[0].coefficients != untouched.model.stands[0].coefficients);
    assert_ne!(run(&mut world, 30), run(&mut untouched, 30), "control: it matters");
    assert!(!same_cells(&world.state.stands[0], &untouched.state.stands[0]));
    assert!(is_finite(&world));
}

#[test]
fn other_cells_begin_anew_and_leave_the_other_stand_alone() {
    let cells = Text { first: "species: Meadow, cells: 32", ..USUAL };
    let response = Text { first: "species: Meadow, cells: 16, response: Chain()", ..USUAL };
    let segments = Text { first: "species: Meadow, cells: 16, representation: Billboard(segments: 3)", ..USUAL };
    let sheets = Text { first: "species: Meadow, cells: 16, response: Springs()", ..USUAL };
    for text in [cells, response, segments, sheets] {
        let (untouched, mut world, kept) = changed(&text);
        assert_eq!(fates(&kept.stands), [false, true], "{}: {kept:?}", text.first);
        assert_eq!((fates(&kept.bodies), kept.ground), (vec![true, true], Fate::Kept));
        assert!(world.state.stands[0].awake.is_empty() && !untouched.state.stands[0].awake.is_empty());
        assert!(same_cells(&world.state.stands[1], &untouched.state.stands[1]) && !world.state.stands[1].awake.is_empty());
        assert_eq!(world.state.step, 60);
        run(&mut world, 10);
        assert!(!world.state.stands[0].awake.is_empty() && is_finite(&world), "{}", text.first);
    }
}

#[test]
fn stands_are_known_by_name() {
    let (untouched, world, kept) = changed(&Text { first: USUAL.second, second: USUAL.first, ..USUAL });
    assert_eq!(fates(&kept.stands), [true, true], "{kept:?}");
    assert!(
        same_cells(&world.state.stands[0], &untouched.state.stands[1]) && same_cells(&world.state.stands[1], &untouched.state.stands[0])
    );
    let (_, _, kept) = changed(&Text { first: "species: Meadow, cells: 16, name: \"hay\"", ..USUAL });
    assert_eq!(fates(&kept.stands), [true, true], "another name at the same place: {kept:?}");
    let (_, world, kept) = changed(&Text { first: "species: Shrub", ..USUAL });
    assert_eq!(kept.stands[1], Fate::Kept);
    assert!(!kept.stands[0].is_kept() && world.state.layered.len() == 1, "{kept:?}");
}

#[test]
fn a_broken_scene_changes_nothing() {
    let mut world = USUAL.world();
    run(&mut world, 60);
    let mut untouched = world.clone();
    let mut out_of_range = USUAL.scene();
    out_of_range.stands[0].cover = 7.0;
    let text = "(version: 1, interactors: [(shape: Mesh(file: \"nowhere.glb\"))])";
    for (scene, message) in [(out_of_range, "`cover` is 7, allowed 0 to 1"), (Scene::parse(text, "").unwrap(), "cannot be read")] {
        let error = world.rescene(scene, &NoAssets).unwrap_err();
        assert!(error.to_string().contains(message), "{error}");
        assert!(world.save() == untouched.save() && world.scene == untouched.scene);
    }
    assert_eq!(run(&mut world, 30), run(&mut untouched, 30));
    let sound = Text { more: "seed: 2", ..USUAL };
    assert!(world.rescene(sound.scene(), &NoAssets).is_ok() && world.scene != untouched.scene, "control");
}

#[test]
fn bodies_come_and_go_and_the_others_stay_where_they_are() {
    let ball = "(name: \"ball\", shape: Sphere(radius: 0.6), path: Circle(radius: 4, speed: 3))";
    let van = "(name: \"van\", shape: Truck, path: Driven(at: (3, 3)))";
    let make = |bodies: &[&str]| {
        let mut scene = USUAL.scene();
        let text = format!("(version: 1, interactors: [{}])", bodies.join(","));
        scene.interactors = Scene::parse(&text, "bodies.ron").unwrap().interactors;
        scene
    };
    let mut world = USUAL.world();
    assert!(world.drive(1, [-2.0, 5.0], 1.0, 0.0));
    run(&mut world, 60);
    let before = world.state.bodies.clone();
    let kept = world.rescene(make(&["(shape: Sphere())", van, ball]), &NoAssets).unwrap();
    assert_eq!(fates(&kept.bodies), [false, true, true]);
    assert_eq!(world.state.bodies[1..], [before[1], before[0]]);
    assert!(world.state.bodies[0].pose.is_some() && world.state.bodies[1].driven.is_some());
    let kept = world.rescene(make(&[van]), &NoAssets).unwrap();
    assert_eq!((fates(&kept.bodies), &world.state.bodies[..]), (vec![true], &before[1..]));
    run(&mut world, 10);
    assert_eq!(world.state.bodies[0].pose, before[1].pose, "it stands where it was driven");
    let renamed = make(&["(name: \"bus\", shape: Truck, path: Driven(at: (3, 3)))", "(name: \"van\", shape: Sphere())"]);
    let kept = world.rescene(renamed, &NoAssets).unwrap();
    assert_eq!(fates(&kept.bodies), [false, true], "a name outweighs a shape");
}

#[test]
fn another_origin_or_length_of_steps_begins_anew() {
    let (_, mut world, kept) = changed(&Text { more: "origin: (1, 0)", ..USUAL });
    assert!([&kept.bodies, &kept.stands].iter().all(|fates| fates.iter().all(|fate| !fate.is_kept())) && !kept.ground.is_kept());
    assert_eq!(world.state.step, 60);
    let mut elsewhere = Text { more: "origin: (1, 0)", ..USUAL }.world();
    run(&mut elsewhere, 60);
    let poses = |world: &World| world.state.bodies.iter().map(|body| body.pose).collect::<Vec<_>>();
    assert_eq!(poses(&world), poses(&elsewhere), "bodies are where that scene has them by now");
    run(&mut world, 10);
    assert!(is_finite(&world));
    let (_, mut world, kept) = changed(&Text { more: "steps_per_second: 120", ..USUAL });
    assert_eq!((fates(&kept.bodies), fates(&kept.stands)), (vec![true, true], vec![false, false]));
    assert_eq!((world.state.step, world.time()), (120, 1.0));
    run(&mut world, 10);
    assert!(is_finite(&world));
}

#[test]
fn a_smaller_budget_begins_anew_where_it_has_no_room() {
    let with = |patches: u32| {
        let mut scene = USUAL.scene();
        (scene.budget.patches, scene.budget.focus_distance) = (patches, 20.0);
        scene
    };
    for (patches, expected) in [(200, true), (9, false)] {
        let mut world = World::new(with(40), &NoAssets).unwrap();
        run(&mut world, 60);
        assert!(world.state.stands[0].awake.len() > 9);
        let kept = world.rescene(with(patches), &NoAssets).unwrap();
        assert_eq!(kept.stands[0].is_kept(), expected, "{kept:?}");
        run(&mut world, 30);
        assert!(world.state.stands.iter().all(|stand| stand.awake.len() + stand.free.len() == patches as usize), "{patches}");
        assert!(is_finite(&world));
    }
}

#[test]
fn meshes_and_air_go_on_where_their_planes_have_the_same_size() {
    let scene = |stand: &str, fluid: &str| {
        let text = format!(
            "(version: 1, field: (patch_side: 8), stands: [(species: Shrub{stand})], wind: [Fluid(side: 16, velocity: (2, 1){fluid})],
             interactors: [(shape: Sphere(radius: 0.6), path: Circle(radius: 4, speed: 3))])"
        );
        Scene::parse(&text, "meshes.ron").unwrap()
    };
    let mut untouched = World::new(scene("", ""), &NoAssets).unwrap();
    run(&mut untouched, 60);
    for (stand, fluid, expected) in [
        (", response: Harmonic(gain: 2.0)", "", [true, true]),
        (", response: Harmonic(cells: 32)", "", [false, true]),
        (", response: Harmonic(side: 5.0)", "", [false, true]),
        (", cover: 0.5", ", viscosity: 0.1", [true, true]),
        ("", ", cells: 32", [true, false]),
    ] {
        let mut world = untouched.clone();
        let kept = world.rescene(scene(stand, fluid), &NoAssets).unwrap();
        assert_eq!((fates(&kept.stands), fates(&kept.fluids)), (vec![expected[0]], vec![expected[1]]), "{stand} {fluid}");
        assert_eq!(world.state.layered[0].waves == untouched.state.layered[0].waves, expected[0], "{stand} {fluid}");
        assert_eq!(world.state.fluids == untouched.state.fluids, expected[1], "{stand} {fluid}");
        run(&mut world, 10);
        assert!(is_finite(&world) && !world.state.layered[0].cuts.is_empty());
    }
}
