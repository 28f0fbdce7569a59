//! Which patches are awake.
//!
//! Chen & Johan 2010, §4.2; methods §1.6. A patch wakes where a swept footprint or a neighbour's disturbed border reaches it, or near a
//! focus when the wind varies; it sleeps after a second of rest. At the budget the patch farthest from every focus goes first.
//! Summaries are read [`LATENCY`] steps late on every backend, so that a GPU never has to be waited for and all backends agree.

use std::collections::BTreeSet;

use crate::state::{Awake, NONE, PatchKey, StandState, TILE, in_field};

/// Steps between a summary's step and the activation that reads it.
pub const LATENCY: usize = 2;
/// Width of the border bands of a [`crate::state::Summary`], cells: a wave crosses less than one cell a step.
pub const BAND: usize = 1 + LATENCY;
/// Time in which a released patch in view fades, s.
const FADE: f64 = 0.3;

/// What activation of one stand goes by in one step.
pub struct Circumstances<'a> {
    /// Steps done before this one.
    pub step: u64,
    /// Patches reached by swept footprints and their margin.
    pub touched: &'a BTreeSet<PatchKey>,
    /// Points the simulation cares about, m from the authored origin.
    pub focuses: &'a [[f64; 2]],
    /// Whether a patch may be seen by a camera.
    pub in_view: &'a dyn Fn(PatchKey) -> bool,
    /// First patch and one past the last in x and z, or `None` for an endless field.
    pub field: Option<[[i32; 2]; 2]>,
    /// Patch side, m.
    pub patch_side: f64,
    /// Patches whose centre is nearer to a focus wake if `gusty`, m.
    pub focus_distance: f64,
    /// Patches whose centre is nearer to a focus keep upper segments, m.
    pub lag_distance: f64,
    /// The wind changes with time.
    pub gusty: bool,
    /// Sleeping patches show the wind patch, tiled.
    pub tiled: bool,
    /// Deviation from rest that sleep allows, rad and rad/s.
    pub tolerance: f32,
    /// Steps per second.
    pub rate: f64,
    /// Who gets a lag slot.
    pub sharing: Sharing<'a>,
}

/// Who gets a lag slot.
#[derive(Clone, Copy, Debug)]
pub enum Sharing<'a> {
    /// Patches near a focus, for their upper segments.
    Near,
    /// Patches that bodies reach, for blades with a state; they keep it until all blades have been handed back.
    Reached(&'a BTreeSet<PatchKey>),
    /// Those, and the awake patches nearest to a focus.
    All(&'a BTreeSet<PatchKey>),
    /// Nobody; a patch that bodies touched stays awake for so many steps after.
    Swinging(u32),
}

impl Circumstances<'_> {
    /// Distance from the patch's centre to the nearest focus, m.
    fn distance(&self, patch: PatchKey) -> f64 {
        let centre = patch.map(|p| (f64::from(p) + 0.5) * self.patch_side);
        let squared = |f: &[f64; 2]| (f[0] - centre[0]) * (f[0] - centre[0]) + (f[1] - centre[1]) * (f[1] - centre[1]);
        self.focuses.iter().map(squared).fold(f64::MAX, f64::min).sqrt()
    }

    fn inside(&self, patch: PatchKey) -> bool {
        in_field(self.field, patch)
    }

    fn fade_steps(&self) -> u32 {
        // At least 30 steps a second, so at least 9.
        (FADE * self.rate).round() as u32
    }

    fn near_focus(&self) -> BTreeSet<PatchKey> {
        let mut near = BTreeSet::new();
        for focus in self.focuses {
            let reach = (self.focus_distance / self.patch_side).ceil() as i32 + 1;
            let home = focus.map(|f| (f / self.patch_side).floor() as i32);
            for z in -reach..=reach {
                for x in -reach..=reach {
                    let patch = [home[0].saturating_add(x), home[1].saturating_add(z)];
                    if self.distance(patch) < self.focus_distance {
                        near.insert(patch);
                    }
                }
            }
        }
        near
    }
}

/// Decides which patches are awake in this step.
pub fn activate(stand: &mut StandState, by: &Circumstances) {
    finish_fades(stand);
    let pushed = read_summary(stand, by);
    let focused = if by.gusty { by.near_focus() } else { BTreeSet::new() };
    put_to_sleep(stand, by, &focused);
    let mut wanted: BTreeSet<PatchKey> = pushed.union(by.touched).copied().collect();
    for patch in &wanted {
        if let Some(awake) = stand.awake.get_mut(patch) {
            (awake.fading, awake.wind_only) = (0, false);
            if by.touched.contains(patch) {
                awake.rest = 0;
            }
        }
    }
    wanted.extend(&focused);
    wake(stand, by, &wanted, &pushed);
    wake_tile(stand, by);
    match by.sharing {
        Sharing::Near => share_lag_slots(stand, by),
        Sharing::Reached(reached) => share_blade_slots(stand, by, reached, reached),
        Sharing::Swinging(settle) => count_swings(stand, by, settle),
        Sharing::All(reached) => {
            let awake = stand.awake.iter().filter(|(patch, awake)| **patch != TILE && awake.fading == 0).map(|(patch, _)| *patch);
            let wanted = awake.filter(|patch| by.distance(*patch) < by.focus_distance || reached.contains(patch)).collect();
            share_blade_slots(stand, by, reached, &wanted);
        }
    }
}

