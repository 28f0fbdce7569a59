//! Bodies, wind, responses and growth change between steps; all of it can be recorded, saved and replayed.

use super::kept::is_finite;
use super::{Text, USUAL, run};
use sward::model::NoAssets;
use sward::saved::LoadError;
use sward::scene::{
    BoxShape, Change, Circle, Cut, Edit, Fluid, Footprint, Interactor, Natural, Path, Regrow, Response, Shape, Sphere, Still, Uniform,
    WindSource,
};
use sward::view::View;
use sward::world::{Input, Log, LogError, World};

fn ball(at: [f64; 2]) -> Interactor {
    Interactor { shape: Shape::Sphere(Sphere { radius: 0.6 }), path: Path::Still(Still { at, yaw: 0.0 }), ..Interactor::default() }
}

fn calm(more: &'static str) -> World {
    let mut scene = Text { bodies: "", more, ..USUAL }.scene();
    scene.wind.clear();
    World::new(scene, &NoAssets).unwrap()
}

/// How far plants lean at most within half a metre of a place.
fn leaning(world: &World, stand: usize, at: [f64; 2]) -> f32 {
    let places: Vec<[f64; 2]> = (0..9).map(|k| [at[0] + 0.5 * f64::from(k % 3 - 1), at[1] + 0.5 * f64::from(k / 3 - 1)]).collect();
    world.bends_at(stand, &places).into_iter().map(tilt).fold(0.0, f32::max)
}

fn tilt(bend: Option<[f32; 2]>) -> f32 {
    bend.map(|[x, z]| x.hypot(z)).unwrap()
}

#[test]
fn a_body_that_comes_bends_and_one_that_goes_leaves_nothing() {
    let mut world = calm("");
    run(&mut world, 5);
    let number = world.add_body(ball([1.0, 1.0]), &NoAssets).unwrap();
    assert!(world.state.bodies[number].pose.is_some(), "it is there at once");
    run(&mut world, 60);
    for stand in 0..2 {
        assert!(leaning(&world, stand, [1.0, 1.0]) > 0.3, "stand {stand}");
        assert!(leaning(&world, stand, [4.6, 4.6]) < 0.05, "control, stand {stand}");
    }
    assert!(world.remove_body(number));
    assert!(!world.remove_body(number) && !world.remove_body(99), "once");
    run(&mut world, 600);
    for stand in 0..2 {
        assert!(leaning(&world, stand, [1.0, 1.0]) < 0.01, "stand {stand} stands up");
    }
    assert!(world.state.stands.iter().all(|stand| stand.awake.is_empty()), "and sleeps");
    // Its place is taken by the next, and lists do not grow.
    for _ in 0..100 {
        let again = world.add_body(ball([0.0, 0.0]), &NoAssets).unwrap();
        assert_eq!(again, number);
        assert!(world.remove_body(again));
    }
    assert_eq!((world.scene.interactors.len(), world.model.bodies.len(), world.state.bodies.len()), (1, 1, 1));
}

#[test]
fn bodies_that_cannot_be_change_nothing() {
    let mut world = USUAL.world();
    run(&mut world, 10);
    let (saved, scene) = (world.save_world(), world.scene.clone());
    let wrong = [
        Interactor { name: "ball".to_owned(), ..ball([0.0; 2]) },
        Interactor { shape: Shape::Sphere(Sphere { radius: -1.0 }), ..ball([0.0; 2]) },
        Interactor { from: 3.0, until: 2.0, ..ball([0.0; 2]) },
        ball([f64::NAN, 0.0]),
        Interactor { shape: Shape::Mesh(sward::scene::MeshShape { file: "none.glb".to_owned(), ..Default::default() }), ..ball([0.0; 2]) },
    ];
    for body in wrong {
        let error = world.add_body(body.clone(), &NoAssets).expect_err("refused");
        assert!(error.to_string().starts_with("interactors[2]") || error.to_string().contains("none.glb"), "{error}");
    }
    assert!(
        world.lead(9, Path::Still(Still::default())).is_err()
            && world.lead(0, Path::Circle(Circle { radius: -1.0, ..Circle::default() })).is_err()
    );
    assert!(!world.teleport(0, [f64::INFINITY, 0.0], 0.0, 0.0) && !world.teleport(7, [0.0; 2], 0.0, 0.0));
    assert!(world.save_world() == saved && world.scene == scene);
    assert!(world.add_body(ball([0.0; 2]), &NoAssets).is_ok(), "control");
}

