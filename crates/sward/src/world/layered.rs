//! Stands of meshes in a step: which plants are near, what brushes past them, what the wind does on their plane, and how they are cut.
//!
//! Chen & Johan 2015, §3.2 and §3.3; methods §5.

use std::collections::{BTreeMap, BTreeSet};

use glam::{DVec3, Vec3};

use super::{World, blown_patches};
use crate::geometry::layers::{Extent, Eye};
use crate::interaction::Piece;
use crate::interaction::reaction::Sums;
use crate::interaction::solid::WorldSolid;
use crate::math::clamped;
use crate::placement::{Growing, grown, plant};
use crate::plan::{Brush, LayeredPlan, Report, TouchPlan, Toucher};
use crate::response::harmonic::{LayeredStand, TOUCH_SIDE, Waves, air, drifted};
use crate::state::{Cuts, LayeredPlant, LayeredState, PatchKey, PlantKey, SheetPool, in_field};
use crate::view::View;
use crate::wind::WindField;

/// A view that has turned so many times as far as asked for is cut anew even while the cut before still fades.
const HURRY: f32 = 3.0;
/// Slower local winds than this are none, m/s.
const CALM: f32 = 0.05;

/// What reaches a plant: pieces of bodies, and a local wind.
#[derive(Default)]
struct Reached {
    solids: Vec<usize>,
    wind: [f32; 2],
}

impl World {
    /// A stand of meshes at rest in the wind of now.
    pub(super) fn empty_layered(&self, stand: &LayeredStand) -> LayeredState {
        let model = &stand.harmonic;
        let mut waves = Waves::new(model.cells as usize);
        let wind = self.plane_wind(stand);
        waves.now = air(model, &wind).into_iter().map(|air| air.map(|part| model.coefficients.gain * part)).collect();
        waves.old = waves.now.clone();
        LayeredState {
            notes: vec![waves.now.clone(); model.ring.notes as usize],
            waves,
            drift: WindField::before(&self.blowing(0.0), self.state.step, 0.0, self.model.dt, 1.0).mean,
            pool: SheetPool::new(self.scene.budget.touched_plants),
            ..LayeredState::default()
        }
    }

    /// The wind of the coming step on the plane of a stand.
    fn plane_wind(&self, stand: &LayeredStand) -> WindField {
        stand.harmonic.wind(self.state.step, self.model.dt, self.model.fluids.iter().zip(&self.state.fluids))
    }

    /// Plants of a patch.
    fn layered_plants(&self, stand: &LayeredStand, patch: PatchKey) -> Vec<LayeredPlant> {
        let corner = patch.map(|along| f64::from(along) * stand.patch_side);
        let stands = |at: [f64; 2]| [at[0], self.model.terrain.height_at(at[0], at[1]), at[1]];
        if !stand.places.is_empty() {
            let there = |at: [f64; 2]| at.map(|metres| (metres / stand.patch_side).floor() as i32) == patch;
            let places = stand.places.iter().enumerate().filter(|(_, place)| there(place.at));
            let [low, high] = stand.placement.height;
            let chance = |number: usize, purpose| crate::math::unit(crate::math::hash(stand.placement.seed, number as i32, 0, 0, purpose));
            let left = |at: [f64; 2]| {
                let cell = |axis: usize| (at[axis] - corner[axis]) / stand.patch_side * f64::from(stand.placement.cells);
                let index = cell(1) as usize * stand.placement.cells as usize + cell(0) as usize;
                stand.growth.tended.map(patch).and_then(|shares| shares.get(index)).map_or(1.0, |share| f32::from(*share) / 255.0)
            };
            let planted = places.map(|(number, place)| LayeredPlant {
                key: (patch, number as u32),
                root: stands(place.at),
                height: left(place.at) * place.height.unwrap_or(low + (high - low) * chance(number, 0)),
                yaw: place.yaw,
                tint: chance(number, 1),
            });
            return planted.filter(|plant| plant.height > 0.0).collect();
        }
        if !in_field(self.model.field, patch) {
            return Vec::new();
        }
        let cells = stand.placement.cells;
        let map = stand.growth.map(&stand.placement, &self.model.terrain, patch, stand.patch_side);
        let whole = Growing::of_share(255);
        let found = (0..cells * cells).filter_map(|cell| {
            let growing = map.as_deref().map_or(whole, |map| map[cell as usize]);
            let plant = grown(plant(&stand.placement, patch, [cell % cells, cell / cells])?, growing)?;
            let at = [corner[0] + f64::from(plant.root[0]), corner[1] + f64::from(plant.root[1])];
            Some(LayeredPlant { key: (patch, cell), root: stands(at), height: plant.height, yaw: plant.yaw, tint: plant.tint })
        });
        found.collect()
    }

