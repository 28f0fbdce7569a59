//! Stands of meshes in a saved state.

use super::{FARTHEST, SavedError};
use crate::response::harmonic::{LayeredStand, TOUCH_SIDE};
use crate::state::{Cut, LayeredState, Waves};

/// Whether numbers of a plane could have come about.
fn plane(waves: &Waves, side: usize) -> bool {
    let near = |cells: &[[f32; 2]]| cells.len() == side * side && cells.iter().flatten().all(|part| (-FARTHEST..=FARTHEST).contains(part));
    waves.side() == side && near(&waves.now) && near(&waves.old)
}

fn cut(cut: &Cut, step: u64) -> bool {
    let near = cut.eye.iter().all(|metres| (-1e9..=1e9).contains(metres)) && cut.window.iter().all(|side| (-1e3..=1e3).contains(side));
    let [x, y, z] = cut.forward;
    let layers = (1..=8).contains(&cut.layers[0]) && cut.layers[1..].iter().all(|count| *count <= 4);
    near && layers && (0.9..1.1).contains(&(x * x + y * y + z * z)) && (0.0..=1e6).contains(&cut.pixels) && cut.step <= step
}

/// A stand of meshes as saved, if it could be.
pub(super) fn restored(stand: &LayeredStand, saved: LayeredState, most: u32, step: u64) -> Result<LayeredState, SavedError> {
    let model = &stand.harmonic;
    let side = model.cells as usize;
    let notes = saved.notes.len() == model.ring.notes as usize
        && saved
            .notes
            .iter()
            .all(|note| note.len() == side * side && note.iter().flatten().all(|part| (-FARTHEST..=FARTHEST).contains(part)));
    let touched = saved.pool.is_sound(most)
        && saved.since.len() == saved.pool.used() as usize
        && saved.pool.taken().all(|(_, place)| saved.touches.get(place as usize).is_some_and(|waves| plane(waves, TOUCH_SIDE as usize)))
        && saved.touches.iter().all(|waves| waves.side() == 0 || plane(waves, TOUCH_SIDE as usize));
    let cuts = saved.cuts.values().all(|cuts| cut(&cuts.now, step) && cuts.before.as_ref().is_none_or(|before| cut(before, step)));
    let drifts = saved.drift.iter().all(|part| (-FARTHEST..=FARTHEST).contains(part));
    if plane(&saved.waves, side) && notes && touched && cuts && drifts && saved.touches.len() <= most as usize {
        Ok(saved)
    } else {
        Err(SavedError::Damaged("its plants in layers are none"))
    }
}
