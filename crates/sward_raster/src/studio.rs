//! A world, drawn on the CPU.

use std::borrow::Cow;

use sward::geometry::mesh::Mesh;
use sward::geometry::relief::Relief;
use sward::picture::Picture;
use sward::picture::frame::{FrameInput, FrameUniform};
use sward::picture::plan::{self, BatchPlan, Seen};
use sward::picture::plants::Plant;
use sward::picture::prepare::{PrepareUniform, Preparing};
use sward::picture::subject::{self, Frame, SHADOW_REACH};
use sward::response::continuum::NODE_CELLS;
use sward::shading::look::{Look, Turf};
use sward::world::World;

use crate::bins::Bins;
use crate::bodies::Bodies;
use crate::clumps::Clumps;
use crate::each::each;
use crate::ground::Ground;
use crate::plants::Batch;
use crate::shadows::{ShadowMap, ShadowTile, TILES};
use crate::sight::Sight;
use crate::sky;
use crate::tile::{SIDE, Tile};

/// Largest side of a picture, pixels.
const LARGEST_SIDE: u32 = 16384;

/// Draws a world.
pub struct Studio {
    looks: Vec<Look>,
    turf: Turf,
    clumps: Clumps,
    relief: Relief,
    meshes: Vec<Mesh>,
    /// Mesh of each body; `None` for a shape without one.
    mesh_of: Vec<Option<usize>>,
}

impl Studio {
    /// Makes what stays the same from picture to picture.
    pub fn new(world: &World) -> Self {
        let looks = subject::looks(world);
        let (mut meshes, mut mesh_of) = (Vec::new(), Vec::new());
        for mesh in subject::meshes(world) {
            mesh_of.push(mesh.map(|mesh| {
                meshes.push(mesh);
                meshes.len() - 1
            }));
        }
        let relief = subject::relief(&world.model.terrain);
        Self { turf: Turf::of(&looks), clumps: Clumps::new(&looks), looks, relief, meshes, mesh_of }
    }

    /// Draws the world as it stands, in `size` pixels (each side is brought into 1..=16384). Cells are read from `world.state`: where a
    /// GPU steps, download them first.
    pub fn draw(&self, world: &World, size: [u32; 2]) -> Picture {
        self.draw_before(world, 0.0, size)
    }

    /// Draws the moment `behind` steps (0 to 1) before the state: see [`World::behind`].
    pub fn draw_before(&self, world: &World, behind: f64, size: [u32; 2]) -> Picture {
        let size = size.map(|side| side.clamp(1, LARGEST_SIDE));
        let behind = behind.clamp(0.0, 1.0);
        let view = world.camera_before(behind);
        let (frame, origin) = Frame::of(world, &view, behind);
        let draws = subject::bodies(world, &frame, &self.mesh_of);
        let input = frame.input(world, &view, &draws);
        let uniform = FrameUniform::new(&input, self.relief.frame(input.origin), size, SHADOW_REACH);
        let batches = self.prepare(world, &Seen { view: &view, origin, fullness: 1.0, behind });
        // Bodies that play a clip have moved.
        let mut meshes: Vec<Cow<'_, Mesh>> = self.meshes.iter().map(Cow::Borrowed).collect();
        for (index, mesh) in self.mesh_of.iter().enumerate() {
            if let (Some(mesh), Some(moved)) = (mesh, subject::moved(world, index, behind)) {
                meshes[*mesh] = Cow::Owned(moved);
            }
        }
        let bodies = Bodies::new(&meshes, &draws);
        let shadows = self.shadow_map(&uniform, &batches, &bodies);
        let sight = Sight::new(uniform, size, &shadows);
        self.paint(&sight, &input, &batches, &bodies)
    }

    /// Near plants of all stands, then plain ones: near to far.
    fn prepare(&self, world: &World, seen: &Seen) -> Vec<Batch> {
        let stands = &world.model.stands;
        let share = world.scene.budget.visible_plants / (stands.len().max(1) as u32);
        let plan = |index: usize| plan::plan(world, index, seen, &self.looks[index], share);
        let plans: Vec<([BatchPlan; 2], f64)> = (0..stands.len()).map(plan).collect();
        let mut batches = Vec::new();
        for plain in [false, true] {
            for (index, (plans, fullness)) in plans.iter().enumerate() {
                let plan = &plans[usize::from(plain)];
                if plan.plants > 0 {
                    batches.push(self.solve(world, index, plan, plain, &Seen { fullness: *fullness, ..*seen }));
                }
            }
        }
        batches
    }