fn finish_fades(stand: &mut StandState) {
    let done: Vec<PatchKey> = stand.awake.iter().filter(|(_, awake)| awake.fading == 1).map(|(patch, _)| *patch).collect();
    for patch in done {
        release(stand, patch);
    }
    for awake in stand.awake.values_mut() {
        (awake.woken, awake.lag_woken) = (false, false);
        awake.fading = awake.fading.saturating_sub(1);
    }
}

fn release(stand: &mut StandState, patch: PatchKey) {
    if let Some(awake) = stand.awake.remove(&patch) {
        stand.free.insert(awake.slot);
        if awake.lag != NONE {
            stand.lag_free.insert(awake.lag);
        }
    }
}

/// Counts rest and returns the patches that a neighbour's border pushes awake.
fn read_summary(stand: &mut StandState, by: &Circumstances) -> BTreeSet<PatchKey> {
    let mut pushed = BTreeSet::new();
    if stand.summaries.front().is_none_or(|(step, _)| step + LATENCY as u64 > by.step) {
        return pushed;
    }
    let limit = by.tolerance * by.tolerance;
    for (patch, summary) in stand.summaries.pop_front().unwrap_or_default().1 {
        stand.counters.clamped += u64::from(summary.clamped);
        let Some(awake) = stand.awake.get_mut(&patch) else { continue };
        awake.held = summary.held;
        awake.rest = if is_over(summary.largest, limit) { 0 } else { awake.rest + 1 };
        if awake.fading > 0 || awake.wind_only || patch == TILE {
            continue;
        }
        for (border, [dx, dz]) in summary.borders.into_iter().zip([[-1, 0], [1, 0], [0, -1], [0, 1]]) {
            if is_over(border, limit) {
                pushed.insert([patch[0].saturating_add(dx), patch[1].saturating_add(dz)]);
            }
        }
    }
    pushed
}

/// A deviation that is not a number is not rest.
fn is_over(deviation: f32, limit: f32) -> bool {
    !matches!(deviation.partial_cmp(&limit), Some(std::cmp::Ordering::Less | std::cmp::Ordering::Equal))
}

fn put_to_sleep(stand: &mut StandState, by: &Circumstances, focused: &BTreeSet<PatchKey>) {
    let second = by.rate.ceil() as u32;
    let resting: Vec<PatchKey> = stand
        .awake
        .iter()
        .filter(|(patch, awake)| {
            **patch != TILE
                && awake.fading == 0
                && !focused.contains(*patch)
                && !by.touched.contains(*patch)
                && awake.touched == 0
                && (awake.rest >= second || awake.wind_only)
        })
        .map(|(patch, _)| *patch)
        .collect();
    for patch in focused {
        // Rested under the focus: only the wind moves it now, and wind does not wake neighbours.
        if let Some(awake) = stand.awake.get_mut(patch) {
            awake.wind_only |= awake.rest >= second && awake.touched == 0 && !by.touched.contains(patch);
        }
    }
    for patch in resting {
        stand.counters.slept += 1;
        // In gusts a patch at rest still differs from β_eq by what its inertia makes it trail.
        // So do blades with a state of their own from what virtual ones would have them do.
        let own = matches!(by.sharing, Sharing::All(_));
        if by.gusty || own { fade(stand, patch, by) } else { release(stand, patch) }
    }
}

fn fade(stand: &mut StandState, patch: PatchKey, by: &Circumstances) {
    if let Some(awake) = stand.awake.get_mut(&patch) {
        awake.fading = by.fade_steps();
    }
}

fn wake(stand: &mut StandState, by: &Circumstances, wanted: &BTreeSet<PatchKey>, pushed: &BTreeSet<PatchKey>) {
    let mut queue: Vec<(f64, PatchKey)> = wanted
        .iter()
        .filter(|patch| !stand.awake.contains_key(*patch) && by.inside(**patch))
        .map(|patch| (by.distance(*patch), *patch))
        .collect();
    queue.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    // Places of fading patches come free by themselves: who waits for one of them need not send another away.
    let mut coming = stand.awake.values().filter(|awake| awake.fading > 0).count();
    for (distance, patch) in queue {
        if stand.free.is_empty() && coming == 0 {
            make_room(stand, by, distance);
        } else if stand.free.is_empty() {
            coming -= 1;
        }
        let Some(slot) = stand.free.pop_first() else {
            stand.counters.denied += 1;
            continue;
        };
        let wind_only = !by.touched.contains(&patch) && !pushed.contains(&patch);
        let awake = Awake { slot, woken: true, wind_only, ..Awake::default() };
        stand.awake.insert(patch, awake);
        stand.counters.woken += 1;
    }
}

