//! The air of a step: the wind that stands and pictures read, and the flow of planes, which bodies drag along.
//!
//! What flows is read as it was when the last step ended, and flows on when all stands have read it: pictures of a moment between two steps mix the
//! two flows around it.

use super::World;
use crate::interaction::{Station, station};
use crate::math;
use crate::model::{Blower, StandModel};
use crate::response::{Stage, continuum};
use crate::wind::fluid::{FluidPlan, FluidSource, Passing};
use crate::wind::{Blowing, Footprint, WindField};

impl World {
    /// The wind of the coming step on the nodes of a stand.
    pub fn wind(&self, stand: &StandModel) -> WindField {
        self.wind_before(stand, 0.0)
    }

    /// The wind `behind` steps (0 to 1) before the state.
    pub fn wind_before(&self, stand: &StandModel, behind: f64) -> WindField {
        self.wind_on(stand.spacing, stand.cells, behind)
    }

    /// The wind on the nodes of patches of so many cells a side, each so many metres wide.
    pub(super) fn wind_on(&self, spacing: f64, cells: u32, behind: f64) -> WindField {
        let node = spacing * f64::from(continuum::NODE_CELLS);
        let mut wind = WindField::before(&self.blowing(behind), self.state.step, behind, self.model.dt, node);
        wind.images = self.model.images.clone();
        let fluids = self.model.fluids.iter().zip(&self.state.fluids);
        wind.fluids = fluids.map(|(fluid, flow)| fluid.field(flow, self.state.step, behind, node)).collect();
        wind.footprints = self.model.blowers.iter().filter_map(|blower| self.blown(blower, cells, node, behind)).collect();
        wind
    }

    /// The sources that are everywhere, as strong as they are.
    pub(super) fn blowing(&self, behind: f64) -> Vec<Blowing> {
        self.model.sources.iter().map(|blowing| Blowing { level: self.level(blowing.place, behind), ..*blowing }).collect()
    }

    /// How strong the source at a place of the scene is, 0 to 1.
    fn level(&self, place: usize, behind: f64) -> f32 {
        self.state.winds.get(place).map_or(1.0, |state| state.level(self.state.step as f64 - behind))
    }

    /// The footprint of a blower on the nodes of a stand; `None` where nothing reaches the ground.
    pub(super) fn blown(&self, blower: &Blower, cells: u32, node: f64, behind: f64) -> Option<Footprint> {
        let source = &blower.source;
        let at = match blower.follow {
            Some(body) => {
                let pose = self.pose_before(body, behind)?;
                let clearance = pose.height - self.model.terrain.height_at(pose.ground[0], pose.ground[1]);
                Station { ground: pose.ground, yaw: pose.yaw, clearance }
            }
            None => station(&source.path, f64::from(source.height), self.time() - behind * self.model.dt),
        };
        let share = 1.0 - at.clearance / f64::from(source.ceiling);
        let level = self.level(blower.place, behind);
        if level == 0.0 {
            return None;
        }
        let speed = level * source.speed * crate::math::clamped(share as f32, 0.0, 1.0);
        let (sine, cosine) = math::sin_cos_f64(at.yaw);
        let turn = [cosine as f32, sine as f32];
        let intervals = cells / continuum::NODE_CELLS;
        Footprint::new(blower.flow, &self.model.images, at.ground, turn, source.radius, speed, intervals, node)
    }

    /// What pushes each plane of air in the coming step.
    pub(super) fn plan_fluids(&self) -> Vec<FluidPlan> {
        let level = |fluid: &FluidSource| self.level(fluid.place, 0.0);
        self.model.fluids.iter().map(|fluid| fluid.plan(self.state.step, level(fluid), self.passing())).collect()
    }

    /// The bodies at the end of the step, as the air meets them.
    fn passing(&self) -> impl Iterator<Item = Passing> {
        self.model.bodies.iter().zip(&self.state.bodies).filter_map(|(body, state)| {
            let (before, now) = (state.before?, state.pose?);
            let ground = self.model.terrain.height_at(now.ground[0], now.ground[1]);
            Some(Passing {
                ground: now.ground,
                velocity: [0, 1].map(|axis: usize| (now.ground[axis] - before.ground[axis]) / self.model.dt),
                yaw: now.yaw,
                half: body.reach,
                clearance: now.height - ground,
            })
        })
    }

    /// Lets the air flow for a step.
    pub(super) fn flow(&mut self, plans: &[FluidPlan], ended: &mut dyn FnMut(Stage)) {
        for ((fluid, flow), plan) in self.model.fluids.iter().zip(&mut self.state.fluids).zip(plans) {
            fluid.step(flow, plan);
            ended(Stage::Air);
        }
    }
}
