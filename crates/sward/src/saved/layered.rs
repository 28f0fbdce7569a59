//! Stands of meshes in a saved state.

use super::{FARTHEST, SavedError};
use crate::response::harmonic::LayeredStand;
use crate::state::{Cut, LayeredState, Waves};

/// Whether numbers of a plane could have come about.
fn near(cells: &[[f32; 2]]) -> bool {
    cells.iter().flatten().all(|part| (-FARTHEST..=FARTHEST).contains(part))
}

fn cut(cut: &Cut, step: u64) -> bool {
    let near = cut.eye.iter().all(|metres| (-1e9..=1e9).contains(metres)) && cut.window.iter().all(|side| (-1e3..=1e3).contains(side));
    let [x, y, z] = cut.forward;
    let layers = (1..=8).contains(&cut.layers[0]) && cut.layers[1..].iter().all(|count| *count <= 4);
    near && layers && (0.9..1.1).contains(&(x * x + y * y + z * z)) && (0.0..=1e6).contains(&cut.pixels) && cut.step <= step
}

/// A stand of meshes as saved, if it could be.
pub(super) fn restored(stand: &LayeredStand, saved: LayeredState, most: u32, step: u64) -> Result<LayeredState, SavedError> {
    let calm = |waves: &Waves| near(&waves.now) && near(&waves.old);
    let waves = calm(&saved.waves) && saved.touches.iter().all(calm) && saved.notes.iter().all(|note| near(note));
    let cuts = saved.cuts.values().all(|cuts| cut(&cuts.now, step) && cuts.before.as_ref().is_none_or(|before| cut(before, step)));
    let drifts = saved.drift.iter().all(|part| (-FARTHEST..=FARTHEST).contains(part));
    if stand.fits(&saved, most) && waves && cuts && drifts { Ok(saved) } else { Err(SavedError::Damaged("its plants in layers are none")) }
}
