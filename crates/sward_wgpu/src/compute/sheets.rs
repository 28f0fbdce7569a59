//! The step of a stand whose billboards bodies deform: its plan as the passes read it, the passes, and the maps of bodies.
//!
//! Who has a sheet, and where, the plan says; so nothing has to come back from the device for it.

use std::sync::Arc;

use bytemuck::{Pod, Zeroable};
use sward::interaction::{distance_map, reaction};
use sward::plan::{ActiveSheet, StandPlan};
use sward::response::StandModel;
use sward::response::continuum::NODE_CELLS;
use sward::response::springs::{self, MOST_MOMENTS, SheetRoot, SpringsCoefficients, SpringsModel, root_of};
use sward::world::World;

use super::Work;
use super::air::AirTexels;
use super::buffers::CellBuffers;
use super::distance_maps::{DistanceMapPasses, MapInput};
use super::passes::{Groups, Pass};
use super::traffic;
use crate::gpu::{Gpu, Program};
use crate::stopwatch::Stopwatch;

/// How sheets lie in their words; needs the springs' texts before it.
pub const SHEET_WORDS_WGSL: &str = include_str!("sheet_words.wgsl");

/// Most sheets of a dispatch: what they need besides is 23 MB then, with the finest sheets.
pub const MOST_AT_ONCE: usize = 4096;

/// `SheetStand` of `sheet_bends.wgsl`: what pictures read of a stand.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct SheetUniform {
    /// Kernel numbers.
    pub coefficients: SpringsCoefficients,
    /// k_w.
    pub wind: f32,
    /// Width of a billboard, m.
    pub width: f32,
    /// Keeps the size a multiple of 16 bytes.
    pub unused: [f32; 2],
}

impl SheetUniform {
    /// Of a stand.
    pub fn new(model: &SpringsModel) -> Self {
        Self { coefficients: model.coefficients, wind: model.wind, width: model.width, unused: [0.0; 2] }
    }
}

/// `SheetStep` of `sheets.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct SheetStep {
    /// Kernel numbers.
    pub coefficients: SpringsCoefficients,
    /// k_w.
    pub wind: f32,
    /// Keeps the size a multiple of 16 bytes.
    /// κ and ⅓ of the mass of a plant over its height: times its height³ its stiffness, N·m/rad/m³.
    pub stiffness: f32,
    /// First word of what bodies feel.
    pub reactions: u32,
    /// Keeps the size a multiple of 16 bytes.
    pub unused: u32,
}

/// `SheetEntry` of `sheets.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct SheetEntry {
    /// Where it stands.
    pub root: SheetRoot,
    /// Which patch.
    pub patch: [i32; 2],
    /// Where its sheet is stored.
    pub place: u32,
    /// 1: it has just got it.
    pub fresh: u32,
    /// First of its bodies.
    pub first: u32,
    /// Their number.
    pub count: u32,
    /// Last moment of the step.
    pub last: u32,
    /// Steps by which it recovers faster.
    pub hurry: u32,
    /// Where an upright column falls, unit (x, z).
    pub heading: [f32; 2],
    /// Keeps the size a multiple of 16 bytes.
    pub unused: [u32; 2],
}

/// The full text of the compute shader.
pub fn assembled() -> String {
    let mut parts = vec![sward::math::WGSL, sward::wind::WGSL, distance_map::WGSL];
    parts.extend(springs::WGSL.iter().chain(&springs::STEP_WGSL));
    parts.extend([reaction::SUMS_WGSL, SHEET_WORDS_WGSL, include_str!("sheets.wgsl"), sward::wind::SUM_WGSL]);
    parts.join("\n")
}

/// The passes, and the maps of bodies.
pub struct SheetPasses {
    touch: Pass,
    resolve: Pass,
    /// Where a body plays a clip.
    maps: Option<DistanceMapPasses>,
    tile: wgpu::Buffer,
    texels: wgpu::Buffer,
    /// What they are of.
    known: Arc<Vec<[f32; 4]>>,
}

