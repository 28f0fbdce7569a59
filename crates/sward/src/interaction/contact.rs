//! One convex piece of one body over one step, as the kernels see it.
//!
//! Inside or outside is decided by integer edge functions; distances, heights and velocities are f32 relative to the
//! footprint's own corner. Twin: `contact.wgsl`.

use bytemuck::{Pod, Zeroable};

use crate::math::{self, either, mask};

/// Width of the band along an edge in which plants bend outwards, m (methods §1.1).
const BAND: f32 = 0.4;

/// A directed edge of a swept footprint, counter-clockwise in (x, z) seen with z up the page: inside is on its left.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct ContactEdge {
    /// Start, fractions of a cell from the footprint's corner.
    pub start: [i32; 2],
    /// End − start, same unit.
    pub along: [i32; 2],
    /// Outward unit normal.
    pub normal: [f32; 2],
    /// Metres per unit of the integer edge function.
    pub metres: f32,
    /// Not used; keeps the size a multiple of 16 bytes.
    pub unused: f32,
}

/// A piece's swept footprint, motion and underside.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Contact {
    /// Cells covered by the footprint's bounding rectangle, x and z.
    pub size: [i32; 2],
    /// First edge of this footprint in the step's edge list.
    pub edge_first: u32,
    /// Number of edges.
    pub edge_count: u32,
    /// A cell is 2^shift units of the edges.
    pub shift: u32,
    /// 0: plane underside. 1: ellipsoid.
    pub kind: u32,
    /// Velocity at the body's centre, m/s.
    pub velocity: [f32; 2],
    /// Body centre at the end of the step, m from the footprint's corner.
    pub centre: [f32; 2],
    /// Turning speed about +Y, rad/s.
    pub yaw_rate: f32,
    /// Cell side, m.
    pub spacing: f32,
    /// Start of the step: x and z of the piece's reference point [m from the corner], height there \[m\], unused.
    pub start: [f32; 4],
    /// End of the step, likewise.
    pub end: [f32; 4],
    /// Plane: gradient of the underside at start (x, z) and end (x, z). Ellipsoid: cos yaw, sin yaw, 1/rx, 1/rz.
    pub form: [f32; 4],
    /// Ellipsoid: vertical radius, m. Plane: 0.
    pub rise: f32,
    /// Index of the body.
    pub body: u32,
    /// Plants taller than this fraction of themselves are pushed at most there: 0.6 · plant height, m.
    pub highest: f32,
    /// Share of the step during which the body is there: less than 1 only of one that vanishes within it.
    pub stays: f32,
}

/// What a piece asks of a plant in one cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Horizontal speed of the body there, m/s.
    pub speed: f32,
    /// Bending direction d, unit.
    pub direction: [f32; 2],
    /// s_o = v·d, m/s.
    pub along: f32,
    /// h_eff, m.
    pub height: f32,
    /// Outward normal of the nearest edge, unit.
    pub normal: [f32; 2],
    /// Distance to the footprint's edge, m.
    pub depth: f32,
}

/// Cells of a row worked on together by [`contacts_of_row`].
pub const ABREAST: usize = 8;

/// Edge choice of methods §1.1 for cells side by side in a row.
struct Nearest {
    /// Negative where the cell's centre is outside.
    inside: [i32; ABREAST],
    depth: [f32; ABREAST],
    normal: [[f32; ABREAST]; 2],
    /// Outward normal if the cell lies in the band of an edge that does not face away from the motion, else 0.
    shape: [[f32; ABREAST]; 2],
}

