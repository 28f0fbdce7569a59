//! Plants one by one, around a point: how long they are, how deep they are in bodies.

use eframe::egui::{Color32, Painter, Shape, Stroke};
use sward::picture::standing::{StandingPlant, standing};
use sward::world::World;

use super::{Closely, ramp};
use crate::sight::Sight;

/// Most plants that are looked at.
const MOST: usize = 1200;
/// Full colour of a length that is off by this share.
const OFF: f64 = 0.02;
/// Full colour of a depth, m.
const DEEP: f64 = 0.05;

fn plants(world: &World, closely: Closely) -> Vec<StandingPlant> {
    let [low, high] = [-1.0, 1.0].map(|sign| closely.at.map(|metres| metres + sign * closely.radius));
    let stands = world.model.stands.len();
    (0..stands).flat_map(|stand| standing(world, stand, [low, high], MOST / stands.max(1))).collect()
}

fn draw(painter: &Painter, sight: &Sight, plant: &StandingPlant, colour: Color32) {
    let seen: Vec<_> = plant.points.iter().filter_map(|point| sight.at(*point)).collect();
    if seen.len() == plant.points.len() {
        painter.add(Shape::line(seen, Stroke::new(1.4, colour)));
    }
}

/// How long plants are, of how long they should be.
pub(super) fn lengths(painter: &Painter, sight: &Sight, world: &World, closely: Closely) -> String {
    let (mut sum, mut worst) = (0.0, 0.0_f64);
    let plants = plants(world, closely);
    for plant in &plants {
        let off = (plant.stretch() - 1.0).abs();
        (sum, worst) = (sum + off, worst.max(off));
        draw(painter, sight, plant, ramp::colour(off / OFF));
    }
    let mean = sum / plants.len().max(1) as f64;
    format!("off by 0 to {:.0} %; of {} here on average {:.3} %, at most {:.2} %", 100.0 * OFF, plants.len(), 100.0 * mean, 100.0 * worst)
}

/// How deep plants are in bodies.
pub(super) fn penetration(painter: &Painter, sight: &Sight, world: &World, closely: Closely) -> String {
    let bodies = world.solids_now();
    let plants = plants(world, closely);
    let (mut inside, mut deepest) = (0, 0.0_f64);
    for plant in &plants {
        let depth = plant.depth(&bodies);
        (inside, deepest) = (inside + usize::from(depth > 1e-4), deepest.max(depth));
        let colour = if depth > 1e-4 { ramp::colour(depth / DEEP) } else { Color32::from_white_alpha(40) };
        draw(painter, sight, plant, colour);
    }
    format!("0 to {:.0} mm; {inside} of {} here, the deepest {:.1} mm", 1e3 * DEEP, plants.len(), 1e3 * deepest)
}
