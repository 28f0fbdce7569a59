//! What a game or a test asks of a world: how far plants lean, how the wind blows, where the bodies are.

use super::World;
use crate::interaction::solid::WorldSolid;
use crate::interaction::{Grid, Piece, swept_between};
use crate::model::StandModel;
use crate::placement::{self, Growing, Plant};
use crate::plan::{around, weights};
use crate::response::chain::{self, ChainModel, Standing};
use crate::response::continuum;
use crate::response::oscillator::{self, Air, OscillatorModel, Own, Record};
use crate::response::springs::{SpringsModel, pool, root_of, target_of};
use crate::state::{PatchKey, StandState, TILE};

impl World {
    /// β \[rad\] of the cell of stand `stand` at a ground position [m from the authored origin]; at rest where the patch sleeps. Of a stand that moves
    /// blade by blade: of the tip of an upright blade that nobody has touched. Of one whose billboards bodies deform: the tilt from foot to tip of the
    /// billboard of that cell, where none grows of one in the cell's middle.
    /// `None` for an unknown stand. Where a GPU steps, download its cells first: the answer is of the cells held here.
    pub fn bend_at(&self, stand: usize, ground: [f64; 2]) -> Option<[f32; 2]> {
        let (model, state) = (self.model.stands.get(stand)?, self.state.stands.get(stand)?);
        let side = i64::from(model.cells);
        let cell = ground.map(|metres| (metres / model.spacing).floor() as i64);
        let patch = cell.map(|k| k.div_euclid(side) as i32);
        let [i, j] = cell.map(|k| k.rem_euclid(side));
        if let Some(chain) = &model.chain {
            let local = [0, 1].map(|axis: usize| (ground[axis] - f64::from(patch[axis]) * model.patch_side) as f32);
            return Some(self.blade_bend(model, chain, state, patch, local));
        }
        if let Some(oscillator) = &model.oscillator {
            return Some(self.swing(model, oscillator, state, patch, [i as u32, j as u32]));
        }
        if let Some(springs) = &model.springs {
            return Some(self.sheet_tilt(stand, springs, patch, (j * side + i) as u32));
        }
        match state.awake.get(&patch).or_else(|| state.awake.get(&TILE)).and_then(|awake| state.cells.now.get(awake.slot as usize)) {
            Some(cells) => {
                let at = (j * side + i) as usize;
                Some([cells[at], cells[(side * side) as usize + at]])
            }
            None => Some(continuum::Rest::of(&self.wind(model), patch, model.cells, model.species.continuum.wind).at(i as i32, j as i32)),
        }
    }

    /// [`World::bend_at`] of many places.
    pub fn bends_at(&self, stand: usize, places: &[[f64; 2]]) -> Vec<Option<[f32; 2]>> {
        places.iter().map(|place| self.bend_at(stand, *place)).collect()
    }

    /// Velocity of the air over a ground position [m from the authored origin] in the coming step, along x and z, m/s: of all sources, as the plants of
    /// the first stand feel it.
    pub fn wind_at(&self, ground: [f64; 2]) -> [f32; 2] {
        self.winds_at(&[ground]).pop().unwrap_or_default()
    }

    /// [`World::wind_at`] of many places.
    pub fn winds_at(&self, places: &[[f64; 2]]) -> Vec<[f32; 2]> {
        let side = self.model.patch_side;
        let (spacing, cells) = self.model.stands.first().map_or((side / 8.0, 8), |stand| (stand.spacing, stand.cells));
        let wind = self.wind_on(spacing, cells, 0.0);
        let velocity = |place: &[f64; 2]| {
            let patch = place.map(|metres| (metres / side).floor() as i32);
            let local = [0, 1].map(|axis: usize| (place[axis] - f64::from(patch[axis]) * side) as f32);
            wind.velocity_local(&wind.patch_phases(patch, cells / continuum::NODE_CELLS), local)
        };
        places.iter().map(velocity).collect()
    }

    /// The bodies as they stand, as solids in the world; none of those that are away.
    pub fn solids_now(&self) -> Vec<WorldSolid> {
        let mut solids = Vec::new();
        for (index, (body, state)) in self.model.bodies.iter().zip(&self.state.bodies).enumerate() {
            let Some(pose) = &state.pose else { continue };
            let moved: Vec<Piece> = body.pieces_between(state).into_iter().map(|[_, now]| now).collect();
            let pieces = if body.is_animated() { &moved } else { &body.pieces };
            solids.extend(pieces.iter().filter_map(|piece| WorldSolid::new(piece, pose, 0, index as u32)));
        }
        solids
    }

    /// Outlines on the ground of what the bodies swept in the last step, m: number of the body, and the corners in order.
    pub fn swept_now(&self) -> Vec<(usize, Vec<[f64; 2]>)> {
        let grid = self.model.stands.first().map_or(Grid { spacing: 0.05, plant_height: 1.0 }, |stand| Grid {
            spacing: stand.spacing,
            plant_height: stand.species.height[1],
        });
        let mut found = Vec::new();
        for (index, (body, state)) in self.model.bodies.iter().zip(&self.state.bodies).enumerate() {
            let (Some(before), Some(now)) = (&state.before, &state.pose) else { continue };
            let moving = body.pieces_between(state);
            let still = body.pieces.iter().filter(|_| !body.is_animated()).map(|piece| [piece, piece]);
            for pair in moving.iter().map(|[from, to]| [from, to]).chain(still) {
                if let Some(print) = swept_between(pair, before, now, self.model.dt, &grid, index as u32) {
                    found.push((index, print.outline(grid.spacing)));
                }
            }
        }
        found
    }

