//! A world, drawn: prepares the visible plants and hands everything to the renderer.

use glam::{Mat3, Mat4, Vec3};
use sward::geometry::mesh::{Mesh, PAINT};
use sward::geometry::truck::truck;
use sward::interaction::Pose;
use sward::scene::{Part, Shape, Species};
use sward::shading::clump::Kind;
use sward::state::PatchKey;
use sward::view::View;
use sward::world::World;

use crate::compute::GpuStep;
use crate::compute::buffers::CellBuffers;
use crate::gpu::{Gpu, GpuError};
use crate::picture::{Picture, Renderer, Setup};
use crate::render::frame::{self, BodyDraw, FrameInput, LightInput};
use crate::render::ground::Relief;
use crate::render::plants::{Look, PlantBatch, PlantCount, PlantDraws};
use crate::render::prepare::{self, BatchBuffers, PreparePass};

/// Paints of bodies, in order, linear RGB.
const PAINTS: [[f32; 3]; 6] =
    [[0.035, 0.105, 0.16], [0.30, 0.035, 0.02], [0.45, 0.34, 0.08], [0.05, 0.13, 0.06], [0.42, 0.40, 0.36], [0.12, 0.05, 0.15]];

/// Where the cells to be drawn are.
pub enum CellsAt<'a> {
    /// In `world.state`; they are uploaded.
    Cpu,
    /// On the GPU already.
    Gpu(&'a GpuStep),
}

/// Draws a world.
pub struct Studio {
    renderer: Renderer,
    prepare: PreparePass,
    looks: Vec<Look>,
    /// Mesh of each body; `None` for a shape without one.
    meshes: Vec<Option<usize>>,
    /// Near and plain plants of each stand.
    batches: Vec<[BatchBuffers; 2]>,
    /// Cells uploaded from the CPU, per stand.
    uploaded: Vec<CellBuffers>,
}

impl Studio {
    /// Builds what stays the same from picture to picture.
    ///
    /// # Errors
    /// What the device reports.
    pub fn new(gpu: &Gpu, world: &World) -> Result<Self, GpuError> {
        let looks: Vec<Look> =
            world.scene.stands.iter().zip(&world.model.stands).map(|(stand, model)| look_of(&stand.species, model)).collect();
        let terrain = &world.model.terrain;
        let relief = Relief {
            heights: terrain.heights().to_vec(),
            columns: terrain.columns(),
            rows: terrain.rows(),
            spacing: terrain.spacing(),
            corner: terrain.corner(),
        };
        let mut renderer = Renderer::new(gpu, &Setup { relief, looks: looks.clone(), ..Setup::default() })?;
        let meshes = world.scene.interactors.iter().map(|body| mesh_of(&body.shape).map(|mesh| renderer.add_mesh(gpu, &mesh))).collect();
        let uploaded = world.model.stands.iter().map(|stand| CellBuffers::new(gpu, stand)).collect();
        let batches = world.model.stands.iter().map(|_| Default::default()).collect();
        let studio = Self { renderer, prepare: PreparePass::new(gpu, world), looks, meshes, batches, uploaded };
        gpu.check()?;
        Ok(studio)
    }

    /// Draws the world as it stands, in `size` pixels.
    ///
    /// # Errors
    /// What the device reports.
    pub fn draw(&mut self, gpu: &Gpu, world: &World, cells: CellsAt<'_>, size: [u32; 2]) -> Result<Picture, GpuError> {
        self.draw_before(gpu, world, cells, 0.0, size)
    }

    /// Draws the moment `behind` steps (0 to 1) before the state: see [`World::behind`].
    ///
    /// # Errors
    /// What the device reports.
    pub fn draw_before(&mut self, gpu: &Gpu, world: &World, cells: CellsAt<'_>, behind: f64, size: [u32; 2]) -> Result<Picture, GpuError> {
        if matches!(cells, CellsAt::Cpu) {
            for (buffers, state) in self.uploaded.iter_mut().zip(&world.state.stands) {
                buffers.reserve(gpu, state, world.model.terrain.is_flat())?;
                buffers.upload(gpu, state);
            }
        }
        let behind = behind.clamp(0.0, 1.0);
        let view = world.camera_before(behind);
        let side = world.model.patch_side;
        let origin = view.focus().map(|metres| (metres / side).floor() as i32);
        let plans = self.prepare_plants(gpu, world, &cells, (&view, behind), origin);
        let mut batches = Vec::new();
        // Near plants of all stands, then plain ones: near to far.
        for plain in 0..2 {
            for (index, plan) in plans.iter().enumerate() {
                if let Some((plants, joints)) = self.batches[index][plain].filled.as_ref().filter(|_| plan[plain] > 0) {
                    let billboard = &world.model.stands[index].species.billboard;
                    let segments = if plain == 1 { 1 } else { billboard.segments };
                    let count = PlantCount::Direct(plan[plain]);
                    batches.push(PlantBatch { plants, joints, count, segments, cards: billboard.cards, look: index, shadows: true });
                }
            }
        }
        let to_frame = Frame { corner: origin.map(|patch| f64::from(patch) * side) };
        let bodies = self.bodies(world, &to_frame, behind);
        let input = to_frame.input(world, (&view, behind), &bodies);
        self.renderer.draw(gpu, &input, &PlantDraws { batches: &batches }, size)?;
        self.renderer.read(gpu)
    }

