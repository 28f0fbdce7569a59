//! What a picture of a world shows: looks of its stands, meshes of its bodies, and where all that is at this moment.

use glam::{Mat3, Mat4, Vec3};

use super::frame::{self, BodyDraw, FrameInput, LightInput};
use crate::geometry::figure::figure_mesh;
use crate::geometry::mesh::{Mesh, PAINT};
use crate::geometry::relief::Relief;
use crate::geometry::truck::truck;
use crate::growth::{Limit, MOST_RECORDS, Near};
use crate::interaction::Pose;
use crate::response::StandModel;
use crate::scene::{Part, Shape, Species};
use crate::shading::clump::Kind;
use crate::shading::look::Look;
use crate::state::PatchKey;
use crate::terrain::Terrain;
use crate::view::View;
use crate::world::World;

/// Paints of bodies, in order, linear RGB.
const PAINTS: [[f32; 3]; 6] =
    [[0.035, 0.105, 0.16], [0.30, 0.035, 0.02], [0.45, 0.34, 0.08], [0.05, 0.13, 0.06], [0.42, 0.40, 0.36], [0.12, 0.05, 0.15]];

/// Half side of the square around the focus that casts shadows, metres.
pub const SHADOW_REACH: f32 = 36.0;

/// Farther off than this, m, bare ground is not told from the rest: the air hides it.
const BARE_SEEN: f64 = 4000.0;

/// How each stand of a world looks.
pub fn looks(world: &World) -> Vec<Look> {
    world.model.stands.iter().map(|model| look_of(&world.scene.stands[model.index].species, model)).collect()
}

/// The mesh of each body; `None` for a shape without one.
pub fn meshes(world: &World) -> Vec<Option<Mesh>> {
    (0..world.model.bodies.len()).map(|body| mesh(world, body)).collect()
}

/// The mesh of a body; `None` for a shape without one, and where a body has been removed.
pub fn mesh(world: &World, body: usize) -> Option<Mesh> {
    if world.state.vacant.contains(&(body as u32)) {
        return None;
    }
    match &world.model.bodies.get(body)?.figure {
        Some(figure) => Some(figure_mesh(figure, 0.0)),
        None => mesh_of(&world.scene.interactors.get(body)?.shape),
    }
}

/// Which mesh belongs to each body, while bodies come and go. Bodies of one shape share a mesh, unless they play a clip.
#[derive(Clone, Debug, Default)]
pub struct Dressing {
    /// Number of each body's mesh; `None` for a shape without one.
    pub meshes: Vec<Option<usize>>,
    /// Serial number of each body, its shape, and whether it plays a clip.
    known: Vec<(u64, u64, bool)>,
}

impl Dressing {
    /// Follows the bodies of a world; `put` gets the number of each mesh that is new or another, and the mesh.
    pub fn follow(&mut self, world: &World, mut put: impl FnMut(usize, Mesh)) {
        let now = world.model.bodies.iter().map(|body| (body.serial, body.shape, body.is_animated()));
        if now.clone().eq(self.known.iter().copied()) {
            return;
        }
        let now: Vec<_> = now.collect();
        self.meshes.resize(now.len(), None);
        let mut fresh = Vec::new();
        for (body, wanted) in now.iter().enumerate() {
            if self.known.get(body) != Some(wanted) {
                self.meshes[body] = None;
                fresh.push(body);
            }
        }
        for body in fresh {
            let (_, shape, moves) = now[body];
            let alike = |other: &usize| self.meshes[*other].is_some() && !moves && now[*other].1 == shape && !now[*other].2;
            self.meshes[body] = match (0..now.len()).find(alike) {
                Some(other) if mesh_is_there(world, body) => self.meshes[other],
                _ => mesh(world, body).map(|mesh| {
                    let free = (0..).find(|number| !self.meshes.contains(&Some(*number))).unwrap_or_default();
                    put(free, mesh);
                    free
                }),
            };
        }
        self.known = now;
    }
}

fn mesh_is_there(world: &World, body: usize) -> bool {
    !world.state.vacant.contains(&(body as u32))
}

