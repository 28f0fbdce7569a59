//! How games and grass add-ons let bent grass stand up again: laws that a host applies once a frame. They are here to be compared with, and
//! move no plant of ours.
//!
//! Each begins at 1, fully bent, and is tuned to have recovered after [`MEANT`] seconds: in frames of no length, but for
//! [`Law::ShareOfGap`], which knows no seconds and is tuned where such things are tuned, at 60 frames a second.

/// How long each law is meant to take, s.
pub(crate) const MEANT: f64 = 1.5;
/// Share of the bend at which laws that never quite end, and plants of ours, have recovered.
pub(crate) const LEFT: f64 = 0.01;
/// Frames a second at which [`Law::ShareOfGap`] is tuned.
const TUNED_AT: f64 = 60.0;
/// Steps of a number of 10 bits.
const STEPS_OF_10_BITS: f64 = 1023.0;
/// A law that takes so many times as long as it is meant to never recovers.
const PATIENCE: f64 = 20.0;

/// A law of recovery.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Law {
    /// A stamp that fades by Δt/T a frame and is stored in 10 bits, as a direction in an RGB10A2 picture is: `x = round(x - dt / T)`.
    LinearIn10Bits,
    /// A share of the gap each frame, however long that is: `x *= 1 - k`.
    ShareOfGap,
    /// A rate times the frame's length: `x *= 1 - min(rate * dt, 1)`, a "lerp" by Δt.
    RateTimesFrame,
    /// What the one before is an approximation of: `x *= exp(-rate * dt)`.
    Exponential,
    /// A critically damped spring, semi-implicit Euler: `v += (-w*w*x - 2*w*v) * dt; x += v * dt`.
    Spring,
}

/// What a law changes.
#[derive(Clone, Copy, Debug)]
struct Fading {
    /// Share of the bend that is left.
    left: f64,
    /// Its rate of change, 1/s: of the spring.
    rate: f64,
}

impl Law {
    /// All of them.
    pub(crate) const ALL: [Self; 5] = [Self::LinearIn10Bits, Self::ShareOfGap, Self::RateTimesFrame, Self::Exponential, Self::Spring];

    /// For a reader.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::LinearIn10Bits => "linear, stored in 10 bits",
            Self::ShareOfGap => "a share of the gap each frame",
            Self::RateTimesFrame => "a rate times the frame's length",
            Self::Exponential => "exponential, exact for any frame",
            Self::Spring => "critically damped spring, Euler",
        }
    }

    /// Share of the bend at which it has recovered.
    fn end(self) -> f64 {
        if self == Self::LinearIn10Bits { 0.0 } else { LEFT }
    }

    /// One frame of `dt` s.
    fn frame(self, fading: &mut Fading, dt: f64) {
        // Exponential laws have LEFT left after MEANT.
        let rate = -LEFT.ln() / MEANT;
        match self {
            Self::LinearIn10Bits => {
                let faded = (fading.left - dt / MEANT).max(0.0);
                fading.left = (faded * STEPS_OF_10_BITS).round() / STEPS_OF_10_BITS;
            }
            Self::ShareOfGap => fading.left *= (-rate / TUNED_AT).exp(),
            Self::RateTimesFrame => fading.left *= 1.0 - (rate * dt).min(1.0),
            Self::Exponential => fading.left *= (-rate * dt).exp(),
            Self::Spring => {
                let stiffness = SPRING / MEANT;
                fading.rate += (-stiffness * stiffness * fading.left - 2.0 * stiffness * fading.rate) * dt;
                fading.left += fading.rate * dt;
            }
        }
    }

    /// Seconds it takes at a rate of frames [1/s]; infinite where it never ends.
    pub(crate) fn recovery(self, frames_per_second: f64) -> f64 {
        let dt = 1.0 / frames_per_second;
        let mut fading = Fading { left: 1.0, rate: 0.0 };
        let frames = (PATIENCE * MEANT * frames_per_second) as u64;
        let curve = (0..=frames).map(|frame| {
            let moment = (frame as f64 * dt, fading.left);
            self.frame(&mut fading, dt);
            moment
        });
        recovered(curve, self.end())
    }
}

/// ω·t at which a critically damped spring let go at rest has [`LEFT`] left: (1 + ωt) e^(−ωt) = 0.01.
const SPRING: f64 = 6.638_352_067_993_812;

/// When a curve of (seconds, share left) is at `end` or nearer to 0 for good, s; between two frames the straight line counts. Infinite for one that
/// is not at its last moment.
pub(crate) fn recovered(curve: impl Iterator<Item = (f64, f64)>, end: f64) -> f64 {
    let mut since: Option<f64> = None;
    let mut last: Option<(f64, f64)> = None;
    for (time, left) in curve {
        let left = left.abs();
        if left > end {
            since = None;
        } else if since.is_none() {
            since = Some(match last {
                Some((before, above)) if above > left => before + (time - before) * (above - end) / (above - left),
                _ => time,
            });
        }
        last = Some((time, left));
    }
    since.unwrap_or(f64::INFINITY)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_has_recovered_when_it_stays() {
        let line = |shares: &[f64]| recovered(shares.iter().enumerate().map(|(at, left)| (at as f64, *left)), 0.25);
        assert_eq!(line(&[1.0, 0.5, 0.0]), 1.5);
        assert_eq!(line(&[1.0, 0.0, -0.75, 0.25, 0.0]), 3.0, "it swung out again");
        assert!(line(&[1.0, 0.5]).is_infinite() && line(&[]).is_infinite());
        assert_eq!(line(&[0.0, 0.0]), 0.0);
    }

    /// The frames in README: 1.5 s become 1.0 to 2.05 s.
    #[test]
    fn ten_bits_make_one_and_a_half_seconds_one_to_two() {
        let at = |rate: f64| Law::LinearIn10Bits.recovery(rate);
        // 1023 steps in 1.5 s are 682 a second: 1 a frame at 1000 frames a second, still 1 at 500, 11 at 60.
        assert!((at(1000.0) - 1.023).abs() < 1e-9 && (at(500.0) - 2.046).abs() < 1e-9 && (at(60.0) - 93.0 / 60.0).abs() < 1e-9);
        // Control: the claim is of these two, not of any; and half a step a frame never fades.
        assert!((at(90.0) - MEANT).abs() < 0.1 && at(1500.0).is_infinite());
    }

    #[test]
    fn laws_take_what_they_are_meant_to_in_very_short_frames() {
        for law in [Law::RateTimesFrame, Law::Exponential, Law::Spring] {
            let off = law.recovery(1e5) / MEANT - 1.0;
            assert!(off.abs() < 1e-3, "{law:?}: {off}");
        }
        assert!((Law::ShareOfGap.recovery(TUNED_AT) / MEANT - 1.0).abs() < 1e-3);
        // Control: the same law elsewhere.
        assert!((Law::ShareOfGap.recovery(2.0 * TUNED_AT) / MEANT - 0.5).abs() < 1e-3);
        assert!(((1.0 + SPRING) * (-SPRING).exp() / LEFT - 1.0).abs() < 1e-9);
    }
}
