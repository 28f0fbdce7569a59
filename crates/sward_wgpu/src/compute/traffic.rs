//! Bytes that the passes of a step must read and write at least, counted from what they do: each cell and each value once a pass,
//! as if caches were perfect. Lists of patches and summaries, 88 bytes a patch, are left out.

use sward::response::StandModel;
use sward::response::chain::ChainModel;
use sward::response::harmonic::TOUCH_SIDE;
use sward::response::springs::{self, SpringsModel, pool};

use super::sheets::SheetEntry;

/// Patches of a stand that each pass of a continuum goes over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Patches {
    /// All awake ones.
    pub awake: u64,
    /// Those that wake in this step.
    pub woken: u64,
    /// Those under footprints.
    pub touched: u64,
    /// Those that keep upper segments.
    pub lagged: u64,
}

/// Bytes of each pass of a continuum in one step; of the wave, in one substep.
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
    /// Of one stand whose cells take `cell` bytes in a time level; `gusty`: β_eq comes from nodes, `ground`: heights are stored.
    pub fn new(stand: &StandModel, patches: &Patches, gusty: bool, cell: u64, ground: bool) -> Self {
        let area = u64::from(stand.cells) * u64::from(stand.cells);
        let nodes = if gusty { 8 * u64::from(stand.cells / 2 + 3) * u64::from(stand.cells / 2 + 3) } else { 0 };
        let upper = 16 * u64::from(stand.lag.segments.saturating_sub(1)) + if stand.lag.kind == 1 { 8 } else { 0 };
        Self {
            rest: patches.awake * nodes,
            wake: patches.woken * area * 2 * cell,
            contact: patches.touched * area * (8 + 4 + if ground { 4 } else { 0 }),
            wave: patches.awake * (area * 3 * cell + nodes) + patches.touched * area * 4,
            lag: patches.lagged * area * (8 + upper),
        }
    }
}

/// Of `virtual_pass`: states read and written, moments written, of all virtual blades of `awake` patches.
pub fn virtual_blades(chain: &ChainModel, awake: u64) -> u64 {
    awake * u64::from(chain.virtual_side) * u64::from(chain.virtual_side) * u64::from(chain.coefficients.segments) * (16 + 16 + 8)
}

/// Of `busy_pass`: of `blades` blades the hold and where they stand.
pub fn looked_at(blades: u64) -> u64 {
    blades * (8 + 48)
}

/// Of `blades_pass`: of `busy` blades the state read and written, and where they stand.
pub fn held_blades(chain: &ChainModel, busy: u64) -> u64 {
    busy * (2 * 4 * (6 * u64::from(chain.coefficients.segments) + 2) + 48 + 8)
}

/// Of `air_pass`: of a texel 8 bytes read and 16 written.
pub fn texels(count: u64) -> u64 {
    count * 24
}

/// Of `fade_pass` and `touch_pass`: of a plant its record read and written, where it fades or is looked at; `blocks` are of 8 × 8 plants.
pub fn records(blocks: u64) -> u64 {
    blocks * 64 * 32
}

/// Of `sheet_touch_pass`: sheets read and written, and made ready for `sheet_resolve_pass`.
pub fn touched_sheets(model: &SpringsModel, sheets: u64) -> u64 {
    sheets * (8 * pool::words(&model.coefficients) as u64 + 4 * sheet_room(model) + size_of::<SheetEntry>() as u64)
}

/// Of `sheet_resolve_pass`: what was made ready is read and written, the sheet written.
pub fn resolved_sheets(model: &SpringsModel, sheets: u64) -> u64 {
    sheets * (4 * pool::words(&model.coefficients) as u64 + 8 * sheet_room(model) + size_of::<SheetEntry>() as u64)
}

/// Words that a sheet needs besides in a step.
pub fn sheet_room(model: &SpringsModel) -> u64 {
    let (columns, rows) = model.coefficients.sides();
    springs::ROOM * (columns * rows) as u64 + 1
}

/// Of `draw_pass`: triangles and points of bodies.
pub fn drawn_maps(triangles: u64, points: u64) -> u64 {
    triangles * 16 + points * 12
}

/// Of `write_pass`: which triangle a texel sees, and the texel.
pub fn written_maps(texels: u64) -> u64 {
    texels * (4 + 16)
}

/// Of `plane_pass`: V and its past read with four neighbours, V and its note written.
pub fn plane(cells: u64) -> u64 {
    8 * 8 * cells
}

/// Of `plant_pass`: likewise, but for notes.
pub fn plants(touched: u64) -> u64 {
    8 * 7 * touched * u64::from(TOUCH_SIDE * TOUCH_SIDE)
}

/// Of one of the eight passes of a plane of air: each reads and writes every cell; four neighbours are read when air is carried, two waves
/// when it is projected.
pub fn air(pass: &str, texels: u64) -> u64 {
    let values = match pass {
        "advect_pass" => 5,
        "project_pass" => 4,
        _ => 2,
    };
    values * 4 * texels
}