/// The mesh of a body that plays a clip, `behind` steps before the state; `None` for others, and while it is away.
pub fn moved(world: &World, body: usize, behind: f64) -> Option<Mesh> {
    let (model, state) = (world.model.bodies.get(body)?, world.state.bodies.get(body)?);
    let figure = model.figure.as_ref().filter(|_| model.is_animated() && state.pose.is_some())?;
    let [before, now] = state.clock;
    Some(figure_mesh(figure, now + (before - now) * behind))
}

/// The ground's shape.
pub fn relief(terrain: &Terrain) -> Relief {
    Relief {
        heights: terrain.heights().to_vec(),
        columns: terrain.columns(),
        rows: terrain.rows(),
        spacing: terrain.spacing(),
        corner: terrain.corner(),
        detail: *terrain.detail(),
    }
}

/// The bodies that are there; `meshes` has the number of each body's mesh.
pub fn bodies(world: &World, frame: &Frame, meshes: &[Option<usize>]) -> Vec<BodyDraw> {
    let mut draws = Vec::new();
    for (index, mesh) in meshes.iter().enumerate() {
        if let (Some(mesh), Some(pose)) = (mesh, world.pose_before(index, frame.behind)) {
            let ground = world.model.terrain.height_at(pose.ground[0], pose.ground[1]) as f32;
            let transform = frame.transform(&pose);
            let paint = world.scene.interactors.get(index).and_then(|body| body.colour).unwrap_or(PAINTS[index % PAINTS.len()]);
            draws.push(BodyDraw { mesh: *mesh, transform, paint, ground, number: index as u32 + 1 });
        }
    }
    draws
}

/// The frame of one picture: positions relative to the corner of the camera's patch.
pub struct Frame {
    /// Ground position (x, z) of the frame origin, m.
    pub corner: [f64; 2],
    /// Steps, 0 to 1, that the picture lies before the state.
    pub behind: f64,
}

impl Frame {
    /// The frame whose origin is the corner of the patch the view stands in, and that patch.
    pub fn of(world: &World, view: &View, behind: f64) -> (Self, PatchKey) {
        let side = world.model.patch_side;
        let origin = view.focus().map(|metres| (metres / side).floor() as i32);
        (Self { corner: origin.map(|patch| f64::from(patch) * side), behind }, origin)
    }

    fn point(&self, at: [f64; 3]) -> Vec3 {
        Vec3::new((at[0] - self.corner[0]) as f32, at[1] as f32, (at[2] - self.corner[1]) as f32)
    }

    /// Body to frame: standing on its base plane, facing its yaw.
    fn transform(&self, pose: &Pose) -> Mat4 {
        let up = Vec3::new(-pose.slope[0] as f32, 1.0, -pose.slope[1] as f32).normalize();
        let (sine, cosine) = (pose.yaw.sin() as f32, pose.yaw.cos() as f32);
        let left = Vec3::new(cosine, 0.0, -sine);
        let forward = left.cross(up).normalize_or(Vec3::Z);
        let axes = Mat3::from_cols(up.cross(forward), up, forward);
        Mat4::from_translation(self.point([pose.ground[0], pose.height, pose.ground[1]])) * Mat4::from_mat3(axes)
    }

    /// What keeps the ground in sight bare, nearest first if it is more than a picture can show.
    fn growth(&self, world: &World, eye: Vec3) -> Near {
        let limits = &world.model.limits;
        let at = [self.corner[0] + f64::from(eye.x), self.corner[1] + f64::from(eye.z)];
        let away = |limit: &Limit| {
            // What limits growth outside its picture too is everywhere.
            if limit.outside < 1.0 {
                return 0.0;
            }
            let [low, high] = limit.outline.bounds();
            let off = [0, 1].map(|axis| (low[axis] - at[axis]).max(at[axis] - high[axis]).max(0.0));
            off[0].hypot(off[1])
        };
        let mut shown: Vec<(usize, f64)> = limits.iter().map(|limit| away(limit)).enumerate().collect();
        shown.retain(|(_, away)| *away < BARE_SEEN);
        shown.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
        shown.truncate(MOST_RECORDS);
        // In the scene's order: the last one lies on top.
        shown.sort_by_key(|(index, _)| *index);
        let seen = [f64::from(eye.x), f64::from(eye.z)];
        let square = [seen.map(|at| at - BARE_SEEN), seen.map(|at| at + BARE_SEEN)];
        Near::of(shown.iter().map(|(index, _)| &*limits[*index]), self.corner, square)
    }

