//! How the ground is cut into patches.

use super::parameters::parameters;

parameters! {
    /// The grid of patches: squares of cells that wake, sleep and are stored together.
    pub struct Field {
        /// Side of a patch.
        patch_side: f32 = 32.0, "m" in 8.0..=64.0;
        /// Number of patches in x and z, centred on the authored position (0, 0). Without it the field has no end.
        patches: Option<[u32; 2]> = None, "patches" in 1..=1000000;
    }
}