    fn solve(&self, world: &World, index: usize, plan: &BatchPlan, plain: bool, seen: &Seen) -> Batch {
        let stand = &world.model.stands[index];
        let uniform = PrepareUniform::new(world, stand, plain, seen, &self.looks[index]);
        let per_plant = uniform.drawn as usize + 1;
        let wind = world.wind_before(stand, seen.behind);
        let preparing = Preparing {
            uniform,
            cells: &world.state.stands[index].cells,
            terrain: &world.model.terrain,
            stand,
            wind: &wind,
            intervals: stand.cells / NODE_CELLS,
        };
        let mut plants = vec![Plant::default(); plan.plants as usize];
        let mut joints = vec![[0.0; 4]; plants.len() * per_plant];
        let (mut rest, mut rest_joints) = (&mut plants[..], &mut joints[..]);
        let mut tasks = Vec::new();
        for draw in &plan.draws {
            let count = (draw.count as usize).min(rest.len());
            let (own, others) = rest.split_at_mut(count);
            let (own_joints, other_joints) = rest_joints.split_at_mut(count * per_plant);
            tasks.push((draw, own, own_joints));
            (rest, rest_joints) = (others, other_joints);
        }
        each(tasks, |(draw, plants, joints)| preparing.prepare_patch(draw, plants, joints));
        let billboard = &stand.species.billboard;
        Batch::new(plants, joints, &self.looks[index], uniform.drawn, billboard.cards)
    }

    fn shadow_map(&self, frame: &FrameUniform, batches: &[Batch], bodies: &Bodies) -> ShadowMap {
        let body_bins = bodies.shadow_bins(frame);
        let bins: Vec<Bins> = batches.iter().map(|batch| batch.shadow_bins(frame)).collect();
        let tiles = each((0..TILES * TILES).collect(), |index| {
            let mut tile = ShadowTile::new(index);
            bodies.draw_shadow(frame, &mut tile, body_bins.of(index));
            for (batch, bins) in batches.iter().zip(&bins) {
                batch.draw_shadow(frame, &self.clumps, &mut tile, bins.of(index));
            }
            tile
        });
        ShadowMap::new(tiles)
    }

    fn paint(&self, sight: &Sight<'_>, input: &FrameInput<'_>, batches: &[Batch], bodies: &Bodies) -> Picture {
        let [width, height] = sight.size;
        let [columns, rows] = sight.size.map(|side| side.div_ceil(SIDE) as usize);
        let ground = Ground::new(sight, &self.relief, input, [columns, rows]);
        let body_bins = bodies.bins(sight, [columns, rows]);
        let bins: Vec<Bins> = batches.iter().map(|batch| batch.bins(sight, [columns, rows])).collect();
        let tiles = each((0..columns * rows).collect(), |index| {
            let mut tile = Tile::new([index % columns, index / columns].map(|at| (at * SIDE as usize) as i64));
            // Near things first: what they hide is never shaded.
            bodies.draw(sight, &mut tile, body_bins.of(index));
            for (batch, bins) in batches.iter().zip(&bins) {
                batch.draw(sight, &self.clumps, &mut tile, bins.of(index));
            }
            ground.draw(sight, &self.turf, &input.growth, &mut tile, index);
            sky::draw(sight, &mut tile);
            tile.resolve(sight.frame.forward.w)
        });
        let mut rgba8 = vec![255; 4 * width as usize * height as usize];
        for (index, tile) in tiles.iter().enumerate() {
            let [left, top] = [index % columns, index / columns].map(|at| at * SIDE as usize);
            let across = (width as usize - left).min(SIDE as usize);
            for (row, line) in tile.chunks_exact(4 * SIDE as usize).enumerate().take(height as usize - top) {
                let to = 4 * ((top + row) * width as usize + left);
                rgba8[to..to + 4 * across].copy_from_slice(&line[..4 * across]);
            }
        }
        Picture { width, height, rgba8 }
    }
}
