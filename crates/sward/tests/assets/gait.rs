//! A walk: where hips, knees and feet are in a round of two steps.
//!
//! Feet come first: each lands on its heel, lies flat, rolls over its ball and swings. Hips and knees follow by the law of cosines. Right-hand
//! turns about +x, so legs swing forward by negative angles.

use std::f64::consts::{PI, TAU};

use sward::math::{atan2_f64, sin_cos_f64};

/// Time of a round of two steps, s.
pub(crate) const ROUND: f64 = 1.1;
/// Speed at which feet do not slide, m/s.
pub(crate) const SPEED: f64 = 1.0;
/// Length of thigh and shin, m.
pub(crate) const LEG: [f64; 2] = [0.43, 0.43];
/// Height of the ankle over the sole, m.
pub(crate) const ANKLE: f64 = 0.09;
/// Share of a round that a foot is on the ground.
const STANCE: f64 = 0.6;
/// Heel, and the ball's height and place, from the point below the ankle, m.
const HEEL: f64 = -0.06;
const BALL: [f64; 2] = [0.13, 0.025];

/// Angles of a leg, rad.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Leg {
    /// Of the thigh.
    pub(crate) thigh: f64,
    /// Of the shin against the thigh.
    pub(crate) shin: f64,
    /// Of the foot against the shin.
    pub(crate) foot: f64,
    /// Of the toes against the foot.
    pub(crate) toes: f64,
}

fn ramp(low: f64, high: f64, at: f64) -> f64 {
    let t = ((at - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Pitch of a foot, rad: toes up is negative.
fn pitch(round: f64) -> f64 {
    let landing = -0.28 * (1.0 - ramp(0.0, 0.1, round));
    let rolling = 0.65 * ramp(0.36, STANCE, round);
    let swinging = (0.65 + 0.28) * ramp(STANCE, 0.97, round);
    landing + rolling - swinging
}

/// Ankle \[z, y\] of a foot on the ground, from below the hip.
fn standing(round: f64) -> [f64; 2] {
    let ground = -SPEED * ROUND * (round - 0.5 * STANCE);
    let (sine, cosine) = sin_cos_f64(pitch(round));
    // A pitch turns z to −y; the heel or the ball keeps its place.
    let (over, height) = if pitch(round) < 0.0 { (HEEL, 0.0) } else { (BALL[0], BALL[1]) };
    let arm = [-over, ANKLE - height];
    [ground + over + cosine * arm[0] + sine * arm[1], height + cosine * arm[1] - sine * arm[0]]
}

/// Ankle of a foot at any time of its round: 0 is when it lands.
fn ankle(round: f64) -> [f64; 2] {
    if round < STANCE {
        return standing(round);
    }
    let (from, to) = (standing(STANCE - 1e-9), standing(0.0));
    let (t, span) = ((round - STANCE) / (1.0 - STANCE), 1.0 - STANCE);
    let (t2, t3) = (t * t, t * t * t);
    // Leaves the ground and comes to it at the ground's own speed.
    let slope = -SPEED * ROUND * span;
    let along = (2.0 * t3 - 3.0 * t2 + 1.0) * from[0] + (t3 - 2.0 * t2 + t) * slope + (3.0 * t2 - 2.0 * t3) * to[0] + (t3 - t2) * slope;
    let rise = 0.045 * sin_cos_f64(PI * t).0;
    [along, from[1] + (to[1] - from[1]) * ramp(0.0, 1.0, t) + rise]
}

/// Height of the hips over the ground, m: lowest with both feet down, twice a round.
pub(crate) fn hips(round: f64) -> f64 {
    0.9 + 0.014 * sin_cos_f64(2.0 * TAU * (round - 0.175)).0
}

fn arccosine(cosine: f64) -> f64 {
    let cosine = cosine.clamp(-1.0, 1.0);
    atan2_f64((1.0 - cosine * cosine).sqrt(), cosine)
}

/// A leg whose foot landed `round` of a round ago, below hips `high` m over the ground.
pub(crate) fn leg(round: f64, high: f64) -> Leg {
    let [along, height] = ankle(round);
    let (down, [thigh, shin]) = (high - height, LEG);
    // A leg never quite straightens.
    let reach = (along * along + down * down).sqrt().min(0.9995 * (thigh + shin));
    let swing = atan2_f64(along, down);
    let above = arccosine((thigh * thigh + reach * reach - shin * shin) / (2.0 * thigh * reach));
    let below = arccosine((shin * shin + reach * reach - thigh * thigh) / (2.0 * shin * reach));
    let (upper, lower) = (-(swing + above), -(swing - below));
    let toes = if round < STANCE { -pitch(round).max(0.0) } else { -0.65 * (1.0 - ramp(STANCE, 0.75, round)) };
    Leg { thigh: upper, shin: lower - upper, foot: pitch(round) - lower, toes }
}
