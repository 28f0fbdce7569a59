//! A picture of the surroundings as light: sky, sun, and what lies below the horizon.
//!
//! Orthmann et al. 2009, §6.1: "sampling an environment map". Pharr & Green 2004 give the idea: light from the directions that are seen.
//! The sun is taken out of the picture (`sun`) and shines by itself, since it casts sharp shadows and no voxel could hold them. Twin:
//! `environment.wgsl`.

mod load;
mod sphere;
mod sun;

use glam::{Vec2, Vec3};

pub use sphere::{FACES, Sphere};
pub use sun::Sun;

use super::sky::Light;
use crate::math::{self, atan2_f64, sin_cos_f64};

/// Directions of a picture of the surroundings in WGSL; needs `math` before it.
pub const WGSL: &str = include_str!("environment.wgsl");

/// Most columns of a picture.
pub const MOST_COLUMNS: u32 = 4096;
/// Sine of the height up to which the sky colours far air.
const HORIZON: f64 = 0.10;
/// Light of far air before the ground, as a share of that of the sky near the horizon.
const AIR: f64 = 0.85;
/// What the ground under an open sky sends back, linear RGB: as in [`Light::new`].
const GROUND: Vec3 = Vec3::new(0.10, 0.12, 0.05);
/// Level light of 1 is exposed like this: the sky of [`super::sky`] has some 3, and is exposed 1.4 times.
const EXPOSURE: f32 = 4.2;

/// The surroundings of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Environment {
    /// Pixels along a row: once round, from −x over −z, +x and +z back to −x before it is turned.
    pub columns: u32,
    /// Rows, from straight up to straight down.
    pub rows: u32,
    /// Linear RGB radiance without the sun, row by row, as far as half-precision numbers hold it.
    pub radiance: Vec<[f32; 3]>,
    /// The sun, if there is one.
    pub sun: Option<Sun>,
    /// Turn about the vertical, rad, from +x towards +z.
    pub turn: f32,
    /// Factor on all of its light; the pixels and the sun have it already.
    pub strength: f32,
    /// Irradiance of level ground that faces up, and down, without the sun, linear RGB.
    pub level: [Vec3; 2],
    /// Colour of the air near the horizon: constant, and two pairs of waves round the horizon.
    pub horizon: [Vec3; 5],
}

impl Environment {
    /// Cosine of the radius of the sun that is drawn.
    pub const DISC: f32 = sun::DISC;

    /// Reads a Radiance RGBE picture (.hdr). `strength` is a factor on its light, `turn` \[rad\] turns it about the vertical.
    ///
    /// # Errors
    /// What is wrong with the picture, and what was expected.
    pub fn from_hdr(bytes: &[u8], strength: f32, turn: f32) -> Result<Self, String> {
        let (columns, rows, pixels) = load::pixels(bytes)?;
        Ok(Self::new(columns, rows, pixels, strength, turn))
    }

    /// Surroundings of `columns` × `rows` pixels; what is missing is black, what is no radiance too.
    pub fn new(columns: u32, rows: u32, mut radiance: Vec<[f32; 3]>, strength: f32, turn: f32) -> Self {
        let (columns, rows) = (columns.clamp(1, MOST_COLUMNS), rows.clamp(1, MOST_COLUMNS));
        radiance.resize(columns as usize * rows as usize, [0.0; 3]);
        radiance.iter_mut().flatten().for_each(|value| *value = load::bright(*value * strength));
        let mut made = Self { columns, rows, radiance, sun: None, turn, strength, level: [Vec3::ZERO; 2], horizon: [Vec3::ZERO; 5] };
        sun::take(&mut made);
        made.radiance.iter_mut().flatten().for_each(|value| *value = half::f16::from_f32(*value).to_f32());
        made.sum();
        made
    }

    /// The light of the whole, for what stands in the open. `strength` is a factor on the sun alone; where there is none, shadows fall
    /// from the direction `azimuth`, `elevation` \[rad\], and nobody sees them.
    pub fn light(&self, strength: f32, azimuth: f32, elevation: f32) -> Light {
        let (up, over) = (math::sin_cos(elevation), math::sin_cos(azimuth));
        let nowhere = Sun { direction: Vec3::new(up.1 * over.1, up.0, up.1 * over.0), irradiance: Vec3::ZERO };
        let Sun { direction, irradiance } = self.sun.unwrap_or(nowhere);
        let sun_colour = irradiance * strength;
        let sky = self.level[0] / std::f32::consts::PI;
        Light { sun: direction, sun_colour, sky, ground: GROUND * (sky + sun_colour * (direction.y.max(0.0) / std::f32::consts::PI)) }
    }

    /// Exposure factor at 0 EV: whatever the unit of the picture, its level light is exposed alike.
    pub fn exposure(&self) -> f32 {
        let sun = self.sun.map_or(Vec3::ZERO, |sun| sun.irradiance);
        let seen = (0.2 * sun + self.level[0]).dot(Vec3::new(0.2126, 0.7152, 0.0722));
        if self.strength > 0.0 && seen > 0.0 { (EXPOSURE * self.strength / seen).clamp(1e-6, 1e6) } else { 1.0 }
    }

