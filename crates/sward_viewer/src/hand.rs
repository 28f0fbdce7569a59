//! A hand that takes a body and drags it over the ground.

use sward::world::World;

use crate::camera::wrapped;
use crate::sight::Sight;

/// Fastest that a hand moves a body, m/s: what goes faster than any plant could follow would jump.
const FASTEST: f64 = 14.0;
/// How soon the body is where the hand is, 1/s.
const SOON: f64 = 9.0;

/// A body in a hand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hand {
    /// Its number.
    pub body: usize,
    /// Where the mouse is on the ground, less where the body was taken, m.
    pub wanted: [f64; 2],
    grip: [f64; 2],
    /// m.
    pub ground: [f64; 2],
    /// Heading, rad.
    pub yaw: f64,
    /// Height over the ground, m.
    pub clearance: f64,
}

/// The body below a point of the window, the nearest one.
pub fn below(world: &World, sight: &Sight, at: eframe::egui::Pos2) -> Option<usize> {
    let (eye, way) = (sight.eye(), sight.ray(at));
    let mut nearest: Option<(f64, usize)> = None;
    for solid in world.solids_now() {
        let [low, high] = solid.bounds();
        // A finger is wide: at least 8 points of the window.
        let middle = [0, 1, 2].map(|axis| 0.5 * (low[axis] + high[axis]));
        let wide = 8.0 * sight.metres(middle);
        let (mut enter, mut leave) = (0.0_f64, f64::MAX);
        for axis in 0..3 {
            let (a, b) = ((low[axis] - wide - eye[axis]) / way[axis], (high[axis] + wide - eye[axis]) / way[axis]);
            (enter, leave) = (enter.max(a.min(b)), leave.min(a.max(b)));
        }
        if enter <= leave && nearest.is_none_or(|(before, _)| enter < before) {
            nearest = Some((enter, solid.body() as usize));
        }
    }
    nearest.map(|(_, body)| body)
}

impl Hand {
    /// Takes a body over at a point (x, z) of the ground; `None` for one that is away.
    pub fn take(world: &mut World, body: usize, at: [f64; 2]) -> Option<Self> {
        let (ground, yaw, clearance) = world.take_over(body)?;
        let grip = [0, 1].map(|axis: usize| ground[axis] - at[axis]);
        Some(Self { body, wanted: ground, grip, ground, yaw, clearance })
    }

    /// The mouse is over another place of the ground.
    pub fn point(&mut self, at: [f64; 2]) {
        self.wanted = [0, 1].map(|axis| at[axis] + self.grip[axis]);
    }

    /// Goes after the mouse for `dt` seconds.
    pub fn go(&mut self, dt: f64) {
        let off = [0, 1].map(|axis: usize| self.wanted[axis] - self.ground[axis]);
        let away = off[0].hypot(off[1]);
        if away < 1e-6 {
            return;
        }
        let way = (away * (1.0 - (-SOON * dt).exp())).min(FASTEST * dt);
        (0..2).for_each(|axis| self.ground[axis] += off[axis] / away * way);
        // It turns to where it goes, sooner when it goes fast.
        let turned = wrapped(off[0].atan2(off[1]) - self.yaw);
        self.yaw = wrapped(self.yaw + turned * (1.0 - (-3.0 * way).exp()));
    }
}

#[cfg(test)]
mod tests {
    use eframe::egui::{Rect, pos2, vec2};
    use sward::model::NoAssets;
    use sward::scene::Scene;

    use super::*;

    fn world() -> World {
        let text = "(version: 1, interactors: [(shape: Sphere(radius: 0.5), path: Still(at: (0, 4)))])";
        World::new(Scene::parse(text, "x").expect("valid"), &NoAssets).expect("compiles")
    }

    #[test]
    fn a_body_is_taken_where_it_is_seen_and_goes_where_the_hand_goes() {
        let mut world = world();
        let view = sward::view::View { eye: [0.0, 2.0, -4.0], target: [0.0, 0.5, 4.0], field_of_view: 0.9 };
        let sight = Sight::new(&view, Rect::from_min_size(pos2(0.0, 0.0), vec2(640.0, 360.0)));
        let seen = sight.at([0.0, 0.5, 4.0]).expect("ahead");
        assert_eq!(below(&world, &sight, seen), Some(0));
        assert_eq!(below(&world, &sight, seen + vec2(150.0, 0.0)), None, "control");
        let mut hand = Hand::take(&mut world, 0, [0.2, 4.0]).expect("there");
        hand.point([3.2, 6.0]);
        let mut fastest = 0.0_f64;
        for _ in 0..180 {
            let before = hand.ground;
            hand.go(1.0 / 60.0);
            fastest = fastest.max(60.0 * (hand.ground[0] - before[0]).hypot(hand.ground[1] - before[1]));
        }
        assert!((hand.ground[0] - 3.0).abs() < 1e-3 && (hand.ground[1] - 6.0).abs() < 1e-3, "{hand:?}");
        assert!(fastest <= FASTEST + 1e-9, "{fastest}");
        assert!((hand.yaw - 3.0_f64.atan2(2.0)).abs() < 0.1, "it looks where it went: {hand:?}");
    }
}
