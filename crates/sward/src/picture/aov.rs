//! Outputs of each pixel beside its colour: depth, motion since the picture before, and which plant it shows.
//!
//! They are of one sample, at the pixel's centre: nothing is blended across an edge. A leaf holds the pixel where it would cover at
//! least half of it. Twin: `aov.wgsl` of `sward_wgpu`.

use glam::{Mat4, Vec2, Vec4};

use super::frame::NEAR;

/// Coverage from which on a leaf holds a pixel (`AOV_COVERAGE` in `aov.wgsl`).
pub const COVERAGE: f32 = 0.5;
/// Both components, in pixels, of the motion of what was behind the camera in the picture before: outside every picture.
pub const UNSEEN: f32 = 65536.0;

/// The outputs of one picture, row-major from the top left.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Aov {
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Distance along the axis of view, m; infinite for the sky.
    pub depth: Vec<f32>,
    /// From the pixel to where the same point of the same surface was in the picture before, pixels: x to the right, y down. Of the sky,
    /// what the camera's turning does; ([`UNSEEN`], [`UNSEEN`]) for what was behind the camera.
    pub motion: Vec<[f32; 2]>,
    /// Number of the plant ([`super::identity`]), or of the body; 0 for ground and sky.
    pub plant: Vec<u32>,
}

/// What one pixel holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AovPixel {
    /// As in [`Aov`].
    pub depth: f32,
    /// As in [`Aov`].
    pub motion: [f32; 2],
    /// As in [`Aov`].
    pub plant: u32,
}

/// The pixel that shows a point: `now` and `then` are its places in the clip spaces of this picture and of the one before.
pub fn pixel(now: Vec4, then: Vec4, size: Vec2, plant: u32) -> AovPixel {
    let motion = if then.w < NEAR {
        [UNSEEN; 2]
    } else {
        let way = (Vec2::new(then.x, then.y) / then.w - Vec2::new(now.x, now.y) / now.w) * (0.5 * size);
        [way.x, -way.y]
    };
    AovPixel { depth: now.w, motion, plant }
}

/// `Aov` of `aov.wgsl`: the camera of the picture before.
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct AovUniform {
    /// Frame space of this picture to clip space of the one before.
    pub then: Mat4,
    /// Eye of the picture before, m in frame space of this one; w unused.
    pub eye: Vec4,
    /// Width and height of both, pixels; zw unused.
    pub size: Vec4,
}
