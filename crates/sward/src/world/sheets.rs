//! Deformed billboards of a step: which bodies come near which, who gets a sheet, and where the bodies' maps are.
//!
//! Orthmann et al. 2009, §5.1; methods §4: the coarse test, on the CPU for every backend. The tree has patches and, below them, blocks of
//! 8 × 8 cells. A billboard that nothing is near is not looked at.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use super::World;
use crate::interaction::distance_map::DistanceMapHead;
use crate::interaction::solid::WorldSolid;
use crate::math;
use crate::placement::Growing;
use crate::plan::{ActiveSheet, StandPlan, Toucher};
use crate::response::continuum::NODE_CELLS;
use crate::response::springs::{SpringsModel, moments, root_of, target_of};
use crate::state::{Billboard, PatchKey, in_field};
use crate::wind::WindField;

/// Billboards that bodies may touch, with their distance from the nearest focus, m.
pub(super) type Near = BTreeMap<Billboard, f32>;

/// What sharing out sheets has changed.
#[derive(Default)]
pub(super) struct Given {
    /// Who has just got one.
    fresh: BTreeSet<Billboard>,
    /// Patches whose places have changed.
    changed: BTreeSet<PatchKey>,
}

/// How much wider than they are boxes of bodies count, m.
const MARGIN: f64 = 0.01;
/// Cells along a node's side.
const NODE: u32 = 8;

/// The boxes around the pieces of one body in a step, and around all of them; m.
struct Boxes {
    body: u32,
    all: [[f64; 3]; 2],
    each: Vec<[[f64; 3]; 2]>,
}

fn boxes(solids: &[WorldSolid]) -> Vec<Boxes> {
    let mut found: Vec<Boxes> = Vec::new();
    for solid in solids {
        let own = solid.bounds();
        match found.last_mut().filter(|last| last.body == solid.body()) {
            Some(last) => {
                for axis in 0..3 {
                    last.all[0][axis] = if own[0][axis] < last.all[0][axis] { own[0][axis] } else { last.all[0][axis] };
                    last.all[1][axis] = if own[1][axis] > last.all[1][axis] { own[1][axis] } else { last.all[1][axis] };
                }
                last.each.push(own);
            }
            None => found.push(Boxes { body: solid.body(), all: own, each: vec![own] }),
        }
    }
    found
}

fn overlap(a: &[[f64; 3]; 2], b: &[[f64; 3]; 2], margin: f64) -> bool {
    (0..3).all(|axis| a[0][axis] <= b[1][axis] + margin && b[0][axis] <= a[1][axis] + margin)
}

impl World {
    /// Billboards of a stand that bodies may touch in the coming step: those whose pose in the wind, or whose own reach where they are deformed, comes
    /// into a box around a piece of a body.
    pub(super) fn near_sheets(&mut self, index: usize, solids: &[WorldSolid]) -> Near {
        let mut near = Near::new();
        let Some(model) = self.model.stands[index].springs.clone() else { return near };
        self.follow_growth(index);
        let stand = &self.model.stands[index];
        let reach = f64::from(stand.species.height[1]) + 0.5 * f64::from(model.width);
        let wind = self.wind(stand);
        let mut grown: BTreeMap<PatchKey, Option<Box<[Growing]>>> = BTreeMap::new();
        let all = boxes(solids);
        for boxes in &all {
            let cell = |axis: usize, way: f64| ((boxes.all[usize::from(way > 0.0)][2 * axis] + way) / stand.spacing).floor() as i64;
            for z in cell(1, -reach)..=cell(1, reach) {
                for x in cell(0, -reach)..=cell(0, reach) {
                    let side = i64::from(stand.cells);
                    let patch = [x.div_euclid(side) as i32, z.div_euclid(side) as i32];
                    let billboard = (patch, (z.rem_euclid(side) * side + x.rem_euclid(side)) as u32);
                    if near.contains_key(&billboard) || !in_field(self.model.field, patch) {
                        continue;
                    }
                    let grown = grown.entry(patch).or_insert_with(|| self.grown(index, patch)).as_deref();
                    if let Some(distance) = self.comes_near(index, (&model, &wind, grown), billboard, boxes) {
                        near.insert(billboard, distance);
                    }
                }
            }
        }
        near
    }

