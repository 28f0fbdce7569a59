//! What a step does to a plant within reach of bodies: it swings freely unless one holds it farther out.
//!
//! Methods §2: contact is unilateral, `H ≥ (free + wind)·d` holds. d starts from where the plant leans and turns towards where bodies push it;
//! a held plant takes the body's rate along when it is let go, its first step included. Differs: a hold tightens no faster than the body's own motion can, and 12 rad/s,
//! so plants under a body that appears or jumps lie down within a few steps instead of in one. Twin: `touch.wgsl`.

use super::instigator::Push;
use super::model::OscillatorCoefficients;
use super::swing::{Own, Record, SHORTEST, limited, stamp_held};
use crate::interaction::reaction::{CRUSHED, Leaning};
use crate::math;

/// No plant leans farther, rad.
const HALF_PI: f32 = std::f32::consts::FRAC_PI_2;
/// A plant that leans less has no direction to turn from, rad.
const UPRIGHT: f32 = 0.05;
/// Bodies oppose each other where their mean push is less than this share of what they push in all.
const OPPOSED: f32 = 0.2;

/// What all pieces of one kind ask of a plant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Gathered {
    strongest: f32,
    strongest_outward: [f32; 2],
    /// Number of that push, and where it touches the plant.
    strongest_number: u32,
    lever: f32,
    aside: f32,
    pace: f32,
    sum: [f32; 2],
    total: f32,
}

impl Gathered {
    #[inline(always)]
    fn add(&mut self, push: &Push, number: u32) {
        if push.tilt > self.strongest {
            (self.strongest, self.strongest_outward) = (push.tilt, push.outward);
            (self.strongest_number, self.lever, self.aside) = (number, push.lever, push.aside);
        }
        self.pace = math::upper(self.pace, push.pace);
        self.sum = [self.sum[0] + push.tilt * push.outward[0], self.sum[1] + push.tilt * push.outward[1]];
        self.total += push.tilt;
    }

    /// The mean of all, weighted by tilt; where they oppose each other the strongest one's.
    #[inline(always)]
    fn outward(&self) -> [f32; 2] {
        let size = (self.sum[0] * self.sum[0] + self.sum[1] * self.sum[1]).sqrt();
        if size < OPPOSED * self.total { self.strongest_outward } else { [self.sum[0] / size, self.sum[1] / size] }
    }
}

/// A plant within reach of bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plant {
    /// How it swings.
    pub own: Own,
    /// How it was last left.
    pub record: Record,
    /// How it stands in the wind, rad.
    pub wind: [f32; 2],
    /// Its moment of inertia about the root, kg·m².
    pub inertia: f32,
    /// Its length, m.
    pub length: f32,
}

/// What a step makes of a plant within reach of bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touched {
    /// Its record after it.
    pub record: Record,
    /// What the body feels that holds it, and which of the pushes that is.
    pub leaning: Option<(u32, Leaning)>,
}

/// The unit direction `from` turned towards the unit direction `to` by at most `most` rad; the other way round where they oppose.
#[inline(always)]
fn turned(from: [f32; 2], to: [f32; 2], most: f32) -> [f32; 2] {
    let along = from[0] * to[0] + from[1] * to[1];
    let across = from[0] * to[1] - from[1] * to[0];
    let (sine, cosine) = math::sin_cos(most);
    if along >= cosine {
        return to;
    }
    let sine = if across < 0.0 { -sine } else { sine };
    [from[0] * cosine - from[1] * sine, from[0] * sine + from[1] * cosine]
}

impl Plant {
    /// Bend at step `now` without bodies, rad.
    #[inline(always)]
    fn shown(&self, co: &OscillatorCoefficients, now: u32) -> [f32; 2] {
        let [x, z] = self.record.at(co, &self.own, now, 0.0);
        limited([x + self.wind[0], z + self.wind[1]])
    }

