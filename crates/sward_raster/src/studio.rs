//! A world, drawn on the CPU.

use std::sync::{Arc, Mutex, PoisonError};

use sward::geometry::mesh::Mesh;
use sward::geometry::relief::Relief;
use sward::growth::Near;
use sward::picture::Picture;
use sward::picture::aov::Aov;
use sward::picture::blade_plan::{BladePlan, LEVELS};
use sward::picture::frame::{BodyDraw, FrameUniform};
use sward::picture::layers::{self, CutPlan, Origin};
use sward::picture::past::Past;
use sward::picture::plan::{self, BatchPlan, Seen};
use sward::picture::plants::Plant;
use sward::picture::prepare::{PrepareUniform, Preparing};
use sward::picture::subject::{self, Dressing, Frame, SHADOW_REACH};
use sward::picture::volume::{AmbientUniform, Lighting};
use sward::response::continuum::NODE_CELLS;
use sward::shading::look::{Look, Turf};
use sward::state::{Cells, PatchKey};
use sward::wind::WindField;
use sward::world::World;

use crate::bins::Bins;
use crate::blades::Strips;
use crate::bodies::Bodies;
use crate::clumps::Clumps;
use crate::each::each;
use crate::ground::Ground;
use crate::growing::Thinning;
use crate::layers::{CutCache, Layers};
use crate::plants::Batch;
use crate::shadows::{ShadowMap, ShadowTile};
use crate::sight::Sight;
use crate::sky;
use crate::surroundings::Surroundings;
use crate::tile::{SIDE, Tile};

/// Largest side of a picture, pixels.
const LARGEST_SIDE: u32 = 16384;

/// What bodies look like.
#[derive(Clone, Default)]
pub(crate) struct Worn {
    /// Mesh of each body.
    pub(crate) dressing: Dressing,
    meshes: Vec<Arc<Mesh>>,
}

impl Worn {
    /// The meshes; those of bodies that play a clip have `moved`.
    pub(crate) fn posed<'a>(&'a self, moved: &'a [Option<Mesh>]) -> Vec<&'a Mesh> {
        let mut meshes: Vec<&Mesh> = self.meshes.iter().map(|mesh| &**mesh).collect();
        for (mesh, moved) in self.dressing.meshes.iter().zip(moved) {
            if let (Some(mesh), Some(moved)) = (mesh, moved) {
                meshes[*mesh] = moved;
            }
        }
        meshes
    }
}

/// Draws a world.
pub struct Studio {
    pub(crate) looks: Vec<Look>,
    turf: Turf,
    pub(crate) clumps: Clumps,
    relief: Relief,
    /// What bodies look like; followed while they come and go.
    worn: Mutex<Worn>,
    /// The light of the scene's surroundings, where it has some.
    lighting: Option<Arc<Lighting>>,
    /// Cuts of plants that are meshes.
    cuts: CutCache,
    /// Share of the distance up to which every plant is drawn.
    near: f64,
}

impl Studio {
    /// Makes what stays the same from picture to picture.
    pub fn new(world: &World) -> Self {
        Self::lit(world, Lighting::of(world).map(Arc::new))
    }

    /// As [`Studio::new`], with the light of the surroundings that was worked out or stored before.
    pub fn lit(world: &World, lighting: Option<Arc<Lighting>>) -> Self {
        let looks = subject::looks(world);
        let relief = subject::relief(&world.model.terrain);
        Self {
            turf: Turf::of(&looks),
            clumps: Clumps::new(&looks),
            looks,
            relief,
            worn: Mutex::default(),
            lighting,
            cuts: CutCache::new(world),
            near: 1.0,
        }
    }

    /// From the next picture on plants grow fewer, and wider, from a `near`th (0.01 to 1) of the usual distance on: for small pictures that must come
    /// soon. Outputs beside a picture ([`Studio::draw_aov`]) always show all.
    pub fn thin(&mut self, near: f64) {
        self.near = near.clamp(0.01, 1.0);
    }

    /// Draws the world as it stands, in `size` pixels (each side is brought into 1..=16384). Cells are read from `world.state`: where a
    /// GPU steps, download them first.
    pub fn draw(&self, world: &World, size: [u32; 2]) -> Picture {
        self.draw_before(world, 0.0, size)
    }

