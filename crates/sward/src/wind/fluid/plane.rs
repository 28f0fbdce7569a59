//! The plane and its step.

use super::advect::advect;
use super::fft::Complex;
use super::force::{Drag, Gust, drag, push};
use super::project::Spectrum;
use super::real::Real;
use crate::math::exp_f64;

/// Fewest cells along a side.
pub const LEAST_SIDE: usize = 16;
/// Most.
pub const MOST_SIDE: usize = 512;
/// Fastest that air flows along an axis, m/s: what gusts without measure would make of it.
pub const FASTEST: f32 = 120.0;

/// What does not change of a plane.
#[derive(Clone, Debug)]
pub struct FluidModel<T> {
    /// Cells along a side, a power of two.
    pub side: usize,
    /// Side of a cell, m.
    pub cell: f32,
    /// Its spectral half.
    pub spectrum: Spectrum<T>,
    /// Cells a step for every m/s.
    pub reach: T,
    /// What is left of the flow after a step.
    pub lasts: T,
}

impl<T: Real> FluidModel<T> {
    /// A plane of `side` × `side` cells of `cell` \[m\]; `side` becomes the next power of two within [`LEAST_SIDE`] and [`MOST_SIDE`]. Air of `viscosity`
    /// \[m²/s\] slows to 1/e in `fade` \[s\]; a step is `dt` \[s\].
    pub fn new(side: usize, cell: f32, viscosity: f64, fade: f64, dt: f64) -> Self {
        let side = side.next_power_of_two().clamp(LEAST_SIDE, MOST_SIDE);
        let spectrum = Spectrum::new(side, f64::from(cell), viscosity, dt);
        Self { side, cell, spectrum, reach: T::of(dt / f64::from(cell)), lasts: T::of(exp_f64(-dt / fade)) }
    }
}

/// The flow of a plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Fluid<T> {
    /// Velocity of each cell, m/s along x and y, row by row.
    pub flow: Vec<Complex<T>>,
    other: Vec<Complex<T>>,
}

impl<T: Real> Fluid<T> {
    /// Air that rests.
    pub fn new(model: &FluidModel<T>) -> Self {
        Self::from_flow(vec![Complex::<T>::default(); model.side * model.side])
    }

    /// Air that flows already.
    pub fn from_flow(flow: Vec<Complex<T>>) -> Self {
        Self { other: vec![Complex::<T>::default(); flow.len()], flow }
    }

    /// One step.
    pub fn step(&mut self, model: &FluidModel<T>, gusts: &[Gust], bodies: &[Drag]) {
        push(&mut self.flow, model.side, model.cell, gusts);
        drag(&mut self.flow, model.side, model.cell, bodies);
        model.spectrum.project(&mut self.flow, true);
        advect(&self.flow, model.side, model.reach, &mut self.other);
        std::mem::swap(&mut self.flow, &mut self.other);
        model.spectrum.project(&mut self.flow, false);
        let most = T::of(f64::from(FASTEST));
        let slowed = |part: T| {
            let left = part * model.lasts;
            let left = if left < most { left } else { most };
            if left > -most { left } else { -most }
        };
        self.flow.iter_mut().for_each(|velocity| *velocity = velocity.map(slowed));
    }
}
