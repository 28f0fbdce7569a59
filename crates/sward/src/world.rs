//! The world: a scene, its compiled model and its state. One step is one page.

mod air;
mod asked;
mod bodies;
mod inputs;
mod kept;
mod layered;
mod reactions;
mod rescene;
mod sheets;

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::sync::Arc;

use crate::activation::{BAND, Circumstances, Sharing, activate, keep};
use crate::interaction::solid::{Solids, WorldSolid};
use crate::interaction::{Contact, Footprint, Pose};
use crate::lanes::Lanes;
use crate::model::{Assets, Model, StandModel, rebased};
use crate::plan::{ContactPair, PatchPlan, Plan, Report, SheetPlan, StandPlan, Toucher, around, patches_under, weights};
use crate::response::{Stage, chain, continuum, harmonic, oscillator, springs};
use crate::scene::{Beyond, Edit, Path, Scene, SceneError, Trail, Value};
use crate::state::{BodyState, Event, NONE, PatchKey, SheetPool, Sheets, StandState, State, TILE, WindState};
use crate::terrain::TerrainError;
use crate::view::View;
use crate::wind::fluid::FluidState;
pub use inputs::{Input, Log, LogError};
pub use kept::{Fate, Kept};
use sheets::Near;

/// Faster than this, m/s, a body has jumped: it sweeps nothing.
const JUMP: f64 = 150.0;
/// No camera is nearer to a blade, m.
const NEAREST: f64 = 1.0;
/// Farther from the origin patch, m, a body cannot be driven: cell numbers would run out.
const FARTHEST: f64 = 1e8;

/// A simulation on the CPU, or the planning half of one on a GPU.
///
/// ```
/// use sward::{model::NoAssets, scene::Scene, world::World};
/// let text = "(version: 1, stands: [(species: Meadow)], interactors: [(shape: Sphere(radius: 1), path: Circle(radius: 5, speed: 4))])";
/// let mut world = World::new(Scene::parse(text, "hello.ron")?, &NoAssets)?;
/// for _ in 0..60 { world.step(); }
/// assert!(world.bend_at(0, [5.0, 0.0]).is_some());
/// # Ok::<(), sward::scene::SceneError>(())
/// ```
#[derive(Clone, Debug)]
pub struct World {
    /// What the author wrote.
    pub scene: Scene,
    /// What a step reads.
    pub model: Model,
    /// What a step changes.
    pub state: State,
    /// Instructions the CPU kernels use; results do not depend on it.
    pub lanes: Lanes,
    /// A camera of the host's, which holds instead of the scene's. Not part of a saved state.
    pub viewed: Option<View>,
    /// What bodies look like from six sides, on the CPU: [`crate::model::BodyMaps::texels`] as of the last step.
    pub texels: Arc<Vec<[f32; 4]>>,
    /// What has happened that no host has asked for yet: see [`World::take_events`]. Not part of a saved state.
    pub(crate) events: VecDeque<Event>,
    /// What hosts have done to the world since [`World::record`]; `None` records nothing.
    pub log: Option<Log>,
}

impl World {
    /// Compiles a scene and puts everything at rest at time 0. All positions of a world are metres from the corner of the scene's
    /// origin patch: what the author wrote is rebased here, once, in f64.
    pub fn new(scene: Scene, assets: &dyn Assets) -> Result<Self, SceneError> {
        Self::compiled(rebased(scene), assets)
    }

    /// The same of a scene whose positions are counted from the origin patch already.
    pub(crate) fn compiled(scene: Scene, assets: &dyn Assets) -> Result<Self, SceneError> {
        let model = Model::compile(&scene, assets)?;
        let fluids = model.fluids.iter().map(|fluid| FluidState::still(fluid.model.side)).collect();
        let (bodies, winds) = (vec![BodyState::default(); scene.interactors.len()], WindState::all(&scene));
        let state = State { bodies, winds, fluids, ..State::default() };
        let texels = Arc::clone(&model.maps.texels);
        let mut world = Self { scene, model, state, lanes: Lanes::default(), viewed: None, texels, events: VecDeque::new(), log: None };
        world.apply_edits(f64::NEG_INFINITY, 0.0);
        world.state.stands = world.model.stands.iter().map(|stand| world.empty_stand(stand)).collect();
        for index in 0..world.state.bodies.len() {
            let pose = world.pose(index, 0.0);
            (world.state.bodies[index].pose, world.state.bodies[index].before) = (pose, pose);
        }
        world.state.layered = world.model.layered.iter().map(|stand| world.empty_layered(stand)).collect();
        world.look_around();
        Ok(world)
    }

