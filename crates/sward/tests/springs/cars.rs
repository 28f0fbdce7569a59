//! Bodies of the size of a car at speed: plants lie down under them.

use glam::Vec3;

use crate::Test;
use crate::bodies::block;
use crate::field::{coefficients, pass, row};

pub(crate) const TESTS: &[Test] =
    &[("a_car_lays_plants_down", a_car_lays_plants_down), ("a_fast_car_is_met_at_several_moments", a_fast_car_is_met_at_several_moments)];

fn a_car_lays_plants_down() {
    for (name, lift, length) in [
        ("car at 8 m/s, 0.2 m up", 0.2, 0.4),
        ("car at 8 m/s, on the ground", 0.0, 0.4),
        ("car at 8 m/s over reed", 0.2, 1.2),
        ("car at 8 m/s over lawn", 0.02, 0.05),
    ] {
        let car = block(name, Vec3::new(1.8, 1.4, 4.4), lift, 64);
        let seen = pass(&coefficients(3, 3), &car, &row(0.9, length), 8.0, None);
        seen.print(name);
        assert!(seen.touched > 300, "it must touch: {seen:?}");
        // No vertex moves on more than 1.5 times as fast as the car, which itself moves L/3 a frame (lawn: 2.7 L).
        assert!(seen.deepest < 0.025, "{seen:?}");
        assert!(seen.jump < if length > 0.1 { 0.57 } else { 1.01 }, "{seen:?}");
        assert!(seen.stretch < 1e-3 && seen.lowest > 0.9e-3, "{seen:?}");
    }
}

fn a_fast_car_is_met_at_several_moments() {
    let co = coefficients(3, 3);
    for (speed, most) in [(15.0, 0.01), (30.0, 0.01)] {
        let car = block("car", Vec3::new(1.8, 1.4, 4.4), 0.2, 64);
        let seen = pass(&co, &car, &row(0.9, 0.4), speed, None);
        let once = pass(&co, &car, &row(0.9, 0.4), speed, Some(1));
        seen.print(&format!("car at {speed} m/s"));
        once.print("the same, at the end of the step only");
        assert!(seen.deepest < most && seen.stretch < 1e-3 && seen.lowest > 0.9e-3, "{seen:?}");
        assert!(once.deepest > seen.deepest && once.over[1] > seen.over[1], "moments between must matter: {once:?}");
    }
}
