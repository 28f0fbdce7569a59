//! Where the camera is: a focus of the simulation and the eye of the picture.

use serde::{Deserialize, Serialize};

use crate::interaction::Pose;
use crate::math;
use crate::model::Model;
use crate::scene::Scene;

/// A camera at one moment, m from the origin patch's corner, f64.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct View {
    /// Eye, m; y is absolute.
    pub eye: [f64; 3],
    /// Point looked at, m; y is absolute.
    pub target: [f64; 3],
    /// Vertical field of view, rad.
    pub field_of_view: f64,
}

/// Smooth position between camera keys.
fn on_keys(scene: &Scene, time: f64) -> ([f64; 3], [f64; 3]) {
    let camera = &scene.camera;
    let keys = &camera.keys;
    let next = keys.iter().take_while(|key| key.time <= time).count();
    match (keys.first(), keys.last()) {
        (Some(first), _) if next == 0 => (first.eye, first.target),
        (_, Some(last)) if next == keys.len() => (last.eye, last.target),
        (Some(_), Some(_)) => {
            let (a, b) = (&keys[next - 1], &keys[next]);
            let s = (time - a.time) / (b.time - a.time);
            let s = s * s * (3.0 - 2.0 * s);
            let mix = |p: [f64; 3], q: [f64; 3]| [0, 1, 2].map(|axis| p[axis] + (q[axis] - p[axis]) * s);
            (mix(a.eye, b.eye), mix(a.target, b.target))
        }
        _ => (camera.eye, camera.target),
    }
}

impl View {
    /// The scene's camera at `time` \[s\]: on its keys, with the body it follows at `followed`, or still. Heights are above the ground.
    pub fn of(scene: &Scene, model: &Model, followed: Option<Pose>, time: f64) -> Self {
        let (mut eye, mut target) = on_keys(scene, time);
        if let Some(pose) = followed {
            let (sine, cosine) = math::sin_cos_f64(pose.yaw);
            for point in [&mut eye, &mut target] {
                let [x, _, z] = *point;
                (point[0], point[2]) = (pose.ground[0] + cosine * x + sine * z, pose.ground[1] - sine * x + cosine * z);
            }
        }
        for point in [&mut eye, &mut target] {
            point[1] += model.terrain.height_at(point[0], point[2]);
        }
        Self { eye, target, field_of_view: f64::from(scene.camera.field_of_view) }
    }

    /// The point on the ground the simulation cares about: below the eye, m.
    pub fn focus(&self) -> [f64; 2] {
        [self.eye[0], self.eye[2]]
    }

    /// Whether a patch of side `side` \[m\] may be in the picture: a wide cone around the view direction on the ground, generous for any
    /// aspect ratio up to 21:9.
    pub fn sees(&self, patch: [i32; 2], side: f64) -> bool {
        let centre = patch.map(|p| (f64::from(p) + 0.5) * side);
        let (to, look) = ([centre[0] - self.eye[0], centre[1] - self.eye[2]], [self.target[0] - self.eye[0], self.target[2] - self.eye[2]]);
        let (distance, length) = ((to[0] * to[0] + to[1] * to[1]).sqrt(), (look[0] * look[0] + look[1] * look[1]).sqrt());
        let radius = side * std::f64::consts::FRAC_1_SQRT_2;
        if distance <= radius || length < 1e-6 {
            return true;
        }
        // Looking steeply down, all around the eye is in view.
        if (self.eye[1] - self.target[1]).abs() > length {
            return true;
        }
        let wide = self.field_of_view * 1.25;
        let half = if wide < 1.5 { wide } else { 1.5 };
        let (sine, cosine) = math::sin_cos_f64(half);
        let along = (to[0] * look[0] + to[1] * look[1]) / length;
        let across = (to[0] * look[1] - to[1] * look[0]).abs() / length;
        across * cosine - along * sine <= radius
    }
}
