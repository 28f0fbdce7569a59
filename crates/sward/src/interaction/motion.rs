//! Where a body is at a time, and how it stands on the ground. f64 and our own functions throughout: the same on every machine.

use serde::{Deserialize, Serialize};

use crate::math;
use crate::scene::{Interactor, Key, Path};
use crate::terrain::Terrain;

/// A body on the ground.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Pose {
    /// Centre, m from the authored origin (x, z).
    pub ground: [f64; 2],
    /// Turn about +Y, rad; forward is (sin, cos).
    pub yaw: f64,
    /// Height of the body's base at the centre, m.
    pub height: f64,
    /// Gradient of the base plane along x and z.
    pub slope: [f64; 2],
}

impl Pose {
    /// The pose a `share` of the way to `later`, 0 to 1: straight, turning the shorter way.
    pub fn towards(&self, later: &Self, share: f64) -> Self {
        let mix = |a: f64, b: f64| a + (b - a) * share;
        let both = |a: [f64; 2], b: [f64; 2]| [mix(a[0], b[0]), mix(a[1], b[1])];
        Self {
            ground: both(self.ground, later.ground),
            yaw: self.yaw + math::wrapped_angle(later.yaw - self.yaw) * share,
            height: mix(self.height, later.height),
            slope: both(self.slope, later.slope),
        }
    }
}

/// Position, yaw and clearance on a path before it meets the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// Position, m from the authored origin (x, z).
    pub ground: [f64; 2],
    /// Turn about +Y, rad.
    pub yaw: f64,
    /// Height above the ground, m.
    pub clearance: f64,
}

/// Tangent at key `k`: slope of the line through its neighbours in time.
fn tangent(keys: &[Key], k: usize) -> [f64; 2] {
    let (before, after) = (&keys[k.saturating_sub(1)], &keys[(k + 1).min(keys.len() - 1)]);
    let span = after.time - before.time;
    if span <= 0.0 { [0.0, 0.0] } else { [(after.at[0] - before.at[0]) / span, (after.at[1] - before.at[1]) / span] }
}

/// Heading of the path at its start, end, or where it stands still: towards the next place that differs.
fn resting_heading(keys: &[Key], from: usize) -> f64 {
    let here = keys[from].at;
    let other = keys[from..].iter().find(|key| key.at != here).map(|key| [key.at[0] - here[0], key.at[1] - here[1]]);
    let back = || keys[..from].iter().rev().find(|key| key.at != here).map(|key| [here[0] - key.at[0], here[1] - key.at[1]]);
    other.or_else(back).map_or(0.0, |d| math::atan2_f64(d[0], d[1]))
}

/// Cubic through the keys (Hermite, neighbour tangents); still before the first and after the last.
fn on_keys(keys: &[Key], repeat: bool, clearance: f64, time: f64) -> Station {
    let Some(last) = keys.last() else { return Station { ground: [0.0; 2], yaw: 0.0, clearance } };
    let (begin, period) = (keys[0].time, last.time - keys[0].time);
    let time = if repeat && period > 0.0 { begin + math::wrapped(time - begin, period) } else { time };
    let segment = keys.iter().take_while(|key| key.time <= time).count();
    let clear = |key: &Key| key.clearance.map_or(clearance, f64::from);
    if segment == 0 || segment == keys.len() {
        let k = segment.saturating_sub(1);
        return Station { ground: keys[k].at, yaw: keys[k].yaw.unwrap_or_else(|| resting_heading(keys, k)), clearance: clear(&keys[k]) };
    }
    let (a, b) = (&keys[segment - 1], &keys[segment]);
    let (ta, tb) = (tangent(keys, segment - 1), tangent(keys, segment));
    let span = b.time - a.time;
    let s = (time - a.time) / span;
    let (s2, s3) = (s * s, s * s * s);
    let mut ground = [0.0; 2];
    let mut motion = [0.0; 2];
    for axis in 0..2 {
        let (p, q, m, n) = (a.at[axis], b.at[axis], ta[axis] * span, tb[axis] * span);
        ground[axis] = p + (q - p) * (3.0 * s2 - 2.0 * s3) + m * (s3 - 2.0 * s2 + s) + n * (s3 - s2);
        motion[axis] = ((q - p) * (6.0 * s - 6.0 * s2) + m * (3.0 * s2 - 4.0 * s + 1.0) + n * (3.0 * s2 - 2.0 * s)) / span;
    }
    let moving = motion[0] * motion[0] + motion[1] * motion[1] > 1e-8;
    let along = if moving { math::atan2_f64(motion[0], motion[1]) } else { resting_heading(keys, segment - 1) };
    // From or to a key that says nothing, a body turns out of its motion or into it: a heading never jumps.
    let yaw = match (a.yaw, b.yaw) {
        (Some(from), Some(to)) => from + math::wrapped_angle(to - from) * s,
        (Some(from), None) => along + math::wrapped_angle(from - along) * (1.0 - s),
        (None, Some(to)) => along + math::wrapped_angle(to - along) * s,
        (None, None) => along,
    };
    Station { ground, yaw, clearance: clear(a) + (clear(b) - clear(a)) * s }
}

/// The place on a path at `time` \[s\]; `clearance` \[m\] where the path names none. Driven paths stay where they begin.
pub fn station(path: &Path, clearance: f64, time: f64) -> Station {
    match path {
        Path::Still(still) => Station { ground: still.at, yaw: f64::from(still.yaw), clearance },
        Path::Driven(driven) => Station { ground: driven.at, yaw: f64::from(driven.yaw), clearance },
        Path::Keyframes(path) => on_keys(&path.keys, path.repeat, clearance, time),
        Path::Circle(circle) => {
            let angle = circle.start + circle.speed / circle.radius * time;
            let (sine, cosine) = math::sin_cos_f64(math::wrapped_angle(angle));
            let way = if circle.speed < 0.0 { -1.0 } else { 1.0 };
            let ground = [circle.centre[0] + circle.radius * cosine, circle.centre[1] + circle.radius * sine];
            Station { ground, yaw: math::atan2_f64(-sine * way, cosine * way), clearance }
        }
    }
}

/// The body standing at a place: on the plane through the ground under its four sides, or level. `half` = half width and half length, m.
pub fn stand(ground: [f64; 2], yaw: f64, clearance: f64, half: [f64; 2], follow: bool, terrain: &Terrain) -> Pose {
    if !follow {
        return Pose { ground, yaw, height: terrain.height_at(ground[0], ground[1]) + clearance, slope: [0.0; 2] };
    }
    let (sine, cosine) = math::sin_cos_f64(yaw);
    let at = |x: f64, z: f64| terrain.height_at(ground[0] + cosine * x + sine * z, ground[1] - sine * x + cosine * z);
    let (left, right, back, front) = (at(-half[0], 0.0), at(half[0], 0.0), at(0.0, -half[1]), at(0.0, half[1]));
    let (across, lengthwise) = ((right - left) / (2.0 * half[0]), (front - back) / (2.0 * half[1]));
    let slope = [cosine * across + sine * lengthwise, -sine * across + cosine * lengthwise];
    Pose { ground, yaw, height: (left + right + back + front) / 4.0 + clearance, slope }
}

/// Pose of an interactor on its own path at `time` \[s\]. `half` as in its model: half width and half length, m.
pub fn pose_on_path(interactor: &Interactor, half: [f64; 2], terrain: &Terrain, time: f64) -> Pose {
    let station = station(&interactor.path, f64::from(interactor.clearance), time);
    stand(station.ground, station.yaw, station.clearance, half, interactor.follow_ground, terrain)
}