    /// A camera in this frame.
    pub fn view(&self, view: &View) -> frame::View {
        frame::View::looking_at(self.point(view.eye), self.point(view.target), view.field_of_view as f32)
    }

    /// Everything of the picture but its plants.
    pub fn input<'a>(&self, world: &'a World, view: &View, bodies: &'a [BodyDraw]) -> FrameInput<'a> {
        let light = &world.scene.light;
        let (eye, target) = (self.point(view.eye), self.point(view.target));
        // Shadows are wanted where one looks, but not farther than they would be seen.
        let ahead = Vec3::new(target.x - eye.x, 0.0, target.z - eye.z).normalize_or(Vec3::Z) * 22.0;
        let at = [f64::from(eye.x + ahead.x) + self.corner[0], f64::from(eye.z + ahead.z) + self.corner[1]];
        let ground = world.model.terrain.height_at(at[0], at[1]);
        FrameInput {
            view: self.view(view),
            origin: self.corner,
            focus: self.point([at[0], ground, at[1]]),
            light: LightInput {
                azimuth: light.azimuth,
                elevation: light.elevation,
                strength: light.strength,
                haze: light.haze,
                fog: light.fog,
                exposure: light.exposure,
                clouds: light.clouds,
                water: light.water,
                surroundings: world
                    .model
                    .environment
                    .as_ref()
                    .map(|environment| (environment.light(light.strength, light.azimuth, light.elevation), environment.exposure())),
            },
            bodies,
            time: world.time() - self.behind * world.model.dt,
            terrain: &world.model.terrain,
            growth: self.growth(world, eye),
        }
    }
}

/// Pictures by species, colours by the stand.
fn look_of(species: &Species, stand: &StandModel) -> Look {
    let kind = match species {
        Species::Lawn => Kind::Lawn,
        Species::Meadow | Species::Shrub | Species::Tree | Species::WaterPlant => Kind::Meadow,
        Species::Reed => Kind::Reed,
        Species::Tussock => Kind::Tussock,
    };
    let billboard = &stand.species.billboard;
    let (root, tip, dryness) = match (&stand.species.blade, &stand.species.sheet) {
        (Some(blade), _) => (blade.colour_root, blade.colour_tip, blade.dryness),
        (_, Some(sheet)) => (sheet.colour_root, sheet.colour_tip, sheet.dryness),
        _ => (billboard.colour_root, billboard.colour_tip, billboard.dryness),
    };
    // Short plants are lost in the turf sooner.
    let gone = match &stand.species.blade {
        Some(blade) => blade.distance,
        None => (275.0 * stand.species.height[1]).clamp(35.0, 110.0),
    };
    Look { fade: [0.6 * gone, gone], root, tip, dryness, ..Look::of(kind) }
}

fn part_mesh(part: &Part) -> Option<Mesh> {
    let mut mesh = mesh_of(&part.shape)?;
    let turn = Mat3::from_rotation_y(part.yaw);
    for vertex in &mut mesh.vertices {
        vertex.position = (turn * Vec3::from(vertex.position) + Vec3::from(part.offset)).to_array();
        vertex.normal = (turn * Vec3::from(vertex.normal)).to_array();
    }
    Some(mesh)
}

/// The mesh of a shape, its lowest point at 0.
fn mesh_of(shape: &Shape) -> Option<Mesh> {
    let round = |radii: [f32; 3]| {
        let mut mesh = Mesh::ellipsoid(Vec3::from(radii), 24, PAINT);
        mesh.vertices.iter_mut().for_each(|vertex| vertex.position[1] += radii[1]);
        mesh
    };
    Some(match shape {
        Shape::Box(block) => Mesh::cuboid(Vec3::from(block.size), 0.04, PAINT),
        Shape::Sphere(sphere) => round([sphere.radius; 3]),
        Shape::Ellipsoid(body) => round(body.radii),
        Shape::Polygon(polygon) => Mesh::prism(&polygon.points.iter().map(|p| (*p).into()).collect::<Vec<_>>(), polygon.height, PAINT),
        Shape::Truck => truck(),
        // Comes from its file.
        Shape::Mesh(_) => return None,
        Shape::Compound(compound) => {
            let mut mesh = Mesh::default();
            compound.parts.iter().filter_map(part_mesh).for_each(|part| mesh.append(&part));
            mesh
        }
    })
}
