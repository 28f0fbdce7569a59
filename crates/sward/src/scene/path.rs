//! Where interactors go. Positions are authored ground positions (x, z); yaw 0 faces +z and a positive yaw turns towards +x.

use super::parameters::{choices, parameters};

choices! {
    /// Where a body goes.
    pub enum Path {
        /// It stays.
        Still(Still),
        /// It passes given places at given times, along a smooth curve.
        Keyframes(Keyframes),
        /// It goes round in a circle, facing ahead.
        Circle(Circle),
        /// A program moves it; until then it stays.
        Driven(Driven),
    }
}

parameters! {
    /// A body that stays.
    pub struct Still {
        /// Position.
        at: [f64; 2] = [0.0, 0.0], "m" in -1000000.0..=1000000.0;
        /// Heading.
        yaw: f32 = 0.0, "rad" in -100.0..=100.0;
    }
}

parameters! {
    /// Places and times.
    pub struct Keyframes {
        /// The places, with increasing times. Before the first and after the last the body stays.
        keys: Vec<Key> = vec![Key::default()], "", required;
        /// Whether to start again after the last key.
        repeat: bool = false, "";
    }
}

parameters! {
    /// A place at a time.
    pub struct Key {
        /// Time.
        time: f64 = 0.0, "s" in 0.0..=1000000000.0, required;
        /// Position.
        at: [f64; 2] = [0.0, 0.0], "m" in -1000000.0..=1000000.0, required;
        /// Heading. Without it the body faces along its motion; from and to a key that has one it turns evenly.
        yaw: Option<f64> = None, "rad" in -100.0..=100.0;
        /// Height of the lowest point above the ground. Without it the interactor's.
        clearance: Option<f32> = None, "m" in -2.0..=1000.0;
    }
}

parameters! {
    /// A circle at constant speed.
    pub struct Circle {
        /// Centre.
        centre: [f64; 2] = [0.0, 0.0], "m" in -1000000.0..=1000000.0;
        /// Radius.
        radius: f64 = 5.0, "m" in 0.01..=100000.0;
        /// Speed; positive goes from +x towards +z, negative the other way.
        speed: f64 = 2.0, "m/s" in -120.0..=120.0;
        /// Place on the circle at time 0: 0 is +x of the centre, turning towards +z.
        start: f64 = 0.0, "rad" in -100.0..=100.0;
    }
}

parameters! {
    /// A body moved by a program.
    pub struct Driven {
        /// Position until it is moved.
        at: [f64; 2] = [0.0, 0.0], "m" in -1000000.0..=1000000.0;
        /// Heading until it is moved.
        yaw: f32 = 0.0, "rad" in -100.0..=100.0;
    }
}
