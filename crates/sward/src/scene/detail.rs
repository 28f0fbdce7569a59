//! Detail below the terrain's own samples.

use super::parameters::parameters;

parameters! {
    /// Bumps that are added to any terrain: smooth noise, finer and lower from octave to octave. They move bodies, bend limits and the picture alike.
    pub struct Detail {
        /// Height of the bumps: three times their root mean square, so hardly a place is farther above or below the terrain.
        amplitude: f32 = 0.1, "m" in 0.0..=20.0;
        /// Distance between the largest bumps. A little below the size of the terrain's pixels, they fill in what those leave out.
        wavelength: f32 = 4.0, "m" in 0.1..=1000.0;
        /// Number of octaves, each with half the wavelength of the one before.
        octaves: u32 = 3, "" in 1..=8;
        /// Height of an octave as a share of the one before: 0 is only the largest bumps, 1 is rubble.
        roughness: f32 = 0.5, "" in 0.0..=1.0;
        /// Seed: another number, other bumps.
        seed: u32 = 1, "";
    }
}
