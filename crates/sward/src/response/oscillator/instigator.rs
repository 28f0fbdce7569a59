//! How far a body makes a plant lean, and where to: the least tilt at which the plant's rod is not inside it.
//!
//! Grass interaction by instigators (article), "Ellipse"; methods §2. A ball or ellipsoid is the article's instigator, raised by its
//! clearance over the root and exact for short rods too; where the rod is long and the body on the ground it is the article's
//! `θ₀(d) = π/2 − atan2(2 h₀ d, R₀² − d²)`. Other pieces are flat below with upright sides: there the least tilt is
//! `min(acos(c/l), atan(depth/c))`, c the clearance, l the rod, depth the way out. Twin: `instigator.wgsl`.

use super::model::OscillatorCoefficients;
use crate::interaction::{Contact, ContactEdge, underside};
use crate::math;

/// Bisection steps of the least tilt: π/2 · 2⁻²⁰ rad.
const BISECTIONS: u32 = 20;
/// A flat underside counts as at least this high over the root, m: else a plant a hair inside its edge would lie flat.
const LOWEST: f32 = 0.02;
/// Nearer to the middle than this, m, there is no way from it to the root.
const MIDDLE: f32 = 1e-4;

/// What one piece asks of a plant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Push {
    /// H: least tilt, rad, above 0 to π/2.
    pub tilt: f32,
    /// Where to, unit ground vector.
    pub outward: [f32; 2],
    /// How fast the piece's own motion may change that tilt, rad/s.
    pub pace: f32,
    /// How far along the rod the piece touches it at that tilt, m.
    pub lever: f32,
    /// 1: the piece pushes it aside; 0: its tip is under the piece, whose way turns it no farther.
    pub aside: f32,
}

/// Whether a rod from `root` along `way` stays outside the unit circle.
#[inline(always)]
fn is_clear(root: [f32; 2], way: [f32; 2]) -> bool {
    let squared = way[0] * way[0] + way[1] * way[1];
    let nearest = math::clamped(-(root[0] * way[0] + root[1] * way[1]) / squared, 0.0, 1.0);
    let (x, y) = (root[0] + nearest * way[0], root[1] + nearest * way[1]);
    x * x + y * y >= 1.0
}

/// H: the least tilt \[rad\], 0 to π/2, at which a rod of length `rod` m is outside an ellipsoid of radius `radius` m and half-height `half` m
/// whose lowest point is `clearance` m ≥ 0 over the root. `share`: distance from its middle to the root over the radius; from 1 on H is 0.
#[inline(always)]
pub fn least_tilt(share: f32, clearance: f32, radius: f32, half: f32, rod: f32) -> f32 {
    if share >= 1.0 || clearance >= rod {
        return 0.0;
    }
    // In radii the body is the unit circle and the root lies below it.
    let raised = clearance / half;
    let root = [share, -(1.0 + raised)];
    let (reach_x, reach_y) = (rod / radius, rod / half);
    if is_clear(root, [0.0, reach_y]) {
        return 0.0;
    }
    // The tangent from the root: the way to the middle turned outwards by the angle that the circle subtends.
    let beyond = (share * share + 2.0 * raised + raised * raised).sqrt();
    let tangent = [(1.0 + raised) - share * beyond, (1.0 + raised) * beyond + share];
    let tangent = [tangent[0] * radius, tangent[1] * half];
    let size = (tangent[0] * tangent[0] + tangent[1] * tangent[1]).sqrt();
    let (mut inside, mut outside) = ([0.0, 1.0], [tangent[0] / size, tangent[1] / size]);
    for _ in 0..BISECTIONS {
        let sum = [inside[0] + outside[0], inside[1] + outside[1]];
        let size = (sum[0] * sum[0] + sum[1] * sum[1]).sqrt();
        let middle = [sum[0] / size, sum[1] / size];
        if is_clear(root, [middle[0] * reach_x, middle[1] * reach_y]) {
            outside = middle;
        } else {
            inside = middle;
        }
    }
    math::atan2(outside[0], outside[1])
}

/// From the root to where the tangent touches the ellipsoid of [`least_tilt`], m.
#[inline(always)]
fn tangent_length(share: f32, clearance: f32, radius: f32, half: f32) -> f32 {
    let up = 1.0 + clearance / half;
    let beyond = math::upper(share * share + up * up - 1.0, 0.0).sqrt();
    // The unit vector along the tangent, as in `least_tilt`, over the squared way to the middle.
    let (x, y) = ((up - share * beyond) * radius, (up * beyond + share) * half);
    (x * x + y * y).sqrt() * beyond / (1.0 + beyond * beyond)
}

