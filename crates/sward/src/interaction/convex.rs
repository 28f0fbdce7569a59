//! Swept footprints: the convex hull of a piece's outline at the start and the end of a step, on a fine integer grid.

use super::contact::{Contact, ContactEdge};
use super::motion::Pose;
use super::piece::{Piece, Underside};
use crate::math;

/// Cells of a stand, as the footprints need them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Cell side, m.
    pub spacing: f64,
    /// Height of the plants, m.
    pub plant_height: f32,
}

/// A contact with its edges and its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Footprint {
    /// Cell of the footprint's corner, counted from the authored origin.
    pub corner: [i64; 2],
    /// What the kernels read; `edge_first` is 0 until it is joined with the other footprints of the step.
    pub contact: Contact,
    /// Counter-clockwise from the lowest (x, z).
    pub edges: Vec<ContactEdge>,
}

impl Footprint {
    /// Its corners in order, m from the authored origin, where cells are so wide \[m\].
    pub fn outline(&self, spacing: f64) -> Vec<[f64; 2]> {
        let part = spacing / f64::from(1_u32 << self.contact.shift);
        let corner = |edge: &ContactEdge| [0, 1].map(|axis| self.corner[axis] as f64 * spacing + f64::from(edge.start[axis]) * part);
        self.edges.iter().map(corner).collect()
    }
}

/// Largest extent of a footprint in units: products of two stay below 2³¹.
const LARGEST: i64 = 1 << 14;

/// Outline of the piece on the ground at a pose, m from the authored origin.
pub(super) fn outline_at(piece: &Piece, pose: &Pose) -> impl Iterator<Item = [f64; 2]> {
    let (sine, cosine) = math::sin_cos_f64(pose.yaw);
    let ground = pose.ground;
    piece.outline.iter().map(move |p| [ground[0] + cosine * p[0] + sine * p[1], ground[1] - sine * p[0] + cosine * p[1]])
}