/// The wind patch stays awake for ever and counts against the budget like any other.
fn wake_tile(stand: &mut StandState, by: &Circumstances) {
    if by.tiled
        && by.gusty
        && !stand.awake.contains_key(&TILE)
        && let Some(slot) = stand.free.pop_first()
    {
        let awake = Awake { slot, woken: true, wind_only: true, ..Awake::default() };
        stand.awake.insert(TILE, awake);
    }
}

/// Releases the awake patch farthest from every focus if it is farther than `distance`; one in view fades first.
fn make_room(stand: &mut StandState, by: &Circumstances, distance: f64) {
    let candidates =
        stand.awake.iter().filter(|(patch, awake)| **patch != TILE && awake.fading == 0 && !awake.woken && !by.touched.contains(*patch));
    let farthest = candidates.map(|(patch, _)| (by.distance(*patch), *patch)).max_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let Some((away, patch)) = farthest else { return };
    if away <= distance {
        return;
    }
    stand.counters.released += 1;
    if (by.in_view)(patch) { fade(stand, patch, by) } else { release(stand, patch) }
}

/// Steps until the plants of each patch are at rest.
fn count_swings(stand: &mut StandState, by: &Circumstances, settle: u32) {
    for (patch, awake) in &mut stand.awake {
        awake.touched = if by.touched.contains(patch) { settle } else { awake.touched.saturating_sub(1) };
    }
}

fn share_lag_slots(stand: &mut StandState, by: &Circumstances) {
    let mut near: Vec<(f64, PatchKey)> =
        stand.awake.keys().filter(|patch| **patch != TILE).map(|patch| (by.distance(*patch), *patch)).collect();
    near.retain(|(distance, _)| *distance < by.lag_distance);
    near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let keep: BTreeSet<PatchKey> = near.iter().map(|(_, patch)| *patch).collect();
    for (patch, awake) in &mut stand.awake {
        if awake.lag != NONE && !keep.contains(patch) {
            stand.lag_free.insert(std::mem::replace(&mut awake.lag, NONE));
        }
    }
    for (_, patch) in near {
        let Some(awake) = stand.awake.get_mut(&patch) else { continue };
        if awake.lag == NONE
            && let Some(slot) = stand.lag_free.pop_first()
        {
            (awake.lag, awake.lag_woken) = (slot, true);
        }
    }
}

/// Room for blades with a state: for `wanted` patches, those nearest to a focus first, those that bodies reach now before all others.
fn share_blade_slots(stand: &mut StandState, by: &Circumstances, reached: &BTreeSet<PatchKey>, wanted: &BTreeSet<PatchKey>) {
    let mut queue: Vec<(bool, f64, PatchKey)> = (wanted.iter().filter(|patch| stand.awake.contains_key(*patch)))
        .map(|patch| (!reached.contains(patch), by.distance(*patch), *patch))
        .collect();
    queue.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
    let capacity = stand.lag_free.len() + stand.awake.values().filter(|awake| awake.lag != NONE).count();
    queue.truncate(capacity);
    let keep: BTreeSet<PatchKey> = queue.iter().map(|(_, _, patch)| *patch).collect();
    let mut done = Vec::new();
    for (patch, awake) in stand.awake.iter_mut().filter(|(_, awake)| awake.lag != NONE) {
        if reached.contains(patch) {
            (awake.held, awake.touched) = (u32::MAX, LATENCY as u32 + 1);
        }
        awake.touched = awake.touched.saturating_sub(1);
        awake.handing = !keep.contains(patch) && (awake.handing || matches!(by.sharing, Sharing::All(_)));
        // What was heard may be older than the last touch.
        if awake.held == 0 && awake.touched == 0 && !keep.contains(patch) {
            done.push(std::mem::replace(&mut awake.lag, NONE));
            awake.handing = false;
        }
    }
    stand.lag_free.extend(done);
    let mut waiting = 0;
    for (_, _, patch) in queue {
        let Some(awake) = stand.awake.get_mut(&patch).filter(|awake| awake.lag == NONE) else { continue };
        match stand.lag_free.pop_first() {
            Some(slot) => {
                (awake.lag, awake.lag_woken, awake.handing) = (slot, true, false);
                (awake.held, awake.touched) = (u32::MAX, LATENCY as u32 + 1);
            }
            None => waiting += 1,
        }
    }
    stand.counters.denied += waiting;
    hand_back(stand, by, &keep, waiting as usize);
}

/// As many patches as wait for room hand their blades back, settled or not: those farthest from every focus.
fn hand_back(stand: &mut StandState, by: &Circumstances, keep: &BTreeSet<PatchKey>, waiting: usize) {
    let holders = stand.awake.iter().filter(|(patch, awake)| awake.lag != NONE && !keep.contains(*patch));
    let mut holders: Vec<(f64, PatchKey)> = holders.map(|(patch, _)| (by.distance(*patch), *patch)).collect();
    holders.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    for (_, patch) in holders.into_iter().take(waiting) {
        if let Some(awake) = stand.awake.get_mut(&patch) {
            awake.handing = true;
        }
    }
}

/// The share of its deviation a fading patch keeps in this step: falls linearly over the fade.
pub fn keep(awake: &Awake) -> f32 {
    if awake.fading == 0 { 1.0 } else { (awake.fading as f32 - 1.0) / awake.fading as f32 }
}
