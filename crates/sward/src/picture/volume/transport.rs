//! Light through a haze of leaves over the ground: rays from every voxel into all directions of a [`crate::shading::environment::Sphere`].
//!
//! A ray is followed in steps that grow with distance. It loses light to leaves, ends on the ground, and sees the surroundings where it
//! leaves the plants and no hill is in the way. What leaves send on goes everywhere alike.

use std::f32::consts::PI;

use glam::{Vec3, Vec4};
use half::f16;

use super::inputs::Inputs;
use crate::math::{self, clamped, exp, floored, smoothstep};
use crate::response::each::each;
use crate::shading::volume::{FACES, Faces, Volume};

/// How often light goes on from leaves and ground.
pub const BOUNCES: usize = 2;
/// First step, as a share of the volume's height.
const STEP: f32 = 1.0 / 28.0;
/// Each step is this much longer than the one before.
const GROWTH: f32 = 1.22;
/// Most steps: 200 heights far.
const STEPS: usize = 36;
/// Less light than this share is none.
const DARK: f32 = 0.003;
/// Width of the rim in which the volume becomes an open field, as a share of its side.
const RIM: f32 = 0.14;
/// Rows whose voxels are worked out before progress is told.
const ROWS: u32 = 8;

/// Light of a voxel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Voxel {
    faces: Faces,
    /// ∫ L dω without the sun's.
    all: Vec3,
    /// Share of the sun that arrives.
    sun: f32,
}

/// What a ray meets.
struct Ray {
    /// Share of what comes from beyond that arrives.
    clear: f32,
    /// Light from leaves and ground on the way.
    light: Vec3,
}

/// A round of light: what leaves and ground send out.
struct Round<'a> {
    inputs: &'a Inputs,
    /// Radiance of leaves in each voxel.
    leaves: &'a [Vec3],
    /// Radiance of the ground under each column.
    floor: &'a [Vec3],
    /// Radiance of hills far away.
    hills: Vec3,
}

/// The volume of light. `progress` hears of shares done, 0..=1.
pub fn volume(inputs: &Inputs, progress: &mut dyn FnMut(f32)) -> Volume {
    let field = light(&inputs.field(), &mut |_| ());
    let voxels = light(inputs, progress);
    let room = &inputs.room;
    let [columns, rows, layers] = room.size;
    let mut texels = Vec::with_capacity(voxels.len() * FACES.len());
    for face in 0..FACES.len() {
        for layer in 0..layers {
            for row in 0..rows {
                for column in 0..columns {
                    let at = ((layer * rows + row) * columns + column) as usize;
                    let share = within(column, columns) * within(row, rows);
                    let value = field[layer as usize].faces[face].lerp(voxels[at].faces[face], share);
                    texels.push(value.to_array().map(f16::from_f32));
                }
            }
        }
    }
    Volume { size: room.size, corner: room.corner, extent: room.extent(), height: room.height, texels }
}

/// How much a column's own light counts: nothing at the rim.
fn within(index: u32, count: u32) -> f32 {
    let to_rim = index.min(count - 1 - index) as f32;
    smoothstep(0.0, math::upper(RIM * count as f32, 1.0), to_rim)
}

/// All rounds of light.
fn light(inputs: &Inputs, progress: &mut dyn FnMut(f32)) -> Vec<Voxel> {
    let columns = inputs.room.columns();
    let (mut leaves, mut floor) = (vec![Vec3::ZERO; columns * inputs.room.size[2] as usize], vec![Vec3::ZERO; columns]);
    let sun = inputs.sun;
    let above: Vec3 = inputs.sphere.irradiance.iter().map(|faces| faces[2]).sum();
    let hills = Vec3::from(inputs.hills) * (above + sun.irradiance * sun.direction.y) / PI;
    let mut voxels = Vec::new();
    for bounce in 0..=BOUNCES {
        let hills = if bounce == 0 { Vec3::ZERO } else { hills };
        let round = Round { inputs, leaves: &leaves, floor: &floor, hills };
        let mut told = |share: f32| progress((bounce as f32 + share) / (BOUNCES + 1) as f32);
        voxels = round.voxels(&mut told);
        let albedo = Vec3::from(inputs.albedo);
        let sent = |voxel: &Voxel| albedo * (voxel.all + sun.irradiance * voxel.sun) / (4.0 * PI);
        let soil =
            |voxel: &Voxel| Vec3::from(inputs.soil) * (voxel.faces[2].truncate() + sun.irradiance * (voxel.sun * sun.direction.y / PI));
        leaves = voxels.iter().map(sent).collect();
        floor = voxels[..columns].iter().map(soil).collect();
    }
    voxels
}

