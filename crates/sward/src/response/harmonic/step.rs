//! A step of a stand of meshes on the CPU: the wind on the plane, its waves, its notes; and the planes of plants that are touched.
//!
//! Chen & Johan 2015, §3.3; methods §5. Reads: wind, bodies on the planes. Writes: state. Twin: `harmonic.wgsl`.

use super::stand::HarmonicModel;
use super::touch::{TOUCH_SIDE, step_touched};
use crate::interaction::reaction::Sums;
use crate::plan::LayeredPlan;
use crate::state::{LayeredState, Waves};
use crate::wind::WindField;

/// The wind on the plane \[m/s\], row by row.
pub fn air(model: &HarmonicModel, wind: &WindField) -> Vec<[f32; 2]> {
    let phases = wind.patch_phases([0, 0], model.cells);
    let n = model.cells as i32;
    (0..n * n).map(|cell| wind.velocity(&phases, [cell % n, cell / n])).collect()
}

/// One step; `step` is the number of steps done before it. Returns what each of the plan's brushes feels: N along the plane's right and up, and against its way
/// through the plane; as many plants as cells.
pub fn step_layered(model: &HarmonicModel, plan: &LayeredPlan, state: &mut LayeredState, step: u64) -> Vec<Sums> {
    let mut felt = vec![Sums::default(); plan.brushes.len()];
    let air = air(model, &plan.wind);
    state.waves.step(&model.coefficients, &air);
    let note = model.ring.present(step + 1) as usize;
    if let Some(note) = state.notes.get_mut(note) {
        note.clear();
        note.extend_from_slice(&state.waves.now);
    }
    for touched in &plan.touched {
        let slot = touched.slot as usize;
        if state.touches.len() <= slot {
            state.touches.resize_with(slot + 1, Waves::default);
        }
        if touched.fresh || state.touches[slot].side() == 0 {
            state.touches[slot] = Waves::new(TOUCH_SIDE as usize);
        }
        let range = touched.brushes.start as usize..touched.brushes.end as usize;
        let (brushes, felt) = (&plan.brushes[range.clone()], &mut felt[range]);
        let leaves = (touched.cell_mass, model.dt);
        step_touched(&mut state.touches[slot], &model.touch_coefficients, touched.wind, brushes, leaves, felt);
    }
    felt
}
