//! The depth cube map of a body: what its surface looks like from the six sides of a cube around it, and how a point lies to it.
//!
//! Orthmann et al. 2009, §5.2–5.3, eq. 1–5 (after Kolb et al. 2004); methods §4. Any triangles: rigid, animated or skinned, drawn anew
//! whenever they move (`raster`). Reads points in the body's frame. Used by responses that move single points. Twin: `distance_map.wgsl`.
//! Differs from the paper: silhouettes are drawn a texel too wide and left to the faces that see them better; ways out end on the tangent
//! plane of what a face sees (docs/papers.md). Hollows that no face looks into count as inside.

mod pieces;
mod posed;
mod raster;

use bytemuck::{Pod, Zeroable};

use super::solid::Nearness;
use crate::math;

/// Distance maps in WGSL; needs `math` before it, and `distance_map_load(index: u32) -> vec4<f32>` from the host.
pub const WGSL: &str = include_str!("distance_map.wgsl");

pub use raster::WGSL as RASTER_WGSL;

/// Texels along a side of a face where nothing else is asked for.
pub const TEXELS: u32 = 64;
/// Most texels along a side of a face.
pub const MOST_TEXELS: u32 = 512;
/// Depth of a texel that sees nothing, m: large, since WGSL has no infinity to compare with.
pub const EMPTY: f32 = 1e9;
/// Depths of four neighbours that differ by more texels than this are not of one surface seen well: the least counts, not their mean. Of a
/// surface that three faces see alike they differ by 2.
const STEEP: f32 = 4.0;

/// The cube a map is drawn in, m, in the body's frame. The same one for all moments of a clip keeps texels where they are on the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cube {
    /// Its middle.
    pub centre: [f32; 3],
    /// Half of its edge, > 0.
    pub half: f32,
}

impl Cube {
    /// The cube around points, two texels of `size` wider on all sides. Points that are not finite do not count; of none a cube of 2 m.
    pub fn around<'a>(points: impl IntoIterator<Item = &'a [f32; 3]>, size: u32) -> Self {
        let (mut low, mut high) = ([EMPTY; 3], [-EMPTY; 3]);
        for point in points.into_iter().filter(|point| point.iter().all(|part| part.is_finite())) {
            for axis in 0..3 {
                low[axis] = math::lower(point[axis], low[axis]);
                high[axis] = math::upper(point[axis], high[axis]);
            }
        }
        if low[0] > high[0] {
            return Self { centre: [0.0; 3], half: 1.0 };
        }
        let mut half = 1e-3;
        for axis in 0..3 {
            half = math::upper(half, 0.5 * (high[axis] - low[axis]));
        }
        let size = sized(size) as f32;
        Self { centre: [0, 1, 2].map(|axis: usize| 0.5 * (low[axis] + high[axis])), half: half * size / (size - 4.0) }
    }
}

/// Texels along a side, within what is possible: 8 to [`MOST_TEXELS`].
pub fn sized(size: u32) -> u32 {
    size.clamp(8, MOST_TEXELS)
}

/// Six faces of a body: +x, −x, +y, −y, +z, −z, each seen from outside, rows along the second next axis, columns along the next.
#[derive(Clone, Debug, PartialEq)]
pub struct DistanceMap {
    /// Texels along a side of a face, 8 to [`MOST_TEXELS`].
    pub size: u32,
    /// Where it is in the body's frame.
    pub cube: Cube,
    /// 6 · size² of them: depth below the face \[m\] or [`EMPTY`], and the surface's unit normal in the body's frame.
    pub texels: Vec<[f32; 4]>,
}

/// A map in the world, before its texels. The same bytes as in WGSL.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct DistanceMapHead {
    /// First of its texels.
    pub first: u32,
    /// Texels along a side of a face.
    pub size: u32,
    /// Which part of the step it stands for; the last is the step's end.
    pub moment: u32,
    /// Index of the body.
    pub body: u32,
    /// Middle of the cube, m from the patch's corner (height absolute); w: half of its edge, m.
    pub centre: [f32; 4],
    /// The body's axes x, y, z in the world, unit; w unused.
    pub axes: [[f32; 4]; 3],
}

impl DistanceMapHead {
    /// The map of body number `body` at a place: the body's origin, m, and its axes. `first` is the index of its first texel.
    pub fn new(map: &DistanceMap, first: u32, (moment, body): (u32, u32), origin: [f32; 3], axes: [[f32; 3]; 3]) -> Self {
        let c = map.cube.centre;
        let at = |axis: usize| origin[axis] + c[0] * axes[0][axis] + c[1] * axes[1][axis] + c[2] * axes[2][axis];
        let centre = [at(0), at(1), at(2), map.cube.half];
        Self { first, size: map.size, moment, body, centre, axes: axes.map(|[x, y, z]| [x, y, z, 0.0]) }
    }

    /// A point of the world, m from the cube's middle along the body's axes.
    #[inline(always)]
    pub fn to_body(&self, at: [f32; 3]) -> [f32; 3] {
        let off = [at[0] - self.centre[0], at[1] - self.centre[1], at[2] - self.centre[2]];
        self.axes.map(|axis| axis[0] * off[0] + axis[1] * off[1] + axis[2] * off[2])
    }

