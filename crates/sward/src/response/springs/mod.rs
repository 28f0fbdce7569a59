//! Springs.
mod lay;
mod lengths;
mod push;
mod recover;
mod sheet;
mod springs;
mod step;
mod vector;
mod wind;
pub use lay::{SPREAD, lay, spread};
pub use lengths::pass;
pub use push::{Faces, Maps, TOLERANCE, TRODDEN, exit, push};
pub use recover::{recovered, share_left, time_left};
pub use sheet::{CLEAR, MOST_SIDE, MOST_VERTICES, Sheet, SheetRoot, SpringsCoefficients};
pub use springs::sweep;
pub use step::{HeldSheet, ROUNDS, is_touched, resolve, step};
pub use wind::{Wave, pose, sway};