    /// Draws the moment `behind` steps (0 to 1) before the state: see [`World::behind`].
    pub fn draw_before(&self, world: &World, behind: f64, size: [u32; 2]) -> Picture {
        self.finish(world, &self.moment(world, (behind, self.near), size, None))
    }

    /// Draws the world with its blades thinned out as `thinning` says: how little it changes the picture is how little pops when a camera
    /// moves.
    pub fn draw_thinned(&self, world: &World, thinning: Thinning, size: [u32; 2]) -> Picture {
        self.finish(world, &self.moment(world, (0.0, self.near), size, Some(thinning)))
    }

    fn finish(&self, world: &World, moment: &Moment) -> Picture {
        let shadows = self.shadow_map(world, moment);
        let sight = self.sight(world, moment, &shadows);
        self.paint(&sight, &self.layout(&sight, moment, world), moment)
    }

    /// Draws the moment `behind` steps (0 to 1) before the state, and beside the picture depth, motion and plant of each pixel. Motion
    /// leads to `past`: the moment of the picture before, or that of this one, and it is 0.
    pub fn draw_aov(&self, world: &World, past: &Past, behind: f64, size: [u32; 2]) -> (Picture, Aov) {
        let moment = self.moment(world, (behind, 1.0), size, None);
        let shadows = self.shadow_map(world, &moment);
        let sight = self.sight(world, &moment, &shadows);
        let layout = self.layout(&sight, &moment, world);
        let before = self.before(world, past, &moment);
        (self.paint(&sight, &layout, &moment), self.trace(&sight, &layout, &moment, &before))
    }