    /// A direction of the body in the world.
    #[inline(always)]
    pub fn to_world(&self, v: [f32; 3]) -> [f32; 3] {
        [0, 1, 2].map(|axis: usize| v[0] * self.axes[0][axis] + v[1] * self.axes[1][axis] + v[2] * self.axes[2][axis])
    }
}

/// What one face sees below a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Side {
    /// d_i of eq. 2, m: negative where the surface lies between the face and the point; large where it sees nothing.
    pub distance: f32,
    /// Distance from the surface's tangent plane there, m: d_i times how far the surface faces the face.
    pub depth: f32,
    /// The surface's unit normal, in the body's frame.
    pub normal: [f32; 3],
}

impl Side {
    /// It sees nothing.
    const EMPTY: Self = Self { distance: EMPTY, depth: EMPTY, normal: [0.0, 1.0, 0.0] };
}

/// Depth and normal of a face where a point is, by bilinear interpolation where all four texels see one surface; otherwise the nearest surface
/// that any of them sees: what is drawn too wide there is cut by the faces that see it better. `at` in texels, from texel centres.
#[inline(always)]
fn looked_up(head: &DistanceMapHead, texels: &[[f32; 4]], face: u32, at: [f32; 2], steep: f32) -> [f32; 4] {
    let (i, j) = (math::floored(at[0]), math::floored(at[1]));
    let (x, y) = (at[0] - i as f32, at[1] - j as f32);
    let size = head.size.max(1);
    let (mut least, mut most) = ([EMPTY, 0.0, 1.0, 0.0], 0.0);
    let mut mean = [0.0; 4];
    for k in 0..4 {
        let (column, row) = (i + k % 2, j + k / 2);
        let beside = column < 0 || row < 0 || column >= size as i32 || row >= size as i32;
        let index = head.first + (face * size + row as u32 % size) * size + column as u32 % size;
        let texel = if beside { [EMPTY, 0.0, 1.0, 0.0] } else { texels.get(index as usize).copied().unwrap_or([EMPTY, 0.0, 1.0, 0.0]) };
        let weight = (if k % 2 == 1 { x } else { 1.0 - x }) * (if k / 2 == 1 { y } else { 1.0 - y });
        for part in 0..4 {
            mean[part] += weight * texel[part];
        }
        least = if texel[0] < least[0] { texel } else { least };
        most = math::upper(most, texel[0]);
    }
    if most - least[0] > steep || least[0] >= EMPTY { least } else { mean }
}

/// What face number `face` sees below a point, m from the cube's middle along the body's axes.
#[inline(always)]
pub fn side(head: &DistanceMapHead, texels: &[[f32; 4]], face: u32, at: [f32; 3]) -> Side {
    let (axis, half) = ((face / 2) as usize, head.centre[3]);
    let sign = if face.is_multiple_of(2) { 1.0 } else { -1.0 };
    let scale = 0.5 * head.size as f32 / half;
    let place = [at[(axis + 1) % 3], at[(axis + 2) % 3]].map(|part| (part + half) * scale - 0.5);
    let [depth, nx, ny, nz] = looked_up(head, texels, face, place, STEEP / scale);
    if depth >= EMPTY {
        return Side::EMPTY;
    }
    let size = math::upper((nx * nx + ny * ny + nz * nz).sqrt(), 1e-6);
    let normal = [nx / size, ny / size, nz / size];
    let distance = depth - (half - sign * at[axis]);
    Side { distance, depth: distance * math::upper(sign * normal[axis], 0.0), normal }
}

/// What all six faces see below a point of the world, or `None` if one of them says it is outside (eq. 2).
#[inline(always)]
pub fn sides(head: &DistanceMapHead, texels: &[[f32; 4]], at: [f32; 3]) -> Option<[Side; 6]> {
    let (own, half) = (head.to_body(at), head.centre[3]);
    let beside = |axis: usize| !(own[axis] > -half && own[axis] < half);
    if beside(0) || beside(1) || beside(2) {
        return None;
    }
    let mut sides = [Side::EMPTY; 6];
    for (face, seen) in sides.iter_mut().enumerate() {
        *seen = side(head, texels, face as u32, own);
        if seen.distance >= 0.0 {
            return None;
        }
    }
    Some(sides)
}

/// How a point of the world lies to a body (eq. 3): inside minus the way to the nearest tangent plane that a face sees; outside its distance
/// from the cube, 0 within that, so never more than the true distance. The normal is that of the surface, of the cube outside it.
#[inline(always)]
pub fn contact_at(head: &DistanceMapHead, texels: &[[f32; 4]], at: [f32; 3]) -> Nearness {
    let Some(sides) = sides(head, texels, at) else {
        let (own, half) = (head.to_body(at), head.centre[3]);
        let off = own.map(|part| part - math::clamped(part, -half, half));
        let distance = (off[0] * off[0] + off[1] * off[1] + off[2] * off[2]).sqrt();
        let normal = if distance > 0.0 { head.to_world(off.map(|part| part / distance)) } else { [0.0, 1.0, 0.0] };
        return Nearness { distance, normal };
    };
    let mut nearest = sides[0];
    for seen in &sides[1..] {
        nearest = if seen.depth > nearest.depth { *seen } else { nearest };
    }
    Nearness { distance: nearest.depth, normal: head.to_world(nearest.normal) }
}
