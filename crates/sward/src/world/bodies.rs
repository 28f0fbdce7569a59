//! Bodies of a step: where they are, and what of the ground they sweep.

use super::{Input, JUMP, World};
use crate::interaction::solid::WorldSolid;
use crate::interaction::{Contact, Footprint, Grid, Piece, Pose, pose_on_path, stand_on, swept, swept_between};
use crate::model::StandModel;
use crate::scene::{Driven, Path};

impl World {
    pub(super) fn pose(&self, index: usize, time: f64) -> Option<Pose> {
        let (interactor, body) = (&self.scene.interactors[index], &self.model.bodies[index]);
        if time < interactor.from || time >= interactor.until || self.state.vacant.contains(&(index as u32)) {
            return None;
        }
        let driven = match interactor.path {
            Path::Driven(_) => self.state.bodies[index].driven,
            _ => None,
        };
        Some(match driven {
            Some((ground, yaw, clearance)) => stand_on(ground, yaw, clearance, body.half, interactor.follow_ground, &self.model.terrain),
            None => pose_on_path(interactor, body.half, &self.model.terrain, time),
        })
    }

    /// Ends a body's path where it is: from now on it is driven from code, with [`World::drive`]. Returns where that is (ground m, yaw rad, clearance m);
    /// `None` for a body that is away or unknown.
    pub fn take_over(&mut self, body: usize) -> Option<([f64; 2], f64, f64)> {
        let pose = self.state.bodies.get(body)?.pose?;
        let interactor = self.scene.interactors.get_mut(body)?;
        let clearance = match (&interactor.path, self.state.bodies[body].driven) {
            (Path::Driven(_), Some((.., clearance))) => clearance,
            _ => {
                // On slopes the base is a little off the ground below its middle.
                let above = pose.height - self.model.terrain.height_at(pose.ground[0], pose.ground[1]);
                let usual = f64::from(interactor.clearance);
                if (above - usual).abs() < 0.3 { usual } else { above }
            }
        };
        interactor.path = Path::Driven(Driven { at: pose.ground, yaw: pose.yaw as f32 });
        self.note(|| Input::TakeOver(body));
        let place = (pose.ground, pose.yaw, clearance);
        self.state.bodies[body].driven = Some(place);
        Some(place)
    }

    /// Poses at the end of the coming step. Returns the pieces of bodies whose own parts move, before and after the step, in body order.
    pub(super) fn move_bodies(&mut self) -> Vec<Vec<[Piece; 2]>> {
        let time = (self.state.step + 1) as f64 * self.model.dt;
        for index in 0..self.state.bodies.len() {
            let next = self.pose(index, time);
            let body = &mut self.state.bodies[index];
            let jumped = |from: &Pose, to: &Pose| {
                let way = [to.ground[0] - from.ground[0], to.ground[1] - from.ground[1]];
                (way[0] * way[0] + way[1] * way[1]).sqrt() > JUMP * self.model.dt
            };
            let jumps = std::mem::take(&mut body.jumps);
            body.before = match (&body.pose, &next) {
                (Some(from), Some(to)) if !jumps && !jumped(from, to) => Some(*from),
                _ => next,
            };
            let elapsed = time - self.scene.interactors[index].from;
            body.clock = [if body.before == next && next != body.pose { elapsed } else { elapsed - self.model.dt }, elapsed];
            body.pose = next;
        }
        self.model.bodies.iter().zip(&self.state.bodies).map(|(body, state)| body.pieces_between(state)).collect()
    }

    /// The bodies as solids, of a stand that moves blade by blade; none too high to touch it.
    pub(super) fn solids(&self, stand: &StandModel, moving: &[Vec<[Piece; 2]>]) -> Vec<WorldSolid> {
        let mut solids = Vec::new();
        let bodies =
            self.model.bodies.iter().zip(&self.state.bodies).enumerate().filter(|_| stand.chain.is_some() || stand.springs.is_some());
        for (index, (body, state)) in bodies {
            let (Some(before), Some(now)) = (&state.before, &state.pose) else { continue };
            let pieces: Vec<&Piece> = match body.is_animated() {
                true => moving[index].iter().map(|[_, after]| after).collect(),
                false => body.pieces.iter().collect(),
            };
            solids.extend(WorldSolid::during(&pieces, before, now, index as u32));
        }
        let height = f64::from(stand.species.height[1]);
        solids.retain(|solid| {
            let [low, high] = solid.reach();
            let ground = self.model.terrain.height_at(0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]));
            // With room for slopes.
            let reach = 0.5 * ((high[0] - low[0]) + (high[1] - low[1]));
            solid.lowest() - ground < height + reach
        });
        solids
    }

    /// Footprints that bodies sweep, in body order, of a stand that moves as a whole. `moving`: pieces of bodies whose own parts move, before and after
    /// the step.
    pub(super) fn footprints(&self, stand: &StandModel, moving: &[Vec<[Piece; 2]>]) -> Vec<Footprint> {
        if stand.chain.is_some() || stand.springs.is_some() {
            return Vec::new();
        }
        let grid = Grid { spacing: stand.spacing, plant_height: stand.coefficients.plant_height };
        let mut footprints = Vec::new();
        for (index, (body, state)) in self.model.bodies.iter().zip(&self.state.bodies).enumerate() {
            let (dt, body_index) = (self.model.dt, index as u32);
            if stand.oscillator.is_some()
                && let Some((before, last, share)) = self.leaving(index)
            {
                let found = body.pieces.iter().filter_map(|piece| swept(piece, &before, &last, share * dt, &grid, body_index));
                footprints.extend(found.map(|print| Footprint { contact: Contact { stays: share as f32, ..print.contact }, ..print }));
            }
            let (Some(before), Some(now)) = (&state.before, &state.pose) else { continue };
            if body.is_animated() {
                let pairs = moving[index].iter();
                footprints.extend(pairs.filter_map(|[a, b]| swept_between([a, b], before, now, dt, &grid, body_index)));
            } else {
                footprints.extend(body.pieces.iter().filter_map(|piece| swept(piece, before, now, dt, &grid, body_index)));
            }
        }
        footprints
    }

    /// Where a body that vanishes within the coming step is before it and at its last moment, and the share of the step for which it is there.
    pub(super) fn leaving(&self, index: usize) -> Option<(Pose, Pose, f64)> {
        let (dt, until) = (self.model.dt, self.scene.interactors[index].until);
        let share = until / dt - self.state.step as f64;
        if share <= 0.0 || self.state.bodies[index].pose.is_some() {
            return None;
        }
        let share = if share < 1.0 { share } else { 1.0 };
        let before = self.pose(index, self.state.step as f64 * dt)?;
        // The last number below it.
        Some((before, self.pose(index, f64::from_bits(until.to_bits() - 1))?, share))
    }
}
