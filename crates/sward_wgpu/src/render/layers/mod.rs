//! Plants cut into layers: textures made when the view has turned, drawn on grids that waves move in every picture.
//!
//! Chen & Johan 2015, §3.2 and §3.6.

mod cut;
mod mesh;
mod waves;

use std::collections::BTreeMap;

use cut::{CutPass, CutTexture};
use mesh::MeshOnGpu;
use sward::geometry::layers::LayerDraw;
use sward::picture::layers::{CutKey, CutPlan, CutUniform, Origin};
use sward::response::harmonic::LayeredStand;

use super::shadow::ShadowMap;
use super::{PipelineParts, Slot, Surroundings, entries, layout, lit_shader, main_pipeline, shadow_pipeline, slots};
use crate::gpu::Gpu;
use crate::stopwatch::Stopwatch;

pub use cut::PARTS as CUT_PARTS;
pub use mesh::FinishUniform;
pub(crate) use waves::WaveUpload;

/// Files of the drawing shader, after the common ones.
pub const PARTS: [&str; 3] = [sward::geometry::layers::WGSL, super::SHADOWS_WGSL, include_str!("layers.wgsl")];

/// The waves of a stand on the GPU: notes one after the other, and planes of touched plants.
#[derive(Clone)]
pub struct WaveBuffers {
    /// V of all notes, [f32; 2] a cell.
    pub notes: wgpu::Buffer,
    /// V of touched plants' planes.
    pub touches: wgpu::Buffer,
}

/// A picture's layers: the camera's cuts and the sun's.
#[derive(Clone, Copy)]
pub struct LayerDraws<'a> {
    /// The stands of meshes.
    pub stands: &'a [LayeredStand],
    /// Where the frame is.
    pub origin: Origin,
    /// What is shown.
    pub plans: &'a [Vec<CutPlan>; 2],
    /// The waves of each stand of meshes.
    pub waves: &'a [WaveBuffers],
}

/// A cut made ready for this frame.
pub(crate) struct ReadyCut {
    pub(crate) key: CutKey,
    /// Its stand.
    pub(crate) stand: usize,
    pub(crate) vertices: u32,
    /// Its layers among all that are drawn.
    pub(crate) layers: std::ops::Range<u32>,
    bindings: wgpu::BindGroup,
}

/// The cuts of one frame: the camera's and the sun's.
#[derive(Default)]
pub(crate) struct ReadyLayers {
    cuts: [Vec<ReadyCut>; 2],
    /// All layers, the camera's first.
    pub(crate) draws: Vec<LayerDraw>,
    /// The waves of each stand.
    pub(crate) waves: Vec<WaveBuffers>,
}

impl ReadyLayers {
    /// The camera's.
    pub(crate) fn cuts(&self) -> &[ReadyCut] {
        &self.cuts[0]
    }
}

pub(crate) struct LayerPass {
    cutting: CutPass,
    meshes: Vec<MeshOnGpu>,
    textures: BTreeMap<CutKey, CutTexture>,
    main: wgpu::RenderPipeline,
    shadow: wgpu::RenderPipeline,
    main_layout: wgpu::BindGroupLayout,
    shadow_layout: wgpu::BindGroupLayout,
    sampler: wgpu::Sampler,
    surroundings: Option<Surroundings>,
    /// Plants cut since the beginning.
    pub(crate) cut: u64,
}

