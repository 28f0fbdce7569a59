//! A world's state as bytes: saved, loaded, and continued as if it had never stopped.
//!
//! `SWARDSTATE`, format version (u32), CRC-32 of the rest (u32), then the state in postcard's encoding; little-endian throughout.
//! Ground and free places are worked out again. On the CPU continuing gives the same bits; a GPU continues from the same bits.

mod layered;
mod planes;
mod whole;

use std::collections::BTreeSet;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::growth::{Growth, Tended};
use crate::response::springs::pool;
use crate::response::{StandModel, chain};
use crate::scene::{self, Response, Scene, Stand, WindSource};
use crate::state::{
    Among, Awake, BodyState, Counters, LayeredState, NONE, PatchKey, Reaction, Regrowth, Sheets, StandState, State, Summary, Tuning,
    WindState,
};
use crate::terrain::Edits;
use crate::wind::fluid::{FASTEST, FluidState};
use crate::world::World;
use planes::Words;
pub use whole::LoadError;

/// What [`World::save`] writes and [`World::restore`] reads.
pub const VERSION: u32 = 8;
const MAGIC: &[u8; 10] = b"SWARDSTATE";
/// Far beyond any bend \[rad\] or velocity \[rad/s\] that the limits leave, and small enough that a step stays finite.
const FARTHEST: f32 = 1e4;
const HEADER: usize = MAGIC.len() + 4 + 4;

/// Why a saved state cannot be continued.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SavedError {
    /// The bytes are something else.
    #[error("this is not a saved state: it does not begin with SWARDSTATE")]
    NotOne,
    /// Of another version of the format.
    #[error("this state has format version {0}, expected {VERSION}: save it again with this sward")]
    Version(u32),
    /// Cut off or changed.
    #[error("this saved state is damaged: {0}")]
    Damaged(&'static str),
    /// Of another scene.
    #[error("this state was saved from another scene: {what} {found} in it, {expected} in the scene")]
    OtherScene {
        /// What differs.
        what: &'static str,
        /// In the saved state.
        found: u64,
        /// In the scene.
        expected: u64,
    },
}

#[derive(Serialize, Deserialize)]
struct Saved<'a> {
    step: u64,
    bodies: Vec<BodyState>,
    reactions: Vec<Reaction>,
    among: Vec<((u32, u32), Among)>,
    focuses: Vec<[f64; 2]>,
    pinned: Vec<[f64; 2]>,
    pending_seconds: f64,
    dropped_steps: u64,
    vacant: BTreeSet<u32>,
    winds: Vec<WindState>,
    tunings: Vec<SavedTuning>,
    regrowing: Vec<Regrowth>,
    /// Of stands of grass, then of meshes.
    tended: Vec<Tended>,
    edits: Edits,
    edited_steps: u64,
    edited: Vec<PatchKey>,
    #[serde(borrow)]
    stands: Vec<SavedStand<'a>>,
    layered: Vec<LayeredState>,
    /// Flows of planes of air, now and a step before.
    fluids: Vec<[Vec<[f32; 2]>; 2]>,
}

/// A response is kept as scenes write it.
#[derive(Serialize, Deserialize)]
struct SavedTuning {
    stand: u32,
    from: String,
    begin: u64,
    steps: u64,
}

/// Planes are those of awake patches, in key order; the second and the fourth of those that have upper segments.
#[derive(Serialize, Deserialize)]
struct SavedStand<'a> {
    cells: u32,
    segments: u32,
    awake: Vec<(PatchKey, Awake)>,
    summaries: Vec<(u64, Vec<(PatchKey, Summary)>)>,
    counters: Counters,
    #[serde(borrow)]
    now: Vec<Words<'a>>,
    #[serde(borrow)]
    old: Vec<Words<'a>>,
    #[serde(borrow)]
    upper: Vec<Words<'a>>,
    #[serde(borrow)]
    history: Vec<Words<'a>>,
    #[serde(borrow)]
    virtual_states: Vec<Words<'a>>,
    sheets: Sheets,
    #[serde(borrow)]
    sheet_words: Words<'a>,
}

impl World {
    /// The state as bytes. Where a GPU steps, download its cells first.
    pub fn save(&self) -> Vec<u8> {
        self.save_after(Vec::new())
    }