#[test]
fn a_body_that_teleports_sweeps_nothing() {
    let way = |jumps: bool| {
        let mut world = calm("");
        let body = world.add_body(Interactor { path: Path::Driven(Default::default()), ..ball([0.0; 2]) }, &NoAssets).unwrap();
        run(&mut world, 30);
        // Slow enough to be swept: 2 m in a step is 120 m/s.
        if jumps {
            world.teleport(body, [2.0, 0.0], 0.0, 0.0)
        } else {
            world.drive(body, [2.0, 0.0], 0.0, 0.0)
        };
        run(&mut world, 1);
        tilt(world.bend_at(0, [1.125, 0.125]))
    };
    assert!(way(true) < 0.1 && way(false) > 0.3, "{} {}", way(true), way(false));
}

#[test]
fn a_camera_and_wind_that_follow_a_body_outlive_it() {
    let mut scene = USUAL.scene();
    scene.camera.follow = Some("ball".to_owned());
    scene.wind.push(WindSource::Footprint(Footprint { follow: Some("ball".to_owned()), ..Footprint::default() }));
    let mut world = World::new(scene, &NoAssets).unwrap();
    run(&mut world, 30);
    let view = world.camera();
    assert!(world.remove_body(0));
    let close = |a: [f64; 3], b: [f64; 3]| (0..3).all(|axis| (a[axis] - b[axis]).abs() < 1e-9);
    assert!(close(world.camera().eye, view.eye) && close(world.camera().target, view.target));
    assert!(world.state.winds[1].vacant && world.scene.validate().is_ok());
    run(&mut world, 30);
    assert!(is_finite(&world));
}

#[test]
fn wind_fades_in_and_out_without_a_jump() {
    for source in [
        WindSource::Uniform(Uniform { velocity: [6.0, 0.0] }),
        WindSource::Natural(Natural { velocity: [6.0, 2.0], turbulence: 0.5 }),
        WindSource::Footprint(Footprint { radius: 6.0, ..Footprint::default() }),
        WindSource::Fluid(Fluid { velocity: [5.0, 0.0], ..Fluid::default() }),
    ] {
        let mut world = calm("");
        world.add_body(ball([3.0, 3.0]), &NoAssets).unwrap();
        run(&mut world, 30);
        // One place where patches are awake, and one where they sleep.
        let places = [[1.0, 1.2], [30.0, 30.0]];
        let look = |world: &World| -> Vec<f32> {
            (0..2).flat_map(|stand| places.map(|place| world.bend_at(stand, place).unwrap())).flatten().collect()
        };
        let follow = |world: &mut World, steps: u32| {
            let (mut before, mut jump) = (look(world), 0.0_f32);
            for _ in 0..steps {
                run(world, 1);
                let now = look(world);
                jump = before.iter().zip(&now).map(|(a, b)| (a - b).abs()).fold(jump, f32::max);
                before = now;
            }
            jump
        };
        let still = look(&world);
        let number = world.add_wind(source.clone(), 1.0, &NoAssets).unwrap();
        let rising = follow(&mut world, 120);
        let blown = look(&world);
        assert!(still.iter().zip(&blown).any(|(a, b)| (a - b).abs() > 0.03), "{source:?}: it moves something: {still:?} {blown:?}");
        assert!(world.remove_wind(number, 1.0) && !world.remove_wind(number, 1.0));
        let falling = follow(&mut world, 1500);
        assert!(rising < 0.05 && falling < 0.05, "{source:?}: jumps by {rising} and {falling}");
        assert!(world.state.winds[number].vacant && world.winds_at(&places) == [[0.0; 2]; 2], "{source:?}");
        assert!(look(&world).iter().all(|bend| bend.abs() < 2e-3), "{source:?}: {:?}", look(&world));
        // Control: at once it jumps.
        world.add_wind(WindSource::Uniform(Uniform { velocity: [9.0, 0.0] }), 0.0, &NoAssets).unwrap();
        assert!(follow(&mut world, 2) > 0.05, "control");
    }
}

