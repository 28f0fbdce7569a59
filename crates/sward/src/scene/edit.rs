//! Changes of the ground, and of what grows there, while a scene runs.

use super::parameters::{choices, parameters};

choices! {
    /// What becomes of the ground under a brush, or of what grows there.
    pub enum Change {
        /// It rises, or sinks where the number is negative.
        Raise(Raise),
        /// It becomes level.
        Flatten(Flatten),
        /// Grass is cut to a height.
        Cut(Cut),
        /// Nothing is left of what grows there.
        Burn,
        /// What was cut or burnt grows again.
        Regrow(Regrow),
    }
}

impl Change {
    /// Whether the ground changes, not what grows there.
    #[must_use]
    pub fn is_of_ground(&self) -> bool {
        matches!(self, Self::Raise(_) | Self::Flatten(_))
    }
}

parameters! {
    /// Grass that is cut.
    pub struct Cut {
        /// Height above the ground that is left of it.
        height: f32 = 0.05, "m" in 0.0..=10.0;
    }
}

parameters! {
    /// Grass that grows again.
    pub struct Regrow {
        /// How long that takes; 0 is at once.
        over: f32 = 10.0, "s" in 0.0..=1000000.0;
    }
}

parameters! {
    /// Ground that rises.
    pub struct Raise {
        /// How far, in the middle.
        height: f32 = 0.5, "m" in -100.0..=100.0, required;
    }
}

parameters! {
    /// Ground that becomes level; bumps of `detail` stay on top.
    pub struct Flatten {
        /// Height it comes to. Without it the height in the middle of the brush.
        height: Option<f32> = None, "m" in -10000.0..=10000.0;
    }
}

parameters! {
    /// A stroke of a round brush over the ground at one moment.
    pub struct Edit {
        /// When.
        time: f64 = 0.0, "s" in 0.0..=1000000000.0;
        /// Middle (x, z).
        at: [f64; 2] = [0.0, 0.0], "m" in -1000000.0..=1000000.0;
        /// Radius: beyond it nothing changes. All edits of the ground of a scene lie within some 680 m.
        radius: f32 = 3.0, "m" in 0.5..=200.0;
        /// Share of the radius within which the ground changes wholly; from there it falls off smoothly. What grows changes wholly up to the radius.
        hardness: f32 = 0.0, "" in 0.0..=0.9;
        /// What happens.
        change: Change = Change::Raise(Raise::default()), "", required;
        /// Names of the stands that are cut, burnt, or grow again; none named: all but shrubs and trees.
        stands: Vec<String> = Vec::new(), "";
    }
}
