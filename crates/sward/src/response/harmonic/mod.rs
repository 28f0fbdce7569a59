//! Vegetation that sways as one sheet of waves on a plane, seen in layers.
//!
//! Chen & Johan 2015; methods §5.
//!
//! | part | what |
//! |---|---|
//! | `stand` | plants that are meshes: where they stand, and the plane that moves them |
//! | `plane` | the waves: a velocity of each cell, drawn by the wind, spreading and swinging |
//! | `touch` | a small plane of one plant, for bodies and local winds |
//! | `history`, `lag` | layers farther off show what the first one did some time ago |
//! | `view` | the same velocity along the axes of a camera, by a rotation |
//! | `step` | a step of a stand, on the CPU |

mod history;
mod lag;
mod plane;
mod stand;
mod step;
mod touch;
mod view;

/// Waves in WGSL.
pub const WGSL: &str = include_str!("harmonic.wgsl");

pub use crate::state::Waves;
pub use history::{Moment, REMEMBERED, Ring};
pub use lag::{drifted, lags};
pub use plane::HarmonicCoefficients;
pub(crate) use stand::largest;
pub use stand::{HarmonicModel, LayeredStand};
pub use step::{air, step_layered};
pub use touch::{TOUCH_SIDE, step_touched};
pub use view::{Axes, seen};