    /// The distance of a billboard from the nearest focus, m, if a body may touch it.
    fn comes_near(
        &self,
        index: usize,
        (model, wind, grown): (&SpringsModel, &WindField, Option<&[Growing]>),
        (patch, cell): Billboard,
        boxes: &Boxes,
    ) -> Option<f32> {
        let (stand, state) = (&self.model.stands[index], &self.state.stands[index]);
        let root = root_of(&self.model.terrain, stand, model, grown, patch, cell)?;
        let corner = patch.map(|along| f64::from(along) * self.model.patch_side);
        let place = |at: [f32; 3]| [f64::from(at[0]) + corner[0], f64::from(at[1]), f64::from(at[2]) + corner[1]];
        let foot = place(root.at);
        // Where air flows the pose in it is not known here: a GPU may hold it.
        let touches = if state.sheets.pool.place((patch, cell)).is_some() || !wind.fluids.is_empty() {
            let far = f64::from(root.length) + 0.5 * f64::from(model.width);
            let own = [foot.map(|part| part - far), foot.map(|part| part + far)];
            boxes.each.iter().any(|piece| overlap(piece, &own, MARGIN))
        } else {
            let sheet = target_of(model, &root, wind, &wind.patch_phases(patch, stand.cells / NODE_CELLS));
            let (columns, rows) = model.coefficients.sides();
            let mut own = [foot, foot];
            for at in sheet.at[..columns * rows].iter().map(|at| place(*at)) {
                for axis in 0..3 {
                    own[0][axis] = if at[axis] < own[0][axis] { at[axis] } else { own[0][axis] };
                    own[1][axis] = if at[axis] > own[1][axis] { at[axis] } else { own[1][axis] };
                }
            }
            boxes.each.iter().any(|piece| overlap(piece, &own, MARGIN))
        };
        let away = |focus: &[f64; 2]| {
            let (x, z) = (foot[0] - focus[0], foot[2] - focus[1]);
            (x * x + z * z).sqrt()
        };
        touches.then(|| {
            self.state.focuses.iter().map(away).fold(f64::from(f32::MAX), |least, now| if now < least { now } else { least }) as f32
        })
    }

    /// The growth map of a patch, known or worked out.
    pub(super) fn grown(&self, index: usize, patch: PatchKey) -> Option<Box<[Growing]>> {
        let (stand, known) = (&self.model.stands[index], &self.state.stands[index].cells.grown);
        if stand.growth.is_free() { None } else { known.get(&patch).cloned().or_else(|| stand.growth_map(&self.model.terrain, patch)) }
    }

    /// Forgets growth maps of patches that sleep or whose ground has changed, and works out those of awake ones.
    fn follow_growth(&mut self, index: usize) {
        let (stand, state) = (&self.model.stands[index], &mut self.state.stands[index]);
        if stand.growth.is_free() {
            return;
        }
        let resampled = &self.state.resampled;
        state.cells.grown.retain(|patch, _| state.awake.contains_key(patch) && !resampled.contains(patch));
        for patch in state.awake.keys() {
            if !state.cells.grown.contains_key(patch)
                && let Some(map) = stand.growth_map(&self.model.terrain, *patch)
            {
                state.cells.grown.insert(*patch, map);
            }
        }
    }

    /// Takes sheets back from billboards that have recovered or whose patch sleeps, and gives them to those that bodies come near. Returns who got one,
    /// and the patches whose places have changed.
    pub(super) fn share_sheets(&mut self, index: usize, near: &Near) -> Given {
        let Some(settle) = self.model.stands[index].springs.as_ref().map(|springs| springs.settle) else { return Given::default() };
        let area = (self.model.stands[index].cells * self.model.stands[index].cells) as usize;
        let state = &mut self.state.stands[index];
        let taken: Vec<(Billboard, u32)> = state.sheets.pool.taken().collect();
        let since = &mut state.sheets.since;
        let woken = state.awake.iter().filter(|(_, awake)| awake.woken).map(|(patch, _)| *patch);
        let mut changed: BTreeSet<PatchKey> = woken.collect();
        for (billboard, place) in taken {
            let steps = &mut since[place as usize];
            *steps = if near.contains_key(&billboard) { 0 } else { steps.saturating_add(1) };
            if *steps >= settle || !state.awake.contains_key(&billboard.0) {
                state.sheets.pool.release(billboard);
                changed.insert(billboard.0);
            }
        }
        let awake = near.iter().filter(|((patch, _), _)| state.awake.contains_key(patch));
        let contacts: Vec<(Billboard, f32)> = awake.map(|(billboard, distance)| (*billboard, *distance)).collect();
        let evicted = state.sheets.pool.evicted;
        let given = state.sheets.pool.request(&contacts, |place| since.get(place as usize).copied().unwrap_or(0));
        since.resize(state.sheets.pool.used() as usize, 0);
        given.iter().for_each(|(_, place)| since[*place as usize] = 0);
        let fresh: BTreeSet<Billboard> = given.into_iter().map(|(billboard, _)| billboard).collect();
        // Who made room for them lives in other patches.
        changed.extend(fresh.iter().map(|(patch, _)| *patch));
        if evicted != state.sheets.pool.evicted {
            changed.extend(state.awake.keys());
        }
        state.lay_places(changed.iter().copied(), area);
        Given { fresh, changed }
    }