    /// A stand that sleeps everywhere.
    pub(crate) fn empty_stand(&self, stand: &StandModel) -> StandState {
        let (slots, lag_slots) = (0..self.scene.budget.patches, 0..lag_capacity(&self.scene, stand));
        let pool = SheetPool::new(stand.springs.as_ref().map_or(0, |springs| springs.capacity));
        let sheets = Sheets { pool, since: Vec::new() };
        StandState { free: slots.collect(), lag_free: lag_slots.collect(), sheets, ..Default::default() }
    }

    /// Finds and cuts the plants of stands of meshes that the camera sees.
    fn look_around(&mut self) {
        let camera = self.camera();
        self.look_from(&camera);
        self.find_plants();
        (0..self.model.layered.len()).for_each(|index| self.cut_plants(index, &camera));
    }

    /// Finds the plants of stands of meshes near the focuses.
    pub(crate) fn find_plants(&mut self) {
        (0..self.model.layered.len()).for_each(|index| self.follow_plants(index));
    }

    /// What the coming step cares about.
    fn look_from(&mut self, camera: &View) {
        self.state.focuses = if self.state.pinned.is_empty() { vec![camera.focus()] } else { self.state.pinned.clone() };
    }

    /// Time of the state, s.
    pub fn time(&self) -> f64 {
        self.state.step as f64 * self.model.dt
    }

    /// The camera at the time of the state: the host's ([`World::viewed`]), or else the scene's.
    pub fn camera(&self) -> View {
        self.camera_before(0.0)
    }

    /// How many steps, 0 to 1, the moment to be shown lies before the state, for a caller of [`World::advance`]: what is on the screen
    /// then moves evenly at any rate of frames, one step late.
    pub fn behind(&self) -> f64 {
        (1.0 - self.state.pending_seconds / self.model.dt).clamp(0.0, 1.0)
    }

    /// The camera `behind` steps (0 to 1) before the state.
    pub fn camera_before(&self, behind: f64) -> View {
        self.viewed.unwrap_or_else(|| self.scene_camera(behind))
    }

    /// The scene's own camera `behind` steps (0 to 1) before the state.
    fn scene_camera(&self, behind: f64) -> View {
        let scene = &self.scene;
        let followed = scene.camera.follow.as_ref().and_then(|name| scene.interactors.iter().position(|body| &body.name == name));
        let pose = followed.and_then(|body| self.pose_before(body, behind));
        View::of(scene, &self.model, pose, self.time() - behind * self.model.dt)
    }

    /// Where a body is at the end of the step being planned.
    fn pose_of(&self, body: u32) -> Option<&Pose> {
        self.state.bodies.get(body as usize).and_then(|state| state.pose.as_ref().or(state.before.as_ref()))
    }

    /// Where a body is `behind` steps (0 to 1) before the state; `None` while it is away.
    pub fn pose_before(&self, body: usize, behind: f64) -> Option<Pose> {
        let state = self.state.bodies.get(body)?;
        let (before, pose) = (state.before?, state.pose?);
        Some(if behind > 0.0 { pose.towards(&before, behind) } else { pose })
    }

    /// One fixed step on the CPU.
    pub fn step(&mut self) {
        let plan = self.plan();
        let reports = self.respond(&plan);
        self.finish(reports);
    }

    /// Runs the whole steps that `seconds` of wall time hold, at most `budget.catch_up`; drops and counts the rest. Returns the steps run.
    pub fn advance(&mut self, seconds: f64) -> u32 {
        let steps = self.take_steps(seconds);
        (0..steps).for_each(|_| self.step());
        steps
    }

    /// The accumulator of [`World::advance`] for a backend that steps elsewhere.
    pub fn take_steps(&mut self, seconds: f64) -> u32 {
        let pending = self.state.pending_seconds + if seconds.is_finite() { seconds.max(0.0) } else { 0.0 };
        let whole = (pending / self.model.dt + 1e-9).floor().max(0.0);
        // After absurdly long times the remainder is nothing but rounding.
        let rest = pending - whole * self.model.dt;
        self.state.pending_seconds = if (0.0..self.model.dt).contains(&rest) { rest } else { 0.0 };
        let steps = whole.min(f64::from(self.scene.budget.catch_up));
        self.state.dropped_steps = self.state.dropped_steps.saturating_add((whole - steps) as u64);
        steps as u32
    }

