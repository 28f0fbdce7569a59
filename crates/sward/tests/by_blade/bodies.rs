//! Bodies push blades out of themselves; blades swing back and are handed back.

use sward::state::NONE;
use sward::world::World;

use crate::common::world;
use crate::field::{deepest, held, meadow, meadow_of_walker, tips};

const WIND: &str = "Natural(velocity: (4, 1), turbulence: 0.25)";
const WALKER: &str = "(name: \"walker\", shape: Ellipsoid(radii: (0.25, 0.9, 0.2)), path: Circle(centre: (0, 2), radius: 3, speed: 1.4))";
const CAR: &str = "(name: \"car\", shape: Truck, path: Keyframes(keys: [(time: 0, at: (0, -30)), (time: 10, at: (0, 50))]))";
/// Every simple shape, still and turning, and all of them as one.
const SHAPES: &str = "(name: \"box\", shape: Box(size: (0.6, 0.5, 0.9)), clearance: 0.1, path: Circle(centre: (-3, 0), radius: 1, speed: 1.2)),
    (name: \"prism\", shape: Polygon(points: [(-0.4, -0.4), (0.4, -0.4), (0, 0.6)], height: 0.8), path: Circle(centre: (3, 0), radius: 1, speed: -1.2)),
    (name: \"ball\", shape: Sphere(radius: 0.5), path: Circle(centre: (-3, 5), radius: 1, speed: 1.2)),
    (name: \"pair\", shape: Compound(parts: [(shape: Sphere(radius: 0.3)), (shape: Box(size: (0.3, 0.3, 0.3)), offset: (0.8, 0.1, 0))]),
        path: Circle(centre: (3, 5), radius: 1, speed: 1.2))";

/// One step; how deep joints lie in bodies and in the ground after it, m.
fn stepped(world: &mut World) -> [f32; 2] {
    let plan = world.plan();
    let reports = world.respond(&plan);
    world.finish(reports);
    deepest(world, &plan)
}

/// The worst of some steps, and the most blades held at once.
fn worst(body: &str, response: &str, steps: u32) -> ([f32; 2], usize) {
    let mut world = meadow(response, WIND, body);
    let (mut deep, mut most) = ([0.0_f32; 2], 0);
    for _ in 0..steps {
        let now = stepped(&mut world);
        deep = [deep[0].max(now[0]), deep[1].max(now[1])];
        most = most.max(held(&world).len());
    }
    (deep, most)
}

/// The figures of the issue: 1 mm for walkers, 5 mm for a car at 8 m/s, nothing below the ground.
#[test]
fn joints_leave_bodies() {
    for (name, body, most) in [("walker", WALKER, 1e-3), ("shapes", SHAPES, 1e-3), ("car", CAR, 5e-3)] {
        let ([inside, below], count) = worst(body, "VirtualInertia()", 300);
        println!("{name}: {count} blades held, {:.2} mm inside, {:.2} mm below the ground", 1e3 * inside, 1e3 * below);
        assert!(count > 10, "{name} touched nothing");
        assert!(inside <= most && below <= 0.0, "{name}: {inside} m inside, {below} m below the ground");
    }
}

/// A body from a glTF file with a clip: legs that swing, a trunk above them.
#[test]
fn joints_leave_a_body_from_a_file() {
    let mut world = meadow_of_walker(
        "(name: \"w\", shape: Mesh(file: \"walker.glb\", clip: \"Walk\"), path: Circle(centre: (0, 2), radius: 3, speed: 1))",
    );
    let (mut deep, mut most) = ([0.0_f32; 2], 0);
    for _ in 0..300 {
        let now = stepped(&mut world);
        deep = [deep[0].max(now[0]), deep[1].max(now[1])];
        most = most.max(held(&world).len());
    }
    println!("{most} blades held, {:.2} mm inside, {:.2} mm below the ground", 1e3 * deep[0], 1e3 * deep[1]);
    assert!(most > 10 && deep[0] <= 1e-3 && deep[1] <= 0.0, "{most} blades, {deep:?} m");
}

/// More bodies over one patch than have bits of their own: the last ones push too.
#[test]
fn joints_leave_the_last_of_many_bodies() {
    let ball = |x: f32, name: usize| {
        format!("(name: \"b{name}\", shape: Sphere(radius: 0.3), path: Circle(centre: ({x}, 3), radius: 0.5, speed: 1))")
    };
    let far: Vec<String> = (0..40).map(|k| ball(0.9, k)).chain([ball(6.5, 40)]).collect();
    let ([inside, below], count) = worst(&far.join(", "), "VirtualInertia()", 60);
    let ([..], alone) = worst(&far[0], "VirtualInertia()", 60);
    println!("{count} blades held, {alone} by the first alone, {:.2} mm inside", 1e3 * inside);
    assert!(count > alone, "the last body touched nothing");
    assert!(inside <= 1e-3 && below <= 0.0, "{inside} m inside, {below} m below the ground");
}

/// A field of 28 km costs what one of 280 m does: the same counters, with wind and a car.
#[test]
fn a_hundred_times_the_field_costs_nothing() {
    let counters = |patches: u32, response: &str| {
        let mut world = world(&format!(
            "field: (patch_side: 28, patches: ({patches}, {patches})), wind: [{WIND}], interactors: [{CAR}],
            stands: [(species: Meadow, cells: 16, response: {response}, representation: Blade())], camera: (eye: (0, 1.7, -6), target: (0, 0, 4))"
        ));
        let mut all = Vec::new();
        for _ in 0..10 {
            world.step();
            let stand = &world.state.stands[0];
            all.push(format!("{:?} {} {}", stand.counters, stand.awake.len(), held(&world).len()));
        }
        all
    };
    for response in ["VirtualInertia()", "Chain()"] {
        let small = counters(10, response);
        assert_eq!(small, counters(1000, response), "{response}");
        assert_ne!(small, counters(1, response), "control: {response} on a field smaller than what is awake");
    }
}

/// Control: where nothing pushes them, blades stand in the body.
#[test]
fn blades_that_nothing_pushes_stand_in_bodies() {
    let mut world = meadow("Chain()", WIND, WALKER);
    let mut deep = 0.0_f32;
    for _ in 0..30 {
        let mut plan = world.plan();
        let solids = plan.stands[0].clone();
        plan.stands[0].patches.iter_mut().for_each(|patch| patch.solids = 0..0);
        let reports = world.respond(&plan);
        world.finish(reports);
        plan.stands[0] = solids;
        deep = deep.max(deepest(&world, &plan)[0]);
    }
    assert!(deep > 0.02, "only {deep} m");
}

/// A touched blade swings, settles, and is handed back; then its patch keeps nothing.
#[test]
fn blades_are_handed_back_and_their_place_comes_free() {
    let body = "(name: \"ball\", shape: Sphere(radius: 0.5), path: Still(at: (4, 4)), from: 0.1, until: 0.5)";
    for wind in ["", WIND] {
        let mut world = meadow("VirtualInertia()", wind, body);
        (0..25).for_each(|_| world.step());
        let touched = held(&world);
        assert!(!touched.is_empty());
        assert!(touched.iter().all(|(_, blade)| blade.hold == 1.0), "blades under the body are its own");
        let mut swung = 0.0_f32;
        let mut steps = 25;
        while !held(&world).is_empty() && steps < 1500 {
            world.step();
            steps += 1;
            let rates = held(&world).into_iter().flat_map(|(_, blade)| blade.state.joints).map(|[_, _, x, y]| x.hypot(y));
            swung = rates.fold(swung, f32::max);
        }
        (0..4).for_each(|_| world.step());
        println!("wind {wind:?}: handed back after {:.2} s, fastest joint {swung:.1} rad/s", f64::from(steps) / 60.0);
        assert!(swung > 1.0, "they swing back with inertia");
        assert!(held(&world).is_empty(), "all are handed back");
        assert!(world.state.stands[0].awake.values().all(|awake| awake.lag == NONE), "and their place is free");
    }
}

/// Tips are handed back without a jump: half a pixel a frame beyond the motion that both have. Control: at once.
#[test]
fn handing_back_shows_no_jump() {
    let body = "(name: \"ball\", shape: Sphere(radius: 0.5), path: Still(at: (4, 4)), from: 0.1, until: 0.5)";
    let most = |hard: bool| {
        let mut world = meadow("VirtualInertia()", WIND, body);
        let mut largest = 0.0_f32;
        for _ in 0..900 {
            let (before, pixels) = (tips(&world), pixels(&mut world));
            if hard {
                release(&mut world);
            }
            world.step();
            for (blade, [own, virtual_, shown]) in tips(&world) {
                let Some([own_before, virtual_before, shown_before]) = before.get(&blade) else { continue };
                // What is shown moves as a mix of the two does; the rest is the handing back.
                let (from, to) = (shown_before.1, shown.1);
                if from <= 0.0 || to >= from {
                    continue;
                }
                let mixed = |axis: usize| {
                    let both = [own.0[axis] - own_before.0[axis], virtual_.0[axis] - virtual_before.0[axis]];
                    shown.0[axis] - shown_before.0[axis] - from * both[0] - (1.0 - from) * both[1]
                };
                let extra = (mixed(0) * mixed(0) + mixed(1) * mixed(1) + mixed(2) * mixed(2)).sqrt();
                largest = largest.max(pixels * extra);
            }
        }
        largest
    };
    let (soft, hard) = (most(false), most(true));
    println!("handing back moves a tip by {soft:.2} pixels a frame beyond its motion; at once {hard:.2}");
    assert!(soft <= 0.6, "{soft} pixels");
    assert!(hard > 3.0, "control: {hard} pixels");
}

/// Pixels of a metre in the patch of the ball.
fn pixels(world: &mut World) -> f32 {
    let mut copy = world.clone();
    let plan = copy.plan();
    plan.stands[0].patches.iter().find(|patch| patch.patch == [0, 0]).map_or(0.0, |patch| patch.pixels)
}

/// Blades on their way back are there at once.
fn release(world: &mut World) {
    let n = world.model.stands[0].chain.as_ref().map_or(0, |chain| chain.coefficients.segments as usize);
    let cells = &mut world.state.stands[0].cells;
    for (values, roots) in cells.lag.iter_mut().zip(&cells.roots) {
        let total = roots.len();
        values[6 * n * total..(6 * n + 1) * total].iter_mut().filter(|hold| **hold < 1.0).for_each(|hold| *hold = 0.0);
    }
}

/// A fast car: how far a tip moves in the frame in which it is first touched, in blade lengths.
#[test]
fn first_touch_of_a_fast_car() {
    let mut world = meadow("VirtualInertia()", WIND, CAR);
    let (mut largest, mut moves) = (0.0_f32, Vec::new());
    for _ in 0..240 {
        let before = tips(&world);
        world.step();
        for (blade, [_, virtual_, shown]) in tips(&world).into_iter().filter(|(_, [_, _, shown])| shown.1 > 0.0) {
            let [x, y, z] = before.get(&blade).map_or(virtual_.0, |[_, _, shown]| shown.0);
            let moved = ((shown.0[0] - x).powi(2) + (shown.0[1] - y).powi(2) + (shown.0[2] - z).powi(2)).sqrt() / shown.2;
            largest = largest.max(moved);
            moves.push(moved);
        }
    }
    moves.sort_by(f32::total_cmp);
    let at = |share: f64| moves[(share * (moves.len() - 1) as f64) as usize];
    println!("tips of held blades move in a frame, in lengths: median {:.3}, p99 {:.2}, most {largest:.2}", at(0.5), at(0.99));
    // The limit, stated in docs/papers.md: a bumper at 8 m/s covers 13 cm in a frame, and what it meets at half its height lies down within one.
    assert!(at(0.5) < 0.05 && at(0.99) < 1.0 && largest < 1.6, "{} {} {largest}", at(0.5), at(0.99));
}

/// A saved state goes on with the same bits; threads change none. Control: a step more is another state.
#[test]
fn saved_states_and_threads_keep_the_bits() {
    for response in ["VirtualInertia()", "Chain()"] {
        let mut world = meadow(response, WIND, WALKER);
        (0..40).for_each(|_| world.step());
        let mut restored = meadow(response, WIND, WALKER);
        restored.restore(&world.save()).expect("a state of the same scene");
        assert_eq!(restored.hash(), world.hash());
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
        (0..30).for_each(|_| world.step());
        pool.install(|| (0..30).for_each(|_| restored.step()));
        assert_eq!(restored.hash(), world.hash(), "{response}");
        assert!(!held(&world).is_empty());
        restored.step();
        assert_ne!(restored.hash(), world.hash());
    }
}

/// Without wind and bodies nothing is awake; with wind alone no blade has a state, unless all have one.
#[test]
fn what_nobody_touches_costs_nothing() {
    let mut still = meadow("VirtualInertia()", "", "");
    let mut windy = meadow("VirtualInertia()", WIND, "");
    let mut all = meadow("Chain()", WIND, "");
    for _ in 0..20 {
        [&mut still, &mut windy, &mut all].into_iter().for_each(World::step);
    }
    assert!(still.state.stands[0].awake.is_empty());
    assert!(!windy.state.stands[0].awake.is_empty() && held(&windy).is_empty());
    assert!(held(&all).len() > 10_000);
    // Wind moves them: what a blade shows differs from place to place and from the still one.
    let bend = |world: &World, x: f64| world.bend_at(0, [x, 2.0]).expect("a stand");
    assert_eq!(bend(&still, 1.0), [0.0, 0.0]);
    assert!(bend(&windy, 1.0)[0] > 0.05 && bend(&windy, 1.0) != bend(&windy, 6.0));
}

/// Any admitted wind leaves all numbers finite.
#[test]
fn storms_stay_finite() {
    for (response, wind) in [("VirtualInertia()", "Uniform(velocity: (60, 0))"), ("Chain()", "Natural(velocity: (40, 20), turbulence: 1)")]
    {
        let mut world = meadow(response, wind, CAR);
        (0..90).for_each(|_| world.step());
        let cells = &world.state.stands[0].cells;
        let mut numbers = cells.now.iter().chain(&cells.virtual_states).chain(&cells.lag).flat_map(|values| values.iter());
        assert!(numbers.all(|value| value.is_finite()), "{response} in {wind}");
    }
}