    /// How far the tip of an upright blade without a state leans at a place of a patch.
    fn blade_bend(&self, stand: &StandModel, chain: &ChainModel, state: &StandState, patch: PatchKey, local: [f32; 2]) -> [f32; 2] {
        let wind = self.wind(stand);
        let phases = wind.patch_phases(patch, stand.cells / continuum::NODE_CELLS);
        let slots = around(state, patch, |awake| awake.slot);
        let standing = Standing { chain, around: slots, weights: weights(state, patch), patch_side: stand.patch_side as f32 };
        let moments = standing.moments(&state.cells.now, local, || wind.velocity_local(&phases, local));
        let bends = standing.pose(&chain::UPRIGHT, 0.0, &moments);
        let mut leans = [[0.0; 2]; chain::MOST_SEGMENTS];
        chain::leans(chain, &chain::UPRIGHT, [1.0, 0.0], [0.0; 2], &bends, &mut leans);
        leans[chain.coefficients.segments as usize - 1]
    }

    /// The tilt from foot to tip of the billboard of a cell; where none grows of one in the cell's middle, in the wind.
    fn sheet_tilt(&self, index: usize, springs: &SpringsModel, patch: PatchKey, cell: u32) -> [f32; 2] {
        let (stand, state, co) = (&self.model.stands[index], &self.state.stands[index], &springs.coefficients);
        let wind = self.wind(stand);
        let target = |root| target_of(springs, root, &wind, &wind.patch_phases(patch, stand.cells / continuum::NODE_CELLS));
        let whole = [0, co.sides().1 - 1];
        let grown = self.grown(index, patch);
        let Some(root) = root_of(&self.model.terrain, stand, springs, grown.as_deref(), patch, cell) else {
            let middle = [cell % stand.cells, cell / stand.cells].map(|at| (at as f32 + 0.5) * stand.placement.spacing);
            let plant = Plant { root: middle, height: stand.species.height[1], yaw: 0.0, tint: 0.0, lean: stand.placement.lean };
            return target(&springs.root(&plant, 0.0, [0.0; 2])).tilt(co, whole);
        };
        let stored = state.awake.get(&patch).and_then(|awake| pool::stored(co, &state.cells, awake.slot, cell));
        stored.map_or(target(&root), |stored| pool::load(co, &root, stored).shown(co, &root, &target(&root))).tilt(co, whole)
    }

    /// How far the plant of a cell leans that swings by itself \[rad, ground vector\]; in the wind of the cell's middle where none grows. `None` for an
    /// unknown stand or cell, and for one that moves otherwise.
    pub fn bend_of_plant(&self, stand: usize, patch: PatchKey, cell: [u32; 2]) -> Option<[f32; 2]> {
        let (model, state) = (self.model.stands.get(stand)?, self.state.stands.get(stand)?);
        let oscillator = model.oscillator.as_ref().filter(|_| cell.iter().all(|along| *along < model.cells))?;
        Some(self.swing(model, oscillator, state, patch, cell))
    }

    /// How far the plant of a cell leans that swings by itself; in the wind of the cell's middle where none grows.
    fn swing(&self, stand: &StandModel, oscillator: &OscillatorModel, state: &StandState, patch: PatchKey, cell: [u32; 2]) -> [f32; 2] {
        let (co, wind, cells) = (&oscillator.coefficients, self.wind(stand), &state.cells);
        let phases = wind.patch_phases(patch, stand.cells / continuum::NODE_CELLS);
        let (around, weights) = (around(state, patch, |awake| awake.slot), weights(state, patch));
        let air = Air { co, levels: &cells.old, around, weights, patch_side: stand.patch_side as f32 };
        let middle = cell.map(|at| (at as f32 + 0.5) * stand.placement.spacing);
        let plant = placement::plant(&stand.placement, patch, cell);
        let root = plant.map_or(middle, |plant| plant.root);
        let [x, z] = air.at(root, 0.0, || wind.velocity_local(&phases, root));
        let index = cell[1] * stand.cells + cell[0];
        let slot = state.awake.get(&patch).map(|awake| awake.slot as usize);
        let found = slot.and_then(|slot| cells.now.get(slot).zip(cells.ground.get(slot))).zip(plant);
        let [dx, dz] = found.map_or([0.0; 2], |((planes, ground), plant)| {
            let grown = ground.grown.get(index as usize).map_or(Some(plant), |growth| placement::grown(plant, Growing::of_share(*growth)));
            let height = grown.map_or(0.0, |plant| plant.height);
            let own = Own::of(co, placement::variety(&stand.placement, patch, index), height);
            Record::load(planes, planes.len() / 4, index as usize).at(co, &own, self.state.step as u32, 0.0)
        });
        oscillator::limited([x + dx, z + dz])
    }
}