    /// Ground → bodies → wind → activation: everything about the coming step that is decided before a cell moves.
    pub fn plan(&mut self) -> Plan {
        self.note_view();
        self.edit_ground();
        self.fade_winds();
        let retuned = self.glide();
        let moving = self.move_bodies();
        let camera = self.camera();
        self.look_from(&camera);
        let mut stands = Vec::new();
        for index in 0..self.model.stands.len() {
            let footprints = self.footprints(&self.model.stands[index], &moving);
            let solids = self.solids(&self.model.stands[index], &moving);
            let near = self.near_sheets(index, &solids);
            self.activate(index, &footprints, &solids, &near, &camera);
            let given = self.share_sheets(index, &near);
            let mut plan = self.plan_stand(index, &footprints, &solids);
            self.plan_sheets(index, &solids, &near, &given, &mut plan);
            plan.rebase = retuned.contains(&index);
            stands.push(plan);
        }
        let maps = self.moving_maps(&stands);
        let brushing = if self.model.layered.is_empty() { Vec::new() } else { self.brushing(&moving) };
        let layered = (0..self.model.layered.len()).map(|index| self.plan_layered(index, &brushing)).collect();
        Plan { step: self.state.step, stands, layered, maps, fluids: self.plan_fluids() }
    }

    /// The response of every stand on the CPU, between [`World::plan`] and [`World::finish`].
    pub fn respond(&mut self, plan: &Plan) -> Vec<Report> {
        self.respond_in_stages(plan, &mut |_| ())
    }

    /// As [`World::respond`]; `ended` hears of each stage that has just ended, for callers with a clock.
    pub fn respond_in_stages(&mut self, plan: &Plan, ended: &mut dyn FnMut(Stage)) -> Vec<Report> {
        self.draw_maps(&plan.maps);
        let (texels, mut reports) = (Arc::clone(&self.texels), Vec::new());
        for ((stand, plan_of), state) in self.model.stands.iter().zip(&plan.stands).zip(&mut self.state.stands) {
            let (terrain, cells) = (&self.model.terrain, &mut state.cells);
            let (summaries, sums) = if let Some(chain) = &stand.chain {
                chain::step_stand(terrain, stand, chain, plan_of, cells, self.model.dt as f32, ended)
            } else if let Some(springs) = &stand.springs {
                springs::step_stand(terrain, stand, springs, plan_of, &texels, cells, ended)
            } else if let Some(oscillator) = &stand.oscillator {
                oscillator::step_stand(terrain, stand, oscillator, plan_of, cells, plan.step, ended)
            } else {
                let found = continuum::step(terrain, stand, plan_of, cells, self.lanes, ended);
                continuum::lags(stand, plan_of, cells, plan.step, self.lanes);
                ended(Stage::Lags);
                found
            };
            reports.push(Report::new(summaries, &plan_of.touchers, sums));
        }
        for (index, plan_of) in plan.layered.iter().enumerate() {
            let sums = harmonic::step_layered(&self.model.layered[index].harmonic, plan_of, &mut self.state.layered[index], plan.step);
            reports.push(self.report_layered(index, &plan_of.touchers, sums));
            ended(Stage::Layers);
        }
        self.flow(&plan.fluids, ended);
        reports
    }

    /// Ends a step and files what each stand reported: those of grass, then those of meshes.
    pub fn finish(&mut self, reports: Vec<Report>) {
        let step = self.state.step;
        self.file(step, reports);
        self.end_step();
    }

    /// Files the reports of step number `step`: what activation reads two steps later, and what bodies feel. A backend that learns them late may file them up to
    /// [`crate::activation::LATENCY`] steps after; steps in order.
    pub fn file(&mut self, step: u64, reports: Vec<Report>) {
        self.feel(step, &reports);
        for (stand, report) in self.state.stands.iter_mut().zip(reports) {
            stand.summaries.push_back((step, report.summaries));
        }
    }

