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
    /// Not used; keeps the size a multiple of 16 bytes.
    pub unused: f32,
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

/// Edge choice of methods §1.1 for one cell.
struct Nearest {
    depth: f32,
    normal: [f32; 2],
    /// Outward normal if the cell lies in the band of an edge that does not face away from the motion, else 0.
    shape: [f32; 2],
}

/// `None` if the point (units of the edges) is outside.
fn nearest(edges: &[ContactEdge], point: [i32; 2], velocity: [f32; 2], speed: f32) -> Option<Nearest> {
    let mut nearest = Nearest { depth: f32::MAX, normal: [0.0, 0.0], shape: [0.0, 0.0] };
    let (mut chosen, mut chosen_facing) = (f32::MAX, 0.0);
    for edge in edges {
        let side = edge.along[0] * (point[1] - edge.start[1]) - edge.along[1] * (point[0] - edge.start[0]);
        if side < 0 {
            return None;
        }
        let distance = side as f32 * edge.metres;
        if distance < nearest.depth {
            (nearest.depth, nearest.normal) = (distance, edge.normal);
        }
        let facing = edge.normal[0] * velocity[0] + edge.normal[1] * velocity[1];
        let closer = distance < chosen - 1e-4 || (distance <= chosen + 1e-4 && facing > chosen_facing);
        if facing >= -1e-3 * speed && closer {
            (chosen, chosen_facing) = (distance, facing);
            nearest.shape = edge.normal;
        }
    }
    if chosen > BAND {
        nearest.shape = [0.0, 0.0];
    }
    Some(nearest)
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
fn underside(contact: &Contact, at: [f32; 2]) -> f32 {
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
    if cell[0] < 0 || cell[1] < 0 || cell[0] >= contact.size[0] || cell[1] >= contact.size[1] {
        return None;
    }
    let half = contact.shift - 1;
    let point = [(2 * cell[0] + 1) << half, (2 * cell[1] + 1) << half];
    let at = [(cell[0] as f32 + 0.5) * contact.spacing, (cell[1] as f32 + 0.5) * contact.spacing];
    let arm = [at[0] - contact.centre[0], at[1] - contact.centre[1]];
    let velocity = [contact.velocity[0] + contact.yaw_rate * arm[1], contact.velocity[1] - contact.yaw_rate * arm[0]];
    let speed = (velocity[0] * velocity[0] + velocity[1] * velocity[1]).sqrt();
    let nearest = nearest(edges, point, velocity, speed)?;
    let clearance = underside(contact, at) - ground;
    if clearance >= plant_height {
        return None;
    }
    let height = math::upper(math::lower(clearance, contact.highest), 0.02);
    let safe = math::upper(speed, 1e-12);
    let heading = [velocity[0] / safe + nearest.shape[0], velocity[1] / safe + nearest.shape[1]];
    let size = math::upper((heading[0] * heading[0] + heading[1] * heading[1]).sqrt(), 1e-12);
    let direction = [heading[0] / size, heading[1] / size];
    let along = velocity[0] * direction[0] + velocity[1] * direction[1];
    Some(Hit { speed, direction, along, height, normal: nearest.normal, depth: nearest.depth })
}