    /// Finds the plants of patches that have come near a focus, and forgets those that are far now, or whose ground has changed.
    pub(super) fn follow_plants(&mut self, index: usize) {
        let side = self.model.patch_side;
        let reach = f64::from(self.model.layered[index].layers().distance);
        let mut wanted = BTreeSet::new();
        for focus in &self.state.focuses {
            let patch = |metres: f64| (metres / side).floor() as i32;
            for z in patch(focus[1] - reach)..=patch(focus[1] + reach) {
                for x in patch(focus[0] - reach)..=patch(focus[0] + reach) {
                    wanted.insert([x, z]);
                }
            }
        }
        let resampled = &self.state.resampled;
        self.state.layered[index].near.retain(|patch, _| wanted.contains(patch) && !resampled.contains(patch));
        for patch in wanted {
            if !self.state.layered[index].near.contains_key(&patch) {
                let plants = self.layered_plants(&self.model.layered[index], patch);
                self.state.layered[index].near.insert(patch, plants);
            }
        }
    }

    /// The bodies as solids, for stands of meshes.
    pub(super) fn brushing(&self, moving: &[Vec<[Piece; 2]>]) -> Vec<WorldSolid> {
        let mut solids = Vec::new();
        for (index, (body, state)) in self.model.bodies.iter().zip(&self.state.bodies).enumerate() {
            let (Some(before), Some(now)) = (&state.before, &state.pose) else { continue };
            let pieces: Vec<&Piece> = match body.is_animated() {
                true => moving[index].iter().map(|[_, after]| after).collect(),
                false => body.pieces.iter().collect(),
            };
            solids.extend(WorldSolid::during(&pieces, before, now, index as u32));
        }
        solids
    }

    /// What one stand of meshes does in the coming step.
    pub(super) fn plan_layered(&mut self, index: usize, solids: &[WorldSolid]) -> LayeredPlan {
        self.follow_plants(index);
        let reached = self.reached(index, solids);
        let fresh = self.share_planes(index, &reached);
        let (stand, state) = (&self.model.layered[index], &self.state.layered[index]);
        let mut plan = LayeredPlan { wind: self.plane_wind(stand), touched: Vec::new(), brushes: Vec::new(), touchers: Vec::new() };
        let nothing = Reached::default();
        for (key, slot) in state.pool.taken() {
            let reached = reached.get(&key).unwrap_or(&nothing);
            let first = plan.brushes.len() as u32;
            let mut cell_mass = 0.0;
            if let Some(plant) = state.plant(key) {
                for solid in reached.solids.iter().map(|solid| &solids[*solid]) {
                    let pose = self.state.bodies[solid.body() as usize].pose.as_ref();
                    plan.brushes.push(self.brush(stand, plant, solid));
                    plan.touchers.push(Toucher::new(solid.body(), pose, solid.middle()));
                }
                cell_mass = stand.cell_mass(plant);
            }
            let brushes = first..plan.brushes.len() as u32;
            plan.touched.push(TouchPlan { slot, fresh: fresh.contains(&key), wind: reached.wind, brushes, cell_mass });
        }
        plan
    }

    /// What bodies felt of plants that are meshes: forces on their plane become those of the world.
    pub fn report_layered(&self, index: usize, touchers: &[Toucher], sums: Vec<Sums>) -> Report {
        let axes = &self.model.layered[index].harmonic.axes;
        let turned = touchers.iter().zip(sums).map(|(toucher, sums)| {
            let way = self.state.bodies.get(toucher.body as usize).map_or([0.0; 2], |body| body.way());
            let against = if way[0] * f64::from(axes.forward[0]) + way[1] * f64::from(axes.forward[2]) > 0.0 { -1.0 } else { 1.0 };
            let [right, up, through] = [0, 1, 2].map(|word: usize| sums.0[word] as f64);
            let mut world = Sums::default();
            for axis in 0..3 {
                let along = |way: &[f32; 3]| f64::from(way[axis]);
                let force = right * along(&axes.right) + up * along(&axes.up) + against * through * along(&axes.forward);
                world.0[axis] = force.round() as i64;
            }
            // A plant is one, however many of its cells a body holds.
            world.0[7] = i64::from(sums.0[7] > 0);
            (*toucher, world)
        });
        Report { summaries: Vec::new(), felt: turned.filter(|(_, sums)| *sums != Sums::default()).collect() }
    }