    /// Counts a step as done, for a backend that files its summaries itself.
    pub fn end_step(&mut self) {
        for stand in &mut self.state.stands {
            stand.counters.patch_steps += stand.awake.len() as u64;
            stand.counters.resampled += self.state.resampled.iter().filter(|patch| stand.awake.contains_key(*patch)).count() as u64;
        }
        self.state.resampled.clear();
        self.rested();
        self.state.step += 1;
        self.end_layered();
    }

    /// What has just changed of stands whose plants swing by themselves is known now.
    pub(crate) fn rested(&mut self) {
        for oscillator in self.model.stands.iter_mut().filter_map(|stand| stand.oscillator.as_mut()) {
            (oscillator.former, oscillator.aired) = (None, false);
        }
    }

    /// Moves a body on a driven path: ground position \[m\], yaw \[rad\], clearance \[m\]. Takes effect in the next step. A body moved
    /// faster than 150 m/s jumps. Returns whether the body was moved: unknown and undriven bodies are left alone, and so are all at
    /// numbers beyond ±1e8.
    pub fn drive(&mut self, body: usize, ground: [f64; 2], yaw: f64, clearance: f64) -> bool {
        let near = ground.iter().chain([&yaw, &clearance]).all(|value| (-FARTHEST..=FARTHEST).contains(value));
        let driven = matches!(self.scene.interactors.get(body).map(|interactor| &interactor.path), Some(Path::Driven(_)));
        if driven
            && near
            && let Some(state) = self.state.bodies.get_mut(body)
        {
            state.driven = Some((ground, yaw, clearance));
            self.note(|| Input::Drive { body, at: ground, yaw, clearance });
        }
        driven && near
    }

    /// Changes the ground under a brush, or cuts, burns or lets grow again what grows there; the edit's `time` is not looked at. Pictures show it at
    /// once; bodies, awake patches and plants follow in the next step. It is part of the state, and saved with it. What the scene itself edits needs no
    /// such call.
    ///
    /// # Errors
    /// A number out of its range, or all edits together lie too far apart; then nothing has changed.
    pub fn edit(&mut self, edit: &Edit) -> Result<(), SceneError> {
        edit.check(&Trail::default())?;
        self.change_ground(edit).map_err(|error| SceneError::in_file("", error.to_string()))?;
        self.note(|| Input::Edit(edit.clone()));
        Ok(())
    }

    fn change_ground(&mut self, edit: &Edit) -> Result<(), TerrainError> {
        if !edit.change.is_of_ground() {
            self.tend(edit);
            return Ok(());
        }
        let [low, high] = self.model.terrain.edit(edit)?;
        let patch = |metres: f64| (metres / self.model.patch_side).floor() as i32;
        for z in patch(low[1])..=patch(high[1]) {
            for x in patch(low[0])..=patch(high[0]) {
                self.state.edited.insert([x, z]);
            }
        }
        Ok(())
    }

    /// The scene's edits of the coming step, once however often it is planned, and the patches that all edits since the last one touch.
    fn edit_ground(&mut self) {
        let next = self.state.step + 1;
        if self.state.edited_steps < next {
            self.regrow();
        }
        self.apply_edits(self.state.edited_steps as f64 * self.model.dt, next as f64 * self.model.dt);
        self.state.edited_steps = next;
        let edited = std::mem::take(&mut self.state.edited);
        self.state.resampled.extend(edited);
    }

    /// What the scene edits after `from` and up to `to` \[s\], earliest first.
    fn apply_edits(&mut self, from: f64, to: f64) {
        for edit in due(&self.scene, from, to) {
            // The model has made room for all of them.
            let _ = self.change_ground(&edit);
        }
    }

    /// A fingerprint of the state's cells: see [`State::hash`].
    pub fn hash(&self) -> u64 {
        self.state.hash()
    }

    /// Pixels of a metre, in a picture of 1080 rows, where a patch is nearest to a focus.
    fn pixels(&self, patch: PatchKey) -> f32 {
        let side = self.model.patch_side;
        let away = |focus: &[f64; 2]| {
            let outside = |axis: usize| {
                let low = f64::from(patch[axis]) * side;
                (low - focus[axis]).max(focus[axis] - low - side).max(0.0)
            };
            (outside(0) * outside(0) + outside(1) * outside(1)).sqrt()
        };
        let nearest = self.state.focuses.iter().map(away).fold(f64::MAX, f64::min);
        let (sine, cosine) = crate::math::sin_cos_f64(0.5 * f64::from(self.scene.camera.field_of_view));
        (540.0 * cosine / sine / nearest.max(NEAREST)) as f32
    }