    fn sight<'a>(&'a self, world: &World, moment: &Moment, shadows: &'a ShadowMap<'a>) -> Sight<'a> {
        let surroundings = self.lighting.as_deref().map(|lighting| {
            let uniform = AmbientUniform::new(lighting, moment.frame.corner, world.scene.light.strength);
            Surroundings { lighting, uniform }
        });
        Sight::new(moment.uniform, moment.size, shadows, surroundings)
    }

    /// Everything of a picture but light and shadow.
    fn moment(&self, world: &World, (behind, near): (f64, f64), size: [u32; 2], thinning: Option<Thinning>) -> Moment {
        let size = size.map(|side| side.clamp(1, LARGEST_SIDE));
        let behind = behind.clamp(0.0, 1.0);
        let view = world.camera_before(behind);
        let (frame, origin) = Frame::of(world, &view, behind);
        let worn = self.worn_in(world);
        let draws = subject::bodies(world, &frame, &worn.dressing.meshes);
        let input = frame.input(world, &view, &draws);
        let uniform = FrameUniform::new(&input, self.relief.frame(input.origin), size, SHADOW_REACH);
        let camera = [input.view.position.x, input.view.position.z];
        let cuts = layers::plan(world, behind, size[1], &input);
        self.cuts.keep(&cuts);
        let growth = input.growth;
        let seen = Seen { view: &view, origin, fullness: 1.0, near, behind };
        let (plans, batches) = self.prepare(world, &seen);
        let (blade_plans, strips) = self.grow(world, &seen, &uniform, thinning.map(|thinning| thinning.within(&frame)));
        let moved: Vec<Option<Mesh>> = (0..worn.dressing.meshes.len()).map(|body| subject::moved(world, body, behind)).collect();
        let bodies = Bodies::new(&worn.posed(&moved), &draws);
        Moment { worn, size, frame, origin, uniform, camera, growth, plans, batches, blade_plans, strips, draws, moved, bodies, cuts }
    }

    /// What the bodies of a world look like.
    fn worn_in(&self, world: &World) -> Worn {
        // A thread that failed has left it whole: it is followed mesh by mesh.
        let mut worn = self.worn.lock().unwrap_or_else(PoisonError::into_inner);
        let Worn { dressing, meshes } = &mut *worn;
        dressing.follow(world, |number, mesh| {
            let mesh = Arc::new(mesh);
            match meshes.get_mut(number) {
                Some(place) => *place = mesh,
                None => meshes.push(mesh),
            }
        });
        worn.clone()
    }

    /// Near plants of all stands, then plain ones: near to far.
    fn prepare(&self, world: &World, seen: &Seen) -> (Vec<Drawn>, Vec<Batch>) {
        let stands = &world.model.stands;
        let share = plan::share(world);
        let plan = |index: usize| plan::plan(world, index, seen, &self.looks[index], share);
        let plans: Vec<([BatchPlan; 2], f64)> = (0..stands.len()).map(plan).collect();
        let mut drawn = Vec::new();
        for plain in [false, true] {
            for (stand, (plans, fullness)) in plans.iter().enumerate() {
                let plan = &plans[usize::from(plain)];
                if plan.plants > 0 {
                    drawn.push((Drawn { stand, plain, plan: plan.clone() }, *fullness));
                }
            }
        }
        let solve = |(drawn, fullness): &(Drawn, f64)| {
            let (stand, seen) = (&world.model.stands[drawn.stand], Seen { fullness: *fullness, ..*seen });
            let uniform = PrepareUniform::new(world, stand, drawn.plain, &seen, &self.looks[drawn.stand]);
            let cells = &world.state.stands[drawn.stand].cells;
            self.solve(world, cells, drawn.stand, &drawn.plan, uniform, &world.wind_before(stand, seen.behind))
        };
        let batches = drawn.iter().map(solve).collect();
        (drawn.into_iter().map(|(drawn, _)| drawn).collect(), batches)
    }

    /// Solves the plants of a batch of a stand, bent as `cells` say, on the ground of a world.
    pub(crate) fn solve(
        &self,
        world: &World,
        cells: &Cells,
        index: usize,
        plan: &BatchPlan,
        uniform: PrepareUniform,
        wind: &WindField,
    ) -> Batch {
        let stand = &world.model.stands[index];
        let per_plant = uniform.joints() as usize;
        let preparing = Preparing { uniform, cells, terrain: &world.model.terrain, stand, wind, intervals: stand.cells / NODE_CELLS };
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
        Batch::new(plants, joints, &self.looks[index], uniform.drawn, stand.species.cards())
    }

    fn shadow_map<'a>(&'a self, world: &'a World, moment: &'a Moment) -> ShadowMap<'a> {
        let Moment { uniform: frame, batches, bodies, .. } = moment;
        let layers = Layers::new(world, &self.cuts, &moment.cuts[1], Origin(moment.frame.corner), None);
        let layer_bins = layers.shadow_bins(frame);
        let body_bins = bodies.shadow_bins(frame);
        let bins: Vec<Bins> = batches.iter().map(|batch| batch.shadow_bins(frame)).collect();
        let blade_bins: Vec<Bins> = moment.strips().map(|strips| strips.shadow_bins(frame)).collect();
        ShadowMap::new(move |index| {
            let mut tile = ShadowTile::new(index);
            bodies.draw_shadow(frame, &mut tile, body_bins.of(index));
            for (batch, bins) in batches.iter().zip(&bins) {
                batch.draw_shadow(frame, &self.clumps, &mut tile, bins.of(index));
            }
            for (strips, bins) in moment.strips().zip(&blade_bins) {
                strips.draw_shadow(frame, &mut tile, bins.of(index));
            }
            layers.draw_shadow(frame, &mut tile, layer_bins.of(index));
            tile
        })
    }

    /// The ground's grid, and what lies in which tile.
    fn layout(&self, sight: &Sight<'_>, moment: &Moment, world: &World) -> Layout {
        let tiles = sight.size.map(|side| side.div_ceil(SIDE) as usize);
        let layers = Layers::new(world, &self.cuts, &moment.cuts[0], Origin(moment.frame.corner), Some(sight));
        Layout {
            layer_bins: layers.bins(sight, tiles),
            layers,
            tiles,
            ground: Ground::new(sight, &self.relief, world.model.terrain.edits(), moment.frame.corner, moment.camera, tiles),
            bodies: moment.bodies.bins(sight, tiles),
            batches: moment.batches.iter().map(|batch| batch.bins(sight, tiles)).collect(),
            strips: moment.strips().map(|strips| strips.bins(sight, tiles)).collect(),
        }
    }

    fn paint(&self, sight: &Sight<'_>, layout: &Layout, moment: &Moment) -> Picture {
        let [columns, rows] = layout.tiles;
        let tiles = each((0..columns * rows).collect(), |index| {
            let mut tile = Tile::new(layout.corner(index));
            // Near things first: what they hide is never shaded.
            moment.bodies.draw(sight, &mut tile, layout.bodies.of(index));
            for (batch, bins) in moment.batches.iter().zip(&layout.batches) {
                batch.draw(sight, &self.clumps, &mut tile, bins.of(index));
            }
            for (strips, bins) in moment.strips().zip(&layout.strips) {
                strips.draw(sight, &mut tile, bins.of(index));
            }
            layout.layers.draw(sight, &mut tile, layout.layer_bins.of(index));
            layout.ground.draw(sight, &self.turf, &moment.growth, &mut tile, index);
            sky::draw(sight, &mut tile);
            tile.resolve(sight.frame.forward.w).as_chunks::<4>().0.to_vec()
        });
        let [width, height] = sight.size;
        Picture { width, height, rgba8: layout.join(&tiles, sight.size, [255; 4]).into_flattened() }
    }
}

