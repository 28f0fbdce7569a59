//! Between the world and the window: where a point of the world is seen, and what lies below the mouse.

use eframe::egui::{Pos2, Rect, pos2};
use sward::terrain::Terrain;
use sward::view::View;

/// Nothing nearer to the eye is seen, m.
const NEAR: f64 = 0.05;
/// Nothing farther is looked for below the mouse, m.
const FAR: f64 = 1500.0;

/// A camera and the part of the window it fills.
#[derive(Clone, Copy, Debug)]
pub struct Sight {
    eye: [f64; 3],
    /// To the right, up, ahead; unit.
    axes: [[f64; 3]; 3],
    /// Half the picture's height at 1 m.
    half: f64,
    area: Rect,
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|axis| a[axis] * b[axis]).sum()
}

fn unit(a: [f64; 3], otherwise: [f64; 3]) -> [f64; 3] {
    let length = dot(a, a).sqrt();
    if length > 1e-9 { a.map(|part| part / length) } else { otherwise }
}

impl Sight {
    /// What `view` sees in a part of the window.
    pub fn new(view: &View, area: Rect) -> Self {
        let ahead = unit([0, 1, 2].map(|axis| view.target[axis] - view.eye[axis]), [0.0, 0.0, 1.0]);
        let right = unit(cross(ahead, [0.0, 1.0, 0.0]), [1.0, 0.0, 0.0]);
        Self { eye: view.eye, axes: [right, cross(right, ahead), ahead], half: (0.5 * view.field_of_view).tan(), area }
    }

    /// The eye, m.
    pub fn eye(&self) -> [f64; 3] {
        self.eye
    }

    /// The part of the window.
    pub fn area(&self) -> Rect {
        self.area
    }

    /// A point in the camera's axes: to the right, up, ahead, m.
    fn seen(&self, at: [f64; 3]) -> [f64; 3] {
        let off = [0, 1, 2].map(|axis| at[axis] - self.eye[axis]);
        self.axes.map(|axis| dot(axis, off))
    }

    fn place(&self, [x, y, ahead]: [f64; 3]) -> Pos2 {
        let rows = 0.5 * f64::from(self.area.height()) / (self.half * ahead);
        self.area.center() + pos2((x * rows) as f32, (-y * rows) as f32).to_vec2()
    }

    /// Where a point \[m\] is seen; `None` behind the eye.
    pub fn at(&self, point: [f64; 3]) -> Option<Pos2> {
        let seen = self.seen(point);
        (seen[2] > NEAR).then(|| self.place(seen))
    }

    /// Where the part of a line before the eye is seen.
    pub fn line(&self, from: [f64; 3], to: [f64; 3]) -> Option<[Pos2; 2]> {
        let [a, b] = [self.seen(from), self.seen(to)];
        if a[2] <= NEAR && b[2] <= NEAR {
            return None;
        }
        let before_the_eye = |one: [f64; 3], other: [f64; 3]| match one[2] < NEAR {
            true => [0, 1, 2].map(|axis| one[axis] + (other[axis] - one[axis]) * (NEAR - one[2]) / (other[2] - one[2])),
            false => one,
        };
        let (a, b) = (before_the_eye(a, b), before_the_eye(b, a));
        Some([self.place(a), self.place(b)])
    }

    /// Metres that a point of the window is worth at a point of the world.
    pub fn metres(&self, point: [f64; 3]) -> f64 {
        2.0 * self.half * self.seen(point)[2].max(NEAR) / f64::from(self.area.height().max(1.0))
    }

    /// Way of the look through a point of the window, unit.
    pub fn ray(&self, at: Pos2) -> [f64; 3] {
        let off = at - self.area.center();
        let scale = 2.0 * self.half / f64::from(self.area.height().max(1.0));
        let [right, up, ahead] = self.axes;
        let (x, y) = (f64::from(off.x) * scale, -f64::from(off.y) * scale);
        unit([0, 1, 2].map(|axis| ahead[axis] + right[axis] * x + up[axis] * y), ahead)
    }

