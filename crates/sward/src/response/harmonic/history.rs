//! What the plane did lately: a ring of its velocities, thirty a second.
//!
//! Chen & Johan 2015, §3.5 (the states of several steps); methods §5: 1.5 s.

use crate::math::{floored, lower, upper};

/// How much is remembered, s.
pub const REMEMBERED: f32 = 1.5;
/// Notes a second, at most.
const NOTES: f64 = 30.0;

/// Which note of a ring holds what. A note is rewritten by every step of its time and then kept, so the newest always holds the present.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ring {
    /// Steps a note.
    pub every: u32,
    /// Notes.
    pub notes: u32,
}

/// Between which two notes a moment lies, and how far from the first to the second.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moment {
    /// The younger note and the older.
    pub notes: [u32; 2],
    /// 0 the younger, 1 the older.
    pub share: f32,
}

impl Ring {
    /// For steps of `dt` \[s\].
    pub fn new(dt: f64) -> Self {
        let every = upper(floored((1.0 / NOTES / dt + 0.5) as f32) as f32, 1.0) as u32;
        let notes = (f64::from(REMEMBERED) / (f64::from(every) * dt)) as u32 + 2;
        Self { every, notes }
    }

    /// The note that holds the present after `steps` steps.
    pub fn present(&self, steps: u64) -> u32 {
        (steps / u64::from(self.every) % u64::from(self.notes)) as u32
    }

    /// Where the moment `ago` \[steps, 0 or more\] before the present is found; the oldest one known where it lies before that.
    pub fn moment(&self, steps: u64, ago: f32) -> Moment {
        // The note before the newest was last written so many steps ago.
        let first = (steps % u64::from(self.every)) as f32 + 1.0;
        let ago = upper(ago, 0.0);
        let (back, share) = if ago < first {
            (0, ago / first)
        } else {
            let along = lower((ago - first) / self.every as f32, (self.notes - 3) as f32 + 1.0);
            let whole = lower(floored(along) as f32, (self.notes - 3) as f32);
            (1 + whole as u32, along - whole)
        };
        let present = self.present(steps);
        let note = |back: u32| (present + self.notes - back % self.notes) % self.notes;
        Moment { notes: [note(back), note(back + 1)], share }
    }
}
