//! Layers farther off show what the first one did some time ago.
//!
//! Chen & Johan 2015, §3.5, eq. 3–4; methods §5. Differs from the paper: its lag changes sign with the wind, needs the future and jumps; here the
//! layer that the wind meets first shows the present, the others the past, and the lag shown changes slowly.

use crate::math::{lower, upper};

/// Slowest passage through the layers, m/s, and longest, s.
const PASSAGE: [f32; 2] = [0.5, 3.0];
/// How fast a lag that is shown may change, s a second.
const CHANGE: f32 = 0.5;

/// Lags of layers at `depths` \[m from the first\] in a mean wind that blows away from the viewer at `away` \[m/s\], s: 0 for the layer that the wind
/// meets first.
pub fn lags(depths: &[f32], away: f32) -> Vec<f32> {
    let deepest = depths.iter().fold(0.0, |most, depth| upper(most, *depth));
    let passage = upper(PASSAGE[0], deepest / PASSAGE[1]);
    let own = |depth: f32| depth * away / (away * away + passage * passage);
    let least = depths.iter().map(|depth| own(*depth)).fold(f32::MAX, lower);
    depths.iter().map(|depth| own(*depth) - least).collect()
}

/// The lags that are shown: they follow, but never faster than half a second a second, so no motion jumps or runs backwards.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lags {
    /// Of each layer, s.
    pub shown: Vec<f32>,
}

impl Lags {
    /// After `dt` \[s\] of following `wanted`.
    pub fn follow(&mut self, wanted: &[f32], dt: f32) {
        if self.shown.len() != wanted.len() {
            self.shown = wanted.to_vec();
        }
        for (shown, wanted) in self.shown.iter_mut().zip(wanted) {
            let change = upper(-CHANGE * dt, lower(CHANGE * dt, wanted - *shown));
            *shown += change;
        }
    }
}

/// What the plane did lately: a ring of its velocities.
#[derive(Clone, Debug, PartialEq)]
pub struct History {
    /// Time between two of them, s.
    pub every: f32,
    ring: Vec<Vec<[f32; 2]>>,
    newest: usize,
    known: usize,
}

impl History {
    /// Room for `seconds` at `every` \[s\].
    pub fn new(seconds: f32, every: f32) -> Self {
        let room = (seconds / every) as usize + 2;
        Self { every, ring: vec![Vec::new(); room], newest: 0, known: 0 }
    }

    /// Notes the present.
    pub fn note(&mut self, now: &[[f32; 2]]) {
        self.newest = (self.newest + 1) % self.ring.len();
        self.ring[self.newest].clear();
        self.ring[self.newest].extend_from_slice(now);
        self.known = (self.known + 1).min(self.ring.len());
    }

    /// The two notes around `ago` \[s\] before the newest, and how far from the younger to the older; the oldest one where it is not known.
    pub fn around(&self, ago: f32) -> Option<([&[[f32; 2]]; 2], f32)> {
        let last = self.known.checked_sub(1)?;
        let steps = lower(upper(ago / self.every, 0.0), last as f32);
        let younger = (steps as usize).min(last);
        let older = (younger + 1).min(last);
        let note = |back: usize| &self.ring[(self.newest + self.ring.len() - back) % self.ring.len()][..];
        Some(([note(younger), note(older)], steps - younger as f32))
    }
}
