//! Blades on the GPU: solved in a compute pass that counts what it finds, drawn indirectly.

mod draw;
mod solve;

use sward::picture::blade_plan::{AROUND, BLADES_PER_INSTANCE, GROUP, HEAD};

use super::prepare::Bending;
pub(crate) use draw::{BladePass, Level, PARTS, ReadyBlades};
pub use solve::{BladeBuffers, SolvePass, Solving};

/// A stand's blades, solved: what a picture draws of them.
#[derive(Clone, Copy)]
pub struct BladeDraw<'a> {
    /// Where they are.
    pub buffers: &'a BladeBuffers,
    /// How those with each number of pieces look.
    pub styles: [sward::shading::blade::BladeStyle; sward::picture::blade_plan::LEVELS],
}

/// The constants of the shaders.
pub fn constants() -> String {
    format!(
        "const BLADE_HEAD: u32 = {HEAD}u;\nconst BLADE_GROUP: u32 = {GROUP}u;\nconst BLADES_PER_INSTANCE: u32 = {BLADES_PER_INSTANCE}u;\nconst BLADE_AROUND: f32 = {AROUND:?};\n"
    )
}

/// Every text of these passes that is not a drawing shader, with its name.
pub fn assembled() -> [(&'static str, String); 5] {
    [
        ("blades, solved", solve::assembled(Bending::Continuum)),
        ("blades, solved blade by blade", solve::assembled(Bending::Chain)),
        ("blades, solved plant by plant", solve::assembled(Bending::Swing)),
        ("blades, solved sheet by sheet", solve::assembled(Bending::Sheet)),
        ("blades, counted", solve::finish()),
    ]
}
