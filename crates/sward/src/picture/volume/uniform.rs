//! Where the volume lies in a picture's frame, and what all passes know of the surroundings.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;

use super::Lighting;
use crate::shading::environment::Environment;
use crate::shading::volume::{Faces, Spot, Volume};

/// `Ambient` of `surroundings.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct AmbientUniform {
    /// The volume's corner, m in frame space (x, z); then 1 / its sides, 1/m.
    pub place: [f32; 4],
    /// 1 / its height, 1/m; layers; turn of the surroundings, rad; cosine of the sun's radius.
    pub shape: [f32; 4],
    /// Radiance of the sun's disc, linear RGB; w = brightest that bodies mirror of the surroundings.
    pub disc: [f32; 4],
    /// Colour of far air: constant, and two pairs of waves round the horizon; w unused.
    pub horizon: [[f32; 4]; 5],
}

impl AmbientUniform {
    /// Of a frame whose origin is `origin` \[m\]; `strength` is the factor on the sun.
    pub fn new(lighting: &Lighting, origin: [f64; 2], strength: f32) -> Self {
        let Lighting { environment, volume } = lighting;
        let corner = [0, 1].map(|axis| (volume.corner[axis] - origin[axis]) as f32);
        let side = volume.extent.map(|side| (1.0 / side) as f32);
        let disc = environment.sun.map_or(Vec3::ZERO, |sun| sun.disc(strength));
        let brightest = 8.0 * environment.level[0].max_element() * std::f32::consts::FRAC_1_PI;
        Self {
            place: [corner[0], corner[1], side[0], side[1]],
            shape: [1.0 / volume.height, volume.size[2] as f32, environment.turn, Environment::DISC],
            disc: disc.extend(brightest).to_array(),
            horizon: environment.horizon.map(|colour| colour.extend(0.0).to_array()),
        }
    }

    /// Share of the volume's height that a place `above` m over the ground has.
    pub fn up(&self, above: f32) -> f32 {
        above * self.shape[0]
    }

    /// The light at a place of frame space, at a share of the volume's height.
    pub fn faces(&self, volume: &Volume, place: Vec3, up: f32) -> Faces {
        let [x, z, across, along] = self.place;
        volume.faces(Spot { across: [(place.x - x) * across, (place.z - z) * along], up })
    }
}
