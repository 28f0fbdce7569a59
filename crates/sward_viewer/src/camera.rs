//! Cameras: the scene's own, one that circles a point, one that flies, one that follows a body.

use sward::view::View;
use sward::world::World;

/// Steepest look up or down, rad.
const STEEPEST: f64 = 1.54;
/// Nearest and farthest from the point looked at, m.
const DISTANCES: [f64; 2] = [0.3, 2000.0];
/// Lowest eye above the ground, m.
const LOWEST: f64 = 0.12;

/// How the camera moves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Kind {
    /// As the scene says.
    #[default]
    Scene,
    /// Around a point.
    Orbit,
    /// On its own way.
    Fly,
    /// Behind a body.
    Follow,
}

impl Kind {
    /// All of them, with what menus say.
    pub const ALL: [(Self, &'static str); 4] =
        [(Self::Scene, "scene"), (Self::Orbit, "orbit"), (Self::Fly, "fly"), (Self::Follow, "follow")];

    /// The one after this.
    pub fn next(self) -> Self {
        let at = Self::ALL.iter().position(|(kind, _)| *kind == self).unwrap_or(0);
        Self::ALL[(at + 1) % Self::ALL.len()].0
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(kind, _)| *kind == self).map_or("", |(_, name)| name)
    }
}

/// A camera.
#[derive(Clone, Copy, Debug, Default)]
pub struct Camera {
    /// How it moves.
    pub kind: Kind,
    /// Heading of the look, rad; 0 looks along +z, turning towards +x.
    heading: f64,
    /// Rise of the look, rad.
    rise: f64,
    /// From the point looked at, m.
    distance: f64,
    /// The point looked at, or the eye of one that flies, m.
    at: [f64; 3],
    /// rad.
    field_of_view: f64,
    /// The body's heading when it was last followed.
    behind: Option<f64>,
}

impl Camera {
    /// Takes over from another view: it stays where it is, and moves as `kind` does from now on.
    pub fn take(&mut self, kind: Kind, view: &View) {
        let way = [0, 1, 2].map(|axis| view.target[axis] - view.eye[axis]);
        let level = way[0].hypot(way[2]);
        self.heading = way[0].atan2(way[2]);
        self.rise = way[1].atan2(level);
        // One that flies looks at nothing near: what was looked at before says how far away to stay.
        let flew = self.kind == Kind::Fly;
        if !flew {
            self.distance = level.hypot(way[1]).clamp(DISTANCES[0], DISTANCES[1]);
        }
        let ahead = self.ahead();
        self.at = match kind {
            Kind::Fly => view.eye,
            _ if flew => [0, 1, 2].map(|axis| view.eye[axis] + ahead[axis] * self.distance),
            _ => view.target,
        };
        self.field_of_view = view.field_of_view;
        (self.kind, self.behind) = (kind, None);
    }

    /// Turns by an angle, rad: to the right, up.
    pub fn turn(&mut self, right: f64, up: f64) {
        self.heading = (self.heading - right).rem_euclid(std::f64::consts::TAU);
        self.rise = (self.rise + up).clamp(-STEEPEST, STEEPEST);
    }

    /// Comes nearer by a factor; one that flies moves ahead.
    pub fn zoom(&mut self, factor: f64) {
        if self.kind == Kind::Fly {
            let ahead = self.ahead();
            (0..3).for_each(|axis| self.at[axis] += ahead[axis] * 2.0 * factor.ln());
        } else {
            self.distance = (self.distance / factor).clamp(DISTANCES[0], DISTANCES[1]);
        }
    }

    /// Moves across the view, m: to the right, up, ahead.
    pub fn slide(&mut self, right: f64, up: f64, ahead: f64) {
        let (forward, (sine, cosine)) = (self.ahead(), self.heading.sin_cos());
        self.at[0] += -cosine * right + forward[0] * ahead;
        self.at[1] += up + forward[1] * ahead;
        self.at[2] += sine * right + forward[2] * ahead;
    }

    /// How far away it is from the point looked at, m.
    pub fn away(&self) -> f64 {
        self.distance
    }

    /// Metres that a pixel of a picture so many rows high is worth at the point looked at.
    pub fn metres(&self, rows: f32) -> f64 {
        2.0 * (0.5 * self.field_of_view).tan() * self.distance / f64::from(rows.max(1.0))
    }

    fn ahead(&self) -> [f64; 3] {
        let ((sine, cosine), (up, level)) = (self.heading.sin_cos(), self.rise.sin_cos());
        [sine * level, up, cosine * level]
    }