    /// What comes near which plants.
    fn reached(&self, index: usize, solids: &[WorldSolid]) -> BTreeMap<PlantKey, Reached> {
        let (stand, state) = (&self.model.layered[index], &self.state.layered[index]);
        let mut reached: BTreeMap<PlantKey, Reached> = BTreeMap::new();
        if stand.harmonic.touch > 0.0 {
            for (number, solid) in solids.iter().enumerate() {
                let [low, high] = solid.bounds();
                let wide = f64::from(stand.harmonic.deep);
                let patch = |metres: f64| (metres / stand.patch_side).floor() as i32;
                for (_, plants) in state.near.range([patch(low[0] - wide), i32::MIN]..=[patch(high[0] + wide), i32::MAX]) {
                    for plant in plants {
                        let extent = Extent::new(plant, stand.specimen.low, stand.specimen.high);
                        let (middle, half) = (extent.centre.to_array(), f64::from(extent.half.x.max(extent.half.z)));
                        let half = [half, f64::from(extent.half.y), half];
                        if (0..3).all(|axis| low[axis] <= middle[axis] + half[axis] && middle[axis] - half[axis] <= high[axis]) {
                            reached.entry(plant.key).or_default().solids.push(number);
                        }
                    }
                }
            }
        }
        // Footprints have a place, so the plane that repeats does not feel them.
        let node = stand.patch_side / 64.0;
        let wind = self.footprints_alone(64, node);
        for print in &wind.footprints {
            for patch in blown_patches(print, stand.patch_side) {
                for plant in state.near.get(&patch).into_iter().flatten() {
                    let local = [0, 1].map(|axis| (plant.root[2 * axis] - f64::from(patch[axis]) * stand.patch_side) as f32);
                    let air = wind.velocity_local(&wind.patch_phases(patch, 64), local);
                    if air[0] * air[0] + air[1] * air[1] > CALM * CALM {
                        // Once for all footprints.
                        reached.entry(plant.key).or_default().wind = [stand.harmonic.along(air), 0.0];
                    }
                }
            }
        }
        reached
    }

    /// Gives planes of their own to plants that are reached, and takes them back from those at rest.
    fn share_planes(&mut self, index: usize, reached: &BTreeMap<PlantKey, Reached>) -> BTreeSet<PlantKey> {
        let settle = self.model.layered[index].harmonic.settle;
        let focuses = self.state.focuses.clone();
        let state = &mut self.state.layered[index];
        let taken: Vec<(PlantKey, u32)> = state.pool.taken().collect();
        for (key, slot) in taken {
            let steps = &mut state.since[slot as usize];
            *steps = if reached.contains_key(&key) { 0 } else { steps.saturating_add(1) };
            if *steps >= settle || state.plant(key).is_none() {
                state.pool.release(key);
            }
        }
        let away = |key: &PlantKey| {
            let root = state.plant(*key).map_or([0.0; 3], |plant| plant.root);
            let off = |focus: &[f64; 2]| (root[0] - focus[0]) * (root[0] - focus[0]) + (root[2] - focus[1]) * (root[2] - focus[1]);
            focuses.iter().map(off).fold(f64::from(f32::MAX), |least, now| if now < least { now } else { least }).sqrt() as f32
        };
        let wanted: Vec<(PlantKey, f32)> = reached.keys().map(|key| (*key, away(key))).collect();
        let given = state.pool.request(&wanted, |slot| state.since.get(slot as usize).copied().unwrap_or(0));
        state.since.resize(state.pool.used() as usize, 0);
        given.iter().for_each(|(_, slot)| state.since[*slot as usize] = 0);
        given.into_iter().map(|(key, _)| key).collect()
    }