    /// What the step does to deformed billboards.
    pub(super) fn plan_sheets(&self, index: usize, solids: &[WorldSolid], near: &Near, given: &Given, plan: &mut StandPlan) {
        let (stand, state) = (&self.model.stands[index], &self.state.stands[index]);
        let Some(model) = &stand.springs else { return };
        let all = boxes(solids);
        let mut nodes: [BTreeSet<(PatchKey, [u32; 2])>; 2] = Default::default();
        let mut taken = state.sheets.pool.taken().peekable();
        for (number, patch) in plan.patches.iter().enumerate() {
            let first = plan.sheets.heads.len() as u32;
            while taken.peek().is_some_and(|((of, _), _)| *of < patch.patch) {
                taken.next();
            }
            let mut heading = None;
            while let Some((billboard, place)) = taken.next_if(|((of, _), _)| *of == patch.patch) {
                let touched = near.contains_key(&billboard);
                let cell = [billboard.1 % stand.cells / NODE, billboard.1 / stand.cells / NODE];
                nodes[usize::from(!touched)].insert((billboard.0, cell));
                let heading = *heading.get_or_insert_with(|| self.add_heads(stand, model, &all, patch.patch, &mut plan.sheets.heads));
                let hurry = if patch.keep < 1.0 { model.settle.div_ceil((0.3 * f64::from(self.model.rate)) as u32) } else { 0 };
                let heads = if touched { first..plan.sheets.heads.len() as u32 } else { first..first };
                plan.sheets.active.push(ActiveSheet {
                    patch: number as u32,
                    cell: billboard.1,
                    place,
                    fresh: given.fresh.contains(&billboard),
                    hurry,
                    heads,
                    heading,
                });
            }
            let corner = patch.patch.map(|along| f64::from(along) * self.model.patch_side);
            plan.touchers.extend(plan.sheets.heads[first as usize..].iter().map(|head| {
                let [x, y, z, _] = head.centre.map(f64::from);
                Toucher::new(head.body, self.pose_of(head.body), [corner[0] + x, y, corner[1] + z])
            }));
        }
        let recovering = nodes[1].difference(&nodes[0]).count() as u32;
        plan.sheets.changed = given.changed.iter().copied().collect();
        plan.sheets.nodes = [nodes[0].len() as u32, recovering];
    }

    /// Adds the maps of bodies that reach a patch, at every moment of the step. Returns where columns under them fall.
    fn add_heads(
        &self,
        stand: &crate::model::StandModel,
        model: &SpringsModel,
        all: &[Boxes],
        patch: PatchKey,
        heads: &mut Vec<DistanceMapHead>,
    ) -> [f32; 2] {
        let (side, length) = (self.model.patch_side, f64::from(stand.species.height[1]));
        let corner = patch.map(|along| f64::from(along) * side);
        let far = length + f64::from(model.width);
        let reaches = |boxes: &&Boxes| {
            (0..2).all(|axis| boxes.all[0][2 * axis] - far < corner[axis] + side && boxes.all[1][2 * axis] + far > corner[axis])
        };
        let mut found = Vec::new();
        let (mut count, mut heading, mut fastest) = (1, [0.0, 1.0], -1.0);
        for boxes in all.iter().filter(reaches) {
            let body = boxes.body as usize;
            let (state, own) = (&self.state.bodies[body], &self.model.bodies[body]);
            let (Some(before), Some(now), Some((map, first))) = (state.before, state.pose, self.model.maps.place(body)) else { continue };
            let way = [now.ground[0] - before.ground[0], now.height - before.height, now.ground[1] - before.ground[1]];
            let long = (way[0] * way[0] + way[1] * way[1] + way[2] * way[2]).sqrt();
            let stride = own
                .figure
                .as_ref()
                .filter(|figure| figure.is_animated())
                .map_or(0.0, |figure| figure.stride(state.clock[0], state.clock[1]));
            count = count.max(moments(long as f32 + stride, length as f32));
            if long > fastest {
                fastest = long;
                let level = (way[0] * way[0] + way[2] * way[2]).sqrt();
                let (sine, cosine) = math::sin_cos_f64(now.yaw);
                heading = if level > 1e-6 { [(way[0] / level) as f32, (way[2] / level) as f32] } else { [sine as f32, cosine as f32] };
            }
            found.push((boxes.body, before, now, map, first));
        }
        for moment in 0..count {
            for (body, before, now, map, first) in &found {
                let pose = now.towards(before, f64::from(count - 1 - moment) / f64::from(count));
                heads.push(DistanceMapHead::posed(map, *first, (moment, *body), &pose, corner));
            }
        }
        heading
    }

    /// Bodies that play a clip and whose maps a step reads, with the seconds since each appeared.
    pub(super) fn moving_maps(&self, stands: &[StandPlan]) -> Vec<(u32, f64)> {
        let read: BTreeSet<u32> = stands.iter().flat_map(|plan| &plan.sheets.heads).map(|head| head.body).collect();
        let moving = read.into_iter().filter(|body| self.model.bodies[*body as usize].is_animated());
        moving.map(|body| (body, self.state.bodies[body as usize].clock[1])).collect()
    }

    /// Draws the maps of bodies anew that play a clip.
    pub(super) fn draw_maps(&mut self, maps: &[(u32, f64)]) {
        for (body, elapsed) in maps {
            let known = (&self.model.bodies[*body as usize].figure, self.model.maps.place(*body as usize));
            let (Some(figure), Some((map, first))) = known else { continue };
            let drawn = figure.distance_map(map.cube, map.size, *elapsed);
            let texels = Arc::make_mut(&mut self.texels);
            texels[first as usize..][..drawn.texels.len()].copy_from_slice(&drawn.texels);
        }
    }
}
