//! Continuum grass: bending spreads through the field as a wave.
//!
//! Chen & Johan 2010, eq. 1–12. State per cell: β, ω [rad, rad/s; ground-plane vectors], and both one step earlier.
//! Reads: wind (as β_eq), contacts, slopes. Writes: state, upper segments.
//! Differs from the paper: vector bend, restoring term κ, limiter, exact direct bending (docs/papers.md).

mod bend;
mod coefficients;
pub mod half;
mod lag;
mod patch;
mod propagate;
mod resistance;
mod rest;
mod step;
mod touch;

/// The functions of this response in WGSL, in the order they need each other; they need `math`, `wind` and `contact` before them.
pub const WGSL: [&str; 6] = [
    crate::interaction::reaction::WGSL,
    include_str!("bend.wgsl"),
    include_str!("resistance.wgsl"),
    include_str!("propagate.wgsl"),
    include_str!("rest.wgsl"),
    include_str!("lag.wgsl"),
];
/// Cells at half their size in WGSL; needs `math` before it.
pub const HALF_WGSL: &str = include_str!("half.wgsl");

pub use super::Stage;
pub use bend::{Held, Push, Touch, contact, held, pushes, touch};
pub use coefficients::{Coefficients, HALF_PI, RATE_LIMIT, REST, SMALLEST_LIMIT, bend_limit, safe_limit};
pub use lag::{LagCoefficients, cascade, from_history, look_up_offset};
pub use patch::{Scratch, Wave, step_patch, wake_patch};
pub use propagate::{Rows, bends, deviation, fade_row, keep_held, limit_row, rates};
pub use resistance::Resistance;
pub use rest::{NODE_CELLS, Rest};
pub(crate) use step::shape_of;
pub use step::{ground_of, lag_planes, lags, step};
pub use touch::{PatchContacts, Touched, touch_patch};
