//! Chain grass: a blade is a few rigid segments on springs, each bent by the wind on it.
//!
//! Belyaev, Laevsky & Chukanov 2011, §3; methods §3.1–3.4. State per joint: ψ \[rad, rotation vector across the segment below\] and its
//! rate \[rad/s\]. Reads: wind at the root. Writes: state. Twins: the `.wgsl` files beside.
//! Differs from the paper: calibrated against the full chain, exact in each step, virtual moments are turned (docs/papers.md).
//!
//! | file | what |
//! |---|---|
//! | `blade` | physical values of a blade, calibrated to what a step reads |
//! | `modes` | inertia, stiffness and first mode of the full chain about upright, f64 |
//! | `frame` | rotations as columns |
//! | `joint` | one step of the simplified chain, f32, and where its joints are |
//! | `virtual_inertia` | moments of a virtual blade, and the pose of a real one under them |
//! | `steady` | how a blade stands in steady wind, by speed |
//! | `virtual_blades`, `standing` | virtual blades of a patch, and how real ones stand between them |
//! | `planting`, `push`, `held` | blades with a state: where they stand, turned out of bodies, taken and handed back |
//! | `model`, `step` | a stand, compiled; its step |
//! | `trail` | how late the tip follows the foot, of the full chain |
//! | `full` | the chain with nothing left out, f64: what tests compare with |

mod blade;
mod error;
mod frame;
mod full;
mod held;
mod joint;
mod model;
mod modes;
pub mod planting;
pub mod pressed;
mod push;
mod species;
mod standing;
mod steady;
mod step;
mod trail;
mod virtual_blades;
mod virtual_inertia;

pub use blade::{Blade, ChainCoefficients, DragLaw, JointCoefficients, MOST_SEGMENTS, calibrate, first_frequency};
pub use error::ChainError;
pub use frame::{Frame, UPRIGHT, bend_towards, planted, product, rotation, to_local, to_world};
pub use full::FullChain;
pub use held::{HeldBlade, Holding, mixed};
pub use joint::{BEND_LIMIT, Bends, ChainState, RATE_LIMIT, joints, rest_turn, step};
pub use model::{ChainModel, Stances};
pub use modes::{Mode, first_mode};
pub use push::{Around, Obstacles, TOLERANCE, is_pushed, push};
pub use standing::{Standing, leans};
pub use steady::{SPEEDS, Steady, TOP};
pub use step::{RESTLESS, loaded, roots, sizes, step as step_stand};
pub use trail::{Trail, trails};
pub use virtual_blades::VirtualBlades;
pub use virtual_inertia::{moments, pose, turned};

/// The functions of one blade in WGSL, in the order they need each other; they need `math` and `oscillation` before them.
pub const WGSL: [&str; 2] = [include_str!("chain.wgsl"), include_str!("virtual_inertia.wgsl")];
/// How blades stand between virtual ones, after [`WGSL`]; the host declares `steady_load(index: u32) -> vec2<f32>` and
/// `standing_load(before: bool, index: u32) -> f32`.
pub const STANDING_WGSL: [&str; 2] = [include_str!("steady.wgsl"), include_str!("standing.wgsl")];
/// Blades with a state, after [`STANDING_WGSL`] and [`crate::interaction::solid::WGSL`]; the host declares `push_solid(index: u32) -> SolidHead`,
/// `held_stands(root: Root, base: mat3x3<f32>, before: bool) -> array<vec2<f32>, 8>`, `held_wind(root: Root) -> vec2<f32>` and
/// `pressed_joint(joint: u32) -> ChainJoint`.
pub const HELD_WGSL: [&str; 4] =
    [include_str!("push.wgsl"), crate::interaction::reaction::WGSL, include_str!("pressed.wgsl"), include_str!("held.wgsl")];
