//! A recording: what a plant that was pulled and let go did, sample by sample.

/// Fewest samples from which a swing can be told.
pub const FEWEST: usize = 12;
/// Larger numbers are none that anybody measured; their squares would overflow.
const LARGEST: f64 = 1e100;

/// Samples of one motion, in order of time. Their distance may change.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    times: Vec<f64>,
    values: Vec<f64>,
}

/// Why samples are no recording. Samples count from 0.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RecordingError {
    /// Too few.
    #[error("{samples} samples, at least {FEWEST} are needed")]
    TooFew {
        /// How many there are.
        samples: usize,
    },
    /// Lists of different lengths.
    #[error("{times} times for {values} values")]
    Unpaired {
        /// How many times.
        times: usize,
        /// How many values.
        values: usize,
    },
    /// No number that could have been measured.
    #[error("{number} is no number that can be measured; allowed -1e100 to 1e100")]
    NoNumber {
        /// Which sample.
        sample: usize,
        /// Its time or value.
        number: f64,
    },
    /// Time does not go on.
    #[error("the time {time} s does not come after {before} s")]
    NotLater {
        /// Which sample.
        sample: usize,
        /// Its time, s.
        time: f64,
        /// That of the sample before, s.
        before: f64,
    },
}

impl RecordingError {
    /// The sample at fault, if it is one.
    #[must_use]
    pub fn sample(&self) -> Option<usize> {
        match self {
            Self::NoNumber { sample, .. } | Self::NotLater { sample, .. } => Some(*sample),
            Self::TooFew { .. } | Self::Unpaired { .. } => None,
        }
    }
}

impl Recording {
    /// Of times \[s\] that go on from sample to sample, and values in any unit: strain, tilt, the way of a tip.
    ///
    /// # Errors
    /// Fewer than [`FEWEST`] samples, numbers that are none, or times that do not go on; the first one wrong.
    pub fn new(times: Vec<f64>, values: Vec<f64>) -> Result<Self, RecordingError> {
        if times.len() != values.len() {
            return Err(RecordingError::Unpaired { times: times.len(), values: values.len() });
        }
        for (sample, (time, value)) in times.iter().zip(&values).enumerate() {
            if let Some(number) = [*time, *value].into_iter().find(|number| number.is_nan() || number.abs() > LARGEST) {
                return Err(RecordingError::NoNumber { sample, number });
            }
            let before = if sample > 0 { times[sample - 1] } else { f64::NEG_INFINITY };
            if *time <= before {
                return Err(RecordingError::NotLater { sample, time: *time, before });
            }
        }
        if times.len() < FEWEST {
            return Err(RecordingError::TooFew { samples: times.len() });
        }
        Ok(Self { times, values })
    }

    /// Times, s.
    #[must_use]
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Values.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }
}
