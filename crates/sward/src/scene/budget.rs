//! Upper limits of work and memory.

use super::parameters::{choices, parameters};

parameters! {
    /// Upper limits of work and memory; what exceeds them is dropped by distance and counted.
    pub struct Budget {
        /// Patches that can be active at once.
        patches: u32 = 225, "patches" in 9..=512;
        /// Patches whose centre is nearer than this to a focus are active.
        focus_distance: f32 = 48.0, "m" in 0.0..=1000.0;
        /// Patches nearer than this to a camera keep the lags of upper segments.
        lag_distance: f32 = 48.0, "m" in 0.0..=1000.0;
        /// Plants drawn at once.
        visible_plants: u32 = 262144, "plants" in 1024..=1048576;
        /// Blades drawn at once: what the representation `Blade` solves and keeps.
        visible_blades: u32 = 262144, "blades" in 1024..=1500000;
        /// Blades of one stand with a state of their own at once, where it moves blade by blade: what the patches hold that bodies touch, or of
        /// the response `Chain` those nearest to a focus.
        stateful_blades: u32 = 1048576, "blades" in 1024..=8388608;
        /// Billboards of one stand that bodies deform at once, or that still recover: beyond them those nearest to having recovered make room, then new
        /// ones farthest from every focus stay as they are.
        sheets: u32 = 16384, "sheets" in 64..=1000000;
        /// Shrubs, trees or water plants of one stand that bodies or winds of a place move at once.
        touched_plants: u32 = 256, "plants" in 1..=65536;
        /// Of those in sight, how many are cut into layers anew in one step because the view of them has turned.
        cuts: u32 = 24, "plants" in 1..=65536;
        /// Pixels of all layers that are kept, millions: 16 MB each.
        layer_pixels: u32 = 16, "million" in 1..=1024;
        /// Steps run at most for one call, to catch up with the clock.
        catch_up: u32 = 4, "steps" in 1..=60;
        /// What plants show beyond the active patches.
        beyond: Beyond = Beyond::Direct, "";
        /// How a GPU stores the cells of active patches; the CPU always keeps 32 bytes a cell.
        precision: Precision = Precision::Full, "";
    }
}

choices! {
    /// What plants show beyond the active patches.
    pub enum Beyond {
        /// The rest pose in the wind of their own place.
        Direct,
        /// One patch of wind, repeated.
        Tiled,
    }
}

choices! {
    /// How a GPU stores the cells of active patches.
    pub enum Precision {
        /// 32 bytes a cell.
        Full,
        /// 16 bytes a cell, rounded in every step: bends are off by some 1e-4 rad.
        Half,
    }
}