    /// The plants of a stand in the last picture: near ones with all segments, and plain ones.
    pub fn batches(&self, stand: usize) -> Option<&[BatchBuffers; 2]> {
        self.batches.get(stand)
    }

    /// Fills the batches; returns the number of plants in each.
    fn prepare_plants(
        &mut self,
        gpu: &Gpu,
        world: &World,
        cells: &CellsAt,
        (view, behind): (&View, f64),
        origin: PatchKey,
    ) -> Vec<[u32; 2]> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let share = world.scene.budget.visible_plants / (world.model.stands.len().max(1) as u32);
        let mut filled = Vec::new();
        for (index, stand) in world.model.stands.iter().enumerate() {
            let look = &self.looks[index];
            let (plans, fullness) = prepare::plan(world, index, view, look, share, origin);
            let stored = match cells {
                CellsAt::Gpu(step) => step.cells(index).unwrap_or(&self.uploaded[index]),
                CellsAt::Cpu => &self.uploaded[index],
            };
            for (plain, batch) in plans.iter().enumerate() {
                let buffers = &mut self.batches[index][plain];
                let seen = (view, origin, fullness, behind);
                self.prepare.record(gpu, &mut encoder, world, stand, batch, plain == 1, seen, look, stored, buffers);
            }
            filled.push([plans[0].plants, plans[1].plants]);
        }
        gpu.queue.submit([encoder.finish()]);
        filled
    }

    fn bodies(&self, world: &World, frame: &Frame, behind: f64) -> Vec<BodyDraw> {
        let mut draws = Vec::new();
        for (index, mesh) in self.meshes.iter().enumerate() {
            if let (Some(mesh), Some(pose)) = (mesh, world.pose_before(index, behind)) {
                let ground = world.model.terrain.height_at(pose.ground[0], pose.ground[1]) as f32;
                draws.push(BodyDraw { mesh: *mesh, transform: frame.transform(&pose), paint: PAINTS[index % PAINTS.len()], ground });
            }
        }
        draws
    }
}

/// The frame of one picture: positions relative to the corner of the camera's patch.
struct Frame {
    corner: [f64; 2],
}

impl Frame {
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

    fn input<'a>(&self, world: &World, (view, behind): (&View, f64), bodies: &'a [BodyDraw]) -> FrameInput<'a> {
        let light = &world.scene.light;
        let (eye, target) = (self.point(view.eye), self.point(view.target));
        // Shadows are wanted where one looks, but not farther than they would be seen.
        let ahead = Vec3::new(target.x - eye.x, 0.0, target.z - eye.z).normalize_or(Vec3::Z) * 22.0;
        let at = [f64::from(eye.x + ahead.x) + self.corner[0], f64::from(eye.z + ahead.z) + self.corner[1]];
        let ground = world.model.terrain.height_at(at[0], at[1]);
        FrameInput {
            view: frame::View::looking_at(eye, target, view.field_of_view as f32),
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
            },
            bodies,
            time: world.time() - behind * world.model.dt,
        }
    }
}

/// Pictures by species, colours by the stand.
fn look_of(species: &Species, stand: &sward::response::StandModel) -> Look {
    let kind = match species {
        Species::Lawn => Kind::Lawn,
        Species::Meadow => Kind::Meadow,
        Species::Reed => Kind::Reed,
        Species::Tussock => Kind::Tussock,
    };
    let billboard = &stand.species.billboard;
    // Short plants are lost in the turf sooner.
    let gone = (275.0 * stand.species.height[1]).clamp(35.0, 110.0);
    Look { fade: [0.6 * gone, gone], root: billboard.colour_root, tip: billboard.colour_tip, dryness: billboard.dryness, ..Look::of(kind) }
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
        Shape::Compound(compound) => {
            let mut mesh = Mesh::default();
            compound.parts.iter().filter_map(part_mesh).for_each(|part| mesh.append(&part));
            mesh
        }
    })
}
