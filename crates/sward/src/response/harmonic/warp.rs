//! How far the picture of a layer is moved at a place.
//!
//! Chen & Johan 2015, §3.6, eq. 6–7; methods §5.

use crate::math::{clamped, exp_f64, ln_f64};

/// What is the same all over a layer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Warp {
    /// λ_x, λ_y, λ_z: metres that a picture is moved for each metre that vegetation moves in a sixtieth of a second.
    pub scale: [f32; 3],
    /// m: share of the motion that the farthest layer loses.
    pub loss: f32,
    /// Depth of this layer over that of the farthest, 0 to 1; 0 where there is one only.
    pub depth: f32,
    /// r: how stiff it is near its root; 0 everything moves alike.
    pub rigidity: f32,
}

/// τ: the time in which a velocity is shown as a way, s.
const SHOWN: f32 = 1.0 / 60.0;

/// Way to the right and up \[m\] of a place that is `up` of the plant's height above its root, moving at `velocity` \[m/s along right, up and away\].
pub fn offset(warp: &Warp, velocity: [f32; 3], up: f32) -> [f32; 2] {
    let share = clamped(up, 0.0, 1.0);
    let held = match (warp.rigidity > 0.0, share > 0.0) {
        (false, _) => 1.0,
        (true, false) => 0.0,
        (true, true) => exp_f64(f64::from(warp.rigidity) * ln_f64(f64::from(share))) as f32,
    };
    let moves = held * (1.0 - warp.loss * warp.depth * warp.depth) * SHOWN;
    let away = if velocity[2] < 0.0 { -velocity[2] } else { velocity[2] };
    [moves * warp.scale[0] * velocity[0], moves * (warp.scale[1] * velocity[1] - warp.scale[2] * away)]
}