/// Counter-clockwise convex hull (x to the right, z up the page), starting at the lowest (x, z); collinear points dropped.
pub(super) fn hull(mut points: Vec<[i32; 2]>) -> Vec<[i32; 2]> {
    points.sort_unstable();
    points.dedup();
    if points.len() < 3 {
        return Vec::new();
    }
    let turn = |a: [i32; 2], b: [i32; 2], c: [i32; 2]| {
        let (ab, ac) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
        i64::from(ab[0]) * i64::from(ac[1]) - i64::from(ab[1]) * i64::from(ac[0])
    };
    let mut chain: Vec<[i32; 2]> = Vec::with_capacity(points.len() * 2);
    for pass in 0..2 {
        let floor = chain.len();
        for &point in &points {
            while chain.len() >= floor + 2 && turn(chain[chain.len() - 2], chain[chain.len() - 1], point) <= 0 {
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        if pass == 0 {
            points.reverse();
        }
    }
    if chain.len() < 3 { Vec::new() } else { chain }
}

fn edges_of(hull: &[[i32; 2]], unit: f64) -> Vec<ContactEdge> {
    (0..hull.len())
        .map(|k| {
            let (start, end) = (hull[k], hull[(k + 1) % hull.len()]);
            let along = [end[0] - start[0], end[1] - start[1]];
            let length = (f64::from(along[0]) * f64::from(along[0]) + f64::from(along[1]) * f64::from(along[1])).sqrt();
            ContactEdge {
                start,
                along,
                normal: [(f64::from(along[1]) / length) as f32, (f64::from(-along[0]) / length) as f32],
                metres: (unit / length) as f32,
                unused: 0.0,
            }
        })
        .collect()
}

/// Reference point and height of the underside at a pose, relative to `corner` [m].
pub(super) fn reference(piece: &Piece, pose: &Pose, corner: [f64; 2]) -> [f32; 4] {
    let (sine, cosine) = math::sin_cos_f64(pose.yaw);
    let o = piece.offset;
    let shift = [cosine * o[0] + sine * o[2], -sine * o[0] + cosine * o[2]];
    let height = pose.height + o[1] + pose.slope[0] * shift[0] + pose.slope[1] * shift[1];
    [(pose.ground[0] + shift[0] - corner[0]) as f32, (pose.ground[1] + shift[1] - corner[1]) as f32, height as f32, 0.0]
}

/// Slope of a plane underside on the ground at a pose.
pub(super) fn slope(piece: &Piece, pose: &Pose) -> [f32; 2] {
    let Underside::Slope { gradient: [x, z] } = piece.underside else { return pose.slope.map(|part| part as f32) };
    let (sine, cosine) = math::sin_cos_f64(pose.yaw);
    [(pose.slope[0] + cosine * x + sine * z) as f32, (pose.slope[1] - sine * x + cosine * z) as f32]
}

/// The footprint a piece sweeps from `start` to `end` in `dt` seconds; `None` if it is too thin to cover a cell centre.
pub fn swept(piece: &Piece, start: &Pose, end: &Pose, dt: f64, grid: &Grid, body: u32) -> Option<Footprint> {
    swept_between([piece, piece], start, end, dt, grid, body)
}

/// The same of a piece that also moves within its body: as it is at `start` and at `end`. Its velocity is its own then, not the body's.
pub fn swept_between(pieces: [&Piece; 2], start: &Pose, end: &Pose, dt: f64, grid: &Grid, body: u32) -> Option<Footprint> {
    let [before, piece] = pieces;
    let points: Vec<[f64; 2]> = outline_at(before, start).chain(outline_at(piece, end)).collect();
    let bound = |axis: usize, pick: fn(f64, f64) -> f64, first: f64| points.iter().map(|p| p[axis]).fold(first, pick);
    let low = [bound(0, f64::min, f64::MAX), bound(1, f64::min, f64::MAX)];
    let high = [bound(0, f64::max, f64::MIN), bound(1, f64::max, f64::MIN)];
    let corner = [(low[0] / grid.spacing).floor() as i64, (low[1] / grid.spacing).floor() as i64];
    let size = [(high[0] / grid.spacing).floor() as i64 - corner[0] + 1, (high[1] / grid.spacing).floor() as i64 - corner[1] + 1];
    let largest = size[0].max(size[1]);
    let shift = (1..=8).rev().find(|shift| largest << shift <= LARGEST)?;
    let units = f64::from(1 << shift) / grid.spacing;
    let corner_metres = [corner[0] as f64 * grid.spacing, corner[1] as f64 * grid.spacing];
    let quantised = |p: &[f64; 2]| [((p[0] - corner_metres[0]) * units).round() as i32, ((p[1] - corner_metres[1]) * units).round() as i32];
    let hull = hull(points.iter().map(quantised).collect());
    let edges = edges_of(&hull, 1.0 / units);
    if edges.is_empty() {
        return None;
    }
    let turn = math::wrapped_angle(end.yaw - start.yaw);
    let (form, rise, kind) = match piece.underside {
        Underside::Plane | Underside::Slope { .. } => {
            let ([ax, az], [bx, bz]) = (slope(before, start), slope(piece, end));
            ([ax, az, bx, bz], 0.0, 0)
        }
        Underside::Ellipsoid { radii } => {
            let (sine, cosine) = math::sin_cos_f64(end.yaw + piece.yaw);
            ([cosine as f32, sine as f32, (1.0 / radii[0]) as f32, (1.0 / radii[2]) as f32], radii[1] as f32, 1)
        }
    };
    let (from, to) = (reference(before, start, corner_metres), reference(piece, end, corner_metres));
    let own = before.offset != piece.offset;
    let apart = |axis: usize| if own { f64::from(to[axis]) - f64::from(from[axis]) } else { end.ground[axis] - start.ground[axis] };
    let centre = |axis: usize| if own { to[axis] } else { (end.ground[axis] - corner_metres[axis]) as f32 };
    let contact = Contact {
        size: [size[0] as i32, size[1] as i32],
        edge_first: 0,
        edge_count: edges.len() as u32,
        shift,
        kind,
        velocity: [(apart(0) / dt) as f32, (apart(1) / dt) as f32],
        centre: [centre(0), centre(1)],
        yaw_rate: (turn / dt) as f32,
        spacing: grid.spacing as f32,
        start: from,
        end: to,
        form,
        rise,
        body,
        highest: 0.6 * grid.plant_height,
        stays: 1.0,
    };
    Some(Footprint { corner, contact, edges })
}
