//! What every pixel's motion should be, in f64, from the core alone: spines, sheets, meshes and cameras of both moments.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3, Vec3};
use sward::geometry::card::rung;
use sward::geometry::mesh::Mesh;
use sward::geometry::sheet::{Around, SheetOf, corner};
use sward::math::smoothstep;
use sward::picture::aov::Aov;
use sward::picture::identity::Identity;
use sward::picture::plan::{self, Seen};
use sward::picture::plants::Plant;
use sward::picture::prepare::{PrepareUniform, Preparing};
use sward::picture::subject::{self, Frame};
use sward::response::continuum::NODE_CELLS;
use sward::state::PatchKey;
use sward::view::View;
use sward::world::World;

/// A triangle, m from the corner of the scene's origin patch.
pub(crate) type Triangle = [DVec3; 3];

/// A camera of its own, from nothing but eye, target and angle.
pub(crate) struct Camera {
    eye: DVec3,
    axes: [DVec3; 3],
    /// Pixels at distance 1.
    scale: f64,
    size: DVec2,
}

impl Camera {
    pub(crate) fn new(view: &View, size: [u32; 2]) -> Self {
        let (eye, target) = (DVec3::from(view.eye), DVec3::from(view.target));
        let ahead = (target - eye).normalize();
        let right = ahead.cross(DVec3::Y).normalize();
        let size = DVec2::new(f64::from(size[0]), f64::from(size[1]));
        Self { eye, axes: [right, right.cross(ahead), ahead], scale: 0.5 * size.y / (0.5 * view.field_of_view).tan(), size }
    }

    /// Pixels from the top left, and depth.
    pub(crate) fn project(&self, at: DVec3) -> (DVec2, f64) {
        let [x, y, depth] = self.axes.map(|axis| axis.dot(at - self.eye));
        (0.5 * self.size + DVec2::new(x, -y) * (self.scale / depth), depth)
    }

    /// From the eye through a place of the picture, to depth 1.
    pub(crate) fn ray(&self, at: DVec2) -> DVec3 {
        let from = (at - 0.5 * self.size) / self.scale;
        self.axes[2] + self.axes[0] * from.x - self.axes[1] * from.y
    }

    /// The point that a place of the picture shows at a depth.
    pub(crate) fn point(&self, at: DVec2, depth: f64) -> DVec3 {
        self.eye + self.ray(at) * depth
    }

    /// Where a direction is seen.
    fn turned(&self, ray: DVec3) -> DVec2 {
        self.project(self.eye + ray).0
    }
}

/// Everything drawn at one moment.
pub(crate) struct Moment {
    pub(crate) camera: Camera,
    /// Cards and sheets by stand, patch and cell of the root.
    plants: BTreeMap<(usize, PatchKey, [u32; 2]), Vec<Triangle>>,
    /// By number of the body.
    bodies: BTreeMap<u32, Vec<Triangle>>,
}

impl Moment {
    pub(crate) fn new(world: &World, behind: f64, size: [u32; 2]) -> Self {
        let view = world.camera_before(behind);
        Self { camera: Camera::new(&view, size), plants: plants(world, &view, behind), bodies: bodies(world, &view, behind) }
    }
}

