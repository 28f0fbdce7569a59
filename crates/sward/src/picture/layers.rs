//! What a picture shows of stands of meshes: which cuts, how large, and their layers where they are now.
//!
//! Chen & Johan 2015, §3.2, §3.5 and §3.6; methods §5.

use glam::{DVec3, Mat3, Mat4, Vec3};

use crate::geometry::layers::{Extent, LayerDraw, NONE, across, depths};
use crate::geometry::warp::Warp;
use crate::picture::frame::{FrameInput, sun_of};
use crate::picture::identity::{Identity, number};
use crate::picture::subject::SHADOW_REACH;
use crate::response::harmonic::{LayeredStand, TOUCH_SIDE, lags};
use crate::scene::Follow;
use crate::state::{Cut, LayeredPlant, LayeredState, PlantKey};
use crate::world::World;

/// Pixels of a piece of a layer's grid, and most pieces along a side.
const PIECE: [f32; 2] = [24.0, 16.0];
/// Largest side of a texture, pixels.
const LARGEST: u32 = 4096;
/// Distance from which the sun looks at a plant, m.
const SUN: f64 = 2000.0;
/// Most layers, wood not counted.
pub const MOST_LAYERS: usize = 16;

/// Which cut of which plant a texture holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct CutKey {
    /// Stand of meshes.
    pub stand: usize,
    /// Plant.
    pub plant: PlantKey,
    /// The step of its cut; [`u64::MAX`] for the sun's.
    pub step: u64,
}

/// A cut that a picture shows.
#[derive(Clone, Debug)]
pub struct CutPlan {
    /// Which one.
    pub key: CutKey,
    /// The plant.
    pub plant: LayeredPlant,
    /// The cut.
    pub cut: Cut,
    /// Depths between its layers, m.
    pub edges: Vec<f32>,
    /// Pixels of a layer.
    pub size: [u32; 2],
    /// Layers beside and below each other in its texture.
    pub grid: [u32; 2],
    /// Its layers where they are now, the wood's last.
    pub layers: Vec<LayerDraw>,
}

impl CutPlan {
    /// Pixels of its texture.
    pub fn texture(&self) -> [u32; 2] {
        [self.size[0] * self.grid[0], self.size[1] * self.grid[1]]
    }

    /// Pixels of a piece of its grids along both sides: as many for all layers.
    pub fn pieces(&self) -> [u32; 2] {
        self.layers.first().map_or([1, 1], |layer| [layer.window[2] as u32, layer.window[3] as u32])
    }
}

/// How much of a cut is there while it takes over from another, or another from it.
#[derive(Clone, Copy)]
struct Fade {
    /// Share of what it covers, 0 to 1.
    share: f32,
    /// Whether the outputs beside the picture tell of it.
    told: bool,
}

/// Of a share that grows evenly, one that looks it: what is dark is seen most where it closes the last gap before a bright sky.
fn eased(share: f32) -> f32 {
    let share = share.min(1.0);
    share * (2.0 - share)
}

/// How a plant's mesh gets into its cut, for whoever draws it there. The same bytes in WGSL.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct CutUniform {
    /// Mesh to frame space.
    pub place: Mat4,
    /// The eye, m in frame space; w: layers, the wood's not counted.
    pub eye: [f32; 4],
    /// Unit; w: left side of the window.
    pub right: [f32; 4],
    /// Unit; w: its bottom.
    pub up: [f32; 4],
    /// Unit; w: its right side.
    pub forward: [f32; 4],
    /// Top of the window; columns and rows of the texture; the plant's tint.
    pub grid: [f32; 4],
    /// Middle of the crown, m in frame space; 1 / its radius.
    pub crown: [f32; 4],
    /// Pixels of a layer; depth of the wood's, m.
    pub size: [f32; 4],
    /// Depths between layers, m; beyond the last one infinite.
    pub edges: [[f32; 4]; 4],
    /// Depths of layers, m.
    pub depths: [[f32; 4]; 4],
}

