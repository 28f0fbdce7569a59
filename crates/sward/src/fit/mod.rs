//! Truth against measured plants: how a plant that was pulled and let go swings.
//!
//! | file | what |
//! |---|---|
//! | `recording` | samples of one motion |
//! | `window` | when it is let go, and about how often it swings |
//! | `curve` | a damped swing on a line, fitted |
//! | `swing` | frequency, damping ratio, residual; or why it is not one mode |
//! | `experiment` | the same measurement on plants of a scene |
//! | `translate` | one response from another |
//! | `reach` | how far a press reaches among plants that touch |

mod curve;
mod experiment;
mod reach;
mod recording;
mod swing;
mod translate;
mod window;

pub use experiment::{ExperimentError, Motion, let_go};
pub use reach::reach;

pub use recording::{FEWEST, Recording, RecordingError};
pub use swing::{FEWEST_SWINGS, LEAST_EXPLAINED, NotOneMode, Swing, swing};
pub use translate::{Translation, response_of};
