//! Which instructions of the machine the kernels use, and numbers of several cells side by side. Every choice computes the same bits.

use std::ops::{Add, Div, Mul, Sub};

pub use pulp::{Scalar, Simd};

/// A set of vector instructions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Lanes {
    /// What every machine of this kind has: four cells at a time.
    Baseline,
    /// 256 bits (x86-64: AVX2).
    Wide,
    /// The widest this machine has, found at run time.
    #[default]
    Widest,
}

/// Work to be compiled for each set of instructions. `run` must be `#[inline(always)]`, with all it calls in its loops: a closure
/// would not do, since the compiler may leave it outside, compiled for the baseline.
pub trait Work {
    /// What comes of it.
    type Output;

    /// Does it.
    fn run<S: Simd>(self, simd: S) -> Self::Output;
}

/// Work as pulp takes it.
struct Dispatched<W>(W);

impl<W: Work> pulp::WithSimd for Dispatched<W> {
    type Output = W::Output;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> W::Output {
        self.0.run(simd)
    }
}

impl Lanes {
    /// The choices this machine has.
    pub fn available() -> Vec<Self> {
        let mut lanes = vec![Self::Baseline];
        #[cfg(target_arch = "x86_64")]
        if pulp::x86::V3::try_new().is_some() {
            lanes.push(Self::Wide);
        }
        lanes.push(Self::Widest);
        lanes
    }

    /// Runs `work`, compiled for this choice.
    pub fn run<W: Work>(self, work: W) -> W::Output {
        match self {
            Self::Baseline => work.run(pulp::Scalar128b),
            #[cfg(target_arch = "x86_64")]
            Self::Wide => match pulp::x86::V3::try_new() {
                Some(level) => Simd::vectorize(level, Dispatched(work)),
                None => work.run(pulp::Scalar128b),
            },
            #[cfg(not(target_arch = "x86_64"))]
            Self::Wide => work.run(pulp::Scalar128b),
            Self::Widest => pulp::Arch::new().dispatch(Dispatched(work)),
        }
    }
}

/// The same number of several cells side by side, as many as an instruction takes. Written like a number, so that a kernel reads like
/// its twin.
#[derive(Clone, Copy, Debug)]
pub struct Number<S: Simd> {
    simd: S,
    values: S::f32s,
}

impl<S: Simd> Number<S> {
    /// One value for all cells.
    #[inline(always)]
    pub fn all(simd: S, value: f32) -> Self {
        Self { simd, values: simd.splat_f32s(value) }
    }

    /// A value for each cell.
    #[inline(always)]
    pub fn of(simd: S, values: S::f32s) -> Self {
        Self { simd, values }
    }

    /// The values.
    #[inline(always)]
    pub fn values(self) -> S::f32s {
        self.values
    }

    /// Bits: of numbers that are not negative they order like the numbers, with what is no number on top.
    #[inline(always)]
    pub fn to_bits(self) -> S::u32s {
        self.simd.transmute_u32s_f32s(self.values)
    }

    /// √.
    #[inline(always)]
    pub fn sqrt(self) -> Self {
        Self { values: self.simd.sqrt_f32s(self.values), ..self }
    }

    /// As [`crate::math::lower`].
    #[inline(always)]
    pub fn lower(self, other: Self) -> Self {
        self.where_less(other, self, other)
    }

    /// `yes` in the cells where this is less than `other`, else `no`.
    #[inline(always)]
    pub fn where_less(self, other: Self, yes: Self, no: Self) -> Self {
        let less = self.simd.less_than_f32s(self.values, other.values);
        Self { values: self.simd.select_f32s(less, yes.values, no.values), ..self }
    }
}

macro_rules! operator {
    ($trait:ident, $name:ident, $instruction:ident) => {
        impl<S: Simd> $trait for Number<S> {
            type Output = Self;

            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                Self { values: self.simd.$instruction(self.values, other.values), ..self }
            }
        }
    };
}

operator!(Add, add, add_f32s);
operator!(Sub, sub, sub_f32s);
operator!(Mul, mul, mul_f32s);
operator!(Div, div, div_f32s);