    /// The same, after what is in `bytes` already.
    fn save_after(&self, mut bytes: Vec<u8>) -> Vec<u8> {
        let state = &self.state;
        let stands = state.stands.iter().zip(&self.model.stands).map(|(stand, model)| {
            // Places of sheets are those of the pool.
            let kept = if model.springs.is_none() { usize::MAX } else { 0 };
            let planes = |slots, pick| planes(stand, slots, kept, pick);
            SavedStand {
                cells: model.cells,
                segments: model.lag.segments,
                awake: stand.awake.iter().map(|(patch, awake)| (*patch, *awake)).collect(),
                summaries: stand.summaries.iter().cloned().collect(),
                counters: stand.counters,
                now: planes(&stand.cells.now, |awake| awake.slot),
                old: planes(&stand.cells.old, |awake| awake.slot),
                upper: planes(&stand.cells.lag, |awake| awake.lag),
                history: planes(&stand.cells.history, |awake| awake.lag),
                virtual_states: planes(&stand.cells.virtual_states, |awake| awake.slot),
                sheets: stand.sheets.clone(),
                sheet_words: Words::of_words(&stand.cells.sheets),
            }
        });
        let saved = Saved {
            step: state.step,
            bodies: state.bodies.clone(),
            reactions: state.reactions.clone(),
            among: state.among.iter().map(|(pair, among)| (*pair, *among)).collect(),
            focuses: state.focuses.clone(),
            pinned: state.pinned.clone(),
            pending_seconds: state.pending_seconds,
            dropped_steps: state.dropped_steps,
            vacant: state.vacant.clone(),
            winds: state.winds.clone(),
            tunings: state.tunings.iter().map(saved_tuning).collect(),
            regrowing: state.regrowing.clone(),
            tended: self.growths().map(|growth| growth.tended.clone()).collect(),
            edits: self.model.terrain.edits().clone(),
            edited_steps: state.edited_steps,
            edited: state.edited.union(&state.resampled).copied().collect(),
            stands: stands.collect(),
            layered: state.layered.clone(),
            fluids: state.fluids.iter().map(|fluid| [fluid.now.to_vec(), fluid.before.to_vec()]).collect(),
        };
        // A vector that grows as it is filled would be copied again and again.
        let planes = saved.stands.iter().flat_map(|stand| [&stand.now, &stand.old, &stand.upper, &stand.history, &stand.virtual_states]);
        bytes.reserve(HEADER + 4 * planes.flatten().map(Words::len).sum::<usize>() + (1 << 20));
        bytes.extend_from_slice(MAGIC);
        bytes.extend_from_slice(&VERSION.to_le_bytes());
        bytes.extend_from_slice(&[0; 4]);
        let payload = bytes.len();
        // Encoding plain data into memory cannot fail.
        let mut bytes = postcard::to_extend(&saved, bytes).unwrap_or_default();
        if let Some((before, payload)) = bytes.split_at_mut_checked(payload)
            && let Some(sum) = before.last_chunk_mut()
        {
            *sum = crc32fast::hash(payload).to_le_bytes();
        }
        bytes
    }