#[test]
fn gusts_of_one_source_do_not_depend_on_others() {
    let natural = |x: f32| WindSource::Natural(Natural { velocity: [x, 0.0], turbulence: 0.4 });
    let mut scene = USUAL.scene();
    scene.wind = vec![WindSource::Uniform(Uniform { velocity: [0.0, 0.0] }), natural(4.0)];
    let mut alone = World::new(scene, &NoAssets).unwrap();
    let mut changed = alone.clone();
    assert!(changed.remove_wind(0, 0.0));
    run(&mut alone, 50);
    run(&mut changed, 50);
    assert_eq!(alone.wind_at([3.0, 1.0]), changed.wind_at([3.0, 1.0]));
    assert_eq!(changed.add_wind(natural(4.0), 0.0, &NoAssets).unwrap(), 0);
    let [a, b] = [alone.wind_at([3.0, 1.0]), changed.wind_at([3.0, 1.0])];
    assert!((b[0] - 2.0 * a[0]).abs() > 0.05, "a second one has gusts of its own: {a:?} {b:?}");
    let other = changed.change_wind(1, natural(-4.0), 0.5, &NoAssets).unwrap();
    assert_eq!(other, 2, "beside the one that fades");
    run(&mut changed, 40);
    assert!(changed.state.winds[1].vacant);
    assert!(changed.change_wind(1, natural(1.0), 0.5, &NoAssets).is_err());
    let nine = (0..9).map(|_| changed.add_wind(WindSource::Footprint(Footprint::default()), 0.0, &NoAssets)).filter(Result::is_ok).count();
    assert_eq!(nine, 8, "no more than the kernels have room for");
}

#[test]
fn responses_glide_without_a_jump() {
    // The same methods, much softer and much stiffer.
    let cases: [(&'static str, [&str; 2]); 5] = [
        (
            "species: Meadow, cells: 16",
            ["Continuum(frequency: 0.8, damping: 0.2, wind: 0.08)", "Continuum(frequency: 3, damping: 0.6, wind: 0.01)"],
        ),
        (
            "species: Meadow, cells: 16, response: Oscillator()",
            ["Oscillator(frequency: 1.2, wind: 4)", "Oscillator(frequency: 4, damping: 1.5)"],
        ),
        (
            "species: Meadow, cells: 16, response: VirtualInertia()",
            ["VirtualInertia(mass: 8e-4, drag: 3e-3)", "VirtualInertia(rigidity_root: 2e-3)"],
        ),
        ("species: Meadow, cells: 16, response: Chain()", ["Chain(frequency: 3)", "Chain(rigidity_root: 2e-3, damping: 0.6)"]),
        ("species: Meadow, cells: 16, response: Springs()", ["Springs(wind: 0.1, recover: 6)", "Springs(recover: 1)"]),
    ];
    let mut largest = 0.0_f32;
    for (first, others) in cases {
        let mut world =
            Text { first, bodies: "(shape: Sphere(radius: 0.6), path: Circle(radius: 2, speed: 3), until: 1)", ..USUAL }.world();
        run(&mut world, 70);
        let places: Vec<[f64; 2]> = (0..40).map(|k| [f64::from(k % 8) * 0.7 - 2.6, f64::from(k / 8) * 1.1 - 2.3]).collect();
        let look = |world: &World| -> Vec<[f32; 2]> { world.bends_at(0, &places).into_iter().flatten().collect() };
        let apart = |a: &[[f32; 2]], b: &[[f32; 2]]| a.iter().zip(b).map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1])).fold(0.0, f32::max);
        for text in others {
            let response: Response = sward::scene::response(text).unwrap();
            let [mut tuned, mut at_once, mut untouched] = [0; 3].map(|_| world.clone());
            tuned.tune(0, response.clone(), 0.5).unwrap_or_else(|error| panic!("{text}: {error}"));
            at_once.tune(0, response, 0.0).unwrap();
            let (mut before, mut old) = (look(&tuned), look(&untouched));
            for step in 0..40 {
                run(&mut tuned, 1);
                run(&mut untouched, 1);
                let (now, usual) = (look(&tuned), look(&untouched));
                // No faster than they move by themselves at most, and a little.
                let (jump, own) = (apart(&before, &now), apart(&old, &usual));
                assert!(jump < 1.6 * own + 0.05, "{text}, step {step}: {jump}, by themselves {own}");
                (before, old) = (now, usual);
            }
            run(&mut at_once, 1);
            largest = largest.max(apart(&look(&world), &look(&at_once)));
            run(&mut at_once, 39);
            assert!(is_finite(&tuned) && tuned.state.tunings.is_empty());
            assert!(apart(&look(&tuned), &look(&untouched)) > 1e-3, "control: {text} matters");
            let (a, b) = (&tuned.model.stands[0], &at_once.model.stands[0]);
            assert!(
                a.coefficients == b.coefficients && a.oscillator == b.oscillator && a.springs == b.springs,
                "{text}: in the end it is the same"
            );
            assert!(a.chain.as_ref().map(|chain| chain.coefficients) == b.chain.as_ref().map(|chain| chain.coefficients), "{text}");
        }
    }
    assert!(largest > 0.2, "control: at once plants jump, by {largest}");
}