/// A frame's origin on the ground, m, for what is drawn in it.
#[derive(Clone, Copy, Debug)]
pub struct Origin(pub [f64; 2]);

impl Origin {
    fn point(self, at: [f64; 3]) -> Vec3 {
        Vec3::new((at[0] - self.0[0]) as f32, at[1] as f32, (at[2] - self.0[1]) as f32)
    }
}

fn with(axis: Vec3, w: f32) -> [f32; 4] {
    [axis.x, axis.y, axis.z, w]
}

/// Middle depth of each layer, and of the wood: of them all.
fn middles(edges: &[f32]) -> Vec<f32> {
    let mut middles: Vec<f32> = edges.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect();
    middles.push(0.5 * (edges[0] + edges[edges.len() - 1]));
    middles
}

impl CutUniform {
    /// Of a cut in a frame.
    pub fn new(stand: &LayeredStand, plan: &CutPlan, origin: Origin) -> Self {
        let (plant, cut) = (&plan.plant, &plan.cut);
        let scale = plant.height / stand.specimen.high[1].max(1e-3);
        let extent = Extent::new(plant, stand.specimen.low, stand.specimen.high);
        let [x, z] = extent.axes;
        let root = origin.point(plant.root);
        let place = Mat4::from_translation(root) * Mat4::from_mat3(Mat3::from_cols(x * scale, Vec3::Y * scale, z * scale));
        let forward = Vec3::from(cut.forward);
        let [right, up] = across(forward);
        let middles = middles(&plan.edges);
        let count = plan.edges.len() - 1;
        let four = |list: &dyn Fn(usize) -> f32| std::array::from_fn(|row| std::array::from_fn(|column| list(4 * row + column)));
        let crown = origin.point(extent.centre.to_array());
        Self {
            place,
            eye: with(origin.point(cut.eye), count as f32),
            right: with(right, cut.window[0]),
            up: with(up, cut.window[1]),
            forward: with(forward, cut.window[2]),
            grid: [cut.window[3], plan.grid[0] as f32, plan.grid[1] as f32, plant.tint],
            crown: with(crown, 1.0 / extent.half.min_element().max(0.05)),
            size: [plan.size[0] as f32, plan.size[1] as f32, middles[count], 0.0],
            edges: four(&|k| if k + 1 < count { plan.edges[k + 1] } else { f32::MAX }),
            depths: four(&|k| middles.get(k).filter(|_| k < count).copied().unwrap_or(middles[count])),
        }
    }
}

/// Everything shown of the stands of meshes `behind` steps (0 to 1) before the state, in a picture of `rows` pixels' height: cuts of the camera, then those of
/// the sun, where it throws shadows.
pub fn plan(world: &World, behind: f64, rows: u32, input: &FrameInput<'_>) -> [Vec<CutPlan>; 2] {
    let (sun, origin) = (sun_of(&input.light), Origin(input.origin));
    let eye = input.view.position.as_dvec3() + DVec3::new(input.origin[0], 0.0, input.origin[1]);
    let focus = [0, 1].map(|axis| f64::from(input.focus[2 * axis]) + input.origin[axis]);
    let mut plans: [Vec<CutPlan>; 2] = Default::default();
    for (index, (stand, state)) in world.model.layered.iter().zip(&world.state.layered).enumerate() {
        let part = Part { world, index, stand, state, behind, origin, identity: Identity::of(world) };
        let fade = f64::from(stand.layers().fade) / world.model.dt;
        for (key, cuts) in &state.cuts {
            let Some(plant) = state.plant(*key) else { continue };
            let age = world.state.step.saturating_sub(cuts.now.step) as f64 - behind;
            let time = if cuts.before.is_some() { (age / fade.max(1e-3)).clamp(0.0, 1.0) as f32 } else { 1.0 };
            let scale = rows as f32 / 1080.0;
            // First the newer cut appears among the older one's leaves, then that one vanishes.
            if time > 0.0 {
                plans[0].push(part.cut(plant, cuts.now, scale, Fade { share: eased(2.0 * time), told: time >= 0.5 }));
            }
            if let Some(before) = cuts.before.filter(|_| time < 1.0) {
                plans[0].push(part.cut(plant, before, scale, Fade { share: eased(2.0 - 2.0 * time), told: time < 0.5 }));
            }
        }
        for plant in state.near.values().flatten() {
            let extent = Extent::new(plant, stand.specimen.low, stand.specimen.high);
            let off = [plant.root[0] - focus[0], plant.root[2] - focus[1]].map(|metres| metres.abs() as f32);
            // What is left out for its distance throws no shadow, either.
            let shown = (extent.centre - eye).length() as f32 - extent.radius() < stand.layers().distance;
            if shown && off[0].max(off[1]) < SHADOW_REACH + extent.radius() {
                plans[1].push(part.cut(plant, suns(&extent, sun), 1.0, Fade { share: 1.0, told: true }));
            }
        }
    }
    fit(&mut plans, f64::from(world.scene.budget.layer_pixels) * 1e6);
    plans
}