    /// Radiance seen in a direction (unit), without the sun.
    pub fn radiance_at(&self, direction: Vec3) -> Vec3 {
        let at = place(direction, self.turn);
        let (x, y) = (at.x * self.columns as f32 - 0.5, at.y * self.rows as f32 - 0.5);
        let (column, row) = (math::floored(x), math::floored(y));
        let (across, down) = (x - column as f32, y - row as f32);
        let pixel = |dx: i32, dy: i32| {
            let (x, y) = ((column + dx).rem_euclid(self.columns as i32), (row + dy).clamp(0, self.rows as i32 - 1));
            Vec3::from(self.radiance[y as usize * self.columns as usize + x as usize])
        };
        pixel(0, 0).lerp(pixel(1, 0), across).lerp(pixel(0, 1).lerp(pixel(1, 1), across), down)
    }

    /// Calls `each` with direction (turned, unit), solid angle \[sr\] and place in [`Environment::radiance`] of every pixel; of small
    /// pictures with those of parts of pixels.
    fn pixels(&self, mut each: impl FnMut([f64; 3], f64, usize)) {
        let parts = 256_u32.div_ceil(self.columns);
        let (across, down) = (self.columns * parts, self.rows * parts);
        let turn = std::f64::consts::TAU / f64::from(across);
        let columns: Vec<[f64; 2]> = (0..across)
            .map(|column| {
                let (sine, cosine) = sin_cos_f64((f64::from(column) + 0.5) * turn - std::f64::consts::PI + f64::from(self.turn));
                [cosine, sine]
            })
            .collect();
        for row in 0..down {
            let height = |edge: f64| sin_cos_f64(edge / f64::from(down) * std::f64::consts::PI);
            let ((_, top), (_, bottom)) = (height(f64::from(row)), height(f64::from(row + 1)));
            let (level, up) = height(f64::from(row) + 0.5);
            let solid = turn * (top - bottom);
            for (column, [x, z]) in columns.iter().enumerate() {
                let at = (row / parts * self.columns) as usize + column / parts as usize;
                each([level * x, up, level * z], solid, at);
            }
        }
    }

    /// Fills what follows from the pixels.
    fn sum(&mut self) {
        let (mut level, mut waves, mut weight) = ([[0.0; 3]; 2], [[0.0; 3]; 5], 0.0);
        self.pixels(|direction, solid, at| {
            let [x, up, z] = direction;
            let side = &mut level[usize::from(up < 0.0)];
            let near_horizon = (0.0..HORIZON).contains(&up);
            let wave = [1.0, 2.0 * x, 2.0 * z, 2.0 * (x * x - z * z), 4.0 * x * z];
            weight += if near_horizon { solid } else { 0.0 };
            for channel in 0..3 {
                let light = f64::from(self.radiance[at][channel]) * solid;
                side[channel] += light * up.abs();
                for (sum, wave) in waves.iter_mut().zip(wave).filter(|_| near_horizon) {
                    sum[channel] += light * wave;
                }
            }
        });
        self.level = level.map(|sum| Vec3::from(sum.map(|sum| sum as f32)));
        // The second pair is damped, so that no bright sun leaves ripples; and air before hills is darker than that before the sky.
        let damped = [1.0, 1.0, 1.0, 0.5, 0.5].map(|share| AIR * share);
        self.horizon = std::array::from_fn(|k| Vec3::from(waves[k].map(|sum| (damped[k] * sum / weight.max(1e-9)) as f32)));
    }
}

/// Where a direction (unit) lies in a picture that is turned by `turn` \[rad\]: u once round, v from straight up to straight down, 0..=1.
pub fn place(direction: Vec3, turn: f32) -> Vec2 {
    let round = (math::atan2(direction.z, direction.x) - turn) * (0.5 * std::f32::consts::FRAC_1_PI) + 0.5;
    let level = (direction.x * direction.x + direction.z * direction.z).sqrt();
    Vec2::new(round - round.floor(), math::atan2(level, direction.y) * std::f32::consts::FRAC_1_PI)
}

/// Colour that the air adds between the eye and far away, by direction of the ray: the horizon's. `horizon` as in [`Environment`].
pub fn air(horizon: &[Vec3; 5], ray: Vec3) -> Vec3 {
    let level = (ray.x * ray.x + ray.z * ray.z).sqrt();
    let (x, z) = (ray.x / math::upper(level, 1e-6), ray.z / math::upper(level, 1e-6));
    let [mean, across, along, first, second] = *horizon;
    (mean + across * x + along * z + first * (x * x - z * z) + second * (2.0 * x * z)).max(0.15 * mean)
}

/// The disc of the sun in a direction (unit): `disc` is its radiance, `cosine` that of its radius.
pub fn disc(direction: Vec3, sun: Vec3, disc: Vec3, cosine: f32) -> Vec3 {
    let inside = (direction.dot(sun) - cosine) / (1.0 - cosine);
    disc * math::smoothstep(-0.2, 0.2, inside)
}

/// The angle between two directions of a picture, rad.
fn angle(a: [f64; 3], b: [f64; 3]) -> f64 {
    let dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    atan2_f64((1.0 - dot * dot).max(0.0).sqrt(), dot)
}
