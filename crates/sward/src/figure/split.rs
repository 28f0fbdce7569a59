//! Concave bodies into nearly convex ones, after V-HACD (Mamou, *Volumetric Hierarchical Approximate Convex Decomposition*, 2016).
//!
//! The body is filled with voxels; the part that leaves most of its convex hull empty is cut by the axis-aligned plane that leaves least
//! of both halves' hulls empty, until there are enough parts or none is worth a cut. Hulls are taken in 98 directions. All of it is whole
//! numbers but for the voxels of the surface, so every machine cuts alike.

use glam::DVec3;

use super::hull::{hull, shaken, volume};
use super::thin::{bounds, directions, thinned};

/// Voxels along the longest side.
const CELLS: i32 = 32;
/// Six times the volume of a voxel in hull units: `UNIT` a side.
const UNIT: i64 = 1024;
/// A part is worth a cut if this share of the whole hull is empty in its own.
const WORTH: f64 = 0.02;
/// Most samples along an edge of a triangle.
const FINEST: f64 = 110.0;
/// Most samples of all triangles.
const MOST_SAMPLES: f64 = 20e6;

/// The grid around a body: voxel 0 along each axis is empty.
struct Grid {
    low: DVec3,
    side: f64,
    size: [i32; 3],
}

impl Grid {
    fn cell(&self, point: DVec3) -> [i32; 3] {
        let place = (point - self.low) / self.side;
        [0, 1, 2].map(|axis| (place[axis] as i32 + 1).clamp(0, self.size[axis] - 1))
    }

    fn index(&self, cell: [i32; 3]) -> usize {
        ((cell[2] * self.size[1] + cell[1]) * self.size[0] + cell[0]) as usize
    }
}

/// Calls `each` for points spread over a triangle, its corners among them.
fn sampled(corners: [DVec3; 3], step: f64, finest: f64, mut each: impl FnMut(DVec3)) {
    let [a, b, c] = corners;
    let longest = (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared()).sqrt();
    let count = ((longest / step).ceil().min(finest) as i32).max(1);
    for i in 0..=count {
        for j in 0..=count - i {
            let (s, t) = (f64::from(i) / f64::from(count), f64::from(j) / f64::from(count));
            each(a + (b - a) * s + (c - a) * t);
        }
    }
}

/// Runs of voxels along one axis: the other two coordinates, first and last.
type Run = [i32; 4];

struct Part {
    cells: Vec<[i32; 3]>,
    /// Six times the empty volume of its hull, hull units.
    empty: i64,
    whole: i64,
}

/// First and last voxel of each line along `axis`.
fn runs(cells: &[[i32; 3]], axis: usize, size: [i32; 3]) -> Vec<Run> {
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut grid: Vec<Option<[i32; 2]>> = vec![None; (size[u] * size[v]) as usize];
    for cell in cells {
        let run = &mut grid[(cell[v] * size[u] + cell[u]) as usize];
        *run = Some(run.map_or([cell[axis]; 2], |[first, last]| [first.min(cell[axis]), last.max(cell[axis])]));
    }
    let numbered = grid.into_iter().zip(0..);
    numbered.filter_map(|(run, at)| run.map(|[first, last]| [at % size[u], at / size[u], first, last])).collect()
}

/// Six times the volume of the hull of runs along `axis`, taken in the directions.
fn hull_volume<'a>(runs: impl Iterator<Item = &'a Run> + Clone, axis: usize, directions: &[[i32; 3]]) -> i64 {
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut points: Vec<[i32; 3]> = Vec::new();
    for d in directions {
        let beyond = [0, 1, 2].map(|k| i32::from(d[k] > 0));
        let support = |run: &Run| {
            let mut corner = [0; 3];
            (corner[u], corner[v]) = (run[0] + beyond[u], run[1] + beyond[v]);
            corner[axis] = if d[axis] > 0 { run[3] + 1 } else { run[2] };
            (corner[0] * d[0] + corner[1] * d[1] + corner[2] * d[2], corner)
        };
        if let Some((_, corner)) = runs.clone().map(support).max_by_key(|(along, _)| *along)
            && !points.contains(&corner)
        {
            points.push(corner);
        }
    }
    let points: Vec<[i64; 3]> =
        points.iter().zip(0..).map(|(corner, number)| shaken(corner.map(|part| i64::from(part) * UNIT), number)).collect();
    volume(&points, &hull(&points))
}

fn part(cells: Vec<[i32; 3]>, size: [i32; 3], directions: &[[i32; 3]]) -> Part {
    let runs = runs(&cells, 0, size);
    let whole = hull_volume(runs.iter(), 0, directions);
    Part { empty: (whole - filled(cells.len())).max(0), cells, whole }
}

fn filled(cells: usize) -> i64 {
    cells as i64 * 6 * UNIT * UNIT * UNIT
}

/// What a cut before voxel `at` along `axis` leaves empty in both halves, with a little for unequal ones.
fn cost(part: &Part, lines: &[Run], axis: usize, at: i32, directions: &[[i32; 3]]) -> i64 {
    // Lines run along the next axis; their first coordinate counts two axes on, their second one is `axis` itself.
    let along = (axis + 1) % 3;
    let half = |below: bool| hull_volume(lines.iter().filter(move |run| (run[1] < at) == below), along, directions);
    let below = part.cells.iter().filter(|cell| cell[axis] < at).count();
    let above = part.cells.len() - below;
    let empty = |hull: i64, cells: usize| (hull - filled(cells)).max(0);
    empty(half(true), below) + empty(half(false), above) + part.empty / 20 * (below.abs_diff(above) as i64) / part.cells.len() as i64
}

