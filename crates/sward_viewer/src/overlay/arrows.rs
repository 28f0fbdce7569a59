//! Fields as arrows: bend, its rate, wind.

use std::collections::BTreeMap;

use eframe::egui::{Painter, Stroke};
use sward::world::World;

use super::lattice::{self, Key, middle, places};
use super::ramp;
use crate::sight::Sight;

/// A place and a vector there.
type Arrow = (Key, [f64; 2]);

/// The first stand with a response of its own that has plants there, and how they lean.
fn lean(world: &World, at: [f64; 2]) -> Option<[f64; 2]> {
    (0..world.model.stands.len()).find_map(|stand| world.bend_at(stand, at)).map(|bend| bend.map(f64::from))
}

/// Draws arrows whose colour is full at `most`; the answer is the largest.
fn draw(painter: &Painter, sight: &Sight, world: &World, arrows: &[Arrow], most: f64) -> f64 {
    let lift = world.model.stands.first().map_or(0.1, |stand| 0.6 * f64::from(stand.species.height[1]));
    let mut largest = 0.0_f64;
    for (key, vector) in arrows {
        let [x, z] = middle(*key);
        let size = vector[0].hypot(vector[1]);
        largest = largest.max(size);
        if size < 0.004 * most {
            continue;
        }
        // A full arrow is as long as its lattice is wide, so neighbours do not cover each other.
        let scale = 0.9 * lattice::side(key.0) / size * (size / most).min(1.0).sqrt();
        let height = |x, z| world.model.terrain.height_at(x, z) + lift;
        let tip = [x + vector[0] * scale, z + vector[1] * scale];
        let Some([from, to]) = sight.line([x, height(x, z), z], [tip[0], height(tip[0], tip[1]), tip[1]]) else { continue };
        let colour = ramp::colour(size / most);
        let stroke = Stroke::new(1.6, colour);
        painter.line_segment([from, to], stroke);
        let back = (from - to) * 0.3;
        for side in [back.rot90() * 0.45, back.rot90() * -0.45] {
            painter.line_segment([to, to + back + side], stroke);
        }
    }
    largest
}

/// How far plants lean.
pub(super) fn bend(painter: &Painter, sight: &Sight, world: &World) -> String {
    let seen = places(sight, &world.model.terrain);
    let arrows: Vec<Arrow> = seen.into_iter().filter_map(|key| Some((key, lean(world, middle(key))?))).collect();
    let largest = draw(painter, sight, world, &arrows, 1.2);
    format!("0 to 1.2 rad, here up to {largest:.3}")
}

/// How the air moves.
pub(super) fn wind(painter: &Painter, sight: &Sight, world: &World) -> String {
    let seen = places(sight, &world.model.terrain);
    let air = world.winds_at(&seen.iter().map(|key| middle(*key)).collect::<Vec<_>>());
    let arrows: Vec<Arrow> = seen.into_iter().zip(air).map(|(key, air)| (key, air.map(f64::from))).collect();
    let largest = draw(painter, sight, world, &arrows, 12.0);
    format!("0 to 12 m/s, here up to {largest:.1}")
}

/// How fast plants move: what has changed since the last picture that shows another step.
#[derive(Debug, Default)]
pub(super) struct Rates {
    /// Step of `leans`.
    step: u64,
    leans: BTreeMap<Key, [f64; 2]>,
    rates: Vec<Arrow>,
}

impl Rates {
    pub(super) fn draw(&mut self, painter: &Painter, sight: &Sight, world: &World) -> String {
        let steps = world.state.step.wrapping_sub(self.step);
        if steps > 0 {
            let seen = places(sight, &world.model.terrain);
            let leans: BTreeMap<Key, [f64; 2]> = seen.into_iter().filter_map(|key| Some((key, lean(world, middle(key))?))).collect();
            let seconds = steps as f64 * world.model.dt;
            let rate = |(key, now): (&Key, &[f64; 2])| {
                let before = self.leans.get(key)?;
                Some((*key, [0, 1].map(|axis| (now[axis] - before[axis]) / seconds)))
            };
            // After a pause, or in another scene, there is nothing to compare with.
            self.rates = if steps < 60 { leans.iter().filter_map(rate).collect() } else { Vec::new() };
            (self.step, self.leans) = (world.state.step, leans);
        }
        let largest = draw(painter, sight, world, &self.rates, 4.0);
        format!("0 to 4 rad/s, here up to {largest:.3}")
    }
}
