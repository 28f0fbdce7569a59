//! Follows how the plants of one place lean.

use std::collections::VecDeque;

use sward::world::World;

/// Moments that are remembered.
const MOMENTS: usize = 1800;

/// A place that is watched.
#[derive(Debug, Default)]
pub struct Probe {
    /// Where, m (x, z).
    pub at: Option<[f64; 2]>,
    /// Stand of the plants there.
    pub stand: usize,
    /// Time \[s\] and lean \[rad, along x and z\], the last one last.
    pub past: VecDeque<(f64, [f32; 2])>,
    step: u64,
}

impl Probe {
    /// Watches another place.
    pub fn put(&mut self, at: [f64; 2]) {
        *self = Self { at: Some(at), stand: self.stand, ..Self::default() };
    }

    /// Remembers how the plants lean now, once a step.
    pub fn take(&mut self, world: &World) {
        let Some(at) = self.at else { return };
        if self.stand >= world.model.stands.len() {
            self.stand = 0;
        }
        if world.state.step < self.step {
            // Begun again.
            self.past.clear();
        }
        if world.state.step == self.step && !self.past.is_empty() {
            return;
        }
        self.step = world.state.step;
        if let Some(lean) = world.bend_at(self.stand, at) {
            self.past.push_back((world.time(), lean));
            if self.past.len() > MOMENTS {
                self.past.pop_front();
            }
        }
    }

    /// How far they lean now, rad.
    pub fn lean(&self) -> Option<f64> {
        self.past.back().map(|(_, [x, z])| f64::from(x.hypot(*z)))
    }
}
