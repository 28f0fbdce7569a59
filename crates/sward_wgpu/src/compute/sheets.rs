//! Stands whose billboards bodies deform. Their sheets are stepped by the core's own kernels, also beside a GPU: there are few of them, and their
//! plan is made on the CPU. The device gets them for pictures.

use bytemuck::{Pod, Zeroable};
use sward::response::springs::{SpringsCoefficients, SpringsModel};

/// How sheets lie in their words; needs the springs' texts before it.
pub const SHEET_WORDS_WGSL: &str = include_str!("sheet_words.wgsl");

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
