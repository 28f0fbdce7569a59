//! Oscillator grass: every plant is a rigid rod on a spring joint that bodies push aside and that then swings back by itself.
//!
//! Grass interaction by instigators (article); methods §2. State per cell, 16 bytes ([`Record`]): the deviation from how the plant stands in
//! the wind \[rad, ground vector\], its rate \[rad/s\], and the step at which it was so. Where nothing touches a plant nothing is computed:
//! its pose is a function of that record and of time. Reads: wind, contacts, ground. Writes: records, and the wind's tilt at texels.
//! Differs from the article: signs (its upright grass falls over), starts with a velocity, exact for short rods and raised bodies, directions
//! that turn instead of flipping, wind (docs/papers.md). Twins: the `.wgsl` files beside.
//!
//! | file | what |
//! |---|---|
//! | `model` | frequency, damping, k, b, l₀ of a species, and what a step reads |
//! | `swing` | where a plant is at a time |
//! | `poses` | the same for all plants of a patch |
//! | `instigator` | how far a body makes a plant lean, and where to |
//! | `touch` | what a step does to a plant within reach of bodies |
//! | `air` | the tilt in the wind, which follows it as slowly as plants do |
//! | `blocks` | which cells bodies can reach |
//! | `rebase` | the motions go on when the numbers change |
//! | `step` | the step of a stand |

mod air;
mod blocks;
mod instigator;
mod model;
mod poses;
mod rebase;
mod step;
mod swing;
mod touch;

pub use air::{Air, AirStep};
pub use blocks::{BLOCK, Block, Blocks};
pub use instigator::{Push, least_tilt, push};
pub use model::{GRAVITY, OscillatorCoefficients, OscillatorError, OscillatorModel, least_height};
pub use poses::Poses;
pub use rebase::rebase;
pub use step::{ground_of, is_census, sizes, step as step_stand};
pub use swing::{Own, Record, curved, limited};
pub use touch::{Plant, Touched, touch};

/// The functions of this response in WGSL, in the order they need each other; they need `math`, `wind`, `contact` and
/// [`super::oscillation`] before them, and from the host `air_load(index: u32) -> f32`.
pub const WGSL: [&str; 6] = [
    crate::interaction::reaction::WGSL,
    include_str!("swing.wgsl"),
    include_str!("air.wgsl"),
    include_str!("instigator.wgsl"),
    include_str!("touch.wgsl"),
    include_str!("rebase.wgsl"),
];
/// Those of them that pictures need: where a plant is, and the air.
pub const POSE_WGSL: [&str; 2] = [include_str!("swing.wgsl"), include_str!("air.wgsl")];
