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

    /// Runs `work`, compiled for this choice. Only what is inlined into `work` profits.
    pub fn run<R>(self, work: impl FnOnce() -> R) -> R {
        match self {
            Self::Baseline => work(),
            #[cfg(target_arch = "x86_64")]
            Self::Wide => match pulp::x86::V3::try_new() {
                Some(level) => level.vectorize(work),
                None => work(),
            },
            #[cfg(not(target_arch = "x86_64"))]
            Self::Wide => work(),
            Self::Widest => pulp::Arch::new().dispatch(work),
        }
    }
}
