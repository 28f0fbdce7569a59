//! How an upright blade stands in steady wind, for every speed: what sleeping patches show.
//!
//! Methods §3.1 and §3.4. Each joint balances its spring against drag and weight on its own segment. Worked out once, f64; a step and a
//! picture look it up. Twin: `steady.wgsl`.

use super::blade::{ChainCoefficients, MOST_SEGMENTS};
use super::joint::{BEND_LIMIT, Bends, count, raised};
use crate::math;

/// Speeds in the table: evenly in √speed from 0 to [`TOP`].
pub const SPEEDS: usize = 64;
/// Highest speed, m/s; faster air bends no farther.
pub const TOP: f32 = 64.0;
/// Newton steps for each joint.
const TURNS: u32 = 40;

/// ψ \[rad\] and what holds it beside spring and weight \[N·m\], by speed and joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Steady {
    /// [`MOST_SEGMENTS`] for each speed, the slowest first.
    pub values: Vec<[f32; 2]>,
}

/// Angle of a joint above a segment tilted by `below`, whose own segment is pulled by `force` \[N\] along the wind and `weight` \[N\] down.
fn balanced(spring: f64, l: f64, force: f64, weight: f64, below: f64) -> f64 {
    let limit = f64::from(BEND_LIMIT);
    let (mut low, mut high) = (0.0, limit);
    let mut angle = 0.0;
    for _ in 0..TURNS {
        let (sine, cosine) = math::sin_cos_f64(below + angle);
        let missing = l * (force * cosine + weight * sine) - spring * angle;
        // What is missing falls as the joint bends, at least where it crosses 0 from above: a bracket keeps Newton on it.
        (low, high) = if missing > 0.0 { (angle, high) } else { (low, angle) };
        let slope = spring + l * (force * sine - weight * cosine);
        let next = angle + missing / if slope > 0.05 * spring { slope } else { 0.05 * spring };
        angle = if next > low && next < high { next } else { 0.5 * (low + high) };
    }
    angle
}

impl Steady {
    /// Of the blade that these coefficients move.
    pub fn of(co: &ChainCoefficients) -> Self {
        let mut values = vec![[0.0; 2]; SPEEDS * MOST_SEGMENTS];
        let (l, weight) = (f64::from(co.half_length), f64::from(co.weight));
        for (k, row) in values.chunks_exact_mut(MOST_SEGMENTS).enumerate() {
            let share = k as f32 / (SPEEDS - 1) as f32;
            let speed = TOP * share * share;
            let force = f64::from(co.drag * raised(speed, co.drag_thirds) * speed);
            let mut tilt = 0.0;
            for (i, value) in row[..count(co)].iter_mut().enumerate() {
                let spring = f64::from(co.joints[i].stiffness);
                let angle = balanced(spring, l, force, weight, tilt);
                tilt += angle;
                *value = [angle as f32, (spring * angle - l * weight * math::sin_cos_f64(tilt).0) as f32];
            }
        }
        Self { values }
    }

    /// ψ and moments of an upright blade ([`super::UPRIGHT`]) in `wind` (x, z) \[m/s\].
    pub fn at(&self, wind: [f32; 2]) -> [Bends; 2] {
        let speed = (wind[0] * wind[0] + wind[1] * wind[1]).sqrt();
        let place = math::lower((speed * (1.0 / TOP)).sqrt() * (SPEEDS - 1) as f32, (SPEEDS - 1) as f32);
        let below = (place as usize).min(SPEEDS - 2);
        let way = place - below as f32;
        let along = [wind[1] / math::upper(speed, 1e-9), wind[0] / math::upper(speed, 1e-9)];
        let mut found = [[[0.0; 2]; MOST_SEGMENTS]; 2];
        for i in 0..MOST_SEGMENTS {
            let (a, b) = (self.values[below * MOST_SEGMENTS + i], self.values[(below + 1) * MOST_SEGMENTS + i]);
            for (kind, bends) in found.iter_mut().enumerate() {
                let value = a[kind] + (b[kind] - a[kind]) * way;
                bends[i] = [value * along[0], value * along[1]];
            }
        }
        found
    }

    /// Tilt of the tip in a wind of `speed` m/s, rad.
    pub fn lean(&self, speed: f32) -> f32 {
        self.at([speed, 0.0])[0].iter().map(|bend| bend[1]).sum()
    }
}
