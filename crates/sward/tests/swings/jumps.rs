//! Bodies that move, vanish, appear and jump: no plant jumps, none stays bent for ever.

use sward::response::oscillator::limited;
use sward::world::World;

use super::field::{coefficients, field, length, touched};

/// Largest change of a plant's bend from one picture to the next, at 60 steps and 120 pictures a second, rad; `each` may move bodies.
fn largest_jump(world: &mut World, steps: u32, mut each: impl FnMut(&mut World, u32)) -> f32 {
    let mut worst: f32 = 0.0;
    let mut shown: std::collections::BTreeMap<_, [f32; 2]> = Default::default();
    for step in 0..steps {
        each(world, step);
        world.step();
        for behind in [0.5, 0.0] {
            for (key, found) in touched(world) {
                let bend = limited(found.at(world, behind));
                let before = shown.insert(key, bend).unwrap_or_default();
                worst = worst.max(length([bend[0] - before[0], bend[1] - before[1]]));
            }
        }
    }
    worst
}

/// What a body may change in half a step at the very most: what the body's own motion asks for, and 12 rad/s.
#[test]
fn nothing_jumps_under_walkers_balls_and_what_appears() {
    let scenes = [
        ("a walker of 1.5 m/s", "(shape: Ellipsoid(radii: (0.25, 0.9, 0.25)), path: Circle(radius: 2, speed: 1.5))", 0.35),
        ("a ball of 4 m/s", "(shape: Sphere(radius: 0.8), path: Circle(radius: 2, speed: 4))", 0.35),
        ("one that appears and vanishes", "(shape: Sphere(radius: 1), path: Still(at: (1, 1)), from: 0.5, until: 1.0)", 0.21),
        (
            "one that hops",
            "(shape: Sphere(radius: 0.5), path: Keyframes(keys: [(time: 0, at: (1, 1), clearance: 1), (time: 0.5, at: (1, 1), clearance: 0), \
             (time: 1, at: (1, 1), clearance: 0), (time: 1.5, at: (2, 1), clearance: 1), (time: 2, at: (3, 1), clearance: 0)]))",
            0.35,
        ),
    ];
    for (name, body, most) in scenes {
        let mut world = field("response: Oscillator()", &format!("interactors: [{body}]"));
        let jump = largest_jump(&mut world, 240, |_, _| ());
        println!("{name}: {jump:.3} rad from picture to picture");
        assert!(jump > 0.01 && jump < most, "{name}: {jump}");
    }
}

#[test]
fn a_body_that_teleports_drags_nothing_along() {
    let driven = "interactors: [(name: \"player\", shape: Sphere(radius: 0.7), path: Driven(at: (1, 1)))]";
    let mut world = field("response: Oscillator()", driven);
    let hop = |world: &mut World, step: u32| {
        if step.is_multiple_of(30) {
            let k = f64::from(step / 30);
            // Far enough each time: what moves less than 2.5 m in a step is fast, not elsewhere.
            world.drive(0, [1.0 + 5.0 * (k * 2.4).sin(), 1.0 + 5.0 * (k * 2.4).cos()], 0.0, 0.0);
        }
    };
    let jump = largest_jump(&mut world, 300, hop);
    println!("a ball that teleports: {jump:.3} rad from picture to picture");
    assert!(jump < 0.21, "{jump}");
    world.drive(0, [500.0, 500.0], 0.0, 0.0);
    world.step();
    // Gone: all come back to rest.
    for _ in 0..coefficients(&world).settle {
        world.step();
    }
    let near = |root: [f64; 2]| root.iter().all(|metres| metres.abs() < 50.0);
    let left =
        touched(&world).iter().filter(|(_, found)| near(found.root)).map(|(_, found)| length(found.at(&world, 0.0))).fold(0.0, f32::max);
    assert!(left < 1e-3, "{left}");
}

/// Without the limit on how fast a hold tightens, a plant under a body that appears would jump.
#[test]
fn without_the_limit_it_would_jump() {
    let mut world = field("response: Oscillator()", "interactors: [(shape: Sphere(radius: 1), path: Still(at: (1, 1)), from: 0.5)]");
    if let Some(oscillator) = &mut world.model.stands[0].oscillator {
        oscillator.coefficients.pace = 10.0;
    }
    let jump = largest_jump(&mut world, 60, |_, _| ());
    assert!(jump > 0.5, "{jump}");
}

/// A plant that is met again while it swings, meets the body where it is: no jump, and it is held from there on.
#[test]
fn meeting_again_while_swinging() {
    let back_and_forth = "interactors: [(shape: Sphere(radius: 0.6), path: Keyframes(repeat: true, keys: [(time: 0, at: (-1, 1)), (time: 0.35, at: (1, 1)), \
                          (time: 0.7, at: (-1, 1))]))]";
    let mut world = field("response: Oscillator(damping: 0.05)", back_and_forth);
    let jump = largest_jump(&mut world, 300, |_, _| ());
    println!("met again and again: {jump:.3} rad from picture to picture");
    assert!(jump < 0.45, "{jump}");
}
