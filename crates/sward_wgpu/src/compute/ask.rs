//! Questions about plants to the device that holds their cells, and the answers on their way back.
//!
//! An answer is of the moment of asking: after all steps handed over till then. It is there when the device has done them, so whoever asks in every step
//! gets answers at most [`sward::activation::LATENCY`] steps old, and nobody waits.

use std::collections::VecDeque;

use sward::picture::asked::{Asked, Asker, Standing};
use sward::response::continuum::NODE_CELLS;
use sward::scene::Precision;
use sward::world::World;

use super::GpuStep;
use super::buffers::{CellBuffers, Numbers};
use super::readback::Readback;
use crate::gpu::{Gpu, GpuError, Program};
use crate::render::height_samples::HeightSamples;
use crate::render::prepare::Bending;
use crate::render::prepare_pipelines::before_bending;

/// Most places of one question.
pub const MOST_PLACES: usize = 1 << 20;

/// The full text of the compute shader.
pub fn assembled(bending: Bending) -> String {
    [&before_bending()[..], &bending.parts(), &[include_str!("ask.wgsl")]].concat().join("\n")
}

/// What came back of a question.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Answers {
    /// What [`GpuStep::ask`] answered.
    pub ticket: u64,
    /// Steps done when it was asked.
    pub step: u64,
    /// How high what grows at each place reaches, m: see [`World::cover_height_at`].
    pub cover: Vec<f32>,
    /// How the plants of each stand of grass stand at each place.
    pub stands: Vec<Vec<Standing>>,
}

/// A question on its way.
struct Asking {
    ticket: u64,
    step: u64,
    /// The round of crowns, m.
    crowns: Vec<f32>,
    submission: wgpu::SubmissionIndex,
    stands: Vec<Readback>,
}

/// The pipelines, made when somebody asks, and what was asked.
#[derive(Default)]
pub(super) struct AskPasses {
    pipelines: Vec<(Bending, bool, wgpu::ComputePipeline)>,
    heights: Option<HeightSamples>,
    asking: VecDeque<Asking>,
    asked: u64,
}

/// What an answer is read from; all that no bending reads is bound all the same.
fn layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    let entry = |binding: u32| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer {
            ty: match binding {
                0 | 1 | 12 => wgpu::BufferBindingType::Uniform,
                _ => wgpu::BufferBindingType::Storage { read_only: binding != 8 },
            },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    };
    let entries: Vec<_> = (0..10).chain([12]).map(entry).collect();
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some("ask"), entries: &entries })
}

impl AskPasses {
    /// The pipeline for cells that are bent and stored in some way.
    fn pipeline(&mut self, gpu: &Gpu, bending: Bending, half: bool) -> wgpu::ComputePipeline {
        if let Some((.., known)) = self.pipelines.iter().find(|(of, halved, _)| (*of, *halved) == (bending, half)) {
            return known.clone();
        }
        let program = Program::new("ask", assembled(bending));
        let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("ask"),
            bind_group_layouts: &[Some(&layout(gpu))],
            ..Default::default()
        });
        let made = program.pipeline(gpu, Some(&layout), "ask_pass", &[("half_precision", f64::from(u32::from(half)))]);
        self.pipelines.push((bending, half, made.clone()));
        made
    }
}

impl GpuStep {
    /// Asks how what grows at places \[m\] stands now; of more than [`MOST_PLACES`] the first ones. Returns the number by which the answer is known.
    ///
    /// # Errors
    /// What the device reports.
    pub fn ask(&mut self, gpu: &Gpu, world: &World, places: &[[f64; 2]]) -> Result<u64, GpuError> {
        let places = &places[..places.len().min(MOST_PLACES)];
        let crowns = places.iter().map(|place| world.crown_height(*place)).collect();
        let heights = match &mut self.ask.heights {
            Some(heights) => {
                heights.follow(gpu, &world.model.terrain);
                heights.buffer.clone()
            }
            none => none.insert(HeightSamples::new(gpu, world.model.terrain.heights(), world.model.terrain.edits())).buffer.clone(),
        };
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let mut stands = Vec::new();
        for index in 0..world.model.stands.len() {
            let mut asker = Asker::new(world, index);
            let questions: Vec<Asked> = places.iter().map(|place| asker.question(*place)).collect();
            let cells = &self.stands[index];
            let half = cells.precision == Precision::Half;
            let pipeline = self.ask.pipeline(gpu, Bending::of_cells(cells), half);
            stands.push(record(gpu, &mut encoder, (&asker, &questions), &pipeline, cells, [&heights, &self.air.buffer]));
        }
        let submission = gpu.queue.submit([encoder.finish()]);
        stands.iter_mut().for_each(|readback| readback.begin(gpu));
        self.ask.asked += 1;
        let ticket = self.ask.asked;
        self.ask.asking.push_back(Asking { ticket, step: world.state.step, crowns, submission, stands });
        gpu.check()?;
        Ok(ticket)
    }