    /// Goes on from a saved state of the same scene; on an error the world is as it was.
    ///
    /// # Errors
    /// Something else than a saved state, another version, damage, or another scene.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), SavedError> {
        let rest = bytes.strip_prefix(MAGIC).ok_or(SavedError::NotOne)?;
        let (version, rest) = rest.split_first_chunk::<4>().ok_or(SavedError::Damaged("it ends too soon"))?;
        let version = u32::from_le_bytes(*version);
        if version != VERSION {
            return Err(SavedError::Version(version));
        }
        let (sum, payload) = rest.split_first_chunk::<4>().ok_or(SavedError::Damaged("it ends too soon"))?;
        if u32::from_le_bytes(*sum) != crc32fast::hash(payload) {
            return Err(SavedError::Damaged("its checksum is another"));
        }
        self.restore_payload(payload)
    }

    /// [`World::restore`] without header and checksum: for tests that feed it damage.
    #[doc(hidden)]
    pub fn restore_payload(&mut self, payload: &[u8]) -> Result<(), SavedError> {
        let saved: Saved = postcard::from_bytes(payload).map_err(|_| SavedError::Damaged("it cannot be decoded"))?;
        self.same_scene(&saved)?;
        // Nothing of this world is touched before all has proved sound.
        let (scene, model, state) = (self.scene.clone(), self.model.clone(), State::default());
        let texels = Arc::clone(&model.maps.texels);
        let mut next = Self { scene, model, state, lanes: self.lanes, viewed: self.viewed, texels, events: Default::default(), log: None };
        next.take_saved(saved)?;
        next.log = self.log.take();
        *self = next;
        Ok(())
    }

    /// Growth of stands of grass, then of meshes.
    fn growths(&self) -> impl Iterator<Item = &Growth> {
        self.model.stands.iter().map(|stand| &stand.growth).chain(self.model.layered.iter().map(|stand| &stand.growth))
    }

    /// Puts what was tended in place of what there is.
    fn take_tended(&mut self, saved: Vec<Tended>) -> Result<(), SavedError> {
        let grass = self.model.stands.iter_mut().map(|stand| (stand.cells, &mut stand.growth));
        let meshes = self.model.layered.iter_mut().map(|stand| (stand.placement.cells, &mut stand.growth));
        for ((cells, growth), tended) in grass.chain(meshes).zip(saved) {
            if !tended.fits(cells) {
                return Err(SavedError::Damaged("what grows in it is none"));
            }
            growth.tended = tended;
        }
        Ok(())
    }

    fn take_saved(&mut self, saved: Saved) -> Result<(), SavedError> {
        let tunings: Option<Vec<Tuning>> = saved.tunings.iter().map(|tuning| self.tuning_of(tuning)).collect();
        let levels = saved.winds.iter().flat_map(|wind| wind.levels).all(|level| (0.0..=1.0).contains(&level));
        let counted = saved.winds.iter().all(|wind| wind.begin <= saved.step && wind.steps < 1 << 40 && wind.number < 1 << 30);
        let growing = saved.regrowing.iter().all(|regrowth| {
            regrowth.at.iter().all(|metres| (-1e9..=1e9).contains(metres))
                && (0.5..=200.0).contains(&regrowth.radius)
                && regrowth.ticks < 1 << 40
        });
        let vacant = saved.vacant.last().is_none_or(|place| (*place as usize) < saved.bodies.len());
        let Some(tunings) = tunings.filter(|_| levels && counted && growing && vacant) else {
            return Err(SavedError::Damaged("a number in it is out of bounds"));
        };
        self.take_tended(saved.tended)?;
        self.state.winds = saved.winds.clone();
        self.state.step = saved.step;
        self.look_at_wind();
        self.state.tunings = tunings.clone();
        self.glide_to(saved.step);
        self.rested();
        let state = State {
            vacant: saved.vacant,
            winds: saved.winds,
            tunings,
            regrowing: saved.regrowing,
            step: saved.step,
            bodies: saved.bodies,
            reactions: saved.reactions,
            among: saved.among.into_iter().collect(),
            focuses: saved.focuses,
            pinned: saved.pinned,
            pending_seconds: saved.pending_seconds,
            dropped_steps: saved.dropped_steps,
            edited_steps: saved.edited_steps,
            edited: saved.edited.into_iter().collect(),
            resampled: Default::default(),
            stands: Vec::new(),
            layered: Vec::new(),
            fluids: restored_fluids(saved.fluids)?,
        };
        if !state_is_sound(&state) {
            return Err(SavedError::Damaged("a number in it is out of bounds"));
        }
        if !self.model.terrain.put_edits(saved.edits) {
            return Err(SavedError::Damaged("its ground is none"));
        }
        let stands = saved.stands.into_iter().enumerate();
        let restored: Result<Vec<_>, _> = stands.map(|(index, stand)| self.restore_stand(index, stand, saved.step)).collect();
        let layered = saved.layered.into_iter().zip(&self.model.layered);
        let layered: Result<Vec<_>, _> =
            layered.map(|(saved, stand)| layered::restored(stand, saved, self.scene.budget.touched_plants, state.step)).collect();
        self.state = State { stands: restored?, layered: layered?, ..state };
        self.find_plants();
        Ok(())
    }

    fn tuning_of(&self, saved: &SavedTuning) -> Option<Tuning> {
        let from: Response = scene::options().from_str(&saved.from).ok()?;
        let stand = usize::try_from(saved.stand).ok().filter(|stand| *stand < self.scene.stands.len())?;
        self.scene.check_stand(stand, &Stand { response: Some(from.clone()), ..self.scene.stands[stand].clone() }).ok()?;
        let tuning = Tuning { stand, from, begin: saved.begin, steps: saved.steps };
        (saved.steps < 1 << 40 && saved.begin < 1 << 53).then_some(tuning)
    }

    fn same_scene(&self, saved: &Saved) -> Result<(), SavedError> {
        let mut counts = vec![
            ("interactors", saved.bodies.len() as u64, self.state.bodies.len() as u64),
            ("stands", saved.stands.len() as u64, self.model.stands.len() as u64),
            ("stands of meshes", saved.layered.len() as u64, self.model.layered.len() as u64),
            ("fluids", saved.fluids.len() as u64, saved.fluids_there(&self.scene) as u64),
        ];
        for (stand, model) in saved.layered.iter().zip(&self.model.layered) {
            counts.push(("cells of a plane", stand.waves.now.len() as u64, u64::from(model.harmonic.cells * model.harmonic.cells)));
        }
        for (stand, model) in saved.stands.iter().zip(&self.model.stands) {
            counts.push(("cells a patch side", stand.cells.into(), model.cells.into()));
            counts.push(("segments", stand.segments.into(), model.lag.segments.into()));
        }
        for (flows, model) in saved.fluids.iter().zip(&self.model.fluids).filter(|_| saved.fluids.len() == self.model.fluids.len()) {
            let expected = (model.texels() / 2) as u64;
            counts.extend(flows.iter().map(|flow| ("cells of air", flow.len() as u64, expected)));
        }
        counts.push(("sources of wind", saved.winds.len() as u64, self.scene.wind.len() as u64));
        counts.push(("stands in what was tended", saved.tended.len() as u64, self.growths().count() as u64));
        match counts.into_iter().find(|(_, found, expected)| found != expected) {
            Some((what, found, expected)) => Err(SavedError::OtherScene { what, found, expected }),
            None => Ok(()),
        }
    }

    fn restore_stand(&self, index: usize, saved: SavedStand, step: u64) -> Result<StandState, SavedError> {
        let model = &self.model.stands[index];
        let mut stand = self.empty_stand(model);
        let (layout, area) = (model.layout(), (model.cells * model.cells) as usize);
        let mut planes = [&saved.now, &saved.old, &saved.upper, &saved.history, &saved.virtual_states].map(|planes| planes.iter());
        let [now, old, uppers, past, states] = &mut planes;
        let counters = saved.counters;
        let counts = [
            counters.woken,
            counters.slept,
            counters.released,
            counters.denied,
            counters.clamped,
            counters.patch_steps,
            counters.resampled,
        ];
        if counts.iter().any(|count| *count >= 1 << 62) {
            return Err(SavedError::Damaged("a number in it is out of bounds"));
        }
        for (patch, mut awake) in saved.awake {
            awake.rest = awake.rest.min(1 << 30);
            let taken = stand.free.remove(&awake.slot) && (awake.lag == NONE || stand.lag_free.remove(&awake.lag));
            if !taken || stand.awake.insert(patch, awake).is_some() {
                return Err(SavedError::Damaged("two patches share one place"));
            }
            fill(&mut stand.cells.now, awake.slot, [layout.now, layout.counts], now.next())?;
            fill(&mut stand.cells.old, awake.slot, [layout.old, 0], old.next())?;
            fill(&mut stand.cells.virtual_states, awake.slot, [layout.virtual_states, 0], states.next())?;
            let ground = &mut stand.cells.ground;
            ground.resize(ground.len().max(awake.slot as usize + 1), Default::default());
            ground[awake.slot as usize] = model.ground_of(&self.model.terrain, patch);
            if awake.lag != NONE {
                fill(&mut stand.cells.lag, awake.lag, [layout.lag, 0], uppers.next())?;
                fill(&mut stand.cells.history, awake.lag, [layout.history, 0], past.next())?;
                if let Some(chain) = &model.chain {
                    let roots = &mut stand.cells.roots;
                    roots.resize(roots.len().max(awake.lag as usize + 1), Box::default());
                    roots[awake.lag as usize] = chain::roots(&self.model.terrain, model, chain, patch);
                }
            }
        }
        if planes.iter().any(|planes| planes.len() > 0) {
            return Err(SavedError::Damaged("it holds more cells than patches"));
        }
        if !saved.summaries.iter().all(|(of, _)| *of < step || (*of == 0 && step == 0)) {
            return Err(SavedError::Damaged("it knows the future"));
        }
        (stand.sheets, stand.cells.sheets) = sheets(model, saved.sheets, saved.sheet_words.words().collect())?;
        if model.springs.is_some() {
            let patches: Vec<PatchKey> = stand.awake.keys().copied().collect();
            stand.lay_places(patches, area);
        }
        (stand.summaries, stand.counters) = (saved.summaries.into(), counters);
        Ok(stand)
    }
}

