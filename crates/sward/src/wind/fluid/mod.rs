//! A plane of air that flows: stable fluids on a periodic grid.
//!
//! Stam 1999, as Chen & Johan 2015, §3.3 use it; methods §5. State: velocity \[m/s\] of n × n cells, n a power of two, 16 to 512, cell by cell, row by
//! row; nothing else. A step is sources and bodies, spreading and projection, advection, projection, damping.
//! Differs from the paper: the projection is spectral, of the very differences that divergence is measured with, so what is left of it is rounding;
//! bodies and obstacles drag the air along (penalty), before it is projected.

mod advect;
mod fft;
mod field;
mod force;
mod plane;
mod project;
mod real;
mod source;

pub use advect::advect;
pub use fft::Fft;
pub use field::{FluidBlock, FluidField, FluidState};
pub use force::{Drag, Gust, drag, push};
pub use plane::{FASTEST, Fluid, FluidModel, LEAST_SIDE, MOST_SIDE};
pub use project::{Spectrum, divergence};
pub use real::Real;
pub use source::{FluidPlan, FluidSource, Passing};

/// The text of the WGSL twins; the host's functions stand in the files. It needs `math.wgsl`.
pub const WGSL: [&str; 4] =
    [include_str!("fft.wgsl"), include_str!("project.wgsl"), include_str!("advect.wgsl"), include_str!("force.wgsl")];
