//! What the kernels need of a species, worked out once when the scene is compiled.

use bytemuck::{Pod, Zeroable};

use crate::math;
use crate::scene::Continuum;

/// Largest bending velocity a cell may carry, rad/s (methods §1.2, §1.3).
pub const RATE_LIMIT: f32 = 60.0;
/// Upright to flat, rad.
pub const HALF_PI: f32 = std::f32::consts::FRAC_PI_2;
/// Smallest bend a steep slope may leave, rad (methods §1.4).
pub const SMALLEST_LIMIT: f32 = 0.05;
/// Cells this close to rest, rad and rad/s, count as resting (methods §1.6).
pub const REST: f32 = 1e-3;

/// Dimensionless numbers of one species at one step and one cell size. The same bytes are the uniform of the WGSL twin.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Coefficients {
    /// c₀, wave speed of a cell at rest, m/s.
    pub base_speed: f32,
    /// μ, gain of wave speed with bending velocity, m.
    pub speed_gain: f32,
    /// c_max, the fastest stable wave, m/s.
    pub speed_cap: f32,
    /// Δt²/Δx², s²/m²: squared speed times this is the weight of the Laplacian.
    pub spread: f32,
    /// c_ω² Δt²/Δx², dimensionless.
    pub rate_spread: f32,
    /// λ_θ for one substep.
    pub damping: f32,
    /// λ_ω for one substep.
    pub rate_damping: f32,
    /// κ Δt² as the scheme needs it (`restoring_of`), dimensionless.
    pub restoring: f32,
    /// κ_ω Δt² likewise.
    pub rate_restoring: f32,
    /// Whole step, s (contact works on whole steps, the wave on substeps).
    pub step: f32,
    /// Height of the plants, m: bodies above it do not touch.
    pub plant_height: f32,
    /// Largest turn of a held plant in one step, rad: 12 rad/s.
    pub turn: f32,
    /// cos and sin of `turn`.
    pub turn_cosine: f32,
    /// See `turn_cosine`.
    pub turn_sine: f32,
    /// Largest approach to the floor under a body in one step, rad: 6 rad/s.
    pub approach: f32,
    /// Not used; keeps the size a multiple of 16 bytes.
    pub unused: f32,
}

/// Damping for another step: λ(Δt) = 1 − (1−λ)^(60 Δt), exact for swaying modes (methods §1.3).
fn damping_of(lambda: f32, dt: f64) -> f64 {
    let steps = 60.0 * dt;
    if steps == 1.0 {
        return f64::from(lambda);
    }
    1.0 - math::exp_f64(steps * math::ln_f64(1.0 - f64::from(lambda)))
}

/// What stands for κΔt² in the scheme so that a uniform bend sways and decays exactly as β'' = −κβ − 2γβ' does, at any step.
///
/// The scheme's modes are the roots of z² − (2 − λ − κΔt²) z + (1 − λ), the equation's are e^(−γΔt ± iω_dΔt). With λ as above their
/// products agree, 1 − λ = e^(−2γΔt) = q²; their sums agree if κΔt² is replaced by 1 + q² − 2q cos(ω_dΔt), ω_d² = κ − γ². κΔt² itself
/// is its limit in short steps, and lets lawn at 60 Hz recover a third too fast.
fn restoring_of(kappa: f32, lambda: f32, dt: f64) -> f64 {
    if kappa == 0.0 {
        return 0.0;
    }
    let decay = -30.0 * math::ln_f64(1.0 - f64::from(lambda));
    let q = math::exp_f64(-decay * dt);
    let squared = f64::from(kappa) - decay * decay;
    let turn = squared.abs().sqrt() * dt;
    let cosine = if squared > 0.0 { math::sin_cos_f64(turn).1 } else { 0.5 * (math::exp_f64(turn) + math::exp_f64(-turn)) };
    let restoring = (1.0 - q) * (1.0 - q) + 2.0 * q * (1.0 - cosine);
    if restoring > 0.0 { restoring } else { 0.0 }
}

/// The fastest stable wave: `(Δx/Δt) √(0.98 (4 − 2λ − κΔt²)/8)` (methods §1.3).
fn fastest(spacing: f64, dt: f64, damping: f64, restoring: f64) -> f64 {
    let room = 0.98 * (4.0 - 2.0 * damping - restoring) / 8.0;
    spacing / dt * if room > 0.0 { room.sqrt() } else { 0.0 }
}

impl Coefficients {
    /// Coefficients for step `dt` \[s\] on cells of side `spacing` \[m\], and the number of substeps the wave needs
    /// (κΔt² ≤ 1 for each). `plant_height` in m.
    pub fn new(species: &Continuum, dt: f64, spacing: f64, plant_height: f32) -> (Self, u32) {
        let stiffest = f64::from(math::upper(species.kappa, species.kappa_omega));
        let whole = (stiffest * dt * dt).sqrt().ceil();
        let substeps = if whole > 1.0 { whole } else { 1.0 };
        let h = dt / substeps;
        let (damping, rate_damping) = (damping_of(species.lambda_theta, h), damping_of(species.lambda_omega, h));
        let restoring = restoring_of(species.kappa, species.lambda_theta, h);
        let rate_restoring = restoring_of(species.kappa_omega, species.lambda_omega, h);
        let rate_speed = f64::from(species.c_omega).min(fastest(spacing, h, rate_damping, rate_restoring));
        let (turn_sine, turn_cosine) = math::sin_cos_f64(12.0 * dt);
        let coefficients = Self {
            base_speed: species.c0,
            speed_gain: species.mu,
            speed_cap: fastest(spacing, h, damping, restoring) as f32,
            spread: (h * h / (spacing * spacing)) as f32,
            rate_spread: (rate_speed * rate_speed * h * h / (spacing * spacing)) as f32,
            damping: damping as f32,
            rate_damping: rate_damping as f32,
            restoring: restoring as f32,
            rate_restoring: rate_restoring as f32,
            step: dt as f32,
            plant_height,
            turn: (12.0 * dt) as f32,
            turn_cosine: turn_cosine as f32,
            turn_sine: turn_sine as f32,
            approach: (6.0 * dt) as f32,
            unused: 0.0,
        };
        (coefficients, substeps as u32)
    }

    /// c = min(c₀ + μ|ω|, c_max), m/s (Chen & Johan eq. 4 and the cap).
    #[inline(always)]
    pub fn wave_speed(&self, rate_squared: f32) -> f32 {
        math::lower(self.base_speed + self.speed_gain * rate_squared.sqrt(), self.speed_cap)
    }
}

/// Largest bend on ground of gradient `slope` along the direction of `bend`: `clamp(π/2 − atan(slope·d), 0.05, π/2)` (methods §1.4).
#[inline(always)]
pub fn bend_limit(slope: [f32; 2], bend: [f32; 2]) -> f32 {
    let length = (bend[0] * bend[0] + bend[1] * bend[1]).sqrt();
    let along = (slope[0] * bend[0] + slope[1] * bend[1]) / math::upper(length, 1e-12);
    math::clamped(HALF_PI - math::atan(along), SMALLEST_LIMIT, HALF_PI)
}

/// The limit of the steepest ground in any direction: below it no cell can be over its own limit.
pub fn safe_limit(steepest: f32) -> f32 {
    math::clamped(HALF_PI - math::atan(steepest), SMALLEST_LIMIT, HALF_PI) * 0.9999
}