/// Planes of awake patches that have a place there, of the first `kept` places.
fn planes<'a>(stand: &'a StandState, slots: &'a [Box<[f32]>], kept: usize, place: fn(&Awake) -> u32) -> Vec<Words<'a>> {
    let used = stand.awake.values().map(place).filter(|slot| *slot != NONE);
    used.map(|slot| Words::of_numbers(slots.get(slot as usize).filter(|_| (slot as usize) < kept).map_or(&[], |plane| plane))).collect()
}

impl Saved<'_> {
    /// Planes of air that blow.
    fn fluids_there(&self, scene: &Scene) -> usize {
        let winds = scene.wind.iter().zip(&self.winds);
        winds.filter(|(source, state)| matches!(source, WindSource::Fluid(_)) && !state.vacant).count()
    }
}

fn saved_tuning(tuning: &Tuning) -> SavedTuning {
    let from = scene::text_of(&tuning.from);
    SavedTuning { stand: tuning.stand as u32, from, begin: tuning.begin, steps: tuning.steps }
}

/// Flows as saved, if they could be.
fn restored_fluids(saved: Vec<[Vec<[f32; 2]>; 2]>) -> Result<Vec<FluidState>, SavedError> {
    let near = |value: &f32| (-FASTEST..=FASTEST).contains(value);
    if !saved.iter().flatten().flatten().flatten().all(near) {
        return Err(SavedError::Damaged("its air is none"));
    }
    Ok(saved.into_iter().map(|[now, before]| FluidState { now: Arc::new(now), before: Arc::new(before) }).collect())
}