impl LayerPass {
    pub(crate) fn new(gpu: &Gpu, stands: &[LayeredStand], surroundings: Option<&Surroundings>) -> Self {
        let device = &gpu.device;
        let own = [
            (0, Slot::Uniform),
            (4, Slot::Storage),
            (5, Slot::Storage),
            (6, Slot::Storage),
            (7, Slot::Picture),
            (8, Slot::Picture),
            (11, Slot::Filtering),
        ];
        let shadow_layout = layout(device, "layer shadows", &own);
        let main_layout =
            layout(device, "layers", &[&own[..], &[(2, Slot::ShadowMap), (3, Slot::Comparison)], slots(surroundings)].concat());
        let module = lit_shader(device, "layers", &PARTS, surroundings);
        let parts = |label, layout, vertex, fragment, coverage| PipelineParts {
            label,
            module: &module,
            layout,
            vertex,
            buffers: &[],
            fragment: Some(fragment),
            coverage,
            depth_write: true,
        };
        let main = main_pipeline(device, &parts("layers", &main_layout, "layers_vertex", "layers_fragment", true));
        let shadow =
            shadow_pipeline(device, &parts("layer shadows", &shadow_layout, "layers_shadow_vertex", "layers_shadow_fragment", false));
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("layers"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            ..Default::default()
        });
        let meshes = stands.iter().map(|stand| MeshOnGpu::new(gpu, &stand.specimen)).collect();
        Self {
            cutting: CutPass::new(gpu, surroundings),
            meshes,
            textures: BTreeMap::new(),
            main,
            shadow,
            main_layout,
            shadow_layout,
            sampler,
            surroundings: surroundings.cloned(),
            cut: 0,
        }
    }

    /// Cuts what is not cut yet, forgets what is not shown, and binds what is.
    pub(crate) fn ready(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        frame: &wgpu::Buffer,
        map: &ShadowMap,
        draws: &LayerDraws<'_>,
        mut stopwatch: Option<&mut Stopwatch>,
    ) -> ReadyLayers {
        let all: Vec<&CutPlan> = draws.plans.iter().flatten().collect();
        let keys: std::collections::BTreeSet<CutKey> = all.iter().map(|plan| plan.key).collect();
        self.textures.retain(|key, _| keys.contains(key));
        for plan in &all {
            let (Some(mesh), Some(stand)) = (self.meshes.get(plan.key.stand), draws.stands.get(plan.key.stand)) else { continue };
            if self.textures.contains_key(&plan.key) {
                continue;
            }
            let writes = stopwatch.as_mut().and_then(|stopwatch| stopwatch.render("cut", &[]));
            let uniform = CutUniform::new(stand, plan, draws.origin);
            let texture = self.cutting.cut(gpu, encoder, frame, mesh, &uniform, plan.texture(), writes.map(|(_, writes)| writes));
            self.textures.insert(plan.key, texture);
            self.cut += 1;
        }
        let list: Vec<LayerDraw> = all.iter().flat_map(|plan| plan.layers.iter().copied()).collect();
        let layers = gpu.filled("layers", bytemuck::cast_slice(&list), wgpu::BufferUsages::STORAGE);
        let mut ready = ReadyLayers { draws: list, waves: draws.waves.to_vec(), ..ReadyLayers::default() };
        let mut first = 0;
        for (of, plans) in draws.plans.iter().enumerate() {
            for plan in plans {
                let range = first..first + plan.layers.len() as u32;
                first = range.end;
                let (key, stand) = (plan.key, plan.key.stand);
                let [columns, rows] = plan.pieces();
                let shadow = of == 1;
                let layout = if shadow { &self.shadow_layout } else { &self.main_layout };
                let map = (!shadow).then_some(map);
                let bindings = draws.waves.get(stand).and_then(|waves| self.bind(gpu, layout, frame, map, &layers, waves, key, &[]));
                let Some(bindings) = bindings else { continue };
                ready.cuts[of].push(ReadyCut { key, stand, vertices: 6 * columns * rows, layers: range, bindings });
            }
        }
        ready
    }

    /// Binds a cut for the pass of outputs.
    pub(crate) fn bind_with(
        &self,
        gpu: &Gpu,
        layout: &wgpu::BindGroupLayout,
        frame: &wgpu::Buffer,
        layers: &wgpu::Buffer,
        waves: &WaveBuffers,
        key: CutKey,
        more: &[(u32, &wgpu::Buffer)],
    ) -> Option<wgpu::BindGroup> {
        self.bind(gpu, layout, frame, None, layers, waves, key, more)
    }

    fn bind(
        &self,
        gpu: &Gpu,
        layout: &wgpu::BindGroupLayout,
        frame: &wgpu::Buffer,
        map: Option<&ShadowMap>,
        layers: &wgpu::Buffer,
        waves: &WaveBuffers,
        key: CutKey,
        more: &[(u32, &wgpu::Buffer)],
    ) -> Option<wgpu::BindGroup> {
        let texture = self.textures.get(&key)?;
        let buffers = [(0, frame), (4, layers), (5, &waves.notes), (6, &waves.touches)];
        let mut all: Vec<wgpu::BindGroupEntry<'_>> = buffers
            .iter()
            .chain(more)
            .map(|(binding, buffer)| wgpu::BindGroupEntry { binding: *binding, resource: buffer.as_entire_binding() })
            .collect();
        all.extend([
            wgpu::BindGroupEntry { binding: 7, resource: wgpu::BindingResource::TextureView(&texture.sky) },
            wgpu::BindGroupEntry { binding: 8, resource: wgpu::BindingResource::TextureView(&texture.sun) },
            wgpu::BindGroupEntry { binding: 11, resource: wgpu::BindingResource::Sampler(&self.sampler) },
        ]);
        if let Some(map) = map {
            all.push(wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::TextureView(&map.view) });
            all.push(wgpu::BindGroupEntry { binding: 3, resource: wgpu::BindingResource::Sampler(&map.sampler) });
            all.extend(entries(self.surroundings.as_ref()));
        }
        Some(gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some("layers"), layout, entries: &all }))
    }

    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, ready: &ReadyLayers) {
        Self::draw_all(pass, &self.main, &ready.cuts[0]);
    }

    pub(crate) fn draw_shadow(&self, pass: &mut wgpu::RenderPass<'_>, ready: &ReadyLayers) {
        Self::draw_all(pass, &self.shadow, &ready.cuts[1]);
    }

    fn draw_all(pass: &mut wgpu::RenderPass<'_>, pipeline: &wgpu::RenderPipeline, cuts: &[ReadyCut]) {
        pass.set_pipeline(pipeline);
        for cut in cuts {
            pass.set_bind_group(0, &cut.bindings, &[]);
            pass.draw(0..cut.vertices, cut.layers.clone());
        }
    }

    /// Pixels of all textures that are kept.
    pub(crate) fn pixels(&self) -> u64 {
        self.textures.values().map(|texture| texture.size.map(u64::from).iter().product::<u64>()).sum()
    }
}
