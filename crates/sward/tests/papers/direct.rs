//! Chen & Johan 2010, eq. 1 and 10–12, solved exactly: what one body does to one plant.

use crate::common::{Dice, world};
use sward::interaction::Hit;
use sward::response::continuum::{Coefficients, Held, bend_limit, contact, pushes};

const DT: f64 = 1.0 / 60.0;

fn coefficients() -> Coefficients {
    world("stands: [(species: Meadow)]").model.stands[0].coefficients
}

/// A hit deep inside a wide body: the floor is left out by a depth of 0.
fn hit(speed: f32, direction: [f32; 2], height: f32) -> Hit {
    Hit { speed, direction, along: speed, height, normal: [0.0, 1.0], depth: 0.0 }
}

fn length(v: [f32; 2]) -> f32 {
    (v[0] * v[0] + v[1] * v[1]).sqrt()
}

fn touched(bend: [f32; 2], hits: &[Hit]) -> Held {
    contact(&coefficients(), bend, [0.0, 0.0], hits).expect("touched")
}

#[test]
fn equation_12_tan_theta_is_v_t_over_h_inside_a_body() {
    let (direction, height) = ([0.6, 0.8], 0.2_f32);
    for speed in [1.0_f32, 10.0, 30.0, 60.0] {
        let (mut bend, mut euler) = ([0.0; 2], 0.0_f64);
        let (mut worst, mut worst_euler) = (0.0_f64, 0.0_f64);
        for step in 1..=90 {
            bend = touched(bend, &[hit(speed, direction, height)]).bend;
            euler += f64::from(speed) * euler.cos().powi(2) / f64::from(height) * DT;
            let exact = (f64::from(speed) * DT * f64::from(step) / f64::from(height)).atan();
            worst = worst.max((f64::from(length(bend)) - exact).abs());
            worst_euler = worst_euler.max((euler - exact).abs());
        }
        println!("{speed} m/s: {worst:.1e} rad off the exact bend, Euler {worst_euler:.1e}");
        // Sixteen units in the last place of a flat plant: one a step, most of which later steps forget.
        assert!(worst < 2e-6, "{speed}: {worst}");
        assert!(worst_euler > 1e-3, "control: the paper's Euler step must fail, {worst_euler}");
        assert!((bend[0] * 0.8 - bend[1] * 0.6).abs() < 1e-6, "bends along the motion");
    }
}

/// The same in a world: a box enters, and a plant in its middle counts whole steps from the first contact on.
#[test]
fn equation_12_holds_under_a_moving_box() {
    for speed in [1.0_f64, 10.0, 30.0] {
        // A slow wave, so that hardly any push runs ahead of the box.
        let text = format!(
            "field: (patch_side: 16.0), stands: [(species: Meadow, cells: 64, response: Continuum(c0: 0.1, mu: 0.0))],
             interactors: [(shape: Box(size: (8.0, 1.0, 14.0)), clearance: 0.2,
             path: Keyframes(keys: [(time: 0.0, at: (0.0, 0.1)), (time: 2.0, at: ({:.1}, 0.1))]))]",
            speed * 2.0
        );
        let mut world = world(&text);
        let plant = [7.0 + ((speed * 0.25 + 0.25) * 4.0).floor() * 0.25 + 0.125, 0.1];
        let (mut steps, mut worst, mut control) = (0, 0.0_f64, 0.0_f64);
        while world.time() < 0.9 {
            world.step();
            let front = world.state.bodies[0].pose.expect("there").ground[0] + 7.0;
            // Not there yet, or already past.
            if front <= plant[0] || front - 14.0 >= plant[0] {
                continue;
            }
            steps += 1;
            let bend = world.bend_at(0, plant).expect("a stand");
            let exact = |height: f64| (speed * DT * f64::from(steps) / height).atan();
            worst = worst.max((f64::from(bend[0]) - exact(0.2)).abs());
            control = control.max((f64::from(bend[0]) - exact(0.21)).abs());
            assert!(bend[1].abs() < 1e-6);
        }
        println!("{speed} m/s: {steps} steps, {worst:.1e}, control {control:.1e}");
        // What is left is the lean the plant had before, pushed by its neighbours.
        assert!(steps > 15 && worst < 2e-3 && control > 5.0 * worst, "{speed}: {worst}, control {control}");
    }
}