#[test]
fn what_cannot_glide_is_refused() {
    let mut world = USUAL.world();
    let saved = world.save_world();
    for text in ["Oscillator()", "Chain()", "Continuum(lag: History)", "Continuum(kappa: -3)", "Springs(columns: 5)"] {
        let error = sward::scene::response(text).and_then(|response| world.tune(0, response, 1.0)).expect_err(text);
        assert!(!error.to_string().is_empty());
    }
    assert!(world.tune(5, Response::Continuum(Default::default()), 1.0).is_err());
    assert!(world.save_world() == saved);
}

#[test]
fn grass_is_cut_burns_and_grows_again() {
    let mut world = calm("");
    let edit = |change: Change| Edit { at: [2.0, 2.0], radius: 2.5, change, ..Edit::default() };
    let share = |world: &World, stand: usize, at: [f64; 2]| {
        let model = &world.model.stands[stand];
        let map = model.growth_map(&world.model.terrain, [0, 0]);
        let cell = at.map(|metres| (metres / model.spacing) as usize);
        map.map_or(255, |map| map[cell[1] * model.cells as usize + cell[0]].share)
    };
    run(&mut world, 1);
    world.edit(&edit(Change::Cut(Cut { height: 0.1 }))).unwrap();
    for stand in 0..2 {
        let left = share(&world, stand, [2.2, 2.2]);
        assert!((40..160).contains(&left), "stand {stand}: {left}");
        assert_eq!(share(&world, stand, [6.2, 6.2]), 255, "control");
    }
    // A ball that hovers passes over what is cut, and bends what is not.
    let hover = |at| Interactor { clearance: 0.12, shape: Shape::Box(BoxShape { size: [1.8, 0.5, 1.8] }), ..ball(at) };
    let numbers = [[2.2, 2.2], [6.2, 6.2]].map(|at| world.add_body(hover(at), &NoAssets).unwrap());
    run(&mut world, 30);
    for stand in 0..2 {
        let [cut, whole] = [[2.2, 2.2], [6.2, 6.2]].map(|at| leaning(&world, stand, at));
        assert!(cut < 0.03 && whole > 0.1, "stand {stand}: {cut} {whole}");
    }
    assert_eq!(numbers.map(|number| world.remove_body(number)), [true; 2]);
    world.edit(&edit(Change::Burn)).unwrap();
    assert_eq!([0, 1].map(|stand| share(&world, stand, [2.2, 2.2])), [0, 0]);
    world.edit(&edit(Change::Regrow(Regrow { over: 2.0 }))).unwrap();
    let mut shares = Vec::new();
    for _ in 0..26 {
        run(&mut world, 5);
        shares.push(share(&world, 0, [2.2, 2.2]));
    }
    assert!(shares.windows(2).all(|pair| pair[0] <= pair[1] && pair[1] - pair[0] < 20), "{shares:?}");
    assert_eq!((shares[0] < 20, shares.last()), (true, Some(&255)), "{shares:?}");
    assert!(world.model.stands.iter().all(|stand| stand.growth.tended.patches().count() == 0), "nothing is kept of it");
    let named = Edit { stands: vec!["tussock".to_owned()], ..edit(Change::Burn) };
    world.edit(&named).unwrap();
    assert_eq!([0, 1].map(|stand| share(&world, stand, [2.2, 2.2])), [255, 0]);
}

