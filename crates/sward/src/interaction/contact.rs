//! One convex piece of one body over one step, as the kernels see it.
//!
//! Inside or outside is decided by integer edge functions; distances, heights and velocities are f32 relative to the
//! footprint's own corner. Twin: `contact.wgsl`.

use bytemuck::{Pod, Zeroable};

use crate::math;

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

impl Hit {
    /// Least bend under the body: atan(depth/h_eff), rad.
    #[inline(always)]
    pub fn floor(&self) -> f32 {
        math::atan(self.depth / self.height)
    }
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

/// All bits where something holds, else none: with it [`either`] needs no branch, and the cells of a row share instructions.
#[inline(always)]
fn mask(holds: bool) -> u32 {
    u32::from(holds).wrapping_neg()
}

/// `yes` where the mask has its bits, else `no`.
#[inline(always)]
fn either(mask: u32, yes: f32, no: f32) -> f32 {
    f32::from_bits((yes.to_bits() & mask) | (no.to_bits() & !mask))
}

/// Height of a plane underside at `at` [m from the corner] for one end of the step.
fn plane(reference: [f32; 4], gradient: [f32; 2], at: [f32; 2]) -> f32 {
    reference[2] + gradient[0] * (at[0] - reference[0]) + gradient[1] * (at[1] - reference[1])
}

/// `at` seen from one end of the step, in radii of the ellipsoid.
fn in_radii(contact: &Contact, reference: [f32; 4], at: [f32; 2]) -> [f32; 2] {
    let (x, z) = (at[0] - reference[0], at[1] - reference[1]);
    let [cosine, sine, across, lengthwise] = contact.form;
    [(cosine * x - sine * z) * across, (sine * x + cosine * z) * lengthwise]
}

/// Lowest underside over `at` during the step; very high where there is none. A plane is lowest at one end of the step, an ellipsoid
/// where it passes nearest: taken at the ends only, a fast ball would skip the plants between.
pub(crate) fn underside(contact: &Contact, at: [f32; 2]) -> f32 {
    if contact.kind == 0 {
        let before = plane(contact.start, [contact.form[0], contact.form[1]], at);
        return math::lower(before, plane(contact.end, [contact.form[2], contact.form[3]], at));
    }
    let (from, to) = (in_radii(contact, contact.start, at), in_radii(contact, contact.end, at));
    let way = [to[0] - from[0], to[1] - from[1]];
    let length = math::upper(way[0] * way[0] + way[1] * way[1], 1e-12);
    let passed = math::clamped(-(from[0] * way[0] + from[1] * way[1]) / length, 0.0, 1.0);
    let (u, v) = (from[0] + passed * way[0], from[1] + passed * way[1]);
    let inside = 1.0 - u * u - v * v;
    let centre = contact.start[2] + passed * (contact.end[2] - contact.start[2]);
    if inside < 0.0 { 1e9 } else { centre - contact.rise * inside.sqrt() }
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
    for k in 0..ABREAST {
        let column = first[0] + k as i32;
        if column < 0 || column >= contact.size[0] || nearest.inside[k] < 0 {
            continue;
        }
        let clearance = underside(contact, [x[k], z]) - ground(k);
        if clearance >= plant_height {
            continue;
        }
        let height = math::upper(math::lower(clearance, contact.highest), 0.02);
        let safe = math::upper(speed[k], 1e-12);
        let heading = [velocity[0][k] / safe + nearest.shape[0][k], velocity[1][k] / safe + nearest.shape[1][k]];
        let size = math::upper((heading[0] * heading[0] + heading[1] * heading[1]).sqrt(), 1e-12);
        let direction = [heading[0] / size, heading[1] / size];
        let along = velocity[0][k] * direction[0] + velocity[1][k] * direction[1];
        let normal = [nearest.normal[0][k], nearest.normal[1][k]];
        found(k, Hit { speed: speed[k], direction, along, height, normal, depth: nearest.depth[k] });
    }
}
