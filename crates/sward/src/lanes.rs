//! Which instructions of the machine the kernels use. Every choice computes the same bits.

/// A set of vector instructions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Lanes {
    /// What every machine of this kind has.
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
    fn run(self) -> Self::Output;
}

/// Work as pulp takes it.
struct Inlined<W>(W);

impl<W: Work> pulp::NullaryFnOnce for Inlined<W> {
    type Output = W::Output;

    #[inline(always)]
    fn call(self) -> W::Output {
        self.0.run()
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
            Self::Baseline => work.run(),
            #[cfg(target_arch = "x86_64")]
            Self::Wide => match pulp::x86::V3::try_new() {
                Some(level) => level.vectorize(Inlined(work)),
                None => work.run(),
            },
            #[cfg(not(target_arch = "x86_64"))]
            Self::Wide => work.run(),
            Self::Widest => pulp::Arch::new().dispatch(Inlined(work)),
        }
    }
}
