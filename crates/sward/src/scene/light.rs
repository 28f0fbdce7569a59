//! Sun, sky and air.

use super::environment::Environment;
use super::parameters::parameters;

parameters! {
    /// Sun, sky and air.
    pub struct Light {
        /// Direction to the sun over the ground: 0 is +x, turning towards +z.
        azimuth: f32 = 0.8, "rad" in -100.0..=100.0;
        /// Height of the sun over the horizon.
        elevation: f32 = 0.5, "rad" in 0.02..=1.57;
        /// Strength of the sun.
        strength: f32 = 1.0, "" in 0.0..=10.0;
        /// Haze in the sky: 0 is deep blue, 1 is milky.
        haze: f32 = 0.3, "" in 0.0..=1.0;
        /// Share of the light lost per metre of air.
        fog: f32 = 0.0015, "1/m" in 0.0..=1.0;
        /// Exposure; each step doubles the brightness.
        exposure: f32 = 0.0, "EV" in -8.0..=8.0;
        /// Share of the sky covered by clouds.
        clouds: f32 = 0.4, "" in 0.0..=1.0;
        /// Depth under water; 0 is in air. Water takes red away first, bends the sun's light down, and hides sky and hills. Set `fog` to how murky it is.
        water: f32 = 0.0, "m" in 0.0..=40.0;
        /// A picture of the surroundings to take all light from.
        environment: Option<Environment> = None, "";
    }
}