    /// Its record if bodies hold it at the end of the step that makes `now` steps, and what they feel; else `None`. The moment is J (Δθ̇/Δt + 2γθ̇ + ω₀²θ), the
    /// part of it that pushes back.
    #[inline(always)]
    fn held(&self, co: &OscillatorCoefficients, by: &Gathered, before: [f32; 2], free: [f32; 2], now: u32) -> Option<(Record, Leaning)> {
        if by.strongest <= 0.0 {
            return None;
        }
        let lean = (free[0] * free[0] + free[1] * free[1]).sqrt();
        let target = by.outward();
        let towards = if lean > UPRIGHT { turned([free[0] / lean, free[1] / lean], target, co.pace) } else { target };
        let along = |bend: [f32; 2]| bend[0] * towards[0] + bend[1] * towards[1];
        let reached = math::upper(along(before), 0.0) + co.pace + by.pace * co.dt;
        let hold = math::lower(math::lower(by.strongest, reached), HALF_PI);
        if hold < along(free) {
            return None;
        }
        let mut deviation = [hold * towards[0] - self.wind[0], hold * towards[1] - self.wind[1]];
        let mut size = (deviation[0] * deviation[0] + deviation[1] * deviation[1]).sqrt();
        if size < SHORTEST {
            (deviation, size) = (towards.map(|part| part * SHORTEST), SHORTEST);
        }
        let leant = (before[0] * before[0] + before[1] * before[1]).sqrt();
        let share = (towards[0] * deviation[0] + towards[1] * deviation[1]) / size;
        let turn = if leant > UPRIGHT { math::atan2(before[0] * towards[1] - before[1] * towards[0], along(before)) } else { 0.0 };
        let record = Record { deviation, rate: (hold - leant) / co.dt * share, stamp: stamp_held(now, turn / co.pace) };
        let was = self.record.rate_at(co, &self.own, now.wrapping_sub(1));
        let (rate, rate_before) = ((hold - along(before)) / co.dt, along(was));
        let away = along(deviation);
        let pull = (rate - rate_before) / co.dt + 2.0 * self.own.gamma * rate + self.own.omega_squared * away;
        let fell = hold > CRUSHED && leant <= CRUSHED;
        let energy = 0.5 * self.inertia * self.own.omega_squared * size * size;
        let leaning = Leaning {
            tilt: hold,
            towards,
            moment: math::upper(self.inertia * pull, 0.0),
            lever: by.lever,
            length: self.length,
            aside: by.aside,
            crushed: if fell { energy } else { 0.0 },
        };
        Some((record, leaning))
    }
}

/// What the step that makes `now` steps makes of a plant, if bodies change it: `pushes` with their numbers and the share of the step each stays for. A body
/// that vanishes within the step lets go at its own moment, not at the step's end: recovery does not depend on the length of steps.
#[inline(always)]
pub fn touch(co: &OscillatorCoefficients, plant: &Plant, pushes: impl Iterator<Item = (u32, Push, f32)>, now: u32) -> Option<Touched> {
    let (mut staying, mut leaving, mut stays) = (Gathered::default(), Gathered::default(), 1.0);
    for (number, push, share) in pushes {
        if share < 1.0 {
            leaving.add(&push, number);
            stays = share;
        } else {
            staying.add(&push, number);
        }
    }
    let before = plant.shown(co, now.wrapping_sub(1));
    let mut plant = *plant;
    let mut changed = None;
    if let Some((held, leaning)) = plant.held(co, &leaving, before, plant.shown(co, now), now) {
        plant.record = held.later(&plant.own, (1.0 - stays) * co.dt, now);
        changed = Some(Touched { record: plant.record, leaning: Some((leaving.strongest_number, leaning)) });
    }
    let free = plant.shown(co, now);
    let held = plant.held(co, &staying, before, free, now);
    let aged = plant.record.is_aged(co, now);
    let held = held.map(|(record, leaning)| Touched { record, leaning: Some((staying.strongest_number, leaning)) });
    held.or(changed).or(aged.then_some(Touched { record: Record::default(), leaning: None }))
}
