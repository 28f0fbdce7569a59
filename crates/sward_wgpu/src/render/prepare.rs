//! Prepare: which patches are drawn, with how many plants, and the pass that solves each visible plant once.
//!
//! Memory depends on `budget.visible_plants`, never on the field: patches are drawn in an even order that may be cut anywhere.

use bytemuck::{Pod, Zeroable};
use sward::placement::PlacementParameters;
use sward::response::StandModel;
use sward::shading::clump::{VARIANTS, first_layer};
use sward::state::{NONE, PatchKey, StandState, TILE};
use sward::terrain::{TerrainAnchor, TerrainGrid};
use sward::view::View;
use sward::world::World;
use wgpu::util::DeviceExt;

use super::plants::{Look, PLANTS_PER_INSTANCE};
use crate::compute::buffers::CellBuffers;
use crate::gpu::Gpu;

/// Every plant is drawn up to this many cells away; then fewer and wider ones.
const FULL_CELLS: f32 = 104.0;
/// How fast they grow fewer with distance.
const THINNING: f32 = 1.25;

/// `Prepare` of `prepare.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct PrepareUniform {
    /// Where plants stand.
    pub placement: PlacementParameters,
    /// The terrain's samples.
    pub grid: TerrainGrid,
    /// Eye, m from the frame origin; the fourth is not used.
    pub camera: [f32; 4],
    /// Segments of the simulation.
    pub segments: u32,
    /// Segments of the cards.
    pub drawn: u32,
    /// The drawing order covers 2^bits cells a side.
    pub bits: u32,
    /// First clump picture.
    pub layer: u32,
    /// Distance beyond which plants are straight, m; 0 where all are plain anyway.
    pub plain: f32,
    /// Distance up to which every plant is drawn, m.
    pub full: f32,
    /// Distance beyond which none is, m.
    pub gone: f32,
    /// Width of a card, m.
    pub width: f32,
    /// k_w.
    pub wind_response: f32,
    /// Share of plants drawn up to `full`.
    pub fullness: f32,
    /// Steps, 0 to 1, that the picture lies before the state.
    pub behind: f32,
    /// Substeps of the wave: the time level before is one of them ago.
    pub substeps: f32,
    /// Gains of `billboard_earlier`.
    pub lag: [f32; 4],
}

/// `PatchDraw` of `prepare.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct PatchDraw {
    /// Patch corner, m from the frame origin.
    pub offset: [f32; 2],
    /// Which patch.
    pub patch: [i32; 2],
    /// Its corner among the terrain's samples.
    pub anchor: TerrainAnchor,
    /// How far cells rule over β_eq at the corners (−−, +−, −+, ++).
    pub weights: [f32; 4],
    /// Slots of the 3×3 patches around it, or none.
    pub slots: [u32; 9],
    /// Lag slots likewise.
    pub lags: [u32; 9],
    /// First plant of this patch in the output.
    pub first: u32,
    /// Places of the drawing order it may fill.
    pub count: u32,
}

/// The patches of one batch: same stand, same number of drawn segments.
#[derive(Debug, Default)]
pub struct BatchPlan {
    /// Near to far.
    pub draws: Vec<PatchDraw>,
    /// Plants in all.
    pub plants: u32,
}

/// A patch in sight.
struct Sighted {
    patch: PatchKey,
    /// Distance from the eye to the nearest point of it on the ground, m.
    distance: f64,
}

/// The full text of the compute shader.
pub fn assembled() -> String {
    let variants = format!("const CLUMP_VARIANTS: u32 = {VARIANTS}u;\nconst PREPARE_THINNING: f32 = {THINNING:?};");
    [
        sward::math::WGSL,
        sward::wind::WGSL,
        sward::terrain::WGSL,
        sward::placement::WGSL,
        sward::geometry::billboard::WGSL,
        &variants,
        include_str!("prepare.wgsl"),
    ]
    .join("\n")
}

fn sighted(world: &World, view: &View, gone: f64) -> Vec<Sighted> {
    let side = world.model.patch_side;
    let home = view.focus().map(|metres| (metres / side).floor() as i32);
    let reach = (gone / side).ceil() as i32 + 1;
    let mut list = Vec::new();
    for z in -reach..=reach {
        for x in -reach..=reach {
            let patch = [home[0].saturating_add(x), home[1].saturating_add(z)];
            let outside = |axis: usize| {
                let low = f64::from(patch[axis]) * side;
                (low - view.focus()[axis]).max(view.focus()[axis] - low - side).max(0.0)
            };
            let distance = outside(0).hypot(outside(1));
            let inside =
                world.model.field.is_none_or(|[low, high]| (0..2).all(|axis| patch[axis] >= low[axis] && patch[axis] < high[axis]));
            if distance < gone && inside && view.sees(patch, side) {
                list.push(Sighted { patch, distance });
            }
        }
    }
    list.sort_by(|a, b| a.distance.total_cmp(&b.distance).then(a.patch.cmp(&b.patch)));
    list
}