#[test]
fn a_plant_leaning_against_the_motion_goes_over_the_top_or_turns() {
    let co = coefficients();
    let d = [1.0, 0.0];
    // A small lean: straight over the top.
    let small = touched([-0.2, 0.1], &[hit(2.0, d, 0.2)]);
    let delta = pushes(&co, std::iter::once(([-0.2, 0.1], &hit(2.0, d, 0.2)))).next().expect("one").delta;
    assert_eq!(small.bend, [-0.2 + delta, 0.1]);
    let exact = ((-0.2_f64).tan() + 2.0 * DT / f64::from(0.2_f32)).atan() + 0.2;
    assert!((f64::from(delta) - exact).abs() < 1e-6);
    // A large one: turned round at 12 rad/s, its length kept, and towards +z from −x where both ways are as long.
    let mut bend = [-1.0_f32, 0.0];
    for step in 1..=15 {
        let held = touched(bend, &[hit(2.0, d, 0.2)]);
        if bend[0] >= 0.0 {
            break;
        }
        let turn = f64::from(length([held.bend[0] - bend[0], held.bend[1] - bend[1]]) / length(bend));
        assert!(turn < 12.0 * DT + 1e-6 && (length(held.bend) - 1.0).abs() < 1e-6, "step {step}");
        let angle = f64::from(step) * 12.0 * DT;
        assert!((f64::from(held.bend[1]) + angle.sin()).abs() < 1e-5, "step {step}: {:?} ccw", held.bend);
        assert!((held.rate[1] - (held.bend[1] - bend[1]) * 60.0).abs() < 1e-3);
        bend = held.bend;
    }
    assert!(bend[0] >= 0.0, "turned round");
    // The other side of the tie: cross product below 0 turns the other way.
    assert!(touched([-1.0, 1e-3], &[hit(2.0, d, 0.2)]).bend[1] > 0.1);
}

#[test]
fn a_held_plant_never_stands_up_and_stays_inside_its_limits() {
    let (co, mut dice) = (coefficients(), Dice(1));
    let (mut fell, mut checked) = (0, 0);
    for _ in 0..20_000 {
        let (angle, way) = (dice.between(0.0, std::f64::consts::TAU), dice.between(0.0, std::f64::consts::TAU));
        let slope = [dice.between(-1.5, 1.5) as f32, dice.between(-1.5, 1.5) as f32];
        let direction = [way.cos() as f32, way.sin() as f32];
        let mut size = dice.between(0.0, 1.57) as f32;
        let unit = [angle.cos() as f32, angle.sin() as f32];
        size = size.min(bend_limit(slope, unit));
        let bend = [unit[0] * size, unit[1] * size];
        let speed = dice.between(0.0, 80.0) as f32;
        let mut body = hit(speed, direction, dice.between(0.02, 0.24) as f32);
        body.depth = dice.between(0.0, 1.0) as f32;
        let held = contact(&co, bend, slope, &[body]).expect("touched");
        let limit = bend_limit(slope, held.bend);
        assert!(length(held.bend) <= limit + 2e-6, "{held:?} over {limit}");
        assert!(length(held.rate) <= 60.0 + 1e-4 && held.rate.iter().chain(&held.bend).all(|v| v.is_finite()));
        let against = bend[0] * direction[0] + bend[1] * direction[1] < 0.0 && size < 0.35;
        if !against && length(held.bend) < limit - 1e-4 {
            checked += 1;
            assert!(length(held.bend) >= size - 2e-6, "{bend:?} → {held:?}");
        }
        fell += u32::from(against && length(held.bend) < size - 1e-3);
    }
    assert!(checked > 5_000, "{checked}");
    assert!(fell > 0, "control: over the top, plants do pass through upright");
}
