//! Chain grass: a blade is a few rigid segments on springs, each bent by the wind on it.
//!
//! Belyaev, Laevsky & Chukanov 2011, §3; methods §3.1–3.4. State per joint: ψ \[rad, rotation vector across the segment below\] and its
//! rate \[rad/s\]. Reads: wind at the root. Writes: state. Twins: `chain.wgsl`, `virtual_inertia.wgsl`.
//! Differs from the paper: calibrated against the full chain, exact in each step, virtual moments are turned (docs/papers.md).
//!
//! | file | what |
//! |---|---|
//! | `blade` | physical values of a blade, calibrated to what a step reads |
//! | `modes` | inertia, stiffness and first mode of the full chain about upright, f64 |
//! | `frame` | rotations as columns |
//! | `joint` | one step of the simplified chain, f32, and where its joints are |
//! | `virtual_inertia` | moments of a virtual blade, and the pose of a real one under them |
//! | `full` | the chain with nothing left out, f64: what tests compare with |

mod blade;
mod error;
mod frame;
mod full;
mod joint;
mod modes;
mod species;
mod virtual_inertia;

pub use blade::{Blade, ChainCoefficients, DragLaw, JointCoefficients, MOST_SEGMENTS, calibrate};
pub use error::ChainError;
pub use frame::{Frame, UPRIGHT, planted, product, rotation, to_local, to_world};
pub use full::FullChain;
pub use joint::{BEND_LIMIT, Bends, ChainState, RATE_LIMIT, joints, step};
pub use modes::{Mode, first_mode};
pub use virtual_inertia::{moments, pose, turned};

/// The functions of this response in WGSL, in the order they need each other; they need `math` and `oscillation` before them.
pub const WGSL: [&str; 2] = [include_str!("chain.wgsl"), include_str!("virtual_inertia.wgsl")];
