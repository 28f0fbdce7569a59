//! A convex piece of a body as a solid: how deep a point is inside it, and which way out is nearest.
//!
//! Belyaev et al. 2011, §3.5; methods §3.5. Sides are upright, the underside and the upper side are planes; balls are ellipsoids. Reads
//! pieces and poses. Used by responses that move single blades. Twin: `solid.wgsl`.

use bytemuck::{Pod, Zeroable};

use super::convex::{hull, outline_at, reference, slope};
use super::motion::Pose;
use super::piece::{Piece, Underside};
use crate::math;

/// Solids in WGSL; needs `math` before it, and `solid_plane(index: u32) -> vec4<f32>` from the host.
pub const WGSL: &str = include_str!("solid.wgsl");

/// Most moments of a step.
const MOMENTS: f64 = 4.0;
/// Corners of an outline are taken to this many parts of a metre.
const PARTS: f64 = 4096.0;

/// A solid, before its planes. The same bytes as in WGSL.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct SolidHead {
    /// First of its planes; of an ellipsoid 0.
    pub first: u32,
    /// Number of its planes: underside, upper side, sides. 0: it is an ellipsoid.
    pub count: u32,
    /// Which part of the step it stands for: a fast body is taken at several moments, the last of which is the step's end.
    pub moment: u32,
    /// Index of the body.
    pub body: u32,
    /// Lowest corner of the box around it, m; w unused.
    pub low: [f32; 4],
    /// Highest corner of that box, m; w unused.
    pub high: [f32; 4],
    /// Centre of an ellipsoid, m; w unused.
    pub centre: [f32; 4],
    /// Cosine and sine of its yaw; unused.
    pub turn: [f32; 4],
    /// Its radii, m; w unused.
    pub radii: [f32; 4],
}

/// Solids that reach one patch, m from the patch's corner (heights absolute).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Solids {
    /// One for each, moment by moment.
    pub heads: Vec<SolidHead>,
    /// Outward unit normals and their distance from the origin: `n · p − d` is the distance from a plane.
    pub planes: Vec<[f32; 4]>,
}

/// How a point lies to a solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearness {
    /// Signed distance, m: negative inside, where it is the way to the nearest side. Outside no more than the true distance.
    pub distance: f32,
    /// The way out, unit.
    pub normal: [f32; 3],
}

impl Nearness {
    /// Far from a solid.
    pub const FAR: Self = Self { distance: AWAY, normal: [0.0, 1.0, 0.0] };
}

/// A solid in the world, m from the authored origin.
#[derive(Clone, Debug, PartialEq)]
pub struct WorldSolid {
    moment: u32,
    body: u32,
    low: [f64; 3],
    high: [f64; 3],
    planes: Vec<[f64; 4]>,
    /// Centre, cosine and sine, radii.
    ellipsoid: Option<([f64; 3], [f64; 2], [f64; 3])>,
}

