//! How plants lie by themselves where pictures say so: a direction, and how messy.
//!
//! Orthmann et al. 2009, §4: an RGB picture of the direction in which all grow, a grey one of how random they are.

use std::sync::Arc;

use super::MaskImage;
use super::image::{Canvas, between};
use crate::math::{self, clamped};
use crate::placement::MOST_LEAN;

/// A picture of directions: the lean of each pixel, rad along x and z.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectionImage {
    canvas: Canvas,
    leans: Vec<[f32; 2]>,
}

impl DirectionImage {
    /// From an RGB PNG of 8 bits, 1 to 2048 pixels a side: red along x, green along z, blue up; 128 is none of it.
    ///
    /// # Errors
    /// What is wrong with the picture, and what was expected.
    pub fn from_png(bytes: &[u8]) -> Result<Self, String> {
        let (canvas, pixels) = Canvas::colours("picture of directions", bytes)?;
        let lean = |[red, green, blue]: [u8; 3]| {
            let [x, z, up] = [red, green, blue].map(|part| (f32::from(part) - 128.0) / 127.0);
            let level = (x * x + z * z).sqrt();
            let angle = math::lower(math::atan2(level, math::upper(up, 0.0)), MOST_LEAN);
            let share = if level > 1e-6 { angle / level } else { 0.0 };
            [x * share, z * share]
        };
        Ok(Self { canvas, leans: pixels.into_iter().map(lean).collect() })
    }

    /// Between pixels; `at` is 0 to 1 along x and z.
    fn at(&self, at: [f32; 2]) -> [f32; 2] {
        let (texels, f) = self.canvas.around(at);
        let leans = texels.map(|texel| self.leans.get(texel as usize).copied().unwrap_or_default());
        [0, 1].map(|axis: usize| between(leans.map(|lean| lean[axis]), f))
    }
}

/// Pictures of how plants lie, on the ground.
#[derive(Clone, Debug, PartialEq)]
pub struct Comb {
    /// Corner of least x and z, m.
    pub corner: [f64; 2],
    /// Width and length, m.
    pub size: [f32; 2],
    /// Which way they lean.
    pub direction: Option<Arc<DirectionImage>>,
    /// How far each leans some way of its own: white is all.
    pub messiness: Option<Arc<MaskImage>>,
}

impl Comb {
    /// Whether it lies anywhere on a square of `side` \[m\].
    pub(super) fn touches(&self, corner: [f64; 2], side: f64) -> bool {
        (0..2).all(|axis| self.corner[axis] < corner[axis] + side && self.corner[axis] + f64::from(self.size[axis]) > corner[axis])
    }

    /// Lean \[rad\] and messiness \[0 to 1\] at a place \[m\], where it says something of it.
    pub(super) fn at(&self, ground: [f64; 2]) -> Option<(Option<[f32; 2]>, Option<f32>)> {
        let at = [0, 1].map(|axis: usize| ((ground[axis] - self.corner[axis]) / f64::from(self.size[axis])) as f32);
        let inside = at.iter().all(|along| (0.0..=1.0).contains(along));
        inside.then(|| (self.direction.as_ref().map(|image| image.at(at)), self.messiness.as_ref().map(|image| image.at(at))))
    }
}

/// A lean in hundredths of a radian, as growth maps have it.
pub(super) fn hundredths(lean: [f32; 2]) -> [i8; 2] {
    // To the nearest: the cast cuts off.
    lean.map(|part| clamped(part * 100.0 + if part < 0.0 { -0.5 } else { 0.5 }, -127.0, 127.0) as i8)
}
