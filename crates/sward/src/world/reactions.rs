//! What bodies feel of the plants of a step, and the events that follow from it.

use std::collections::VecDeque;

use super::World;
use crate::plan::Report;
use crate::state::{Among, BodyState, Event, Happening, Reaction};

/// How often a host hears of crushed plants, and after how long without any a body has left them, s.
const PACE: f64 = 0.1;
/// Most events that are kept for a host that does not ask.
const MOST_EVENTS: usize = 4096;

impl World {
    /// What plants do to a body: as of the last step on the CPU, of one up to [`crate::activation::LATENCY`] steps before on a GPU. Nothing of a body that is away;
    /// `None` for an unknown one.
    pub fn reaction(&self, body: usize) -> Option<Reaction> {
        self.state.bodies.get(body)?;
        Some(self.state.reactions.get(body).copied().unwrap_or_default())
    }

    /// What has happened between bodies and plants since this was last asked, oldest first; of a host that never asks the last 4096 events are kept.
    pub fn take_events(&mut self) -> Vec<Event> {
        self.events.drain(..).collect()
    }

    /// A body is gone: so it has left all plants.
    pub(super) fn leave(&mut self, body: usize) {
        let key = body as u32;
        let left: Vec<(u32, u32)> = self.state.among.range((key, 0)..=(key, u32::MAX)).map(|(pair, _)| *pair).collect();
        for pair in left {
            self.state.among.remove(&pair);
            tell(&mut self.events, &self.state.bodies, self.state.step, pair, Happening::Left);
        }
        if let Some(reaction) = self.state.reactions.get_mut(body) {
            *reaction = Reaction::default();
        }
    }

    /// Adds up what bodies felt in step number `step`, and tells of it.
    pub(super) fn feel(&mut self, step: u64, reports: &[Report]) {
        let bodies = self.state.bodies.len();
        let mut reactions = vec![Reaction::default(); bodies];
        let pace = ((PACE / self.model.dt).round() as u64).max(1);
        for (number, report) in reports.iter().enumerate() {
            let Some(stand) = self.stand_number(number) else { continue };
            for (toucher, sums) in report.felt.iter().filter(|(toucher, _)| (toucher.body as usize) < bodies) {
                let (force, moment, arm) = (sums.force(), sums.moment(), toucher.arm.map(f64::from));
                let reaction = &mut reactions[toucher.body as usize];
                for axis in 0..3 {
                    let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
                    reaction.force[axis] += force[axis];
                    reaction.torque[axis] += moment[axis] + arm[next] * force[last] - arm[last] * force[next];
                }
                reaction.plants = reaction.plants.saturating_add(sums.plants());
                let pair = (toucher.body, stand as u32);
                let among = self.state.among.entry(pair).or_insert_with(|| {
                    tell(&mut self.events, &self.state.bodies, step, pair, Happening::Entered);
                    Among { due: step, ..Among::default() }
                });
                among.last = step;
                among.crushed = among.crushed.saturating_add(sums.crushed());
                among.energy += sums.crushed_energy();
            }
        }
        for (body, reaction) in reactions.iter_mut().enumerate() {
            reaction.power = -self.power(body, reaction);
        }
        self.state.reactions = reactions;
        self.tell_of_crushed(step, pace);
    }

    /// Events that are due.
    fn tell_of_crushed(&mut self, step: u64, pace: u64) {
        let (events, bodies) = (&mut self.events, &self.state.bodies);
        self.state.among.retain(|pair, among| {
            let left = step >= among.last.saturating_add(pace);
            if among.crushed > 0 && (left || step >= among.due) {
                let what = Happening::Crushed { plants: among.crushed, energy: among.energy };
                *among = Among { last: among.last, due: step.saturating_add(pace), ..Among::default() };
                tell(events, bodies, step, *pair, what);
            }
            if left {
                tell(events, bodies, step, *pair, Happening::Left);
            }
            !left
        });
    }

    /// Power of what a body feels, along its way and its turn, W.
    fn power(&self, body: usize, reaction: &Reaction) -> f64 {
        let state = &self.state.bodies[body];
        let (Some(before), Some(pose)) = (&state.before, &state.pose) else { return 0.0 };
        let [x, z] = state.way();
        let way = [x, pose.height - before.height, z];
        let turn = (pose.yaw - before.yaw + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI;
        let work: f64 = (0..3).map(|axis| reaction.force[axis] * way[axis]).sum();
        (work + reaction.torque[1] * turn) / self.model.dt
    }

    /// The number in the scene of the stand that a report is of: stands of grass come first, then those of meshes.
    fn stand_number(&self, report: usize) -> Option<usize> {
        let grass = self.model.stands.len();
        match report.checked_sub(grass) {
            None => Some(self.model.stands[report].index),
            Some(layered) => Some(self.model.layered.get(layered)?.index),
        }
    }
}

/// Files an event that a body and a stand are part of.
fn tell(events: &mut VecDeque<Event>, bodies: &[BodyState], step: u64, (body, stand): (u32, u32), what: Happening) {
    let (body, stand) = (body as usize, stand as usize);
    let pose = bodies.get(body).and_then(|state| state.pose.or(state.before));
    let at = pose.map_or([0.0; 3], |pose| [pose.ground[0], pose.height, pose.ground[1]]);
    if events.len() >= MOST_EVENTS {
        events.pop_front();
    }
    events.push_back(Event { step, body, stand, at, what });
}
