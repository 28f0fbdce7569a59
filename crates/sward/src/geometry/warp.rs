//! How far the picture of a layer is moved at a place.
//!
//! Chen & Johan 2015, §3.6, eq. 6–7; methods §5. Twin: `layers_corner` of `layers.wgsl`.

use crate::math::clamped;

/// τ: the time in which a velocity is shown as a way, s.
const SHOWN: f32 = 1.0 / 60.0;

/// What is the same all over a layer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Warp {
    /// m for each m/s to the right and up, and down for each m/s to or from the eye.
    pub scale: [f32; 3],
    /// r: how stiff it is near its root; 0 everything moves alike.
    pub rigidity: f32,
}

impl Warp {
    /// Of a layer `depth` \[share of that of the farthest, 0 where there is one only\] behind the first. `scale` is λ, metres for each metre of way in a
    /// sixtieth of a second; `loss` is m, the share of the motion that the farthest layer loses.
    pub fn new(scale: [f32; 3], loss: f32, depth: f32, rigidity: f32) -> Self {
        let moves = (1.0 - loss * depth * depth) * SHOWN;
        Self { scale: scale.map(|way| moves * way), rigidity }
    }
}

/// Way to the right and up \[m\] of a place that is `up` of the plant's height above its root, moving at `velocity` \[m/s along right, up and away\].
pub fn offset(warp: &Warp, velocity: [f32; 3], up: f32) -> [f32; 2] {
    let share = clamped(up, 0.0, 1.0);
    let held = if warp.rigidity > 0.0 { share.powf(warp.rigidity) } else { 1.0 };
    let away = if velocity[2] < 0.0 { -velocity[2] } else { velocity[2] };
    [held * warp.scale[0] * velocity[0], held * (warp.scale[1] * velocity[1] - warp.scale[2] * away)]
}