impl SheetPasses {
    /// Reads the wind from other texels.
    pub fn heed(&mut self, air: &AirTexels) {
        self.tile = air.buffer.clone();
    }

    /// Builds the pipelines and uploads the maps of bodies: of those that play no clip they stay. Wind is read
    /// from `air`.
    pub fn new(gpu: &Gpu, world: &World, air: &AirTexels) -> Self {
        let program = Program::new("sheets", assembled());
        let storage = wgpu::BufferUsages::STORAGE;
        let texels = if world.texels.is_empty() { &[[0.0; 4]][..] } else { &world.texels };
        Self {
            touch: Pass::plain(gpu, &program, "sheet_touch_pass", &[0, 1, 2, 3, 4, 5, 6, 8]),
            resolve: Pass::plain(gpu, &program, "sheet_resolve_pass", &[0, 2, 3, 4, 5, 6, 7]),
            maps: world.model.bodies.iter().any(|body| body.is_animated()).then(|| DistanceMapPasses::new(gpu)),
            tile: air.buffer.clone(),
            texels: gpu.filled("maps of bodies", bytemuck::cast_slice(texels), storage),
            known: Arc::clone(&world.model.maps.texels),
        }
    }

    /// Follows bodies that come and go. Maps of those that play a clip are drawn before they are read.
    pub fn follow(&mut self, gpu: &Gpu, world: &World) {
        if self.maps.is_none() && world.model.bodies.iter().any(|body| body.is_animated()) {
            self.maps = Some(DistanceMapPasses::new(gpu));
        }
        let texels = &world.model.maps.texels;
        if !Arc::ptr_eq(&self.known, texels) {
            let bytes = if texels.is_empty() { &[[0.0; 4]][..] } else { &texels[..] };
            self.texels = gpu.filled("maps of bodies", bytemuck::cast_slice(bytes), wgpu::BufferUsages::STORAGE);
            self.known = Arc::clone(texels);
        }
    }

    /// Records the drawing of maps of bodies that play a clip, each with the seconds since it appeared.
    pub fn draw_maps(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        world: &World,
        moving: &[(u32, f64)],
        work: &mut Work,
        stopwatch: Option<&mut Stopwatch>,
    ) {
        let Some(passes) = &self.maps else { return };
        let points = posed(world, moving);
        passes.record(gpu, encoder, &map_inputs(world, &points), &self.texels, work, stopwatch);
    }

