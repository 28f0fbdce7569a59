//! Contact of one patch: which cells bodies reach, and what becomes of them.
//!
//! Chen & Johan 2010, §5.1; methods §1.1. Reads footprints, ground, β. Writes β and ω of held cells. The GPU host is `contact_pass` in
//! `step.wgsl` of `sward_wgpu`.

use super::bend::{self, Push, Touch};
use super::coefficients::Coefficients;
use super::resistance::{HeldCell, Resistance};
use super::rest::Rest;
use crate::interaction::reaction::Sums;
use crate::interaction::{ABREAST, Contact, ContactEdge, Hit, contacts_of_row};
use crate::plan::ContactPair;
use crate::state::Ground;

/// What reaches one patch.
pub struct PatchContacts<'a> {
    /// The patch's own footprints: which, and the cell of their corner.
    pub pairs: &'a [ContactPair],
    /// All footprints of the step.
    pub contacts: &'a [Contact],
    /// Their edges.
    pub edges: &'a [ContactEdge],
    /// How plants resist them.
    pub resistance: Resistance,
}

/// Working space of one thread for contact.
#[derive(Default)]
pub struct Touched {
    hits: Vec<Hit>,
    /// Of which of the patch's footprints each hit is.
    whose: Vec<u32>,
    /// Cells and the numbers of their hits: see [`keyed`].
    order: Vec<u64>,
    /// β and ω where each hit is.
    cells: Vec<[f32; 4]>,
    /// What each hit does.
    pushes: Vec<Push>,
    /// Held cells, and the first hit of each in `order`.
    held: Vec<(u32, u32)>,
    /// What touches them.
    touches: Vec<Touch>,
    /// Some of them side by side, as bodies feel them, and of which of the patch's footprints.
    resisting: Vec<HeldCell>,
    numbers: Vec<usize>,
    /// What bodies feel, one for each of the patch's footprints.
    pub felt: Vec<Sums>,
}

/// Cells first, hits of a cell in body order: in one word, which is sorted faster than two.
#[inline(always)]
fn keyed(cell: u32, hit: u32) -> u64 {
    u64::from(cell) << 32 | u64::from(hit)
}

#[inline(always)]
fn cell_of(key: u64) -> u32 {
    (key >> 32) as u32
}

#[inline(always)]
fn hit_of(key: u64) -> usize {
    key as u32 as usize
}

/// Bends the cells under bodies; `now` is the patch as it is, `rest` where it would rest. Returns the cells held, in order, and leaves what bodies feel in
/// [`Touched::felt`]. Their past would be the same, and is not
/// written: the wave leaves them as they are, and nothing else reads it.
#[inline(always)]
pub fn touch_patch(
    co: &Coefficients,
    cells: usize,
    by: &PatchContacts,
    ground: &Ground,
    rest: &Rest,
    now: &mut [f32],
    touched: &mut Touched,
) -> Vec<u32> {
    let area = cells * cells;
    let Touched { hits, whose, order, cells: there, pushes, held, touches, resisting, numbers, felt } = touched;
    held.clear();
    felt.clear();
    felt.resize(by.pairs.len(), Sums::default());
    find_hits(co, cells, by, ground, order, (hits, whose));
    if !order.is_sorted() {
        order.sort_unstable();
    }
    // All are read first: one by one each would wait for memory. ω is read only for this.
    there.clear();
    let (x, z, rate_x, rate_z) = (&now[..area], &now[area..2 * area], &now[2 * area..3 * area], &now[3 * area..4 * area]);
    for key in &*order {
        let cell = cell_of(*key) as usize;
        there.push([x[cell], z[cell], rate_x[cell], rate_z[cell]]);
    }
    pushes.clear();
    for (order, there) in order.chunks(ABREAST).zip(there.chunks(ABREAST)) {
        let asked = order.iter().zip(there).map(|(key, before)| ([before[0], before[1]], &hits[hit_of(*key)]));
        pushes.extend(bend::pushes(co, asked));
    }
    touches.clear();
    let mut first = 0;
    for same in order.chunk_by(|a, b| cell_of(*a) == cell_of(*b)) {
        let (cell, before, pushes) = (cell_of(same[0]), there[first], &pushes[first..]);
        let hits = same.iter().map(|key| &hits[hit_of(*key)]).zip(pushes.iter().copied());
        if let Some(touch) = bend::touch([before[0], before[1]], ground.slope(cells, cell as usize), hits) {
            held.push((cell, first as u32));
            touches.push(touch);
        }
        first += same.len();
    }
    for (held, touches) in held.chunks(ABREAST).zip(touches.chunks(ABREAST)) {
        resisting.clear();
        numbers.clear();
        for ((cell, first), next) in held.iter().zip(bend::held(co, touches)) {
            let [i, j] = [*cell as usize % cells, *cell as usize / cells];
            let number = whose[hit_of(order[(*first + next.by) as usize])] as usize;
            let ContactPair { contact, corner } = by.pairs[number];
            let contact = &by.contacts[contact as usize];
            let middle = |at: usize, axis: usize| (at as i32 - corner[axis]) as f32 * contact.spacing + 0.5 * contact.spacing;
            let root =
                [middle(i, 0) - contact.centre[0], ground.height(cells, *cell as usize) - contact.end[2], middle(j, 1) - contact.centre[1]];
            let values = [next.bend[0], next.bend[1], next.rate[0], next.rate[1]];
            for (plane, value) in values.into_iter().enumerate() {
                now[plane * area + *cell as usize] = value;
            }
            numbers.push(number);
            resisting.push(HeldCell { before: there[*first as usize], held: next, rest: rest.at(i as i32, j as i32), root });
        }
        let words = by.resistance.felt(co, resisting, co.plant_height);
        numbers.iter().zip(words).for_each(|(number, words)| felt[*number].add_words(words));
    }
    held.iter().map(|(cell, _)| *cell).collect()
}

/// What bodies do to cells, body by body, and which hit is of which cell: only cells within a footprint's own bounds are looked at.
#[inline(always)]
fn find_hits(
    co: &Coefficients,
    cells: usize,
    by: &PatchContacts,
    ground: &Ground,
    order: &mut Vec<u64>,
    (hits, whose): (&mut Vec<Hit>, &mut Vec<u32>),
) {
    let side = cells as i32;
    let within = |low: i32, size: i32| low.clamp(0, side)..low.saturating_add(size).clamp(0, side);
    order.clear();
    hits.clear();
    whose.clear();
    for (number, ContactPair { contact, corner }) in by.pairs.iter().enumerate() {
        let contact = &by.contacts[*contact as usize];
        let edges = &by.edges[contact.edge_first as usize..][..contact.edge_count as usize];
        let columns = within(corner[0], contact.size[0]);
        for j in within(corner[1], contact.size[1]) {
            let row = j as usize * cells;
            for i in columns.clone().step_by(ABREAST) {
                let count = if columns.end - i < ABREAST as i32 { (columns.end - i) as usize } else { ABREAST };
                let first = row + i as usize;
                let height = |k: usize| if k < count { ground.height(cells, first + k) } else { 0.0 };
                contacts_of_row(contact, edges, [i - corner[0], j - corner[1]], height, co.plant_height, |k, hit| {
                    if k < count {
                        order.push(keyed((first + k) as u32, hits.len() as u32));
                        hits.push(hit);
                        whose.push(number as u32);
                    }
                });
            }
        }
    }
}