impl WorldSolid {
    /// A piece of body number `body` at a pose; `None` for one without extent.
    pub fn new(piece: &Piece, pose: &Pose, moment: u32, body: u32) -> Option<Self> {
        let [x, z, height, _] = reference(piece, pose, pose.ground).map(f64::from);
        let middle = [pose.ground[0] + x, height, pose.ground[1] + z];
        if let Underside::Ellipsoid { radii } = piece.underside {
            let (sine, cosine) = math::sin_cos_f64(pose.yaw + piece.yaw);
            let wide = |a: f64, b: f64| (radii[0] * radii[0] * a * a + radii[2] * radii[2] * b * b).sqrt();
            let reach = [wide(cosine, sine), radii[1], wide(sine, cosine)];
            let box_of = |sign: f64| [0, 1, 2].map(|axis| middle[axis] + sign * reach[axis]);
            let ellipsoid = Some((middle, [cosine, sine], radii));
            return Some(Self { moment, body, low: box_of(-1.0), high: box_of(1.0), planes: Vec::new(), ellipsoid });
        }
        let corners: Vec<[f64; 2]> = outline_at(piece, pose).collect();
        let fine = |p: &[f64; 2]| [0, 1].map(|axis: usize| ((p[axis] - pose.ground[axis]) * PARTS).round() as i32);
        let outline: Vec<[f64; 2]> = hull(corners.iter().map(fine).collect())
            .iter()
            .map(|p| [0, 1].map(|axis: usize| pose.ground[axis] + f64::from(p[axis]) / PARTS))
            .collect();
        if outline.is_empty() || piece.rise <= 0.0 {
            return None;
        }
        let level = |gradient: [f64; 2], height: f64, sign: f64| {
            let size = (1.0 + gradient[0] * gradient[0] + gradient[1] * gradient[1]).sqrt() * sign;
            let normal = [-gradient[0] / size, 1.0 / size, -gradient[1] / size];
            [normal[0], normal[1], normal[2], normal[0] * middle[0] + normal[1] * height + normal[2] * middle[2]]
        };
        let [under, upper] = [slope(piece, pose).map(f64::from), pose.slope];
        let mut planes = vec![level(under, middle[1], -1.0), level(upper, middle[1] + piece.rise, 1.0)];
        let (mut low, mut high) = ([f64::MAX; 3], [f64::MIN; 3]);
        for (k, p) in outline.iter().enumerate() {
            let next = outline[(k + 1) % outline.len()];
            let along = [next[0] - p[0], next[1] - p[1]];
            let length = (along[0] * along[0] + along[1] * along[1]).sqrt();
            let normal = [along[1] / length, -along[0] / length];
            planes.push([normal[0], 0.0, normal[1], normal[0] * p[0] + normal[1] * p[1]]);
            let off = [p[0] - middle[0], p[1] - middle[2]];
            let bottom = middle[1] + under[0] * off[0] + under[1] * off[1];
            let top = middle[1] + piece.rise + upper[0] * off[0] + upper[1] * off[1];
            for (axis, [least, most]) in [[p[0], p[0]], [bottom, top], [p[1], p[1]]].into_iter().enumerate() {
                low[axis] = if least < low[axis] { least } else { low[axis] };
                high[axis] = if most > high[axis] { most } else { high[axis] };
            }
        }
        Some(Self { moment, body, low, high, planes, ellipsoid: None })
    }

    /// The pieces of body number `body` on its way from one pose to another in a step: at its end, and before it as often as the body passes its own
    /// narrowest half, at most four times in all.
    pub fn during(pieces: &[&Piece], from: &Pose, to: &Pose, body: u32) -> Vec<Self> {
        let way = [to.ground[0] - from.ground[0], to.ground[1] - from.ground[1]];
        let way = (way[0] * way[0] + way[1] * way[1]).sqrt();
        let narrowest = pieces.iter().map(|piece| piece.narrowest()).fold(f64::MAX, f64::min);
        let passed = (way / narrowest).ceil();
        let passed = if passed < MOMENTS { passed } else { MOMENTS };
        let moments = if passed > 1.0 { passed as u32 } else { 1 };
        let at = |moment: u32| {
            let pose = to.towards(from, f64::from(moments - 1 - moment) / f64::from(moments));
            pieces.iter().filter_map(move |piece| Self::new(piece, &pose, moment, body))
        };
        (0..moments).flat_map(at).collect()
    }

    /// The lowest and the highest corner of the box around it, x and z, m.
    pub fn reach(&self) -> [[f64; 2]; 2] {
        [[self.low[0], self.low[2]], [self.high[0], self.high[2]]]
    }

    /// The lowest and the highest corner of the box around it, m.
    pub fn bounds(&self) -> [[f64; 3]; 2] {
        [self.low, self.high]
    }

    /// The middle of the box around it, m.
    pub fn middle(&self) -> [f64; 3] {
        [0, 1, 2].map(|axis: usize| 0.5 * (self.low[axis] + self.high[axis]))
    }

    /// Number of its body.
    pub fn body(&self) -> u32 {
        self.body
    }

    /// Its lowest point, m.
    pub fn lowest(&self) -> f64 {
        self.low[1]
    }

    /// How deep a point (x, y, z) is in it, m: to first order for one that is an ellipsoid. 0 outside.
    pub fn depth(&self, at: [f64; 3]) -> f64 {
        if (0..3).any(|axis| at[axis] <= self.low[axis] || at[axis] >= self.high[axis]) {
            return 0.0;
        }
        let mut solids = Solids::default();
        self.add_to(&mut solids, [at[0], at[2]]);
        let near = nearness(&solids.heads[0], &solids.planes, [0.0, at[1] as f32, 0.0], false);
        if near.distance < 0.0 { f64::from(-near.distance) } else { 0.0 }
    }