    /// Records one step of stand number `index`. Returns room for summaries, all zero, since a patch whose sheets have recovered sleeps by
    /// itself, and the sums of what bodies feel.
    pub fn record(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        world: &World,
        (index, model): (usize, &SpringsModel),
        plan: &StandPlan,
        cells: &CellBuffers,
        work: &mut Work,
        mut stopwatch: Option<&mut Stopwatch>,
    ) -> wgpu::Buffer {
        let stand = &world.model.stands[index];
        let all = entries(world, (index, model), plan);
        let nothing = vec![0; 4 * super::report_words(plan).max(4) as usize];
        let report = gpu.filled("reports", &nothing, wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
        if all.is_empty() {
            return report;
        }
        let mut filled = |label: &str, bytes: &[u8]| {
            work.uploaded += bytes.len() as u64;
            gpu.filled(label, if bytes.is_empty() { &[0; 80] } else { bytes }, wgpu::BufferUsages::STORAGE)
        };
        let numbers = SheetStep {
            coefficients: model.coefficients,
            wind: model.wind,
            stiffness: stand.inertia * stand.species.continuum.kappa,
            reactions: super::SUMMARY_WORDS * plan.patches.len() as u32,
            unused: 0,
        };
        let numbers = filled("sheets", bytemuck::bytes_of(&numbers));
        let wind = filled("wind", bytemuck::bytes_of(&plan.wind.block(stand.cells / NODE_CELLS)));
        let heads = filled("where maps are", bytemuck::cast_slice(&plan.sheets.heads));
        let words = traffic::sheet_room(model);
        let room = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("sheets in a step"),
            size: 4 * words * all.len().min(MOST_AT_ONCE) as u64,
            usage: wgpu::BufferUsages::STORAGE,
            mapped_at_creation: false,
        });
        let lists: Vec<wgpu::Buffer> =
            all.chunks(MOST_AT_ONCE).map(|some| filled("deformed billboards", bytemuck::cast_slice(some))).collect();
        for (some, list) in all.chunks(MOST_AT_ONCE).zip(&lists) {
            let bound = [
                (0, &numbers),
                (1, &wind),
                (2, list),
                (3, &cells.sheets),
                (4, &heads),
                (5, &self.texels),
                (6, &room),
                (7, &report),
                (8, &self.tile),
            ];
            let near = some.iter().filter(|entry| entry.count > 0).count();
            for (pass, count) in [(&self.touch, some.len()), (&self.resolve, near)] {
                let groups = Groups::Direct([count.div_ceil(64) as u32, 1, u32::from(count > 0)]);
                work.add(&pass.run(gpu, encoder, &bound, groups, stopwatch.as_deref_mut()));
            }
        }
        let near = all.iter().filter(|entry| entry.count > 0).count();
        work.traffic += traffic::touched_sheets(model, all.len() as u64) + traffic::resolved_sheets(model, near as u64);
        report
    }
}

/// Points of bodies that play a clip, where they are after so many seconds.
pub(super) fn posed(world: &World, moving: &[(u32, f64)]) -> Vec<(usize, Vec<[f32; 3]>)> {
    let points = |(body, elapsed): &(u32, f64)| {
        let figure = world.model.bodies.get(*body as usize)?.figure.as_ref()?;
        Some((*body as usize, figure.points(*elapsed)))
    };
    moving.iter().filter_map(points).collect()
}

/// The maps to be drawn of bodies with such points.
pub(super) fn map_inputs<'a>(world: &'a World, posed: &'a [(usize, Vec<[f32; 3]>)]) -> Vec<MapInput<'a>> {
    let input = |(body, points): &'a (usize, Vec<[f32; 3]>)| {
        let triangles = &world.model.bodies.get(*body)?.figure.as_ref()?.figure.triangles;
        let (map, first) = world.model.maps.place(*body)?;
        Some(MapInput { points, triangles, cube: map.cube, size: map.size, first })
    };
    posed.iter().filter_map(input).collect()
}

/// The sheets of a plan, as the passes read them; those first that bodies may touch.
pub(super) fn entries(world: &World, (index, model): (usize, &SpringsModel), plan: &StandPlan) -> Vec<SheetEntry> {
    let (stand, grown): (&StandModel, _) = (&world.model.stands[index], &world.state.stands[index].cells.grown);
    let entry = |sheet: &ActiveSheet| {
        let patch = plan.patches[sheet.patch as usize].patch;
        let root = root_of(&world.model.terrain, stand, model, grown.get(&patch).map(|map| &map[..]), patch, sheet.cell)?;
        let heads = &plan.sheets.heads[sheet.heads.start as usize..sheet.heads.end as usize];
        Some(SheetEntry {
            root,
            patch,
            place: sheet.place,
            fresh: u32::from(sheet.fresh),
            first: sheet.heads.start,
            count: heads.len() as u32,
            last: heads.iter().map(|head| head.moment).max().unwrap_or(0).min(MOST_MOMENTS - 1),
            hurry: sheet.hurry,
            heading: sheet.heading,
            unused: [0; 2],
        })
    };
    let (near, far): (Vec<SheetEntry>, Vec<SheetEntry>) = plan.sheets.active.iter().filter_map(entry).partition(|entry| entry.count > 0);
    [near, far].concat()
}
