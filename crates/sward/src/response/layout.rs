//! How the state of a stand is stored: a state fits every stand with the same layout. Loading a state asks for it, and changing a scene while it runs.

use super::chain;
use super::continuum;
use super::harmonic::{LayeredStand, TOUCH_SIDE};
use super::oscillator;
use super::springs::pool;
use super::stand::StandModel;
use crate::state::{LayeredState, NONE, StandState, Waves};

/// How plants of a stand move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Method {
    /// Bending spreads as a wave.
    Continuum,
    /// Every plant swings by itself.
    Oscillator,
    /// Bodies deform billboards.
    Springs,
    /// Every blade of a patch has a state.
    Chain,
    /// Blades that bodies have touched have one.
    VirtualInertia,
}

/// How the cells of a stand are stored. Lengths are values of a slot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Layout {
    /// How its plants move.
    pub(crate) method: Method,
    /// Cells along a patch side.
    pub(crate) cells: u32,
    /// Segments that move.
    pub(crate) segments: u32,
    /// Of time level n; of deformed billboards none is kept, their places follow from the pool.
    pub(crate) now: usize,
    /// Of time level n−1.
    pub(crate) old: usize,
    /// Of upper segments, or of blades with a state.
    pub(crate) lag: usize,
    /// Of past β.
    pub(crate) history: usize,
    /// Of states of virtual blades.
    pub(crate) virtual_states: usize,
    /// So many of the last values of level n are any bits: they count steps.
    pub(crate) counts: usize,
    /// Words of a sheet, and most sheets.
    pub(crate) sheets: [usize; 2],
    /// Columns and rows of a sheet.
    pub(crate) sides: (usize, usize),
}

impl StandModel {
    /// How its cells are stored.
    pub(crate) fn layout(&self) -> Layout {
        let area = (self.cells * self.cells) as usize;
        let mut layout = Layout {
            method: Method::Continuum,
            cells: self.cells,
            segments: self.lag.segments,
            now: 0,
            old: 0,
            lag: 0,
            history: 0,
            virtual_states: 0,
            counts: 0,
            sheets: [0; 2],
            sides: (0, 0),
        };
        if let Some(springs) = &self.springs {
            layout.method = Method::Springs;
            layout.sheets = [pool::words(&springs.coefficients), springs.capacity as usize];
            layout.sides = springs.coefficients.sides();
        } else if let Some(chain) = &self.chain {
            layout.method = if chain.all { Method::Chain } else { Method::VirtualInertia };
            let [moments, states, blades] = chain::sizes(chain, self.cells);
            (layout.now, layout.old, layout.lag, layout.virtual_states) = (moments, moments, blades, states);
        } else if let Some(oscillator) = &self.oscillator {
            layout.method = Method::Oscillator;
            [layout.now, layout.old] = oscillator::sizes(oscillator, self.cells);
            layout.counts = area;
        } else {
            (layout.now, layout.old) = (4 * area, 4 * area);
            [layout.lag, layout.history] = continuum::lag_planes(&self.lag).map(|planes| planes * area);
        }
        layout
    }
}

impl Layout {
    /// Whether a state has the cells of all its awake patches. One whose cells only a GPU holds has not.
    pub(crate) fn is_whole(&self, state: &StandState) -> bool {
        let long = |slots: &[Box<[f32]>], slot: u32, length: usize| slots.get(slot as usize).map_or(0, |values| values.len()) == length;
        let cells = &state.cells;
        let sheets = self.method != Method::Springs || cells.sheets.len() >= self.sheets[0] * state.sheets.pool.used() as usize;
        sheets
            && state.awake.values().all(|awake| {
                let levels =
                    self.method == Method::Springs || long(&cells.now, awake.slot, self.now) && long(&cells.old, awake.slot, self.old);
                let lags = awake.lag == NONE || long(&cells.lag, awake.lag, self.lag) && long(&cells.history, awake.lag, self.history);
                levels && lags && (self.virtual_states == 0 || long(&cells.virtual_states, awake.slot, self.virtual_states))
            })
    }
}

/// Whether waves lie on a plane of `side` cells along each side.
fn lies_on(waves: &Waves, side: usize) -> bool {
    waves.side() == side && waves.now.len() == side * side && waves.old.len() == side * side
}

impl LayeredStand {
    /// Whether a state has the planes and notes of this stand, with at most `most` plants that are touched.
    pub(crate) fn fits(&self, state: &LayeredState, most: u32) -> bool {
        let (side, touched) = (self.harmonic.cells as usize, TOUCH_SIDE as usize);
        let notes = state.notes.len() == self.harmonic.ring.notes as usize && state.notes.iter().all(|note| note.len() == side * side);
        let known = |place: u32| state.touches.get(place as usize).is_some_and(|waves| lies_on(waves, touched));
        let touches = state.touches.len() <= most as usize
            && state.pool.is_sound(most)
            && state.since.len() == state.pool.used() as usize
            && state.pool.taken().all(|(_, place)| known(place))
            && state.touches.iter().all(|waves| waves.side() == 0 || lies_on(waves, touched));
        lies_on(&state.waves, side) && notes && touches
    }
}