    /// Adds it to the solids of the patch whose corner is at `corner` (x, z), m.
    pub fn add_to(&self, solids: &mut Solids, corner: [f64; 2]) {
        let local = |p: [f64; 3]| [(p[0] - corner[0]) as f32, p[1] as f32, (p[2] - corner[1]) as f32, 0.0];
        let first = solids.planes.len() as u32;
        let shifted = |[x, y, z, d]: [f64; 4]| [x as f32, y as f32, z as f32, (d - x * corner[0] - z * corner[1]) as f32];
        solids.planes.extend(self.planes.iter().map(|plane| shifted(*plane)));
        let (centre, turn, radii) = self.ellipsoid.unwrap_or_default();
        solids.heads.push(SolidHead {
            first,
            count: self.planes.len() as u32,
            moment: self.moment,
            body: self.body,
            low: local(self.low),
            high: local(self.high),
            centre: if self.ellipsoid.is_some() { local(centre) } else { [0.0; 4] },
            turn: [turn[0] as f32, turn[1] as f32, 0.0, 0.0],
            radii: [radii[0] as f32, radii[1] as f32, radii[2] as f32, 0.0],
        });
    }
}

/// Distance far outside, m: what the box around a solid keeps away from it need not be known better.
const AWAY: f32 = 1e3;

/// How a point (patch-local x, z; absolute y) lies to a solid. `standing`: its underside is none, since plants there cannot pass below.
#[inline(always)]
pub fn nearness(solid: &SolidHead, planes: &[[f32; 4]], at: [f32; 3], standing: bool) -> Nearness {
    let beside = |axis: usize| at[axis] < solid.low[axis] || at[axis] > solid.high[axis];
    if beside(0) || beside(2) || at[1] > solid.high[1] || (at[1] < solid.low[1] && !standing) {
        return Nearness::FAR;
    }
    if solid.count == 0 {
        return ellipsoid_nearness(solid, at);
    }
    let mut nearest = Nearness { distance: -AWAY, normal: [0.0, 1.0, 0.0] };
    let skipped = if standing { 1 } else { 0 };
    for [x, y, z, d] in &planes[solid.first as usize + skipped..(solid.first + solid.count) as usize] {
        let distance = x * at[0] + y * at[1] + z * at[2] - d;
        if distance > nearest.distance {
            nearest = Nearness { distance, normal: [*x, *y, *z] };
        }
    }
    nearest
}

/// To first order in the distance, exact at the surface and for balls.
#[inline(always)]
fn ellipsoid_nearness(solid: &SolidHead, at: [f32; 3]) -> Nearness {
    let [cosine, sine, ..] = solid.turn;
    let (x, y, z) = (at[0] - solid.centre[0], at[1] - solid.centre[1], at[2] - solid.centre[2]);
    let own = [cosine * x - sine * z, y, sine * x + cosine * z];
    let (mut share, mut rise) = (0.0, 0.0);
    let mut gradient = [0.0; 3];
    for axis in 0..3 {
        let part = own[axis] / solid.radii[axis];
        gradient[axis] = part / solid.radii[axis];
        share += part * part;
        rise += gradient[axis] * gradient[axis];
    }
    let (share, rise) = (share.sqrt(), math::upper(rise.sqrt(), 1e-9));
    let [gx, gy, gz] = gradient.map(|part| part / rise);
    Nearness { distance: share * (share - 1.0) / rise, normal: [cosine * gx + sine * gz, gy, -sine * gx + cosine * gz] }
}

/// Whether plants with their root at `root` cannot pass below a solid: it reaches down to them, closer than `room` m.
#[inline(always)]
pub fn stands_on(solid: &SolidHead, planes: &[[f32; 4]], root: [f32; 3], room: f32) -> bool {
    if solid.count == 0 {
        return false;
    }
    let [x, y, z, d] = planes[solid.first as usize];
    x * root[0] + y * root[1] + z * root[2] - d < room
}
