//! Where a body's map is while the body stands on its base plane, as pictures show it.

use super::{DistanceMap, DistanceMapHead};
use crate::interaction::motion::Pose;
use crate::math;

type Vector = [f64; 3];

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// A vector at length 1, or `otherwise`.
fn unit(a: Vector, otherwise: Vector) -> Vector {
    let size = (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]).sqrt();
    if size > 1e-12 { a.map(|part| part / size) } else { otherwise }
}

impl DistanceMapHead {
    /// The map of a body at a pose, for the patch whose corner is at `corner` (x, z), m. See [`Self::new`] for the rest.
    pub fn posed(map: &DistanceMap, first: u32, (moment, body): (u32, u32), pose: &Pose, corner: [f64; 2]) -> Self {
        let up = unit([-pose.slope[0], 1.0, -pose.slope[1]], [0.0, 1.0, 0.0]);
        let (sine, cosine) = math::sin_cos_f64(pose.yaw);
        let forward = unit(cross([cosine, 0.0, -sine], up), [0.0, 0.0, 1.0]);
        let axes = [cross(up, forward), up, forward].map(|axis| axis.map(|part| part as f32));
        let origin = [pose.ground[0] - corner[0], pose.height, pose.ground[1] - corner[1]].map(|part| part as f32);
        Self::new(map, first, (moment, body), origin, axes)
    }
}
