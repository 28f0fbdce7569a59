//! The pass that draws plants: crossed cards bent along their joints, or sheets, many plants per instance.

use std::collections::HashMap;

use sward::shading::look::Style;

use super::clump_texture::ClumpTexture;
use super::plants::{Look, MOST_CARDS, MOST_SEGMENTS, PLANTS_PER_INSTANCE, PlantBatch, PlantCount, PlantDraws, index_count};
use super::shadow::ShadowMap;
use super::{PipelineParts, Slot, Surroundings, entries, layout, lit_shader, main_pipeline, shadow_pipeline, slots};
use crate::gpu::Gpu;

/// Files of the pass's shader for cards, after the common ones.
pub const PARTS: [&str; 6] = [
    super::card::WGSL,
    super::SHADOWS_WGSL,
    include_str!("plants.wgsl"),
    include_str!("cards.wgsl"),
    include_str!("leaves.wgsl"),
    include_str!("plant_shadows.wgsl"),
];
/// The same for sheets: other corners.
pub const SHEET_PARTS: [&str; 6] = [
    super::sheet::WGSL,
    super::SHADOWS_WGSL,
    include_str!("plants.wgsl"),
    include_str!("sheet_grids.wgsl"),
    include_str!("leaves.wgsl"),
    include_str!("plant_shadows.wgsl"),
];

/// The pipelines of cards, or of sheets.
struct Pipelines {
    main: wgpu::RenderPipeline,
    shadow: wgpu::RenderPipeline,
}

impl Pipelines {
    fn new(gpu: &Gpu, parts: &[&str], layouts: [&wgpu::BindGroupLayout; 2], surroundings: Option<&Surroundings>) -> Self {
        let device = &gpu.device;
        let [main_layout, shadow_layout] = layouts;
        let module = lit_shader(device, "plants", parts, surroundings);
        let main = main_pipeline(
            device,
            &PipelineParts {
                label: "plants",
                module: &module,
                layout: main_layout,
                vertex: "plants_vertex",
                buffers: &[],
                fragment: Some("plants_fragment"),
                coverage: true,
                depth_write: true,
            },
        );
        let shadow = shadow_pipeline(
            device,
            &PipelineParts {
                label: "plant shadows",
                module: &module,
                layout: shadow_layout,
                vertex: "plants_shadow_vertex",
                buffers: &[],
                fragment: Some("plants_shadow_fragment"),
                coverage: false,
                depth_write: true,
            },
        );
        Self { main, shadow }
    }
}

/// A batch made ready for this frame.
pub(crate) struct Ready<'a> {
    pub(crate) batch: PlantBatch<'a>,
    /// Number of the batch in the picture.
    pub(crate) number: usize,
    main: wgpu::BindGroup,
    shadow: wgpu::BindGroup,
}

/// The batches of one frame.
pub(crate) struct ReadyPlants<'a>(pub(crate) Vec<Ready<'a>>);

pub(crate) struct PlantPass {
    cards: Pipelines,
    /// Made when there are sheets.
    sheets: Option<Pipelines>,
    main_layout: wgpu::BindGroupLayout,
    shadow_layout: wgpu::BindGroupLayout,
    pub(crate) clumps: ClumpTexture,
    looks: Vec<Look>,
    surroundings: Option<Surroundings>,
    styles: HashMap<(usize, u32, u32), wgpu::Buffer>,
    indices: HashMap<(u32, u32), wgpu::Buffer>,
}

impl PlantPass {
    pub(crate) fn new(gpu: &Gpu, looks: &[Look], surroundings: Option<&Surroundings>) -> Self {
        let device = &gpu.device;
        let own =
            [(0, Slot::Uniform), (4, Slot::Storage), (5, Slot::Storage), (6, Slot::Uniform), (7, Slot::Pictures), (8, Slot::Filtering)];
        let shadow_layout = layout(device, "plant shadows", &own);
        let main_layout =
            layout(device, "plants", &[&own[..], &[(2, Slot::ShadowMap), (3, Slot::Comparison)], slots(surroundings)].concat());
        Self {
            cards: Pipelines::new(gpu, &PARTS, [&main_layout, &shadow_layout], surroundings),
            sheets: None,
            main_layout,
            shadow_layout,
            clumps: ClumpTexture::new(gpu, looks),
            looks: looks.to_vec(),
            surroundings: surroundings.cloned(),
            styles: HashMap::new(),
            indices: HashMap::new(),
        }
    }

