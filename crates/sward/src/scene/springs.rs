//! Settings of the response that deforms billboards: sheets of vertices on springs, pushed out of any body.
//!
//! Orthmann et al. 2009, §5; methods §4.

use super::parameters::{choices, parameters, parameters_with_overrides};

choices! {
    /// How a sheet goes back: the share that is left of how bodies left it, by the share t of its time that is left.
    pub enum Recovery {
        /// t²(3 − 2t): begins and ends gently.
        Smooth,
        /// t³: the paper's, quick at first.
        Cubic,
    }
}

parameters_with_overrides! {
    /// How billboards are deformed, and how they recover.
    pub struct Springs, SpringsOverrides {
        /// Columns of a sheet's vertices, across.
        columns: u32 = 3, "" in 2..=9;
        /// Rows of a sheet's vertices, from the root up.
        rows: u32 = 3, "" in 2..=9;
        /// Share of its change of length that a spring takes back in a sweep: 1 is stiff, 0 does nothing.
        stiffness: f32 = 1.0, "" in 0.0..=1.0;
        /// Sweeps over all springs in a step.
        iterations: u32 = 2, "" in 0..=16;
        /// Time in which a billboard recovers after a body has left it.
        recover: f32 = 2.5, "s" in 0.05..=600.0;
        /// How it does.
        recovery: Recovery = Recovery::Smooth, "";
        /// How far wind holds the tips: the tilt is atan(wind · speed^(4/3)), speed in m/s.
        wind: f32 = 0.0356, "" in 0.0..=1.0;
        /// Texels along a side of the six pictures that a body is known by: more see thinner parts.
        texels: u32 = 64, "" in 16..=256;
    }
    extra {}
}
