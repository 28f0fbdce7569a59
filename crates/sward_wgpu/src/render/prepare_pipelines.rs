//! Which shaders solve plants: their texts, and the pipelines of a world.

use sward::picture::plan::THINNING;
use sward::picture::prepare::PrepareUniform;
use sward::response::springs;
use sward::scene::Precision;
use sward::shading::clump::VARIANTS;
use sward::world::World;

use super::prepare::Bending;
use crate::compute::CELLS_WGSL;
use crate::compute::buffers::CellBuffers;
use crate::gpu::{Gpu, Program};

/// What plants become.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Solved {
    /// Joints of cards.
    Spines,
    /// Points of sheets.
    Sheets,
}

impl Solved {
    /// Of a batch.
    pub(super) fn of(uniform: &PrepareUniform) -> Self {
        if uniform.is_sheet() { Self::Sheets } else { Self::Spines }
    }

    /// What it needs after [`Bending::parts`].
    fn parts(self, bending: Bending) -> Vec<&'static str> {
        let [vector, sheet, lengths, _, wind, surface] = springs::WGSL;
        match (self, bending) {
            (Self::Spines, _) => vec![include_str!("spines.wgsl")],
            // The bending brings what sheets are.
            (Self::Sheets, Bending::Sheet) => vec![surface, include_str!("deformed_at.wgsl"), include_str!("sheets.wgsl")],
            (Self::Sheets, _) => vec![vector, sheet, lengths, wind, surface, include_str!("bent_at.wgsl"), include_str!("sheets.wgsl")],
        }
    }
}

/// The texts before those of [`Bending::parts`].
pub(crate) fn before_bending() -> [&'static str; 7] {
    [
        sward::math::WGSL,
        sward::wind::WGSL,
        sward::terrain::WGSL,
        sward::placement::WGSL,
        sward::geometry::billboard::WGSL,
        sward::response::continuum::HALF_WGSL,
        CELLS_WGSL,
    ]
}

/// The full text of the compute shader.
pub fn assembled(bending: Bending, solved: Solved) -> String {
    let variants = format!("const CLUMP_VARIANTS: u32 = {VARIANTS}u;\nconst PREPARE_THINNING: f32 = {THINNING:?};");
    [&before_bending()[..], &[&variants], &bending.parts(), &solved.parts(bending), &[include_str!("prepare.wgsl")]].concat().join("\n")
}

/// The pipelines for all that plants become of one kind.
pub(super) struct Pipelines {
    /// For cells at full precision.
    full: wgpu::ComputePipeline,
    /// For cells at half precision, where the scene asks for them.
    half: Option<wgpu::ComputePipeline>,
    /// For stands that move blade by blade, where there are any.
    by_blade: Option<wgpu::ComputePipeline>,
    /// For stands of plants that swing by themselves, where there are any.
    swinging: Option<wgpu::ComputePipeline>,
    /// For stands whose billboards bodies deform, where there are any.
    deformed: Option<wgpu::ComputePipeline>,
}

impl Pipelines {
    pub(super) fn new(gpu: &Gpu, world: &World, solved: Solved) -> Self {
        let program = |bending: Bending| Program::new("prepare", assembled(bending, solved));
        let continuum = program(Bending::Continuum);
        let of = |bending: Bending| bending.is_in(world).then(|| program(bending));
        let [by_blade, swinging, deformed] = [Bending::Chain, Bending::Swing, Bending::Sheet].map(of);
        let pipeline = |program: &Program, half: f64| program.pipeline(gpu, None, "prepare_pass", &[("half_precision", half)]);
        Self {
            full: pipeline(&continuum, 0.0),
            half: (world.scene.budget.precision == Precision::Half).then(|| pipeline(&continuum, 1.0)),
            by_blade: by_blade.map(|program| pipeline(&program, 0.0)),
            swinging: swinging.map(|program| pipeline(&program, 0.0)),
            deformed: deformed.map(|program| pipeline(&program, 0.0)),
        }
    }

    /// The one that reads these cells.
    pub(super) fn of(&self, cells: &CellBuffers) -> &wgpu::ComputePipeline {
        let pipeline = match Bending::of_cells(cells) {
            Bending::Chain => self.by_blade.as_ref(),
            Bending::Swing => self.swinging.as_ref(),
            Bending::Sheet => self.deformed.as_ref(),
            Bending::Continuum => self.half.as_ref().filter(|_| cells.precision == Precision::Half),
        };
        pipeline.unwrap_or(&self.full)
    }
}
