//! Where bodies were a while ago: for scripts that look whether they leave tracks.

use std::collections::VecDeque;

use sward::world::World;

/// Steps ago.
const STEPS: usize = 90;
/// How far a body must be from there, m.
const AWAY: f64 = 4.0;
/// How far to the side nothing touches the plants, m.
const ASIDE: f64 = 4.0;

/// The last places of every body, one a step.
#[derive(Debug, Default)]
pub struct Trails {
    step: u64,
    places: Vec<VecDeque<Option<[f64; 2]>>>,
}

impl Trails {
    /// Remembers where bodies are; called at least once in every step, or places are missing.
    pub fn take(&mut self, world: &World) {
        let bodies = world.state.bodies.len();
        if world.state.step < self.step || self.places.len() != bodies {
            *self = Self { places: vec![VecDeque::new(); bodies], ..Self::default() };
        }
        if world.state.step == self.step {
            return;
        }
        self.step = world.state.step;
        for (place, body) in self.places.iter_mut().zip(&world.state.bodies) {
            place.push_back(body.pose.map(|pose| pose.ground));
            if place.len() > STEPS {
                place.pop_front();
            }
        }
    }

    /// Where a body was, and a place to the side of its way from there; none while it is near.
    pub fn places(&self, body: usize) -> [Option<[f64; 2]>; 2] {
        let Some(places) = self.places.get(body) else { return [None; 2] };
        let (Some(Some(then)), Some(Some(now))) = (places.front(), places.back()) else { return [None; 2] };
        let way = [now[0] - then[0], now[1] - then[1]];
        let length = way[0].hypot(way[1]);
        if places.len() < STEPS || length < AWAY {
            return [None; 2];
        }
        let aside = [then[0] - way[1] / length * ASIDE, then[1] + way[0] / length * ASIDE];
        [Some(*then), Some(aside)]
    }
}