/// Share of plants drawn at a distance, m: the CPU side of `thin` in `prepare.wgsl`.
fn thin(distance: f64, fullness: f64, spacing: f64) -> f64 {
    (f64::from(FULL_CELLS) * spacing / distance.max(1e-3)).powf(f64::from(THINNING)).min(1.0) * fullness
}

fn bits(cells: u32) -> u32 {
    cells.next_power_of_two().trailing_zeros()
}

/// Places a patch needs, a whole number of instances.
fn places(distance: f64, fullness: f64, stand: &StandModel) -> u32 {
    let all = 1_u32 << (2 * bits(stand.cells));
    ((thin(distance, fullness, stand.spacing) * f64::from(all)).ceil() as u32).min(all).next_multiple_of(PLANTS_PER_INSTANCE)
}

/// Weights at the corners: a patch that only the wind keeps awake gives way to β_eq towards sleeping neighbours.
fn weights(state: &StandState, patch: PatchKey) -> [f32; 4] {
    if !state.awake.get(&patch).is_some_and(|awake| awake.wind_only) {
        return [1.0; 4];
    }
    [[-1, -1], [0, -1], [-1, 0], [0, 0]].map(|[x, z]| {
        let all = [[0, 0], [1, 0], [0, 1], [1, 1]].iter().all(|[dx, dz]| {
            let key = [patch[0].wrapping_add(x + dx), patch[1].wrapping_add(z + dz)];
            state.awake.contains_key(&key)
        });
        if all { 1.0 } else { 0.0 }
    })
}

/// Decides what of a stand is drawn: plants of `segments`, and beyond `plain_distance` plain ones. `share` of the plant budget is this
/// stand's.
pub fn plan(world: &World, index: usize, view: &View, look: &Look, share: u32, origin: PatchKey) -> ([BatchPlan; 2], f64) {
    let (stand, state) = (&world.model.stands[index], &world.state.stands[index]);
    let list = sighted(world, view, f64::from(look.fade[1]));
    let wanted = |fullness: f64| list.iter().map(|patch| u64::from(places(patch.distance, fullness, stand))).sum::<u64>();
    let mut fullness = 1.0;
    while wanted(fullness) > u64::from(share) && fullness > 1e-3 {
        fullness *= 0.9;
    }
    let plain = f64::from(stand.species.billboard.plain_distance);
    let mut batches = [BatchPlan::default(), BatchPlan::default()];
    for patch in &list {
        let far = usize::from(patch.distance > plain || stand.species.billboard.segments == 1);
        let batch = &mut batches[far];
        let count = places(patch.distance, fullness, stand);
        if u64::from(batch.plants) + u64::from(count) > u64::from(share) {
            break;
        }
        batch.draws.push(draw(world, state, patch.patch, origin, batch.plants, count));
        batch.plants += count;
    }
    (batches, fullness)
}

fn draw(world: &World, state: &StandState, patch: PatchKey, origin: PatchKey, first: u32, count: u32) -> PatchDraw {
    let side = world.model.patch_side;
    let around = |pick: fn(&sward::state::Awake) -> u32| {
        let mut found = [NONE; 9];
        for (k, slot) in found.iter_mut().enumerate() {
            let key = [patch[0].wrapping_add(k as i32 % 3 - 1), patch[1].wrapping_add(k as i32 / 3 - 1)];
            // Where a patch sleeps, the tiled one stands in if there is one; its cells wrap around.
            *slot = state.awake.get(&key).or_else(|| state.awake.get(&TILE)).map_or(NONE, pick);
        }
        found
    };
    PatchDraw {
        offset: [0, 1].map(|axis| (f64::from(patch[axis].wrapping_sub(origin[axis])) * side) as f32),
        patch,
        anchor: world.model.terrain.anchor(patch.map(|p| f64::from(p) * side)),
        weights: weights(state, patch),
        slots: around(|awake| awake.slot),
        lags: around(|awake| awake.lag),
        first,
        count,
    }
}

/// The pipeline and what it always reads.
pub struct PreparePass {
    pipeline: wgpu::ComputePipeline,
    heights: wgpu::Buffer,
    tile: wgpu::Buffer,
}