/// `first` is the centre of the first cell in units of the edges, `cell` the side of a cell.
#[inline(always)]
fn nearest(edges: &[ContactEdge], first: [i32; 2], cell: i32, velocity: [[f32; ABREAST]; 2], speed: [f32; ABREAST]) -> Nearest {
    let none = [0.0; ABREAST];
    let mut nearest = Nearest { inside: [0; ABREAST], depth: [f32::MAX; ABREAST], normal: [none; 2], shape: [none; 2] };
    let (mut chosen, mut chosen_facing) = ([f32::MAX; ABREAST], none);
    for edge in edges {
        let first_side = edge.along[0] * (first[1] - edge.start[1]) - edge.along[1] * (first[0] - edge.start[0]);
        let slope = edge.along[1] * cell;
        for k in 0..ABREAST {
            let side = first_side - slope * k as i32;
            nearest.inside[k] |= side;
            let distance = side as f32 * edge.metres;
            let nearer = mask(distance < nearest.depth[k]);
            let facing = edge.normal[0] * velocity[0][k] + edge.normal[1] * velocity[1][k];
            let closer = mask(distance < chosen[k] - 1e-4) | (mask(distance <= chosen[k] + 1e-4) & mask(facing > chosen_facing[k]));
            let better = mask(facing >= -1e-3 * speed[k]) & closer;
            nearest.depth[k] = either(nearer, distance, nearest.depth[k]);
            nearest.normal[0][k] = either(nearer, edge.normal[0], nearest.normal[0][k]);
            nearest.normal[1][k] = either(nearer, edge.normal[1], nearest.normal[1][k]);
            chosen[k] = either(better, distance, chosen[k]);
            chosen_facing[k] = either(better, facing, chosen_facing[k]);
            nearest.shape[0][k] = either(better, edge.normal[0], nearest.shape[0][k]);
            nearest.shape[1][k] = either(better, edge.normal[1], nearest.shape[1][k]);
        }
    }
    for k in 0..ABREAST {
        let near = mask(chosen[k] <= BAND);
        nearest.shape[0][k] = either(near, nearest.shape[0][k], 0.0);
        nearest.shape[1][k] = either(near, nearest.shape[1][k], 0.0);
    }
    nearest
}

/// Height of a plane underside at `at` [m from the corner] for one end of the step.
#[inline(always)]
fn plane(reference: [f32; 4], gradient: [f32; 2], at: [f32; 2]) -> f32 {
    reference[2] + gradient[0] * (at[0] - reference[0]) + gradient[1] * (at[1] - reference[1])
}

/// `at` seen from one end of the step, in radii of the ellipsoid.
#[inline(always)]
fn in_radii(contact: &Contact, reference: [f32; 4], at: [f32; 2]) -> [f32; 2] {
    let (x, z) = (at[0] - reference[0], at[1] - reference[1]);
    let [cosine, sine, across, lengthwise] = contact.form;
    [(cosine * x - sine * z) * across, (sine * x + cosine * z) * lengthwise]
}

/// Lowest underside over `at` during the step; very high where there is none.
pub(crate) fn underside(contact: &Contact, at: [f32; 2]) -> f32 {
    if contact.kind == 0 { plane_underside(contact, at) } else { round_underside(contact, at) }
}

/// A plane is lowest at one end of the step.
#[inline(always)]
fn plane_underside(contact: &Contact, at: [f32; 2]) -> f32 {
    let before = plane(contact.start, [contact.form[0], contact.form[1]], at);
    math::lower(before, plane(contact.end, [contact.form[2], contact.form[3]], at))
}

/// An ellipsoid is lowest where it passes nearest: taken at the ends only, a fast ball would skip the plants between.
#[inline(always)]
fn round_underside(contact: &Contact, at: [f32; 2]) -> f32 {
    let (from, to) = (in_radii(contact, contact.start, at), in_radii(contact, contact.end, at));
    let way = [to[0] - from[0], to[1] - from[1]];
    let length = math::upper(way[0] * way[0] + way[1] * way[1], 1e-12);
    let passed = math::clamped(-(from[0] * way[0] + from[1] * way[1]) / length, 0.0, 1.0);
    let (u, v) = (from[0] + passed * way[0], from[1] + passed * way[1]);
    let inside = 1.0 - u * u - v * v;
    let centre = contact.start[2] + passed * (contact.end[2] - contact.start[2]);
    either(mask(inside < 0.0), 1e9, centre - contact.rise * math::upper(inside, 0.0).sqrt())
}