    /// What it sees; `None` for the scene's own. `body`: the one to follow; `seconds` since the last call.
    pub fn view(&mut self, world: &World, body: Option<usize>, seconds: f64) -> Option<View> {
        let pose = body.and_then(|body| world.pose_before(body, world.behind().min(1.0)));
        match (self.kind, pose) {
            (Kind::Scene, _) => return None,
            (Kind::Follow, Some(pose)) => {
                // Swings round behind the body, as somebody who runs after it would.
                if let Some(before) = self.behind {
                    let turned = wrapped(pose.yaw - before);
                    let turned = turned * (1.0 - (-3.0 * seconds).exp());
                    self.heading += turned;
                    self.behind = Some(before + turned);
                } else {
                    self.behind = Some(pose.yaw);
                }
                self.at = [pose.ground[0], pose.height + 0.8, pose.ground[1]];
            }
            _ => {}
        }
        let ahead = self.ahead();
        let (mut eye, mut target) = match self.kind {
            Kind::Fly => (self.at, [0, 1, 2].map(|axis| self.at[axis] + ahead[axis])),
            _ => ([0, 1, 2].map(|axis| self.at[axis] - ahead[axis] * self.distance), self.at),
        };
        let lowest = world.model.terrain.height_at(eye[0], eye[2]) + LOWEST;
        if eye[1] < lowest {
            if self.kind == Kind::Fly {
                target[1] += lowest - eye[1];
                self.at[1] = lowest;
            }
            eye[1] = lowest;
        }
        Some(View { eye, target, field_of_view: self.field_of_view })
    }
}

/// An angle, -pi to pi.
pub(crate) fn wrapped(angle: f64) -> f64 {
    (angle + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: [f64; 3], b: [f64; 3]) -> bool {
        (0..3).all(|axis| (a[axis] - b[axis]).abs() < 1e-9)
    }

    #[test]
    fn taking_over_moves_nothing() {
        let world = World::new(sward::scene::Scene::parse("(version: 1)", "x").expect("valid"), &sward::model::NoAssets).expect("compiles");
        let before = View { eye: [1.0, 2.0, 3.0], target: [4.0, 1.0, 9.0], field_of_view: 0.8 };
        for kind in [Kind::Orbit, Kind::Fly] {
            let mut camera = Camera::default();
            camera.take(kind, &before);
            let view = camera.view(&world, None, 0.1).expect("its own");
            assert!(close(view.eye, before.eye), "{kind:?} {view:?}");
            let way = |view: &View| [0, 1, 2].map(|axis| view.target[axis] - view.eye[axis]);
            let scale = if kind == Kind::Fly { 1.0 / (9.0_f64 + 1.0 + 36.0).sqrt() } else { 1.0 };
            assert!(close(way(&view), way(&before).map(|part| part * scale)), "{kind:?} {view:?}");
            camera.turn(0.3, 0.0);
            assert!(!close(way(&camera.view(&world, None, 0.1).expect("its own")), way(&view)), "control");
        }
        assert_eq!(Camera::default().view(&world, None, 0.1), None, "the scene's own");
    }

    #[test]
    fn after_a_flight_it_keeps_its_distance() {
        let world = World::new(sward::scene::Scene::parse("(version: 1)", "x").expect("valid"), &sward::model::NoAssets).expect("compiles");
        let mut camera = Camera::default();
        camera.take(Kind::Orbit, &View { eye: [0.0, 3.0, 0.0], target: [0.0, 1.0, 8.0], field_of_view: 0.8 });
        let away = camera.away();
        camera.take(Kind::Fly, &camera.clone().view(&world, None, 0.1).expect("its own"));
        camera.slide(2.0, 1.0, 3.0);
        let flown = camera.view(&world, None, 0.1).expect("its own");
        camera.take(Kind::Follow, &flown);
        let view = camera.view(&world, None, 0.1).expect("its own");
        assert!((camera.away() - away).abs() < 1e-9 && away > 8.0, "{} {away}", camera.away());
        assert!(close(view.eye, flown.eye), "{view:?}");
    }

    #[test]
    fn no_eye_goes_below_the_ground() {
        let world = World::new(sward::scene::Scene::parse("(version: 1)", "x").expect("valid"), &sward::model::NoAssets).expect("compiles");
        let mut camera = Camera::default();
        camera.take(Kind::Orbit, &View { eye: [0.0, 1.0, 0.0], target: [0.0, 0.5, 5.0], field_of_view: 0.8 });
        camera.turn(0.0, 1.4);
        assert!(camera.view(&world, None, 0.1).expect("its own").eye[1] >= LOWEST);
    }
}