/// Much of what a game does, by chance numbers of a seed; some of it is refused.
fn play(world: &mut World, seed: u32, steps: u32) {
    let mut chance = {
        let mut count = 0_u32;
        move |below: u32| {
            count += 1;
            (sward::math::unit(sward::math::hash(seed, count as i32, 0, 0, 77)) * below as f32) as u32 % below.max(1)
        }
    };
    for _ in 0..steps {
        let at = [f64::from(chance(120)) * 0.1 - 6.0, f64::from(chance(120)) * 0.1 - 6.0];
        let bodies = world.scene.interactors.len() as u32;
        match chance(24) {
            0 | 1 => {
                let shape = if chance(2) == 0 { ball(at).shape } else { Shape::Box(BoxShape { size: [1.0, 0.8, 1.4] }) };
                if bodies < 12 || !world.state.vacant.is_empty() {
                    world.add_body(Interactor { shape, ..ball(at) }, &NoAssets).unwrap();
                }
            }
            2 => drop(world.remove_body(2 + chance(bodies) as usize)),
            3 => drop(world.teleport(chance(bodies + 1) as usize, at, 0.3, 0.0)),
            4 => drop(world.lead(chance(bodies + 1) as usize, Path::Circle(Circle { centre: at, radius: 2.0, ..Circle::default() }))),
            5 => drop(world.add_wind(WindSource::Natural(Natural { velocity: [at[0] as f32, 2.0], turbulence: 0.3 }), 0.4, &NoAssets)),
            6 => drop(world.remove_wind(chance(6) as usize, 0.3)),
            7 => drop(world.add_wind(WindSource::Footprint(Footprint { radius: 4.0, ..Footprint::default() }), 0.2, &NoAssets)),
            8 => drop(world.tune(0, sward::scene::response(["Continuum(frequency: 1)", "Continuum()"][chance(2) as usize]).unwrap(), 0.3)),
            9 => {
                drop(world.tune(1, sward::scene::response(["Oscillator(frequency: 5)", "Oscillator()"][chance(2) as usize]).unwrap(), 0.3))
            }
            10 => world.edit(&Edit { at, radius: 1.0, change: Change::Cut(Cut { height: 0.1 }), ..Edit::default() }).unwrap(),
            11 => world.edit(&Edit { at, radius: 2.0, change: Change::Regrow(Regrow { over: 1.0 }), ..Edit::default() }).unwrap(),
            12 => world.state.pinned = vec![at],
            13 => world.viewed = Some(View { eye: [at[0], 2.0, at[1]], target: [0.0; 3], field_of_view: 0.8 }),
            14 => drop(world.take_over(chance(bodies) as usize)),
            _ => drop(world.drive(1, at.map(|metres| 0.2 * metres), 0.0, 0.0)),
        }
        world.step();
    }
}

#[test]
fn a_log_replays_to_the_same_bits() {
    let mut world = USUAL.world();
    let mut again = world.clone();
    world.record();
    play(&mut world, 5, 900);
    assert!(is_finite(&world));
    let log = world.log.clone().unwrap();
    assert!(log.inputs.len() > 300 && log.steps == 900);
    let read = Log::parse(&log.to_ron()).unwrap();
    assert_eq!(read.inputs, log.inputs);
    let mut steps = 0;
    read.replay(&mut again, &NoAssets, &mut |_| steps += 1).unwrap();
    assert_eq!((steps, again.hash(), again.save_world() == world.save_world()), (900, world.hash(), true));
    // Control: one input less is another run.
    let mut other = USUAL.world();
    let mut less = log.clone();
    let drive = less.inputs.iter().position(|(_, input)| matches!(input, Input::Drive { .. })).unwrap();
    less.inputs.remove(drive);
    less.replay(&mut other, &NoAssets, &mut |_| ()).unwrap();
    assert_ne!(other.hash(), world.hash());
    // And a log of another world says at which step it does not fit.
    let mut empty = calm("");
    assert!(matches!(log.replay(&mut empty, &NoAssets, &mut |_| ()), Err(LogError::Input { .. })));
    assert!(matches!(Log::parse("(version: 1, inputs: [(0, Fly)], steps: 3)"), Err(LogError::Text { line: 1, .. })));
    assert_eq!(Log::parse("(version: 7, inputs: [], steps: 3)"), Err(LogError::Version(7)));
}

#[test]
fn a_world_is_loaded_as_it_was_saved() {
    for seed in 0..4 {
        let mut world = USUAL.world();
        play(&mut world, seed, 200 + 37 * seed);
        let bytes = world.save_world();
        let mut loaded = World::load(&bytes, &NoAssets).unwrap();
        assert!(loaded.save_world() == bytes, "seed {seed}");
        loaded.viewed = world.viewed;
        for part in 0..4 {
            assert_eq!(run(&mut loaded, 25), run(&mut world, 25), "seed {seed}, part {part}");
        }
        play(&mut loaded, 99, 100);
        play(&mut world, 99, 100);
        assert!(loaded.save_world() == world.save_world(), "seed {seed}: it goes on in every way");
    }
    let bytes = USUAL.world().save_world();
    assert!(matches!(World::load(b"SWARDSTATE", &NoAssets), Err(LoadError::NotOne)));
    for cut in [10, 15, 40, bytes.len() - 1] {
        assert!(World::load(&bytes[..cut], &NoAssets).is_err(), "{cut}");
    }
    for place in (10..bytes.len()).step_by(211) {
        let mut harmed = bytes.clone();
        harmed[place] ^= 0x55;
        let _ = World::load(&harmed, &NoAssets);
    }
}