fn plants(world: &World, view: &View, behind: f64) -> BTreeMap<(usize, PatchKey, [u32; 2]), Vec<Triangle>> {
    let (frame, origin) = Frame::of(world, view, behind);
    let looks = subject::looks(world);
    let mut all = BTreeMap::new();
    for (index, stand) in world.model.stands.iter().enumerate() {
        let seen = Seen { view, origin, fullness: 1.0, near: 1.0, behind };
        let share = plan::share(world);
        let (plans, fullness) = plan::plan(world, index, &seen, &looks[index], share);
        let (seen, wind) = (Seen { fullness, ..seen }, world.wind_before(stand, behind));
        for (plain, batch) in plans.iter().enumerate() {
            let uniform = PrepareUniform::new(world, stand, plain == 1, &seen, &looks[index]);
            let (cells, terrain, intervals) = (&world.state.stands[index].cells, &world.model.terrain, stand.cells / NODE_CELLS);
            let preparing = Preparing { uniform, cells, terrain, stand, wind: &wind, intervals };
            let (joints, cards) = (uniform.joints() as usize, stand.species.cards());
            for draw in &batch.draws {
                let mut solved = vec![Plant::default(); draw.count as usize];
                let mut spines = vec![[0.0; 4]; solved.len() * joints];
                preparing.prepare_patch(draw, &mut solved, &mut spines);
                for (plant, spine) in solved.iter().zip(spines.chunks_exact(joints)).filter(|(plant, _)| plant.height > 0.0) {
                    let root = [plant.root[0] - draw.offset[0], plant.root[2] - draw.offset[1]];
                    let cell = root.map(|metres| (f64::from(metres) / stand.spacing) as u32);
                    let eye = [0, 1, 2].map(|axis| (view.eye[axis] - [frame.corner[0], 0.0, frame.corner[1]][axis]) as f32);
                    all.insert((index, draw.patch, cell), triangles(plant, spine, cards, looks[index].fade, eye, &frame));
                }
            }
        }
    }
    all
}

fn placed(at: Vec3, frame: &Frame) -> DVec3 {
    at.as_dvec3() + DVec3::new(frame.corner[0], 0.0, frame.corner[1])
}

fn triangles(plant: &Plant, spine: &[[f32; 4]], cards: u32, [near, end]: [f32; 2], eye: [f32; 3], frame: &Frame) -> Vec<Triangle> {
    let away = Vec3::from(plant.root).distance(eye.into());
    let keep = 1.0 - 0.85 * smoothstep(near, end, away + (plant.tint - 0.5) * 0.3 * (end - near));
    let joint = |at: usize| Vec3::new(spine[at][0], spine[at][1], spine[at][2]);
    if cards == 0 {
        return sheet(plant, &spine.iter().map(|at| Vec3::new(at[0], at[1], at[2])).collect::<Vec<_>>(), keep, frame);
    }
    let last = spine.len() - 1;
    let mut all = Vec::new();
    for card in 0..cards {
        let turn = plant.yaw + card as f32 * std::f32::consts::PI / cards as f32;
        let corner = |at: usize, side: f32| {
            let around = [joint(0), joint(at), joint(at.saturating_sub(1)), joint((at + 1).min(last))];
            placed(rung(around, turn, plant.width, (card + 1) as f32 * at as f32, keep).corner(side), frame)
        };
        for at in 0..last {
            let [a, b, c, d] = [corner(at, -1.0), corner(at, 1.0), corner(at + 1, -1.0), corner(at + 1, 1.0)];
            all.extend([[a, b, c], [c, b, d]]);
        }
    }
    all
}

fn sheet(plant: &Plant, points: &[Vec3], keep: f32, frame: &Frame) -> Vec<Triangle> {
    let pieces = points.len().isqrt() - 1;
    let of = SheetOf { root: plant.root.into(), width: plant.width, height: plant.height, tint: plant.tint };
    let corner = |column: usize, row: usize| {
        let (side, along) = (2.0 * column as f32 / pieces as f32 - 1.0, row as f32 / pieces as f32);
        let around = Around::of(pieces, [column, row], |at| points[at]);
        placed(corner(&of, &around, [side, along], keep).place, frame)
    };
    let mut all = Vec::new();
    for row in 0..pieces {
        for column in 0..pieces {
            let [a, b] = [corner(column, row), corner(column + 1, row)];
            let [c, d] = [corner(column, row + 1), corner(column + 1, row + 1)];
            all.extend([[a, b, c], [c, b, d]]);
        }
    }
    all
}

