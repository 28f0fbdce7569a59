//! Bodies: where they are, what ground they sweep in a step, and what they ask of a plant under them.
//!
//! Chen & Johan 2010, §5.1–5.2; methods §1.1. A body is a set of convex pieces; each piece and step becomes one [`Contact`],
//! quantised to fractions of a cell so that every backend calls the same cells inside. Twin: `contact.wgsl`.

mod contact;
mod convex;
pub mod distance_map;
mod figure;
mod motion;
mod piece;
pub mod reaction;
pub mod skin;
pub mod solid;

/// Contact of one cell in WGSL; the host declares `contact_edge(index: u32) -> ContactEdge`. Needs `math` before it.
pub const WGSL: &str = include_str!("contact.wgsl");

pub(crate) use contact::underside;
pub use contact::{ABREAST, Contact, ContactEdge, Hit, contact_at, contacts_of_row};
pub use convex::{Footprint, Grid, swept, swept_between};
pub use figure::FigureBody;
pub use motion::{Pose, Station, pose_on_path, stand as stand_on, station};
pub use piece::{Piece, Underside, pieces_of};