impl Round<'_> {
    fn voxels(&self, progress: &mut dyn FnMut(f32)) -> Vec<Voxel> {
        let [columns, rows, layers] = self.inputs.room.size;
        let mut voxels = vec![Voxel::default(); columns as usize * rows as usize * layers as usize];
        for first in (0..rows).step_by(ROWS as usize) {
            let last = (first + ROWS).min(rows);
            let lines = (first..last).flat_map(|row| (0..layers).map(move |layer| (row, layer))).collect();
            let line = |(row, layer)| (row, layer, (0..columns).map(|column| self.voxel([column, row, layer])).collect::<Vec<_>>());
            for (row, layer, line) in each(lines, line) {
                let at = ((layer * rows + row) * columns) as usize;
                voxels[at..at + columns as usize].copy_from_slice(&line);
            }
            progress(last as f32 / rows as f32);
        }
        voxels
    }

    fn voxel(&self, [column, row, layer]: [u32; 3]) -> Voxel {
        let (sphere, room) = (&self.inputs.sphere, &self.inputs.room);
        let up = layer as f32 / (room.size[2] - 1) as f32 * room.height;
        let from = [column, row].map(|at| at as f32 + 0.5);
        let (mut faces, mut all) = ([Vec4::ZERO; FACES.len()], Vec3::ZERO);
        for part in 0..sphere.directions.len() {
            let ray = self.ray(from, up, sphere.directions[part], part as u32 % sphere.round);
            let facing = &sphere.facing[part];
            for (face, sum) in faces.iter_mut().enumerate() {
                let light = ray.clear * sphere.irradiance[part][face] + facing[face] * ray.light;
                *sum += light.extend(ray.clear * facing[face]) / PI;
            }
            all += ray.clear * sphere.light[part] + sphere.solid() * ray.light;
        }
        let sun = self.inputs.sun.direction;
        let turn = math::atan2(sun.z, sun.x) * (0.5 / PI);
        let way = ((turn - floored(turn) as f32) * sphere.round as f32) as u32;
        Voxel { faces, all, sun: self.ray(from, up, sun, way.min(sphere.round - 1)).clear }
    }

    /// Follows a ray from a place (voxels over the ground, m above it) in a direction, which is number `way` of those over the ground.
    fn ray(&self, from: [f32; 2], up: f32, direction: Vec3, way: u32) -> Ray {
        let room = &self.inputs.room;
        let along = [direction.x / room.voxel[0] as f32, direction.z / room.voxel[1] as f32];
        let start = up + self.ground(from);
        let (mut ray, mut gone, mut step) = (Ray { clear: 1.0, light: Vec3::ZERO }, 0.0, STEP * room.height);
        for _ in 0..STEPS {
            let middle = gone + 0.5 * step;
            let at = [from[0] + along[0] * middle, from[1] + along[1] * middle];
            let above = start + direction.y * middle - self.ground(at);
            if above >= room.height && direction.y > 0.0 {
                break;
            }
            let column = self.column(at);
            if above <= 0.0 {
                ray.light += ray.clear * self.floor[column];
                return Ray { clear: 0.0, ..ray };
            }
            let left = exp(-self.lost(column, above) * step);
            ray.light += ray.clear * (1.0 - left) * self.leaves[self.layer(above) * room.columns() + column];
            ray.clear *= left;
            if ray.clear < DARK {
                return Ray { clear: 0.0, ..ray };
            }
            (gone, step) = (gone + step, step * GROWTH);
        }
        let column = self.column(from);
        let level = (direction.x * direction.x + direction.z * direction.z).sqrt();
        let skyline = self.inputs.skyline.get(column * self.inputs.sphere.round as usize + way as usize).copied().unwrap_or(0.0);
        if direction.y < skyline * level {
            ray.light += ray.clear * self.hills;
            ray.clear = 0.0;
        }
        ray
    }

    /// The column under a place, or the nearest.
    fn column(&self, at: [f32; 2]) -> usize {
        let [columns, rows, _] = self.inputs.room.size;
        let within = |at: f32, count: u32| clamped(at, 0.0, (count - 1) as f32) as usize;
        within(at[1], rows) * columns as usize + within(at[0], columns)
    }

    fn layer(&self, above: f32) -> usize {
        let last = (self.inputs.room.size[2] - 1) as f32;
        (clamped(above / self.inputs.room.height, 0.0, 1.0) * last + 0.5) as usize
    }

    /// Share of light lost per metre.
    fn lost(&self, column: usize, above: f32) -> f32 {
        let level = (above / self.inputs.room.height * self.inputs.levels as f32) as usize;
        self.inputs.leaves.get(level * self.inputs.room.columns() + column).copied().unwrap_or(0.0)
    }

    /// Height of the ground, m.
    fn ground(&self, at: [f32; 2]) -> f32 {
        if self.inputs.skyline.is_empty() {
            return 0.0;
        }
        let [columns, rows, _] = self.inputs.room.size;
        let place = |at: f32, count: u32| {
            let at = clamped(at - 0.5, 0.0, (count - 1) as f32);
            let low = (at as u32).min(count - 1);
            (low as usize, (low + 1).min(count - 1) as usize, at - low as f32)
        };
        let ((west, east, across), (north, south, down)) = (place(at[0], columns), place(at[1], rows));
        let height = |row: usize, column: usize| self.inputs.ground[row * columns as usize + column];
        let line = |row: usize| height(row, west) + (height(row, east) - height(row, west)) * across;
        line(north) + (line(south) - line(north)) * down
    }
}
