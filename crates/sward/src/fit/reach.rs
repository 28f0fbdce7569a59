//! How far a press reaches among plants that touch: what the speed of the bending wave follows from.
//!
//! Not from a paper; Chen & Johan 2010 leave c to be tuned, and name botanical properties as future work. A single plant does not say how fast a push
//! spreads, but height, distance and frequency do. At rest the wave equation is c²∇²β = κβ: a press dies away as e^(−r/ℓ), ℓ = c/√κ. And plants that
//! stand in a row as straight rods lean on one another: the tip of one is at the next one, so tan θ' = tan θ − s / (h cos θ). From both, c = √κ ℓ.

use crate::math::{atan, sin_cos_f64};

/// Tilt of the plant that is pressed, rad: half-way down.
const PRESSED: f64 = std::f64::consts::FRAC_PI_4;
/// Plants that are looked at; those beyond hardly lean.
const MOST: u32 = 100_000;

/// ℓ \[m\] of plants `height` \[m\] high that stand `distance` \[m\] apart; 0 where they do not touch.
///
/// The sum of all tilts in a row, times their distance, over the tilt that is pressed, is R = √(ℓ² + s²/4) of the wave sampled at the plants.
#[must_use]
pub fn reach(height: f64, distance: f64) -> f64 {
    let (mut tilt, mut sum) = (PRESSED, 0.5);
    for _ in 0..MOST {
        let (sine, cosine) = sin_cos_f64(tilt);
        let tangent = sine / cosine - distance / (height * cosine);
        if tangent.is_nan() || tangent <= 0.0 {
            break;
        }
        tilt = f64::from(atan(tangent as f32));
        sum += tilt / PRESSED;
    }
    let whole = distance * sum;
    let squared = whole * whole - 0.25 * distance * distance;
    if squared > 0.0 { squared.sqrt() } else { 0.0 }
}
