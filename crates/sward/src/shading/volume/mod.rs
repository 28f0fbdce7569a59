//! A volume of light among the plants: share of the sky seen, and light from all sides, in voxels laid on the ground.
//!
//! Orthmann et al. 2009, §6.1: "a volume, with each voxel storing ambient occlusion information", and a second one of irradiance, read by
//! trilinear interpolation. Twin: `volume.wgsl`; it is worked out in [`crate::picture::volume`].
//!
//! Differs from the paper: both volumes are one, with irradiance for six normals (an ambient cube: McTaggart 2004), so that light of the
//! sky's colours falls on every side of a leaf, and what shines through its back is known too. Six non-negative numbers do not ring, as
//! spherical harmonics do near a bright horizon, and are exact on level ground. Layers follow the terrain.

pub mod lit;

use glam::{Vec3, Vec4, Vec4Swizzles};

pub use super::environment::FACES;
use crate::math;

/// The light of a place in WGSL.
pub const WGSL: &str = include_str!("volume.wgsl");

/// Numbers of a voxel: one for each face.
pub const FACE_COUNT: u32 = 6;

/// What is known of the light of a place, for each of the [`FACES`]: rgb what a white leaf would send back, irradiance / π; w share of
/// the surroundings seen, weighted as for irradiance.
pub type Faces = [Vec4; FACES.len()];

/// The volume.
#[derive(Clone, Debug, PartialEq)]
pub struct Volume {
    /// Columns along x, rows along z, layers upwards.
    pub size: [u32; 3],
    /// Its corner of least x and z, m from the corner of the origin patch.
    pub corner: [f64; 2],
    /// Its sides along x and z, m.
    pub extent: [f64; 2],
    /// Height of the last layer above the ground, m; the first one lies on the ground.
    pub height: f32,
    /// Light of the voxels, [`Faces`] one after the other, each layer by layer, row by row; as half-precision numbers hold it.
    pub texels: Vec<[half::f16; 4]>,
}

/// Where a place lies in the volume.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// Shares of the sides, 0..=1 inside.
    pub across: [f32; 2],
    /// Share of the height, 0..=1 inside.
    pub up: f32,
}

impl Volume {
    /// Voxels.
    pub fn voxels(&self) -> usize {
        self.size.iter().map(|side| *side as usize).product()
    }

    /// The light of a place; outside the volume that of its nearest place, which is an open field's.
    pub fn faces(&self, spot: Spot) -> Faces {
        let [columns, rows, layers] = self.size;
        let (column, east) = between(spot.across[0] * columns as f32 - 0.5, columns);
        let (row, south) = between(spot.across[1] * rows as f32 - 0.5, rows);
        let (layer, above) = between(math::clamped(spot.up, 0.0, 1.0) * (layers - 1) as f32, layers);
        std::array::from_fn(|face| {
            let load = |layer: u32, row: u32, column: u32| {
                let at = ((face as u32 * layers + layer) * rows + row) * columns + column;
                self.texels.get(at as usize).map_or(Vec4::ZERO, |texel| Vec4::from(texel.map(half::f16::to_f32)))
            };
            let level = |layer: u32| {
                let along = |row: u32| load(layer, row, column[0]).lerp(load(layer, row, column[1]), east);
                along(row[0]).lerp(along(row[1]), south)
            };
            level(layer[0]).lerp(level(layer[1]), above)
        })
    }
}

/// The two samples around a place, and how near it is to the second.
fn between(at: f32, count: u32) -> ([u32; 2], f32) {
    let at = math::clamped(at, 0.0, (count - 1) as f32);
    let low = (math::floored(at) as u32).min(count - 1);
    ([low, (low + 1).min(count - 1)], at - low as f32)
}

/// Light on a surface: what it would send back if it were white, and the share of the surroundings it sees.
pub fn facing(faces: &Faces, normal: Vec3) -> Vec4 {
    let squared = normal * normal;
    let side = |value: f32, positive: usize| if value < 0.0 { faces[positive + 1] } else { faces[positive] };
    side(normal.x, 0) * squared.x + side(normal.y, 2) * squared.y + side(normal.z, 4) * squared.z
}

/// Mean of the light from all sides.
pub fn mean(faces: &Faces) -> Vec3 {
    (faces[0] + faces[1] + faces[2] + faces[3] + faces[4] + faces[5]).xyz() / FACES.len() as f32
}
