//! Springs: a billboard is a sheet of vertices that bodies push aside, that keeps its shape, and that recovers.
//!
//! Orthmann, Rezk-Salama & Kolb 2009, §5; methods §4. State per billboard that something touches: the sheet as it was left \[m\], steps
//! since then, and by which way each vertex left the body. Reads: distance maps ([`crate::interaction::distance_map`]), the pose in the
//! wind. Writes: state. Twins: the `.wgsl` files beside.
//! Differs from the paper: columns keep their lengths, directions recover, what finds no way out lies down (docs/papers.md).
//!
//! | file | what |
//! |---|---|
//! | `sheet` | roots, vertices, lengths at rest |
//! | `wind` | how it stands where nothing touches it |
//! | `push` | out of bodies, by their distance maps |
//! | `sweep` | structural and shear springs |
//! | `lengths` | columns keep their lengths, above the ground |
//! | `lay` | what is still in a body lies down; nothing jumps |
//! | `recover` | back to the wind's pose |
//! | `step` | one step of one billboard |
//! | `model`, `stand` | a stand, compiled; its step |
//! | `pool` | which billboards have a sheet, and how it is stored |
//! | `surface` | a smooth surface for drawing |

mod lay;
mod lengths;
mod model;
pub mod pool;
pub mod pressed;
mod push;
mod recover;
mod sheet;
mod stand;
mod step;
pub mod surface;
mod sweep;
mod vector;
mod wind;

pub use lay::{AHEAD, SPREAD, lay, spread};
pub use lengths::pass;
pub use model::SpringsModel;
pub use push::{Faces, MOST_MOMENTS, Maps, TOLERANCE, TRODDEN, exit, moments, push};
pub use recover::{recovered, share_left, time_left};
pub use sheet::{CLEAR, MOST_SIDE, MOST_VERTICES, Sheet, SheetRoot, SpringsCoefficients};
pub use stand::{root_of, step_stand, target_of};
pub use step::{HeldSheet, ROUNDS, is_touched, resolve, step};
pub use sweep::sweep;
pub use wind::{Wave, pose, sway};

/// The functions of one billboard in WGSL that pictures need as well, in the order they need each other; they need `math` before them.
pub const WGSL: [&str; 6] = [
    include_str!("vector.wgsl"),
    include_str!("sheet.wgsl"),
    include_str!("lengths.wgsl"),
    include_str!("recover.wgsl"),
    include_str!("wind.wgsl"),
    include_str!("surface.wgsl"),
];

/// The functions of a step in WGSL; they need [`WGSL`] and [`crate::interaction::distance_map::WGSL`] before them, and from the host
/// `springs_map(index: u32) -> DistanceMapHead` and a billboard's own words: `springs_word(k: u32) -> u32`, `springs_put_word(k: u32, word: u32)`.
pub const STEP_WGSL: [&str; 7] = [
    include_str!("held.wgsl"),
    include_str!("sweep.wgsl"),
    include_str!("push.wgsl"),
    include_str!("lay.wgsl"),
    include_str!("step.wgsl"),
    crate::interaction::reaction::WGSL,
    include_str!("pressed.wgsl"),
];

/// Words of a billboard's own that a step in WGSL needs for each vertex.
pub const ROOM: u64 = 20;
