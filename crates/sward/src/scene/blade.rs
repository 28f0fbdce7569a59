//! Settings of the blade representation: every blade a strip of triangles.
//!
//! Belyaev et al. 2011, §2: density by weight (§2.2), light (§2.3).

use super::parameters::{parameters, parameters_with_overrides};

parameters_with_overrides! {
    /// How the blades of a plant grow, thin out with distance and are lit. Colours are linear red, green and blue.
    pub struct Blade, BladeOverrides {
        /// Segments from root to tip that move: how smoothly a blade bends.
        segments: u32 = 4, "" in 1..=8;
        /// Blades of a plant.
        blades: u32 = 32, "" in 1..=64;
        /// How near the blades of a plant stand to its root: 0 anywhere in its cell, 1 all at the root.
        tuft: f32 = 0.25, "" in 0.0..=1.0;
        /// Height of the shortest blade of a plant, as a share of the plant's.
        shortest: f32 = 0.5, "" in 0.05..=1.0;
        /// Width at the widest.
        width: f32 = 0.009, "m" in 0.0005..=0.2;
        /// Lean of a blade at its root, at most.
        lean: f32 = 0.35, "rad" in 0.0..=1.2;
        /// How much farther the tip of a blade leans by itself, at most.
        curl: f32 = 1.0, "rad" in 0.0..=2.0;
        /// Turn about its own length from root to tip, at most.
        twist: f32 = 0.9, "rad" in 0.0..=6.3;
        /// Pieces of a strip near the camera, farther off, and far away.
        pieces: [u32; 3] = [7, 4, 2], "" in 1..=12;
        /// Distances from the camera at which the second and the third number of pieces begin.
        piece_distances: [f32; 2] = [10.0, 30.0], "m" in 1.0..=1000.0;
        /// How blades thin out at distance d: seen from above, the share 1 / (a + b d + c d²) of them is drawn, 1 at most.
        thinning: [f32; 3] = [0.15, 0.006, 0.0012], "" in 0.0..=100.0;
        /// Distance from the camera at which the last blades are gone; they shrink from six tenths of it on.
        distance: f32 = 110.0, "m" in 5.0..=1000.0;
        /// Colour at the root.
        colour_root: [f32; 3] = [0.030, 0.050, 0.015], "" in 0.0..=1.0;
        /// Colour at the tip.
        colour_tip: [f32; 3] = [0.200, 0.260, 0.070], "" in 0.0..=1.0;
        /// Share of dry, straw-coloured blades.
        dryness: f32 = 0.05, "" in 0.0..=1.0;
        /// Light that passes through a blade, as a share of what it reflects.
        translucency: f32 = 0.8, "" in 0.0..=2.0;
        /// Exponent by which sunlight fails from tip to root: neighbours keep it off.
        sun_falloff: f32 = 1.6, "" in 0.0..=8.0;
        /// Light of the sky at the root, as a share of that at the tip.
        ambient_root: f32 = 0.22, "" in 0.0..=1.0;
        /// Highlight of tips where the ground is seen at a flat angle.
        silhouette: f32 = 0.12, "" in 0.0..=2.0;
    }
    extra {}
}