    fn activate(&mut self, index: usize, footprints: &[Footprint], solids: &[WorldSolid], near: &Near, camera: &View) {
        let stand = &self.model.stands[index];
        let length = f64::from(stand.species.height[1]);
        let by_blade = solids.iter().filter(|_| stand.chain.is_some());
        let reached: BTreeSet<PatchKey> = by_blade.flat_map(|solid| patches_within(solid, length, self.model.patch_side)).collect();
        // What swings by itself does not push its neighbours.
        let margin = if stand.oscillator.is_some() { 0 } else { BAND as i64 + 1 };
        let side = i64::from(stand.cells);
        let mut touched: BTreeSet<PatchKey> = reached.iter().copied().chain(near.keys().map(|(patch, _)| *patch)).collect();
        for footprint in footprints.iter().filter(|footprint| reaches(&self.model, footprint, stand)) {
            for patch in patches_under(footprint, side, margin) {
                touched.insert(patch);
            }
        }
        if stand.feels_wind() {
            self.wind(stand).footprints.iter().for_each(|print| touched.extend(blown_patches(print, self.model.patch_side)));
        }
        let budget = &self.scene.budget;
        let by = Circumstances {
            step: self.state.step,
            touched: &touched,
            focuses: &self.state.focuses,
            in_view: &|patch| camera.sees(patch, self.model.patch_side),
            field: self.model.field,
            patch_side: self.model.patch_side,
            focus_distance: f64::from(budget.focus_distance),
            lag_distance: f64::from(budget.lag_distance),
            gusty: self.model.gusty && stand.feels_wind(),
            tiled: self.scene.budget.beyond == Beyond::Tiled,
            tolerance: stand.tolerance,
            rate: f64::from(self.model.rate),
            sharing: match &stand.chain {
                None => stand.settle().map_or(Sharing::Near, Sharing::Swinging),
                Some(chain) if chain.all => Sharing::All(&reached),
                Some(_) => Sharing::Reached(&reached),
            },
        };
        let stand = &mut self.state.stands[index];
        activate(stand, &by);
    }

    fn plan_stand(&self, index: usize, footprints: &[Footprint], solids: &[WorldSolid]) -> StandPlan {
        let (stand, state) = (&self.model.stands[index], &self.state.stands[index]);
        let side = i64::from(stand.cells);
        let wind = self.wind(stand);
        let mut plan = StandPlan {
            tile_wind: wind.snapped(stand.cells / continuum::NODE_CELLS),
            wind,
            patches: Vec::new(),
            contacts: Vec::new(),
            edges: Vec::new(),
            pairs: Vec::new(),
            solids: Solids::default(),
            touchers: Vec::new(),
            sheets: SheetPlan::default(),
            rebase: false,
        };
        let mut reached: BTreeMap<PatchKey, Vec<ContactPair>> = BTreeMap::new();
        for footprint in footprints {
            let contact = plan.contacts.len() as u32;
            plan.contacts.push(Contact { edge_first: plan.edges.len() as u32, ..footprint.contact });
            plan.edges.extend(&footprint.edges);
            let [x, z] = [0, 1].map(|axis| footprint.corner[axis] as f64 * stand.spacing + f64::from(footprint.contact.centre[axis]));
            let at = [x, f64::from(footprint.contact.end[2]), z];
            plan.touchers.push(Toucher::new(footprint.contact.body, self.pose_of(footprint.contact.body), at));
            for patch in patches_under(footprint, side, 0) {
                let corner = [0, 1].map(|axis| (footprint.corner[axis] - i64::from(patch[axis]) * side) as i32);
                reached.entry(patch).or_default().push(ContactPair { contact, corner });
            }
        }
        for (patch, awake) in &state.awake {
            let first = plan.pairs.len();
            plan.pairs.extend(reached.remove(patch).unwrap_or_default());
            let slot = |dx: i32, dz: i32| {
                // The tiled patch is its own neighbour on every side.
                let key = if *patch == TILE { TILE } else { [patch[0].wrapping_add(dx), patch[1].wrapping_add(dz)] };
                state.awake.get(&key).map_or(NONE, |awake| awake.slot)
            };
            let first_solid = plan.solids.heads.len();
            if awake.lag != NONE && stand.chain.is_some() {
                let corner = patch.map(|p| f64::from(p) * self.model.patch_side);
                let length = f64::from(stand.species.height[1]);
                let near = solids.iter().filter(|solid| patches_within(solid, length, self.model.patch_side).any(|key| key == *patch));
                for solid in near {
                    solid.add_to(&mut plan.solids, corner);
                    plan.touchers.push(Toucher::new(solid.body(), self.pose_of(solid.body()), solid.middle()));
                }
            }
            plan.patches.push(PatchPlan {
                around: around(state, *patch, |awake| awake.slot),
                weights: weights(state, *patch),
                solids: first_solid..plan.solids.heads.len(),
                pixels: self.pixels(*patch),
                handing: awake.handing,
                patch: *patch,
                slot: awake.slot,
                lag: awake.lag,
                neighbours: [slot(-1, 0), slot(1, 0), slot(0, -1), slot(0, 1)],
                keep: keep(awake),
                aired: stand.oscillator.as_ref().is_some_and(|oscillator| oscillator.aired),
                woken: awake.woken,
                edited: self.state.resampled.contains(patch),
                lag_woken: awake.lag_woken,
                pairs: first..plan.pairs.len(),
            });
        }
        plan
    }
}

