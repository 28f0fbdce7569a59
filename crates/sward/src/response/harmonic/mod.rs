//! Vegetation that sways as one sheet of waves on a plane, seen in layers.
//!
//! Chen & Johan 2015; methods §5.
//!
//! | part | what |
//! |---|---|
//! | `plane` | the waves: a velocity of each cell, drawn by the wind, spreading and swinging |
//! | `view` | the same velocity along the axes of a camera, by a rotation |
//! | `lag` | layers farther off show what the first one did some time ago |
//! | `warp` | how far a layer's picture is moved where |

mod lag;
mod plane;
mod view;
mod warp;

pub use lag::{History, Lags, lags};
pub use plane::{HarmonicCoefficients, Waves};
pub use view::{Axes, seen};
pub use warp::{Warp, offset};