/// A batch of a picture.
pub(crate) struct Drawn {
    pub(crate) stand: usize,
    pub(crate) plain: bool,
    pub(crate) plan: BatchPlan,
}

/// Everything of a picture but light and shadow.
pub(crate) struct Moment {
    /// What bodies look like.
    pub(crate) worn: Worn,
    pub(crate) size: [u32; 2],
    pub(crate) frame: Frame,
    pub(crate) origin: PatchKey,
    uniform: FrameUniform,
    /// Ground position of the eye, m in frame space.
    camera: [f32; 2],
    /// What keeps the ground bare.
    growth: Near,
    /// What each of the batches is.
    pub(crate) plans: Vec<Drawn>,
    pub(crate) batches: Vec<Batch>,
    /// Stands of blades: which, and what was decided of them.
    pub(crate) blade_plans: Vec<(usize, BladePlan)>,
    /// Their blades.
    pub(crate) strips: Vec<[Strips; LEVELS]>,
    pub(crate) draws: Vec<BodyDraw>,
    /// Meshes of the bodies that play a clip.
    pub(crate) moved: Vec<Option<Mesh>>,
    pub(crate) bodies: Bodies,
    /// Cuts of the camera, and of the sun.
    pub(crate) cuts: [Vec<CutPlan>; 2],
}

impl Moment {
    /// All strips, near to far.
    pub(crate) fn strips(&self) -> impl Iterator<Item = &Strips> {
        (0..LEVELS).flat_map(|level| self.strips.iter().map(move |strips| &strips[level]))
    }
}

/// What lies in which tile of a picture.
pub(crate) struct Layout {
    /// Columns and rows.
    pub(crate) tiles: [usize; 2],
    pub(crate) ground: Ground,
    pub(crate) bodies: Bins,
    pub(crate) batches: Vec<Bins>,
    pub(crate) strips: Vec<Bins>,
    /// Plants that are meshes.
    pub(crate) layers: Layers,
    pub(crate) layer_bins: Bins,
}

impl Layout {
    /// First pixel of a tile.
    pub(crate) fn corner(&self, index: usize) -> [i64; 2] {
        [index % self.tiles[0], index / self.tiles[0]].map(|at| (at * SIDE as usize) as i64)
    }

    /// Puts the pixels of all tiles, each [`SIDE`]², together.
    pub(crate) fn join<T: Copy>(&self, tiles: &[Vec<T>], size: [u32; 2], empty: T) -> Vec<T> {
        let ([width, height], side) = (size.map(|side| side as usize), SIDE as usize);
        let mut all = vec![empty; width * height];
        for (index, tile) in tiles.iter().enumerate() {
            let [left, top] = self.corner(index).map(|at| at as usize);
            let across = (width - left).min(side);
            for (row, line) in tile.chunks_exact(side).enumerate().take(height - top) {
                let to = (top + row) * width + left;
                all[to..to + across].copy_from_slice(&line[..across]);
            }
        }
        all
    }
}
