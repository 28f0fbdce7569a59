//! All directions in parts of equal size, and what the surroundings send from each of them.

use glam::Vec3;

use super::Environment;
use crate::math::sin_cos_f64;

/// Normals that light is kept for: +x, −x, up, down, +z, −z. Between them it is weighted by the squares of a normal's parts.
pub const FACES: [Vec3; 6] = [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z];

/// Directions in `4 n × 2 n` parts of the same solid angle: rows of equal height, each once round.
#[derive(Clone, Debug, PartialEq)]
pub struct Sphere {
    /// Parts once round.
    pub round: u32,
    /// Rows, from straight down to straight up.
    pub rows: u32,
    /// The middle of each part, unit.
    pub directions: Vec<Vec3>,
    /// ∫ max(n · ω, 0) dω of each part for the six [`FACES`], sr.
    pub facing: Vec<[f32; 6]>,
    /// ∫ L max(n · ω, 0) dω likewise: what reaches the faces where nothing is in between. Linear RGB.
    pub irradiance: Vec<[Vec3; 6]>,
    /// ∫ L dω of each part.
    pub light: Vec<Vec3>,
}

impl Sphere {
    /// Some `samples` parts, 8 to 512, of a sky without the sun.
    pub fn new(environment: &Environment, samples: u32) -> Self {
        let n = (1..=8).find(|n| 8 * n * n + 8 * n + 2 > samples).unwrap_or(8);
        let (round, rows) = (4 * n, 2 * n);
        let parts = (round * rows) as usize;
        let mut sums = vec![[[0.0_f64; 4]; 7]; parts];
        environment.pixels(|direction, solid, at| {
            let [x, up, z] = direction;
            let sums = &mut sums[part(round, rows, [x, up, z])];
            let [r, g, b] = environment.radiance[at].map(f64::from);
            for (sum, weight) in sums.iter_mut().zip([x, -x, up, -up, z, -z, 1.0]) {
                let weight = weight.max(0.0) * solid;
                for (sum, value) in sum.iter_mut().zip([weight, r * weight, g * weight, b * weight]) {
                    *sum += value;
                }
            }
        });
        let colour = |sum: [f64; 4]| Vec3::new(sum[1] as f32, sum[2] as f32, sum[3] as f32);
        Self {
            round,
            rows,
            directions: (0..parts as u32).map(|part| middle(round, rows, part)).collect(),
            facing: sums.iter().map(|sums| std::array::from_fn(|face| sums[face][0] as f32)).collect(),
            irradiance: sums.iter().map(|sums| std::array::from_fn(|face| colour(sums[face]))).collect(),
            light: sums.iter().map(|sums| colour(sums[6])).collect(),
        }
    }

    /// Solid angle of a part, sr.
    pub fn solid(&self) -> f32 {
        4.0 * std::f32::consts::PI / (self.round * self.rows) as f32
    }
}

/// The part that a direction lies in.
fn part(round: u32, rows: u32, [x, up, z]: [f64; 3]) -> usize {
    let turn = crate::math::atan2_f64(z, x) / std::f64::consts::TAU;
    let column = ((turn - turn.floor()) * f64::from(round)) as u32;
    let row = ((0.5 + 0.5 * up) * f64::from(rows)) as u32;
    (row.min(rows - 1) * round + column.min(round - 1)) as usize
}

fn middle(round: u32, rows: u32, part: u32) -> Vec3 {
    let (sine, cosine) = sin_cos_f64((f64::from(part % round) + 0.5) / f64::from(round) * std::f64::consts::TAU);
    let up = (f64::from(part / round) + 0.5) / f64::from(rows) * 2.0 - 1.0;
    let level = (1.0 - up * up).sqrt();
    Vec3::new((level * cosine) as f32, up as f32, (level * sine) as f32)
}