/// What a piece asks of a plant at `at` m from the footprint's corner, on `ground` m, `rod` m long, that faces along `facing`. `None` where
/// it does not reach it.
#[inline(always)]
pub fn push(
    co: &OscillatorCoefficients,
    contact: &Contact,
    edges: impl Iterator<Item = ContactEdge>,
    at: [f32; 2],
    ground: f32,
    rod: f32,
    facing: [f32; 2],
) -> Option<Push> {
    let arm = [at[0] - contact.centre[0], at[1] - contact.centre[1]];
    let velocity = [contact.velocity[0] + contact.yaw_rate * arm[1], contact.velocity[1] - contact.yaw_rate * arm[0]];
    let speed = (velocity[0] * velocity[0] + velocity[1] * velocity[1]).sqrt();
    if contact.kind == 0 {
        return push_flat(contact, edges, at, ground, rod, velocity, speed);
    }
    let in_radii = |x: f32, z: f32| {
        let [cosine, sine, across, lengthwise] = contact.form;
        [(cosine * x - sine * z) * across, (sine * x + cosine * z) * lengthwise]
    };
    // Where it passes nearest during the step: a fast ball would skip the plants between.
    let from = in_radii(at[0] - contact.start[0], at[1] - contact.start[1]);
    let to = in_radii(at[0] - contact.end[0], at[1] - contact.end[1]);
    let way = [to[0] - from[0], to[1] - from[1]];
    let length = math::upper(way[0] * way[0] + way[1] * way[1], 1e-12);
    let passed = math::clamped(-(from[0] * way[0] + from[1] * way[1]) / length, 0.0, 1.0);
    let (u, v) = (from[0] + passed * way[0], from[1] + passed * way[1]);
    let share = (u * u + v * v).sqrt();
    let middle = [0, 1, 2].map(|axis| contact.start[axis] + passed * (contact.end[axis] - contact.start[axis]));
    let off = [at[0] - middle[0], at[1] - middle[1]];
    let distance = (off[0] * off[0] + off[1] * off[1]).sqrt();
    // Its radius towards the root: of one that is not round on the ground too.
    let wide = if share > 1e-4 { distance / share } else { 1.0 / math::upper(contact.form[2], contact.form[3]) };
    let clearance = math::upper(middle[2] - contact.rise - ground, 0.0);
    let tilt = least_tilt(share, clearance, wide, contact.rise, rod);
    if tilt <= 0.0 {
        return None;
    }
    let ahead = if speed > 1e-4 { [velocity[0] / speed, velocity[1] / speed] } else { facing };
    let outward = if distance > MIDDLE { [off[0] / distance, off[1] / distance] } else { ahead };
    let rising = (contact.end[2] - contact.start[2]) / co.dt;
    let narrow = math::lower(wide, contact.rise);
    let lever = math::lower(tangent_length(share, clearance, wide, contact.rise), rod);
    Some(Push { tilt, outward, pace: 2.0 * (speed * speed + rising * rising).sqrt() / narrow, lever, aside: 1.0 })
}

/// The same of a piece that is flat below: out over the nearest edge that does not face away from the motion.
#[inline(always)]
fn push_flat(
    contact: &Contact,
    edges: impl Iterator<Item = ContactEdge>,
    at: [f32; 2],
    ground: f32,
    rod: f32,
    velocity: [f32; 2],
    speed: f32,
) -> Option<Push> {
    let clearance = math::upper(underside(contact, at) - ground, LOWEST);
    if clearance >= rod {
        return None;
    }
    let units = (1_u32 << contact.shift) as f32 / contact.spacing;
    let place = [at[0] * units, at[1] * units];
    let (mut depth, mut outward, mut inside) = (f32::MAX, [0.0; 2], true);
    for edge in edges {
        let off = [place[0] - edge.start[0] as f32, place[1] - edge.start[1] as f32];
        let distance = (edge.along[0] as f32 * off[1] - edge.along[1] as f32 * off[0]) * edge.metres;
        let facing = edge.normal[0] * velocity[0] + edge.normal[1] * velocity[1];
        inside &= distance > 0.0;
        if facing >= -1e-3 * speed && distance < depth {
            (depth, outward) = (distance, edge.normal);
        }
    }
    if !inside || depth == f32::MAX {
        return None;
    }
    let under = math::atan2((rod * rod - clearance * clearance).sqrt(), clearance);
    let out = math::atan(depth / clearance);
    let tilt = math::lower(under, out);
    let (_, cosine) = math::sin_cos(tilt);
    let lever = math::lower(clearance / math::upper(cosine, 1e-3), rod);
    let aside = if out < under { 1.0 } else { 0.0 };
    Some(Push { tilt, outward, pace: speed / clearance, lever, aside })
}