/// The layers of a cut as they were `behind` steps before the state of another moment's world, in the frame of this one.
pub fn then(world: &World, behind: f64, plan: &CutPlan, origin: Origin) -> Vec<LayerDraw> {
    let (Some(stand), Some(state)) = (world.model.layered.get(plan.key.stand), world.state.layered.get(plan.key.stand)) else {
        return plan.layers.clone();
    };
    let part = Part { world, index: plan.key.stand, stand, state, behind, origin, identity: Identity::of(world) };
    let first = plan.layers.first().copied().unwrap_or_default();
    let pieces = [first.window[2], first.window[3]];
    part.layers(&plan.plant, &plan.cut, &plan.edges, plan.grid, pieces, Fade { share: first.forward[3], told: first.which[1] != 0 })
}

/// A plant as the sun sees it.
fn suns(extent: &Extent, sun: Vec3) -> Cut {
    let eye = extent.centre + sun.as_dvec3() * SUN;
    let forward = -sun;
    let [right, up] = across(forward);
    let [x, y] = [right, up].map(|axis| 1.02 * extent.along(axis) / SUN as f32);
    // As fine as the shadow map.
    let pixels = SUN as f32 * crate::picture::frame::SHADOW_SIDE as f32 / (2.0 * SHADOW_REACH);
    Cut { eye: eye.to_array(), forward: forward.to_array(), window: [-x, -y, x, y], pixels, layers: [1, 0, 0], step: u64::MAX }
}

/// Makes textures smaller until all of them fit.
fn fit(plans: &mut [Vec<CutPlan>; 2], most: f64) {
    let pixels = |plan: &CutPlan| plan.texture().map(f64::from).iter().product::<f64>();
    let all: f64 = plans.iter().flatten().map(pixels).sum();
    if all > most {
        let share = (most / all).sqrt();
        for plan in plans.iter_mut().flatten() {
            plan.size = plan.size.map(|side| ((f64::from(side) * share) as u32).max(1));
        }
    }
}

/// A stand in a picture.
struct Part<'a> {
    world: &'a World,
    index: usize,
    stand: &'a LayeredStand,
    state: &'a LayeredState,
    behind: f64,
    origin: Origin,
    identity: Identity,
}

