//! A picture of a world, as far as no graphics device is needed: what is drawn, from where, in which light.
//!
//! `sward_wgpu` and `sward_raster` both draw from it: [`plan`] decides which patches are seen, [`prepare`] solves each visible plant
//! once (on a GPU `prepare.wgsl` does), [`frame`] lays out camera, light and shadow map, [`subject`] gives looks, meshes and poses.
//! Where a scene has a picture of its surroundings, [`volume`] works out the light among the plants. Beside a picture there may be outputs of each pixel, [`aov`], for which [`past`] remembers the picture before. [`standing`] tells of single plants what a picture
//! shows of them.

pub mod aov;
pub mod asked;
pub mod blade_plan;
pub mod blades;
pub mod frame;
pub mod identity;
pub mod layers;
pub mod past;
pub mod plan;
pub mod plants;
pub mod prepare;
mod sheet_at;
mod sheets;
pub mod standing;
pub mod subject;
pub mod volume;

/// A finished picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// sRGB code values and opaque alpha, row-major from the top left.
    pub rgba8: Vec<u8>,
}
