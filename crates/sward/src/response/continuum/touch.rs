//! Contact of one patch: which cells bodies reach, and what becomes of them.
//!
//! Chen & Johan 2010, §5.1; methods §1.1. Reads footprints, ground, β. Writes β and ω of held cells. The GPU host is `contact_pass` in
//! `step.wgsl` of `sward_wgpu`.

use super::bend;
use super::coefficients::Coefficients;
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
}

/// Working space of one thread for contact.
#[derive(Default)]
pub struct Touched {
    hits: Vec<Hit>,
    /// (cell, number of its hit).
    order: Vec<(u32, u32)>,
    /// β and ω where each hit is.
    cells: Vec<[f32; 4]>,
    /// Held cells, β and ω.
    held: Vec<(u32, [f32; 4])>,
}

/// Bends the cells under bodies; `now` is the patch as it is. Returns the cells held, in order. Their past would be the same, and is not
/// written: the wave leaves them as they are, and nothing else reads it.
#[inline(always)]
pub fn touch_patch(
    co: &Coefficients,
    cells: usize,
    by: &PatchContacts,
    ground: &Ground,
    now: &mut [f32],
    touched: &mut Touched,
) -> Vec<u32> {
    let area = cells * cells;
    let Touched { hits, order, cells: there, held } = touched;
    find_hits(co, cells, by, ground, order, hits);
    // By cell; hits of a cell stay in body order.
    if !order.is_sorted() {
        order.sort_unstable();
    }
    // All are read, then all are worked out, then all written: one by one each would wait for memory. ω is read only for this.
    there.clear();
    there.extend(order.iter().map(|(cell, _)| [0, 1, 2, 3].map(|plane| now[plane * area + *cell as usize])));
    held.clear();
    let mut first = 0;
    for same in order.chunk_by(|a, b| a.0 == b.0) {
        let (cell, [x, z, ..]) = (same[0].0, there[first]);
        first += same.len();
        let slope = ground.slope(cells, cell as usize);
        if let Some(next) = bend::contact(co, [x, z], slope, same.iter().map(|(_, hit)| hits[*hit as usize])) {
            held.push((cell, [next.bend[0], next.bend[1], next.rate[0], next.rate[1]]));
        }
    }
    for (plane, now) in now.chunks_exact_mut(area).enumerate() {
        held.iter().for_each(|(cell, values)| now[*cell as usize] = values[plane]);
    }
    held.iter().map(|(cell, _)| *cell).collect()
}

/// What bodies do to cells, body by body, and which hit is of which cell: only cells within a footprint's own bounds are looked at.
#[inline(always)]
fn find_hits(co: &Coefficients, cells: usize, by: &PatchContacts, ground: &Ground, order: &mut Vec<(u32, u32)>, hits: &mut Vec<Hit>) {
    let side = cells as i32;
    let within = |low: i32, size: i32| low.clamp(0, side)..low.saturating_add(size).clamp(0, side);
    order.clear();
    hits.clear();
    for ContactPair { contact, corner } in by.pairs {
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
                        order.push(((first + k) as u32, hits.len() as u32));
                        hits.push(hit);
                    }
                });
            }
        }
    }
}