    /// A piece of a body on a plant's own plane.
    fn brush(&self, stand: &LayeredStand, plant: &LayeredPlant, solid: &WorldSolid) -> Brush {
        let model = &stand.harmonic;
        let [low, high] = solid.bounds();
        let from_root = [0, 1, 2].map(|axis| (0.5 * (low[axis] + high[axis]) - plant.root[axis]) as f32);
        let half = [0, 1, 2].map(|axis| (0.5 * (high[axis] - low[axis])) as f32);
        let state = &self.state.bodies[solid.body() as usize];
        let way = |axis: usize| match (&state.before, &state.pose) {
            (Some(before), Some(pose)) => ((pose.ground[axis] - before.ground[axis]) / self.model.dt) as f32,
            _ => 0.0,
        };
        let rises = match (&state.before, &state.pose) {
            (Some(before), Some(pose)) => ((pose.height - before.height) / self.model.dt) as f32,
            _ => 0.0,
        };
        let ground = [way(0), way(1)];
        let through = model.through(ground);
        let right = model.axes.right;
        let wide =
            (if right[0] < 0.0 { -right[0] } else { right[0] }) * half[0] + (if right[2] < 0.0 { -right[2] } else { right[2] }) * half[2];
        let cell = model.touch_cell;
        let most = f64::from(TOUCH_SIDE) as f32;
        Brush {
            at: [model.along([from_root[0], from_root[2]]) / cell, from_root[1] / cell],
            // No narrower than the cells can show.
            half: [clamped(1.3 * wide / cell + 0.5, 1.0, most), clamped(1.3 * half[1] / cell + 0.5, 1.0, most)],
            velocity: [model.along(ground), rises].map(|part| model.touch * clamped(part, -20.0, 20.0)),
            through: model.touch * clamped(if through < 0.0 { -through } else { through }, 0.0, 20.0),
            hold: Brush::hold(self.model.dt as f32),
        }
    }

    /// Wind of places alone.
    fn footprints_alone(&self, cells: u32, node: f64) -> WindField {
        let mut wind = WindField::before(&[], self.state.step, 0.0, self.model.dt, node);
        wind.images = self.model.images.clone();
        let intervals = cells * crate::response::continuum::NODE_CELLS;
        wind.footprints = self.model.blowers.iter().filter_map(|blower| self.blown(blower, intervals, node, 0.0)).collect();
        wind
    }

    /// The end of a step: the mean wind is followed, and plants in sight are cut where the view has turned.
    pub(super) fn end_layered(&mut self) {
        let camera = self.camera();
        for index in 0..self.model.layered.len() {
            let stand = &self.model.layered[index];
            let mean = WindField::before(&self.blowing(0.0), self.state.step, 0.0, self.model.dt, 1.0).mean;
            let (deep, dt) = (stand.harmonic.deep, self.model.dt as f32);
            let state = &mut self.state.layered[index];
            state.drift = drifted(state.drift, mean, deep, dt);
            self.cut_plants(index, &camera);
        }
    }

    /// Cuts plants that come in sight, and those around which the view has turned: nearest to need first, within the budget.
    pub(super) fn cut_plants(&mut self, index: usize, camera: &View) {
        let (stand, step) = (&self.model.layered[index], self.state.step);
        let layers = stand.layers();
        let eye = eye_of(camera);
        let fade = (f64::from(layers.fade) / self.model.dt) as u64;
        let state = &mut self.state.layered[index];
        let (mut seen, mut turned) = (Vec::new(), Vec::new());
        for plant in state.near.values().flatten() {
            let extent = Extent::new(plant, stand.specimen.low, stand.specimen.high);
            let near = (extent.centre - eye.at).length() - f64::from(extent.radius()) < f64::from(layers.distance);
            let sees = near && eye.sees(&extent);
            match state.cuts.get_mut(&plant.key) {
                None if sees => seen.push((plant.key, eye.cut(&extent, layers, step))),
                None => {}
                Some(cuts) => {
                    if cuts.before.is_some() && step.saturating_sub(cuts.now.step) >= fade {
                        cuts.before = None;
                    }
                    let by = eye.turned(&cuts.now, &extent) / layers.turn;
                    if !sees && (!near || by > 1.0) {
                        state.cuts.remove(&plant.key);
                    } else if by > 1.0 && (cuts.before.is_none() || by > HURRY) {
                        turned.push((by, plant.key, eye.cut(&extent, layers, step)));
                    }
                }
            }
        }
        let near = &state.near;
        state.cuts.retain(|(patch, _), _| near.contains_key(patch));
        turned.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        turned.truncate(self.scene.budget.cuts as usize);
        state.cut += (seen.len() + turned.len()) as u64;
        for (key, cut) in seen {
            state.cuts.insert(key, Cuts { now: cut, before: None });
        }
        for (_, key, cut) in turned {
            if let Some(cuts) = state.cuts.get_mut(&key) {
                *cuts = Cuts { now: cut, before: (fade > 0).then_some(cuts.now) };
            }
        }
    }
}

/// A camera as cutting knows it.
fn eye_of(view: &View) -> Eye {
    let (at, target) = (DVec3::from(view.eye), DVec3::from(view.target));
    let (sine, cosine) = crate::math::sin_cos_f64(0.5 * view.field_of_view);
    Eye { at, forward: (target - at).as_vec3().normalize_or(Vec3::Z), half: (sine / cosine) as f32 }
}