fn bodies(world: &World, view: &View, behind: f64) -> BTreeMap<u32, Vec<Triangle>> {
    let (frame, _) = Frame::of(world, view, behind);
    let still: Vec<Option<Mesh>> = subject::meshes(world);
    let numbers: Vec<Option<usize>> = (0..still.len()).map(Some).collect();
    let draws = subject::bodies(world, &frame, &numbers);
    let triangles = |draw: &sward::picture::frame::BodyDraw| {
        let moved = subject::moved(world, draw.mesh, behind);
        let mesh = moved.as_ref().or(still[draw.mesh].as_ref()).expect("every body here has a mesh");
        let corner = |at: u32| placed(draw.transform.transform_point3(mesh.vertices[at as usize].position.into()), &frame);
        (draw.number, mesh.indices.chunks_exact(3).map(|three| [corner(three[0]), corner(three[1]), corner(three[2])]).collect())
    };
    draws.iter().map(triangles).collect()
}

/// Where a ray meets a triangle: depth along the ray, and weights of the corners. A little beyond the rim counts: corners are snapped
/// to parts of pixels when they are drawn.
fn hit(eye: DVec3, ray: DVec3, [a, b, c]: &Triangle) -> Option<(f64, DVec3)> {
    let (ab, ac) = (*b - *a, *c - *a);
    let across = ray.cross(ac);
    let area = ab.dot(across);
    let from = eye - *a;
    let (u, v) = (from.dot(across) / area, ray.dot(from.cross(ab)) / area);
    let depth = ac.dot(from.cross(ab)) / area;
    (u > -0.1 && v > -0.1 && u + v < 1.1 && depth > 0.0).then(|| (depth, DVec3::new(1.0 - u - v, u, v)))
}

/// The motion a pixel should have; `None` where nothing is at its depth, as at a triangle's rim, or where it was not drawn before.
pub(crate) fn motion(world: &World, identity: &Identity, moments: [&Moment; 2], aov: &Aov, at: usize) -> Option<DVec2> {
    seen(world, identity, moments, aov, at).map(|(motion, _)| motion)
}

/// Where a triangle is seen, twice its area in pixels, less than 0 from the other side.
fn area(camera: &Camera, triangle: &Triangle) -> f64 {
    let [a, b, c] = triangle.map(|corner| camera.project(corner).0);
    (b - a).perp_dot(c - a)
}

/// Motion, and how large the triangle there was seen before, of what it is seen now: less than 0 from the other side.
pub(crate) fn seen(world: &World, identity: &Identity, moments: [&Moment; 2], aov: &Aov, at: usize) -> Option<(DVec2, f64)> {
    let [before, now] = moments;
    let pixel = DVec2::new(f64::from(at as u32 % aov.width) + 0.5, f64::from(at as u32 / aov.width) + 0.5);
    let (depth, number) = (f64::from(aov.depth[at]), aov.plant[at]);
    let home = world.camera().focus().map(|metres| (metres / world.model.patch_side).floor() as i32);
    let (here, there) = match identity.place(number, home) {
        Some(place) => {
            let key = (place.stand, place.patch, place.cell);
            (now.plants.get(&key)?, before.plants.get(&key)?)
        }
        None if number > 0 => (now.bodies.get(&number)?, before.bodies.get(&number)?),
        None if depth.is_infinite() => return Some((before.camera.turned(now.camera.ray(pixel)) - pixel, 1.0)),
        None => return Some((before.camera.project(now.camera.point(pixel, depth)).0 - pixel, 1.0)),
    };
    if here.len() != there.len() {
        return None;
    }
    let (ray, eye) = (now.camera.ray(pixel), now.camera.eye);
    let hits = here.iter().zip(there).filter_map(|(here, there)| hit(eye, ray, here).map(|hit| (hit, here, there)));
    let ((found, weights), here, there) = hits.min_by(|a, b| (a.0.0 - depth).abs().total_cmp(&(b.0.0 - depth).abs()))?;
    if (found - depth).abs() > 1e-4 * depth {
        return None;
    }
    let point = there[0] * weights.x + there[1] * weights.y + there[2] * weights.z;
    Some((before.camera.project(point).0 - pixel, area(&before.camera, there) / area(&now.camera, here)))
}