    /// The ground below a point of the window, m (x, z).
    pub fn ground(&self, terrain: &Terrain, at: Pos2) -> Option<[f64; 2]> {
        let way = self.ray(at);
        let along = |distance: f64| [0, 1, 2].map(|axis| self.eye[axis] + way[axis] * distance);
        let above = |distance: f64| {
            let [x, y, z] = along(distance);
            y - terrain.height_at(x, z)
        };
        let (mut before, mut distance) = (0.0, 0.0);
        while distance < FAR {
            let height = above(distance);
            if height <= 0.0 {
                // Between the last two places; thirty halvings are exact enough for anything that is drawn.
                let (mut low, mut high) = (before, distance);
                for _ in 0..30 {
                    let middle = 0.5 * (low + high);
                    if above(middle) > 0.0 { low = middle } else { high = middle }
                }
                let [x, _, z] = along(high);
                return Some([x, z]);
            }
            before = distance;
            // No ground is steeper than the walk is careful.
            distance += (0.4 * height).max(0.02 + 0.002 * distance);
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use eframe::egui::vec2;
    use sward::model::NoAssets;
    use sward::scene::Scene;
    use sward::world::World;

    use super::*;

    fn sight() -> Sight {
        let view = View { eye: [1.0, 2.0, -3.0], target: [2.0, 0.5, 4.0], field_of_view: 0.9 };
        Sight::new(&view, Rect::from_min_size(pos2(100.0, 50.0), vec2(640.0, 360.0)))
    }

    #[test]
    fn what_is_looked_at_is_in_the_middle() {
        let seen = sight().at([2.0, 0.5, 4.0]).expect("ahead");
        assert!(seen.distance(pos2(420.0, 230.0)) < 1e-3, "{seen}");
        assert!(sight().at([1.0, 2.0, -9.0]).is_none(), "behind the eye");
        // Up is up, and what lies to the right of one who looks along +z is at −x.
        assert!(sight().at([2.0, 1.5, 4.0]).expect("ahead").y < 230.0);
        assert!(sight().at([0.0, 0.5, 4.0]).expect("ahead").x > 420.0);
    }

    #[test]
    fn the_ground_below_the_mouse_is_seen_there() {
        let hills = "terrain: Image(path: \"assets/jacksboro.png\", scale: 0.03125, offset: (-86.4, 55.0)),";
        for terrain in ["", hills] {
            let scene = Scene::parse(&format!("(version: 1, {terrain})"), "x").expect("valid");
            let world = World::new(scene, &sward_scenes::Embedded).expect("compiles");
            let ground = world.model.terrain.height_at(0.0, 0.0);
            let view = View { eye: [1.0, 3.0 + ground, -3.0], target: [2.0, 0.5 + ground, 4.0], field_of_view: 0.9 };
            let sight = || Sight::new(&view, sight().area());
            for at in [pos2(420.0, 300.0), pos2(150.0, 380.0), pos2(700.0, 330.0)] {
                let ground = sight().ground(&world.model.terrain, at).expect("looks down");
                let height = world.model.terrain.height_at(ground[0], ground[1]);
                let seen = sight().at([ground[0], height, ground[1]]).expect("ahead");
                assert!(seen.distance(at) < 0.01, "{seen} {at}");
            }
        }
        let world = World::new(Scene::parse("(version: 1)", "x").expect("valid"), &NoAssets).expect("compiles");
        assert_eq!(sight().ground(&world.model.terrain, pos2(420.0, 51.0)), None, "the sky");
    }

    #[test]
    fn lines_end_before_the_eye() {
        let [a, b] = sight().line([1.0, 1.0, -20.0], [2.0, 0.5, 4.0]).expect("half of it is ahead");
        assert!(b.distance(pos2(420.0, 230.0)) < 1e-3 && a.is_finite());
        assert!(sight().line([1.0, 1.0, -20.0], [2.0, 0.5, -14.0]).is_none());
    }
}
