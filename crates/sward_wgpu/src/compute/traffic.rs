//! Bytes that the passes of a step must read and write at least, counted from what they do: each cell and each value once a pass,
//! as if caches were perfect. Lists of patches and summaries, 88 bytes a patch, are left out.

use sward::response::StandModel;

use super::buffers::CellBuffers;
use super::entries::Entries;

/// Bytes of each pass in one step; of the wave, in one substep.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Traffic {
    /// β_eq written at wind nodes.
    pub rest: u64,
    /// Both time levels written.
    pub wake: u64,
    /// β read, ground read, the held mask written; what bodies bend is written besides.
    pub contact: u64,
    /// Both time levels read, one written; β_eq at wind nodes and the held mask read. Slopes are read only where a cell bends beyond
    /// what the steepest one would allow.
    pub wave: u64,
    /// β read, upper segments read and written, the ring of `history` besides.
    pub lag: u64,
}

impl Traffic {
    /// Of one stand.
    pub fn new(stand: &StandModel, entries: &Entries, gusty: bool, cells: &CellBuffers) -> Self {
        let area = u64::from(stand.cells) * u64::from(stand.cells);
        let cell = cells.cell_bytes();
        let nodes = if gusty { 8 * u64::from(stand.cells / 2 + 3) * u64::from(stand.cells / 2 + 3) } else { 0 };
        let [awake, woken, touched, lagged] =
            [&entries.awake, &entries.woken, &entries.touched, &entries.lagged].map(|list| list.len() as u64);
        let upper = 16 * u64::from(stand.lag.segments.saturating_sub(1)) + if stand.lag.kind == 1 { 8 } else { 0 };
        Self {
            rest: awake * nodes,
            wake: woken * area * 2 * cell,
            contact: touched * area * (8 + 4 + if cells.has_ground() { 4 } else { 0 }),
            wave: awake * (area * 3 * cell + nodes) + touched * area * 4,
            lag: lagged * area * (8 + upper),
        }
    }
}
