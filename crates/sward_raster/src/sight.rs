//! What all passes know about a picture: camera, light, air, shadows, size.

use glam::{Vec2, Vec3, Vec4, Vec4Swizzles};
use sward::picture::frame::FrameUniform;
use sward::shading::common::fog;
use sward::shading::sky::Light;

use crate::shadows::ShadowMap;
use crate::surroundings::Surroundings;

/// A picture's frame, taken apart.
pub(crate) struct Sight<'a> {
    pub(crate) frame: FrameUniform,
    pub(crate) light: Light,
    /// Eye, m in frame space.
    pub(crate) eye: Vec3,
    /// Size in pixels.
    pub(crate) size: [u32; 2],
    pub(crate) shadows: &'a ShadowMap<'a>,
    /// Where the scene has some.
    pub(crate) surroundings: Option<Surroundings<'a>>,
}

impl<'a> Sight<'a> {
    pub(crate) fn new(frame: FrameUniform, size: [u32; 2], shadows: &'a ShadowMap<'a>, surroundings: Option<Surroundings<'a>>) -> Self {
        let light = Light { sun: frame.sun.xyz(), sun_colour: frame.sun_colour.xyz(), sky: frame.sky.xyz(), ground: frame.ground.xyz() };
        Self { light, eye: frame.camera.xyz(), size, shadows, surroundings, frame }
    }

    /// Clip space of a place.
    #[inline]
    pub(crate) fn clip(&self, place: Vec3) -> Vec4 {
        self.frame.view_projection * place.extend(1.0)
    }

    /// Size in pixels, as numbers to reckon with.
    pub(crate) fn pixels(&self) -> Vec2 {
        Vec2::new(self.size[0] as f32, self.size[1] as f32)
    }

    /// Haziness of the sky, 0..=1.
    pub(crate) fn haze(&self) -> f32 {
        self.frame.sun.w
    }

    /// What `distance` m of air leave of light.
    #[inline]
    pub(crate) fn clear(&self, distance: f32) -> f32 {
        fog(distance, self.frame.camera.w)
    }

    /// A place in the pattern of the ground, m.
    #[inline]
    pub(crate) fn pattern(&self, place: Vec3) -> Vec2 {
        Vec2::new(place.x, place.z) + self.frame.phase.xy()
    }
}

/// Between three values, by their weights.
#[inline]
pub(crate) fn mix(weights: Vec3, values: &[Vec3; 3]) -> Vec3 {
    values[0] * weights.x + values[1] * weights.y + values[2] * weights.z
}