/// The best cut of a part: axis and first voxel of the upper half.
fn best_cut(part: &Part, size: [i32; 3], directions: &[[i32; 3]]) -> Option<(usize, i32)> {
    let mut best: Option<(i64, usize, i32)> = None;
    for axis in 0..3 {
        let lines = runs(&part.cells, (axis + 1) % 3, size);
        let (low, high) = part.cells.iter().fold((i32::MAX, i32::MIN), |(low, high), cell| (low.min(cell[axis]), high.max(cell[axis])));
        let mut own: Option<(i64, i32)> = None;
        let mut consider = |at: i32| {
            if at > low && at <= high && own.is_none_or(|(_, chosen)| chosen != at) {
                let cost = cost(part, &lines, axis, at, directions);
                if own.is_none_or(|(least, _)| cost < least) {
                    own = Some((cost, at));
                }
            }
            own
        };
        (low + 1..=high).step_by(2).for_each(|at| _ = consider(at));
        if let Some((_, at)) = consider(low) {
            consider(at - 1);
            consider(at + 1);
        }
        if let Some((cost, at)) = own
            && best.is_none_or(|(least, ..)| cost < least)
        {
            best = Some((cost, axis, at));
        }
    }
    best.map(|(_, axis, at)| (axis, at))
}

/// All voxels on or within the surface.
fn solid(grid: &Grid, points: &[DVec3], triangles: &[[u32; 3]], finest: f64) -> Vec<[i32; 3]> {
    let [nx, ny, nz] = grid.size;
    // 0: not reached yet, 1: surface, 2: outside.
    let mut state = vec![0_u8; (nx * ny * nz) as usize];
    for t in triangles {
        sampled(t.map(|index| points[index as usize]), 0.5 * grid.side, finest, |point| state[grid.index(grid.cell(point))] = 1);
    }
    let mut open = vec![[0; 3]];
    state[0] = 2;
    while let Some(cell) = open.pop() {
        for (axis, way) in [(0, -1), (0, 1), (1, -1), (1, 1), (2, -1), (2, 1)] {
            let mut next = cell;
            next[axis] += way;
            if (0..grid.size[axis]).contains(&next[axis]) && state[grid.index(next)] == 0 {
                state[grid.index(next)] = 2;
                open.push(next);
            }
        }
    }
    let all = (0..nz).flat_map(|z| (0..ny).flat_map(move |y| (0..nx).map(move |x| [x, y, z])));
    all.filter(|cell| state[grid.index(*cell)] != 2).collect()
}

/// Points whose hulls cover the body in at most `most` nearly convex parts; just the points themselves if `most` is 1.
pub(super) fn split(points: &[DVec3], triangles: &[[u32; 3]], most: usize) -> Vec<Vec<DVec3>> {
    let (low, high) = bounds(points);
    let longest = (high - low).max_element();
    if most < 2 || !(longest > 0.0 && longest.is_finite()) {
        return vec![points.to_vec()];
    }
    let side = longest / f64::from(CELLS) * 1.000001;
    let grid = Grid { low, side, size: ((high - low) / side).to_array().map(|cells| cells as i32 + 3) };
    let affordable = (MOST_SAMPLES / triangles.len().max(1) as f64 * 2.0).sqrt();
    let finest = if affordable < FINEST { affordable } else { FINEST };
    let directions = directions();
    let mut parts = vec![part(solid(&grid, points, triangles, finest), grid.size, &directions)];
    let worth = (parts[0].whole as f64 * WORTH) as i64;
    while parts.len() < most {
        let Some(worst) = (0..parts.len()).rev().max_by_key(|k| parts[*k].empty).filter(|k| parts[*k].empty > worth) else { break };
        let Some((axis, at)) = best_cut(&parts[worst], grid.size, &directions) else { break };
        let (below, above) = std::mem::take(&mut parts[worst].cells).into_iter().partition(|cell| cell[axis] < at);
        parts[worst] = part(below, grid.size, &directions);
        parts.push(part(above, grid.size, &directions));
    }
    gathered(&grid, points, triangles, finest, &parts)
}

/// The surface within each part, reaching half a voxel into its neighbours, so that no gap is left between their hulls.
fn gathered(grid: &Grid, points: &[DVec3], triangles: &[[u32; 3]], finest: f64, parts: &[Part]) -> Vec<Vec<DVec3>> {
    if parts.len() < 2 {
        return vec![points.to_vec()];
    }
    let mut owner = vec![u16::MAX; (grid.size[0] * grid.size[1] * grid.size[2]) as usize];
    for (part, number) in parts.iter().zip(0_u16..) {
        part.cells.iter().for_each(|cell| owner[grid.index(*cell)] = number);
    }
    let mut found: Vec<Extremes> = parts.iter().map(|_| Extremes::default()).collect();
    let reach = 0.5 * grid.side;
    let around = [DVec3::ZERO, DVec3::X, -DVec3::X, DVec3::Y, -DVec3::Y, DVec3::Z, -DVec3::Z].map(|way| way * reach);
    for t in triangles {
        sampled(t.map(|index| points[index as usize]), reach, finest, |point| {
            let owners = around.map(|way| owner[grid.index(grid.cell(point + way))]);
            for (k, number) in owners.iter().enumerate() {
                if !owners[..k].contains(number)
                    && let Some(part) = found.get_mut(usize::from(*number))
                {
                    part.add(point);
                }
            }
        });
    }
    found.into_iter().map(|part| part.points).filter(|points| !points.is_empty()).collect()
}

/// The points seen so far, thinned to the corners of their hull whenever there are many.
#[derive(Default)]
struct Extremes {
    points: Vec<DVec3>,
}

impl Extremes {
    fn add(&mut self, point: DVec3) {
        self.points.push(point);
        if self.points.len() > 4096 {
            self.points = thinned(&self.points).0;
        }
    }
}
