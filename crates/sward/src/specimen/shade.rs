//! How open to the sky each vertex is: crowns are dark inside.
//!
//! Leaves and wood are a haze in cubes, half their area in sight from any side. What comes through is followed along 14 directions, from cube to
//! cube: 32³ cubes at most, whatever the plant has.

use glam::Vec3;

use super::progress::Share;
use super::vertex::SpecimenVertex;
use crate::math;

/// Cubes along the longest side.
const LONGEST: usize = 32;
/// Share of the area in a cube that is in sight from a side, on average.
const IN_SIGHT: f32 = 0.5;
/// How much of the light comes from above, from the sides and from below.
const FROM: [f32; 3] = [1.0, 0.55, 0.2];

/// Cubes around a plant; the outermost are empty.
struct Cubes {
    size: [usize; 3],
    corner: Vec3,
    side: f32,
}

impl Cubes {
    fn around([low, high]: [Vec3; 2]) -> Self {
        let extent = high - low;
        let side = math::upper(extent.max_element() / (LONGEST - 2) as f32, 1e-6);
        let size = extent.to_array().map(|length| ((length / side) as usize + 1).min(LONGEST - 2) + 2);
        Self { size, corner: low - side, side }
    }

    fn count(&self) -> usize {
        self.size[0] * self.size[1] * self.size[2]
    }

    fn index(&self, cube: [usize; 3]) -> usize {
        (cube[2] * self.size[1] + cube[1]) * self.size[0] + cube[0]
    }

    /// The cube a place lies in.
    fn of(&self, place: Vec3) -> usize {
        let at = ((place - self.corner) / self.side).to_array();
        self.index([0, 1, 2].map(|axis| (math::upper(at[axis], 0.0) as usize).min(self.size[axis] - 1)))
    }

    /// Between the middles of the eight cubes around a place.
    fn between(&self, values: &[f32], place: [f32; 3]) -> f32 {
        let at = ((Vec3::from(place) - self.corner) / self.side - 0.5).to_array();
        let first = [0, 1, 2].map(|axis| (math::upper(at[axis], 0.0) as usize).min(self.size[axis] - 2));
        let share = [0, 1, 2].map(|axis| math::clamped(at[axis] - first[axis] as f32, 0.0, 1.0));
        let start = self.index(first);
        let (row, plane) = (self.size[0], self.size[0] * self.size[1]);
        let along = |at: usize| values[at] + (values[at + 1] - values[at]) * share[0];
        let level = |at: usize| along(at) + (along(at + row) - along(at)) * share[1];
        level(start) + (level(start + plane) - level(start)) * share[2]
    }
}

/// What of each direction's light comes through, with its weight, summed up for each cube.
fn open(cubes: &Cubes, density: &[f32]) -> Vec<f32> {
    let directions = (0..27).map(|k: i32| [k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1]);
    let directions = directions.filter(|d| [1, 3].contains(&d.iter().map(|part| part.abs()).sum::<i32>()));
    let mut sum = vec![0.0; cubes.count()];
    let mut weights = 0.0;
    for direction in directions {
        let weight = FROM[(1 - direction[1]) as usize];
        weights += weight;
        let parts: i32 = direction.iter().map(|part| part * part).sum();
        let half_step = 0.5 * cubes.side * (parts as f32).sqrt();
        // From where the light comes: the next cube that way is known before this one.
        let order = |axis: usize| {
            let count = cubes.size[axis];
            (0..count).map(move |k| if direction[axis] > 0 { count - 1 - k } else { k })
        };
        let mut depth = vec![0.0_f32; cubes.count()];
        for z in order(2) {
            for y in order(1) {
                for x in order(0) {
                    let cube = [x, y, z];
                    let next = [0, 1, 2].map(|axis| cube[axis].wrapping_add_signed(direction[axis] as isize));
                    let own = cubes.index(cube);
                    if next.iter().zip(cubes.size).all(|(next, size)| *next < size) {
                        let next = cubes.index(next);
                        depth[own] = depth[next] + half_step * (density[own] + density[next]);
                    }
                    sum[own] += weight * math::exp(-depth[own]);
                }
            }
        }
    }
    sum.iter().map(|sum| sum / weights).collect()
}

/// Writes into each vertex how open it is. Triangles from `wood` on are seen less: half of each is inside.
pub(super) fn shade(vertices: &mut [SpecimenVertex], triangles: &[[u32; 3]], wood: u32, bounds: [Vec3; 2], progress: &mut Share<'_, '_>) {
    let cubes = Cubes::around(bounds);
    let mut areas = vec![0.0_f64; cubes.count()];
    let mut gathering = progress.part(0.0, 0.6);
    for (index, corners) in triangles.iter().enumerate() {
        gathering.item(index, triangles.len());
        let [a, b, c] = corners.map(|corner| Vec3::from(vertices[corner as usize].position));
        let area = 0.5 * (b - a).cross(c - a).length();
        // Large ones lie in several cubes.
        let pieces = math::clamped((area.sqrt() / cubes.side) * 2.0 + 1.0, 1.0, 8.0) as u32;
        let share = f64::from(area) / f64::from(pieces * pieces) * if index as u32 >= wood { 0.5 } else { 1.0 };
        let place = |u: f32, v: f32| a + (b - a) * u + (c - a) * v;
        if pieces == 1 {
            areas[cubes.of(place(1.0 / 3.0, 1.0 / 3.0))] += share;
            continue;
        }
        for k in 0..pieces * pieces {
            let (u, v) = ((k % pieces) as f32 + 0.5, (k / pieces) as f32 + 0.5);
            let (u, v) = (u / pieces as f32, v / pieces as f32);
            let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
            areas[cubes.of(place(u, v))] += share;
        }
    }
    let volume = f64::from(cubes.side) * f64::from(cubes.side) * f64::from(cubes.side);
    let density: Vec<f32> = areas.iter().map(|area| (area / volume) as f32 * IN_SIGHT).collect();
    let open = open(&cubes, &density);
    let mut writing = progress.part(0.6, 1.0);
    let count = vertices.len();
    for (index, vertex) in vertices.iter_mut().enumerate() {
        writing.item(index, count);
        vertex.set_shade(cubes.between(&open, vertex.position));
    }
}
