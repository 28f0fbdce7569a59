//! Sources of wind; their sum is the velocity of the air.

use super::parameters::{choices, parameters};

choices! {
    /// Something that moves the air.
    pub enum WindSource {
        /// The same velocity everywhere and always.
        Uniform(Uniform),
        /// A mean velocity with travelling gusts.
        Natural(Natural),
    }
}

parameters! {
    /// Steady wind.
    pub struct Uniform {
        /// Velocity of the air in x and z.
        velocity: [f32; 2] = [4.0, 0.0], "m/s" in -60.0..=60.0;
    }
}

parameters! {
    /// Wind with gusts of three sizes that travel over the ground.
    pub struct Natural {
        /// Mean velocity of the air in x and z.
        velocity: [f32; 2] = [4.0, 0.0], "m/s" in -60.0..=60.0;
        /// Standard deviation of the gusts over the mean speed.
        turbulence: f32 = 0.25, "" in 0.0..=1.0;
    }
}