    /// Makes what the batches need; batches with an unknown look or shape are left out.
    pub(crate) fn ready<'a>(&mut self, gpu: &Gpu, frame: &wgpu::Buffer, map: &ShadowMap, draws: &PlantDraws<'a>) -> ReadyPlants<'a> {
        let fits = |(_, batch): &(usize, &PlantBatch<'_>)| {
            batch.look < self.looks.len() && (1..=MOST_SEGMENTS).contains(&batch.segments) && batch.cards <= MOST_CARDS
        };
        let batches: Vec<(usize, &PlantBatch<'a>)> = draws.batches.iter().enumerate().filter(fits).collect();
        if self.sheets.is_none() && batches.iter().any(|(_, batch)| batch.is_sheet()) {
            let layouts = [&self.main_layout, &self.shadow_layout];
            self.sheets = Some(Pipelines::new(gpu, &SHEET_PARTS, layouts, self.surroundings.as_ref()));
        }
        ReadyPlants(batches.into_iter().map(|(number, batch)| self.ready_batch(gpu, frame, map, number, *batch)).collect())
    }

    fn ready_batch<'a>(&mut self, gpu: &Gpu, frame: &wgpu::Buffer, map: &ShadowMap, number: usize, batch: PlantBatch<'a>) -> Ready<'a> {
        let device = &gpu.device;
        self.indices.entry((batch.segments, batch.cards)).or_insert_with(|| index_buffer(gpu, batch.segments, batch.cards));
        let look = &self.looks[batch.look];
        let style = self.styles.entry((batch.look, batch.segments, batch.cards)).or_insert_with(|| style_buffer(gpu, look, &batch));
        let own = [
            wgpu::BindGroupEntry { binding: 0, resource: frame.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 4, resource: batch.plants.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 5, resource: batch.joints.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 6, resource: style.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 7, resource: wgpu::BindingResource::TextureView(&self.clumps.view) },
            wgpu::BindGroupEntry { binding: 8, resource: wgpu::BindingResource::Sampler(&self.clumps.sampler) },
        ];
        let shadow = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("plant shadows"),
            layout: &self.shadow_layout,
            entries: &own,
        });
        let mut all = own.to_vec();
        all.push(wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::TextureView(&map.view) });
        all.push(wgpu::BindGroupEntry { binding: 3, resource: wgpu::BindingResource::Sampler(&map.sampler) });
        all.extend(entries(self.surroundings.as_ref()));
        let main = device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some("plants"), layout: &self.main_layout, entries: &all });
        Ready { batch, number, main, shadow }
    }

    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, plants: &ReadyPlants<'_>) {
        for ready in &plants.0 {
            pass.set_pipeline(&self.pipelines(&ready.batch).main);
            pass.set_bind_group(0, &ready.main, &[]);
            self.draw_batch(pass, &ready.batch);
        }
    }

    pub(crate) fn draw_shadow(&self, pass: &mut wgpu::RenderPass<'_>, plants: &ReadyPlants<'_>) {
        for ready in plants.0.iter().filter(|ready| ready.batch.shadows) {
            pass.set_pipeline(&self.pipelines(&ready.batch).shadow);
            pass.set_bind_group(0, &ready.shadow, &[]);
            self.draw_batch(pass, &ready.batch);
        }
    }

    fn pipelines(&self, batch: &PlantBatch<'_>) -> &Pipelines {
        self.sheets.as_ref().filter(|_| batch.is_sheet()).unwrap_or(&self.cards)
    }

    /// `style` of a batch made ready.
    pub(crate) fn style(&self, batch: &PlantBatch<'_>) -> Option<&wgpu::Buffer> {
        self.styles.get(&(batch.look, batch.segments, batch.cards))
    }

    /// Draws a batch with whatever pipeline is set.
    pub(crate) fn draw_batch(&self, pass: &mut wgpu::RenderPass<'_>, batch: &PlantBatch<'_>) {
        let Some(indices) = self.indices.get(&(batch.segments, batch.cards)) else {
            return;
        };
        pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint16);
        match batch.count {
            PlantCount::Direct(count) => {
                pass.draw_indexed(0..index_count(batch.segments, batch.cards), 0, 0..count.div_ceil(PLANTS_PER_INSTANCE));
            }
            PlantCount::Indirect(buffer, offset) => pass.draw_indexed_indirect(buffer, offset),
        }
    }
}

/// Two triangles per segment or piece; corner numbers are taken apart again in the vertex shader.
fn index_buffer(gpu: &Gpu, segments: u32, cards: u32) -> wgpu::Buffer {
    // Corners of a row, rows, and how often there are so many.
    let (across, rows, count) = if cards == 0 { (segments + 1, segments + 1, 1) } else { (2, segments + 1, cards) };
    let strips = PLANTS_PER_INSTANCE * count;
    let pieces = (0..rows - 1).flat_map(|row| (0..across - 1).map(move |column| row * across + column));
    let indices: Vec<u16> = (0..strips)
        .flat_map(|strip| pieces.clone().map(move |piece| strip * across * rows + piece))
        .flat_map(|at| [at, at + 1, at + across, at + across, at + 1, at + across + 1])
        .map(|index| index as u16)
        .collect();
    gpu.filled("plant indices", bytemuck::cast_slice(&indices), wgpu::BufferUsages::INDEX)
}

fn style_buffer(gpu: &Gpu, look: &Look, batch: &PlantBatch<'_>) -> wgpu::Buffer {
    let style = Style::new(look, batch.segments, batch.cards, PLANTS_PER_INSTANCE);
    gpu.filled("plant style", bytemuck::bytes_of(&style), wgpu::BufferUsages::UNIFORM)
}