    /// The answer to the oldest question that has none yet, if it has come. Never waits.
    ///
    /// # Errors
    /// What the device reports.
    pub fn answer(&mut self, gpu: &Gpu) -> Result<Option<Answers>, GpuError> {
        gpu.look();
        let there = self.ask.asking.front_mut().is_some_and(|asking| asking.stands.iter_mut().all(Readback::is_there));
        if there { self.wait_for_answer(gpu) } else { Ok(None) }
    }

    /// The same, waiting for it; `None` if nothing was asked.
    ///
    /// # Errors
    /// What the device reports.
    pub fn wait_for_answer(&mut self, gpu: &Gpu) -> Result<Option<Answers>, GpuError> {
        let Some(asking) = self.ask.asking.pop_front() else { return Ok(None) };
        let mut answers = Answers { ticket: asking.ticket, step: asking.step, cover: asking.crowns, stands: Vec::new() };
        for readback in asking.stands {
            let numbers: Vec<[f32; 4]> = readback.take(gpu, &asking.submission)?;
            for (cover, [.., height, _]) in answers.cover.iter_mut().zip(&numbers) {
                *cover = cover.max(*height);
            }
            answers.stands.push(numbers.into_iter().map(|[x, z, height, _]| Standing { bend: [x, z], height }).collect());
        }
        Ok(Some(answers))
    }
}

/// Records the questions to one stand.
fn record(
    gpu: &Gpu,
    encoder: &mut wgpu::CommandEncoder,
    (asker, questions): (&Asker<'_>, &[Asked]),
    pipeline: &wgpu::ComputePipeline,
    cells: &CellBuffers,
    [heights, air]: [&wgpu::Buffer; 2],
) -> Readback {
    let made = |label: &str, bytes: &[u8], usage| gpu.filled(label, if bytes.is_empty() { &[0; 256] } else { bytes }, usage);
    let (uniform, storage) = (wgpu::BufferUsages::UNIFORM, wgpu::BufferUsages::STORAGE);
    let bytes = 16 * questions.len() as u64;
    let answers = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("answers"),
        size: bytes.max(16),
        usage: storage | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });
    if questions.is_empty() {
        return Readback::record(gpu, encoder, &answers, 0);
    }
    let prepare = made("ask", bytemuck::bytes_of(&asker.uniform), uniform);
    let wind = made("wind", bytemuck::bytes_of(&asker.wind.block(asker.uniform.placement.cells / NODE_CELLS)), uniform);
    let draws = made("patches asked about", bytemuck::cast_slice(&asker.draws), storage);
    let asked = made("questions", bytemuck::cast_slice(questions), storage);
    let nothing = made("nothing", &[], uniform);
    let is_sheet = matches!(cells.numbers, Some(Numbers::Sheet(_)));
    let numbers = cells.numbers.as_ref().map_or(&nothing, Numbers::buffer);
    let upper = if is_sheet { &cells.sheets } else { &cells.upper };
    let bound = [&prepare, &wind, &draws, &cells.now, upper, heights, air, &asked, &answers, &cells.old];
    let numbered = bound.into_iter().enumerate().map(|(binding, buffer)| (binding as u32, buffer)).chain([(12, numbers)]);
    let entries: Vec<_> =
        numbered.map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() }).collect();
    let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("ask"),
        layout: &pipeline.get_bind_group_layout(0),
        entries: &entries,
    });
    {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("ask"), timestamp_writes: None });
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &group, &[]);
        let groups = (questions.len() as u32).div_ceil(64);
        pass.dispatch_workgroups(groups.min(ROW), groups.div_ceil(ROW), 1);
    }
    Readback::record(gpu, encoder, &answers, bytes)
}

/// Workgroups in a row of a dispatch.
const ROW: u32 = 1024;