impl Part<'_> {
    fn cut(&self, plant: &LayeredPlant, cut: Cut, scale: f32, fade: Fade) -> CutPlan {
        let extent = Extent::new(plant, self.stand.specimen.low, self.stand.specimen.high);
        let edges = depths(&cut, &extent, self.stand.layers().bands);
        let count = edges.len() as u32;
        let across = (count as f32).sqrt().ceil() as u32;
        let grid = [across, count.div_ceil(across)];
        let wide = [0, 1].map(|axis| (cut.window[axis + 2] - cut.window[axis]) * cut.pixels * scale);
        let most = [0, 1].map(|axis| (LARGEST / grid[axis]) as f32 / wide[axis].max(1.0)).into_iter().fold(1.0, f32::min);
        let size = wide.map(|pixels| ((pixels * most).ceil() as u32).clamp(2, LARGEST));
        let pieces = wide.map(|pixels| (pixels / PIECE[0]).ceil().clamp(1.0, PIECE[1]));
        let key = CutKey { stand: self.index, plant: plant.key, step: cut.step };
        let layers = self.layers(plant, &cut, &edges, grid, pieces, fade);
        CutPlan { key, plant: *plant, cut, edges, size, grid, layers }
    }

    fn layers(&self, plant: &LayeredPlant, cut: &Cut, edges: &[f32], grid: [u32; 2], pieces: [f32; 2], fade: Fade) -> Vec<LayerDraw> {
        let (stand, state, world) = (self.stand, self.state, self.world);
        let (model, look) = (&stand.harmonic, stand.layers());
        let forward = Vec3::from(cut.forward);
        let [right, up] = across(forward);
        let middles = middles(edges);
        let count = edges.len() - 1;
        let from_first: Vec<f32> = middles[..count].iter().map(|depth| depth - middles[0]).collect();
        let deepest = from_first[count - 1];
        let away = Vec3::new(state.drift[0], 0.0, state.drift[1]).dot(forward);
        let lags = lags(&from_first, away);
        let side = f64::from(model.cells) * f64::from(model.cell);
        let along = plant.root[0] * f64::from(model.axes.right[0]) + plant.root[2] * f64::from(model.axes.right[2]);
        let place = (along.rem_euclid(side) / f64::from(model.cell)) as f32;
        let area = model.cells * model.cells;
        let touch = state.pool.place(plant.key).map_or(NONE, |slot| slot * TOUCH_SIDE * TOUCH_SIDE);
        let layer = |k: usize| {
            let wood = k == count;
            let depth = if count > 1 && !wood { from_first[k] / deepest.max(1e-6) } else { 0.0 };
            let warp = Warp::new(look.scale, look.loss, depth, look.rigidity);
            let lag = if wood { 0.0 } else { lags[k] };
            let (ago, back) = match look.follow {
                Follow::Record => (lag, 0.0),
                Follow::LookUp => (0.0, lag * model.speed / model.cell),
                Follow::AtOnce => (0.0, 0.0),
            };
            let moment = model.ring.moment(world.state.step, (f64::from(ago) / world.model.dt + self.behind) as f32);
            let [column, row] = [k as u32 % grid[0], k as u32 / grid[0]].map(|at| at as f32);
            let cell = [1.0 / grid[0] as f32, 1.0 / grid[1] as f32];
            let [sx, sy, sz] = if wood { [0.0; 3] } else { warp.scale };
            LayerDraw {
                eye: with(self.origin.point(cut.eye), middles[k]),
                right: with(right, cut.window[0]),
                up: with(up, cut.window[1]),
                forward: with(forward, fade.share),
                window: [cut.window[2], cut.window[3], pieces[0], pieces[1]],
                cell: [column * cell[0], row * cell[1], cell[0], cell[1]],
                root: with(self.origin.point(plant.root), plant.height),
                plane: with(Vec3::from(model.axes.right), place),
                scale: [sx, sy, sz, warp.rigidity],
                cells: [1.0 / model.cell, 1.0 / model.touch_cell, moment.share, back],
                notes: [moment.notes[0] * area, moment.notes[1] * area, touch, model.cells],
                which: [self.number(plant), fade.told.into(), k as u32, u32::from(!wood)],
            }
        };
        (0..=count).map(layer).collect()
    }

    /// Number of a plant in outputs beside pictures.
    fn number(&self, plant: &LayeredPlant) -> u32 {
        number(self.identity.of_stand(self.world.model.stands.len() + self.index), plant.key.0, plant.key.1)
    }
}
