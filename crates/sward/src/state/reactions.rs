//! What plants do to bodies, and what a host wants to hear of it.

use serde::{Deserialize, Serialize};

/// What all plants together do to a body in a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Reaction {
    /// Force on the body, N (x, y, z).
    pub force: [f64; 3],
    /// Its moment about the body's base: the middle of its underside, where its pose says it is; N·m.
    pub torque: [f64; 3],
    /// Power by which the body works on the plants as it moves, W; less than 0 where they push it on.
    pub power: f64,
    /// Plants that it holds, cells of a stand that moves as one, blades of one that moves blade by blade.
    pub plants: u32,
}

/// What happens between a body and the plants of a stand.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Happening {
    /// It begins to touch them.
    Entered,
    /// It has not touched any for a tenth of a second, or is gone.
    Left,
    /// It has laid some of them down, farther than 1 rad, in the last tenth of a second.
    Crushed {
        /// How many.
        plants: u32,
        /// Energy with which they are held down, J.
        energy: f64,
    },
}

/// A [`Happening`], and who, where and when.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Event {
    /// Number of the step, counted from 0.
    pub step: u64,
    /// Number of the body.
    pub body: usize,
    /// Number of the stand in the scene.
    pub stand: usize,
    /// Where the body's base is, m (x, y, z).
    pub at: [f64; 3],
    /// What.
    pub what: Happening,
}

/// A body among the plants of a stand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Among {
    /// Number of the step in which it last touched one.
    pub last: u64,
    /// Plants crushed that no event has told of yet.
    pub crushed: u32,
    /// Their energy, J.
    pub energy: f64,
    /// Number of the step from which on an event may tell of them.
    pub due: u64,
}
