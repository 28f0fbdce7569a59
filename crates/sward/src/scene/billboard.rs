//! Settings of the billboard representation: crossed cards with a picture of a clump.

use super::parameters::{parameters, parameters_with_overrides};

parameters_with_overrides! {
    /// How the cards of a plant are cut and coloured. Colours are linear red, green and blue.
    pub struct Billboard, BillboardOverrides {
        /// Segments from root to tip near the camera: how smoothly a plant bends.
        segments: u32 = 4, "" in 1..=8;
        /// Width of a card.
        width: f32 = 0.45, "m" in 0.01..=5.0;
        /// Crossed cards per plant.
        cards: u32 = 2, "" in 1..=3;
        /// Distance from the camera beyond which a plant has one segment.
        plain_distance: f32 = 40.0, "m" in 1.0..=1000.0;
        /// Colour at the root.
        colour_root: [f32; 3] = [0.030, 0.050, 0.015], "" in 0.0..=1.0;
        /// Colour at the tip.
        colour_tip: [f32; 3] = [0.200, 0.260, 0.070], "" in 0.0..=1.0;
        /// Share of dry, straw-coloured blades.
        dryness: f32 = 0.35, "" in 0.0..=1.0;
    }
    extra {}
}