/// The transient buffers of one batch, kept from picture to picture.
#[derive(Default)]
pub struct BatchBuffers {
    /// Storage of plants and joints, and room in plants.
    pub filled: Option<(wgpu::Buffer, wgpu::Buffer)>,
    /// Plants in the last picture, those of height 0 included.
    pub plants: u32,
    /// Segments of each.
    pub segments: u32,
    room: u32,
}

impl BatchBuffers {
    /// Makes room for `plants` plants of `joints` joints.
    fn reserve(&mut self, gpu: &Gpu, plants: u32, joints: u32) {
        if plants <= self.room && self.filled.is_some() {
            return;
        }
        let make = |label: &str, bytes: u64| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: bytes.max(64),
                usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            })
        };
        let plants_bytes = u64::from(plants) * 32;
        self.filled = Some((make("plants", plants_bytes), make("joints", u64::from(plants) * u64::from(joints) * 16)));
        self.room = plants;
    }
}

impl PreparePass {
    /// Builds the pipeline for a world's terrain.
    pub fn new(gpu: &Gpu, world: &World) -> Self {
        let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("prepare"),
            source: wgpu::ShaderSource::Wgsl(assembled().into()),
        });
        let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("prepare"),
            layout: None,
            module: &module,
            entry_point: Some("prepare_pass"),
            compilation_options: Default::default(),
            cache: None,
        });
        let storage = |label: &str, contents: &[u8]| {
            gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some(label),
                contents,
                usage: wgpu::BufferUsages::STORAGE,
            })
        };
        Self {
            pipeline,
            heights: storage("terrain", bytemuck::cast_slice(world.model.terrain.heights())),
            tile: storage("wind tile", bytemuck::cast_slice(&world.model.wind_texels())),
        }
    }

    /// Records the pass for one batch. `plain` batches have one segment.
    pub fn record(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        world: &World,
        stand: &StandModel,
        batch: &BatchPlan,
        plain: bool,
        view: (&View, PatchKey, f64, f64),
        look: &Look,
        cells: &CellBuffers,
        buffers: &mut BatchBuffers,
    ) {
        let drawn = if plain { 1 } else { stand.species.billboard.segments };
        (buffers.plants, buffers.segments) = (batch.plants, drawn);
        if batch.draws.is_empty() {
            return;
        }
        let (view, origin, fullness, behind) = view;
        let side = world.model.patch_side;
        let billboard = &stand.species.billboard;
        buffers.reserve(gpu, batch.plants, drawn + 1);
        let Some((plants, joints)) = &buffers.filled else { return };
        let uniform = PrepareUniform {
            placement: stand.placement,
            grid: world.model.terrain.grid(),
            camera: [
                (view.eye[0] - f64::from(origin[0]) * side) as f32,
                view.eye[1] as f32,
                (view.eye[2] - f64::from(origin[1]) * side) as f32,
                0.0,
            ],
            segments: billboard.segments,
            drawn,
            bits: bits(stand.cells),
            layer: first_layer(look.kind),
            plain: if plain { 0.0 } else { billboard.plain_distance },
            full: FULL_CELLS * stand.spacing as f32,
            gone: look.fade[1],
            width: billboard.width,
            wind_response: stand.species.continuum.wind,
            fullness: fullness as f32,
            behind: behind as f32,
            substeps: stand.substeps as f32,
            lag: stand.lag.past(),
        };
        let made = |label: &str, contents: &[u8], usage| {
            gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some(label), contents, usage })
        };
        let uniform = made("prepare", bytemuck::bytes_of(&uniform), wgpu::BufferUsages::UNIFORM);
        let wind = world.wind_before(stand, behind).block(stand.cells / sward::response::continuum::NODE_CELLS);
        let wind = made("wind", bytemuck::bytes_of(&wind), wgpu::BufferUsages::UNIFORM);
        let draws = made("patches to draw", bytemuck::cast_slice(&batch.draws), wgpu::BufferUsages::STORAGE);
        let bound = [&uniform, &wind, &draws, &cells.now, &cells.upper, &self.heights, &self.tile, plants, joints, &cells.old];
        let entries: Vec<wgpu::BindGroupEntry> = bound
            .iter()
            .enumerate()
            .map(|(binding, buffer)| wgpu::BindGroupEntry { binding: binding as u32, resource: buffer.as_entire_binding() })
            .collect();
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("prepare"),
            layout: &self.pipeline.get_bind_group_layout(0),
            entries: &entries,
        });
        let most = batch.draws.iter().map(|draw| draw.count).max().unwrap_or(0);
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("prepare"), timestamp_writes: None });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(most.div_ceil(64), batch.draws.len() as u32, 1);
    }
}