/// Sheets as saved, if they could be.
fn sheets(model: &StandModel, sheets: Sheets, words: Vec<u32>) -> Result<(Sheets, Vec<u32>), SavedError> {
    let damaged = Err(SavedError::Damaged("its sheets are none"));
    let Some(springs) = &model.springs else {
        let none = sheets.pool.is_empty() && words.is_empty();
        return if none { Ok((Sheets::default(), words)) } else { damaged };
    };
    let (each, used) = (pool::words(&springs.coefficients), sheets.pool.used() as usize);
    let whole = words.len().is_multiple_of(each) && (words.len() / each >= used || sheets.pool.is_empty());
    let (columns, rows) = springs.coefficients.sides();
    let points = 3 * columns * (rows - 1);
    // Metres from a patch's corner, and absolute heights.
    let near =
        words.chunks(each).flat_map(|sheet| &sheet[..points.min(sheet.len())]).all(|word| (-1e6..=1e6).contains(&f32::from_bits(*word)));
    let counted = sheets.pool.is_sound(springs.capacity) && sheets.since.len() == used;
    if whole && near && counted && words.len() / each <= springs.capacity as usize { Ok((sheets, words)) } else { damaged }
}

/// Puts the next `length` values into a slot, the last `free` of which may be anything; slots below it that nobody uses are zero.
fn fill(slots: &mut Vec<Box<[f32]>>, slot: u32, [length, free]: [usize; 2], plane: Option<&Words>) -> Result<(), SavedError> {
    let Some(plane) = plane.filter(|plane| plane.len() == length) else {
        return Err(SavedError::Damaged("cells are missing"));
    };
    let slot = slot as usize;
    while slots.len() <= slot {
        slots.push(vec![0.0; length].into_boxed_slice());
    }
    slots[slot].iter_mut().zip(plane.numbers()).for_each(|(place, value)| *place = value);
    let sound = slots[slot][..length - free].iter().fold(true, |sound, value| sound & (-FARTHEST..=FARTHEST).contains(value));
    if sound { Ok(()) } else { Err(SavedError::Damaged("a cell is out of bounds")) }
}

fn state_is_sound(state: &State) -> bool {
    let near = |value: &f64| (-1e9..=1e9).contains(value);
    let poses = state.bodies.iter().flat_map(|body| [body.pose, body.before]).flatten();
    let mut numbers: Vec<f64> =
        poses.flat_map(|pose| [pose.ground[0], pose.ground[1], pose.yaw, pose.height, pose.slope[0], pose.slope[1]]).collect();
    numbers.extend(state.bodies.iter().filter_map(|body| body.driven).flat_map(|(at, yaw, clearance)| [at[0], at[1], yaw, clearance]));
    numbers.extend(state.bodies.iter().flat_map(|body| body.clock));
    numbers.extend(state.focuses.iter().chain(&state.pinned).flatten());
    numbers.push(state.pending_seconds);
    let felt = state.reactions.iter().flat_map(|felt| felt.force.into_iter().chain(felt.torque).chain([felt.power]));
    numbers.extend(felt.map(|value| 1e-6 * value));
    numbers.extend(state.among.values().map(|among| 1e-6 * among.energy));
    // A step number below 2⁵³ is exact as a time.
    let counted = state.step < 1 << 53 && (state.step..=state.step + 1).contains(&state.edited_steps);
    numbers.iter().all(near) && state.pending_seconds >= 0.0 && counted
}
