//! What can be wrong with a blade.

/// Why a blade could not be calibrated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ChainError {
    /// Too few or too many segments.
    #[error("a blade of {segments} segments; write 1 to {most}")]
    Segments {
        /// As written.
        segments: u32,
        /// Most that fit.
        most: usize,
    },
    /// A number outside its range, or none.
    #[error("{what} is {value}; write a number from {low} to {high}")]
    Range {
        /// Which, with its unit.
        what: &'static str,
        /// As written.
        value: f64,
        /// Least allowed.
        low: f64,
        /// Most allowed.
        high: f64,
    },
    /// The weight turns a segment over against its spring.
    #[error(
        "the blade cannot stand: at joint {joint} of {segments} its weight takes {share:.0} % of what the spring holds, at most 80 % may; \
         make the stiffness there at least {needed:.3e} N·m/rad, or the segments lighter or shorter"
    )]
    CannotStand {
        /// Which, from 1 at the root.
        joint: usize,
        /// Of how many.
        segments: usize,
        /// Weight over spring, %.
        share: f64,
        /// Stiffness that would do, N·m/rad.
        needed: f64,
    },
    /// Each joint holds, all together do not.
    #[error("the blade cannot stand: upright it buckles under its own weight; make it stiffer, lighter or shorter")]
    Buckles,
}