/// What a scene edits after `from` and up to `to` \[s\], earliest first.
fn due(scene: &Scene, from: f64, to: f64) -> Vec<Edit> {
    let mut due: Vec<Edit> = scene.edits.iter().filter(|edit| edit.time > from && edit.time <= to).cloned().collect();
    due.sort_by(|a, b| a.time.total_cmp(&b.time));
    due
}

/// Patches that blades stand in which a solid can touch: those are `length` m long at most.
fn patches_within(solid: &WorldSolid, length: f64, patch_side: f64) -> impl Iterator<Item = PatchKey> + use<> {
    let [low, high] = solid.reach();
    let span = |axis: usize| {
        let patch = |metres: f64| (metres / patch_side).floor() as i32;
        patch(low[axis] - length)..=patch(high[axis] + length)
    };
    let (xs, zs) = (span(0), span(1));
    zs.flat_map(move |z| xs.clone().map(move |x| [x, z]))
}

/// Patches that a footprint reaches: those of its square.
fn blown_patches(print: &crate::wind::Footprint, patch_side: f64) -> impl Iterator<Item = PatchKey> + use<> {
    // Images turn within the circle round their square.
    let reach = f64::from(print.radius) * if print.kind == 2 { std::f64::consts::SQRT_2 } else { 1.0 };
    let span = |axis: usize| {
        let centre = f64::from(print.centre[axis]) * f64::from(print.part);
        let patch = |metres: f64| print.patch[axis].saturating_add((metres / patch_side).floor() as i32);
        patch(centre - reach)..=patch(centre + reach)
    };
    let (xs, zs) = (span(0), span(1));
    zs.flat_map(move |z| xs.clone().map(move |x| [x, z]))
}

/// Whether a body flies too high to touch anything: its underside against the ground below its centre, with room for slopes.
fn reaches(model: &Model, footprint: &Footprint, stand: &StandModel) -> bool {
    let contact = &footprint.contact;
    let centre = [0, 1].map(|axis| footprint.corner[axis] as f64 * stand.spacing + f64::from(contact.end[axis]));
    let ground = model.terrain.height_at(centre[0], centre[1]);
    let lowest = f64::from(contact.end[2].min(contact.start[2]) - contact.rise);
    let reach = 0.5 * stand.spacing * f64::from(contact.size[0].max(contact.size[1]));
    lowest - ground < stand.reach() + reach
}

/// Patches that can keep upper segments: as many as fit a disc of the lag distance and half a patch around one focus. Or that can keep
/// blades with a state: as many as the budget holds.
fn lag_capacity(scene: &Scene, stand: &StandModel) -> u32 {
    if let Some(chain) = &stand.chain {
        return (scene.budget.stateful_blades / chain.blades_of_patch(stand.cells).max(1)).min(scene.budget.patches);
    }
    if stand.lag.segments < 2 || stand.settle().is_some() {
        return 0;
    }
    let radius = f64::from(scene.budget.lag_distance / scene.field.patch_side) + 0.75;
    ((std::f64::consts::PI * radius * radius).ceil() as u32).min(scene.budget.patches)
}