/// [`underside`] over places side by side.
#[inline(always)]
fn undersides(contact: &Contact, x: [f32; ABREAST], z: f32) -> [f32; ABREAST] {
    let mut heights = [0.0; ABREAST];
    if contact.kind == 0 {
        (0..ABREAST).for_each(|k| heights[k] = plane_underside(contact, [x[k], z]));
    } else {
        (0..ABREAST).for_each(|k| heights[k] = round_underside(contact, [x[k], z]));
    }
    heights
}

/// Contact of one cell: `cell` counted from the footprint's corner, `ground` the terrain height at its centre \[m\]. `None` if the
/// piece does not reach the plants there.
pub fn contact_at(contact: &Contact, edges: &[ContactEdge], cell: [i32; 2], ground: f32, plant_height: f32) -> Option<Hit> {
    let mut first = None;
    contacts_of_row(contact, edges, cell, |_| ground, plant_height, |k, hit| first = if k == 0 { Some(hit) } else { first });
    first
}

/// Contacts of [`ABREAST`] cells side by side along +x, of which `first` is the first: see [`contact_at`]. `ground` gives the height at
/// the k-th of them \[m\], and is asked of cells within the footprint only; `found` is told the contact of the k-th.
#[inline(always)]
pub fn contacts_of_row(
    contact: &Contact,
    edges: &[ContactEdge],
    first: [i32; 2],
    ground: impl Fn(usize) -> f32,
    plant_height: f32,
    mut found: impl FnMut(usize, Hit),
) {
    let beside = first[0] <= -(ABREAST as i32) || first[0] >= contact.size[0];
    if beside || first[1] < 0 || first[1] >= contact.size[1] {
        return;
    }
    let half = contact.shift - 1;
    let point = [(2 * first[0] + 1) << half, (2 * first[1] + 1) << half];
    let z = (first[1] as f32 + 0.5) * contact.spacing;
    let (mut x, mut velocity, mut speed) = ([0.0; ABREAST], [[0.0; ABREAST]; 2], [0.0; ABREAST]);
    for k in 0..ABREAST {
        x[k] = ((first[0] + k as i32) as f32 + 0.5) * contact.spacing;
        let arm = [x[k] - contact.centre[0], z - contact.centre[1]];
        velocity[0][k] = contact.velocity[0] + contact.yaw_rate * arm[1];
        velocity[1][k] = contact.velocity[1] - contact.yaw_rate * arm[0];
        speed[k] = (velocity[0][k] * velocity[0][k] + velocity[1][k] * velocity[1][k]).sqrt();
    }
    let nearest = nearest(edges, point, 1 << contact.shift, velocity, speed);
    let mut clearance = undersides(contact, x, z);
    let mut reached = [false; ABREAST];
    for k in 0..ABREAST {
        let column = first[0] + k as i32;
        if column >= 0 && column < contact.size[0] && nearest.inside[k] >= 0 {
            clearance[k] -= ground(k);
            reached[k] = clearance[k] < plant_height;
        }
    }
    if reached == [false; ABREAST] {
        return;
    }
    // Of all of them, since eight cost as much as one.
    let (mut height, mut direction, mut along) = ([0.0; ABREAST], [[0.0; ABREAST]; 2], [0.0; ABREAST]);
    for k in 0..ABREAST {
        height[k] = math::upper(math::lower(clearance[k], contact.highest), 0.02);
        let safe = math::upper(speed[k], 1e-12);
        let heading = [velocity[0][k] / safe + nearest.shape[0][k], velocity[1][k] / safe + nearest.shape[1][k]];
        let size = math::upper((heading[0] * heading[0] + heading[1] * heading[1]).sqrt(), 1e-12);
        (direction[0][k], direction[1][k]) = (heading[0] / size, heading[1] / size);
        along[k] = velocity[0][k] * direction[0][k] + velocity[1][k] * direction[1][k];
    }
    for k in (0..ABREAST).filter(|k| reached[*k]) {
        let normal = [nearest.normal[0][k], nearest.normal[1][k]];
        let direction = [direction[0][k], direction[1][k]];
        found(k, Hit { speed: speed[k], direction, along: along[k], height: height[k], normal, depth: nearest.depth[k] });
    }
}
