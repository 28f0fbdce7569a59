//! Chen & Johan 2010, eq. 2–6 with κ: how a plane wave and a uniform bend move, step by step.

use crate::common::Torus;

/// Numbers of the scheme for one field: λ, what stands for κΔt², c²Δt²/Δx².
#[derive(Clone, Copy, Debug)]
struct Scheme {
    lambda: f64,
    restoring: f64,
    spread: f64,
}

impl Scheme {
    /// A field whose uniform bend sways as β'' = −κβ − 2γβ' does, γ = −30 ln(1−λ), with waves of `speed` [m/s].
    fn of(lambda: f64, kappa: f64, speed: f64) -> Self {
        let growth = (1.0 - lambda).sqrt();
        let decay = -30.0 * (1.0 - lambda).ln();
        let turn = (kappa - decay * decay).sqrt() * DT;
        let courant = speed * DT / SPACING;
        Self { lambda, restoring: 1.0 + growth * growth - 2.0 * growth * turn.cos(), spread: courant * courant }
    }

    /// Growth per step and phase per step of the mode whose Laplacian is `laplacian`, for a mode that sways.
    fn mode(self, laplacian: f64) -> (f64, f64) {
        let trace = 2.0 - self.lambda + self.spread * laplacian - self.restoring;
        let growth = (1.0 - self.lambda).sqrt();
        let cosine = trace / (2.0 * growth);
        assert!(cosine.abs() < 1.0, "the mode does not sway");
        (growth, cosine.acos())
    }
}

const CELLS: usize = 64;
const SPACING: f64 = 0.25;
const DT: f64 = 1.0 / 60.0;

fn laplacian(wave: [usize; 2]) -> f64 {
    wave.iter().map(|k| 2.0 * (std::f64::consts::TAU * *k as f64 / CELLS as f64).cos() - 2.0).sum()
}

fn phase(wave: [usize; 2], i: usize, j: usize) -> f64 {
    std::f64::consts::TAU * (wave[0] * i + wave[1] * j) as f64 / CELLS as f64
}

/// Amplitude and phase of a plane wave in a plane.
fn projected(plane: &[f32], wave: [usize; 2]) -> (f64, f64) {
    let (mut real, mut imaginary) = (0.0, 0.0);
    for (at, value) in plane.iter().enumerate() {
        let angle = phase(wave, at % CELLS, at / CELLS);
        real += f64::from(*value) * angle.cos();
        imaginary -= f64::from(*value) * angle.sin();
    }
    let scale = 2.0 / plane.len() as f64;
    ((real * real + imaginary * imaginary).sqrt() * scale, imaginary.atan2(real))
}

/// How far growth and phase of a travelling wave are from a scheme's after `steps`, as shares and radians.
fn mismatch(torus: &Torus, plane: usize, wave: [usize; 2], scheme: Scheme, steps: i32) -> (f64, f64) {
    let (growth, turn) = scheme.mode(laplacian(wave));
    let (size, angle) = projected(torus.plane(plane), wave);
    let off = angle + f64::from(steps) * turn;
    let wrapped = off - std::f64::consts::TAU * (off / std::f64::consts::TAU).round();
    ((size / (0.1 * growth.powi(steps)) - 1.0).abs(), wrapped.abs())
}

#[test]
fn equations_5_and_6_a_plane_wave_grows_and_turns_as_the_scheme_says() {
    let text = "field: (patch_side: 16.0), stands: [(species: Meadow, cells: 64, response: Continuum(c0: 3.0, mu: 0.0, c_omega: 2.0,
        lambda_theta: 0.05, lambda_omega: 0.08, kappa: 60.0, kappa_omega: 30.0))]";
    let (bend, rate) = (Scheme::of(0.05, 60.0, 3.0), Scheme::of(0.08, 30.0, 2.0));
    let steps = 60;
    for wave in [[1, 0], [0, 3], [5, 2], [13, 9], [32, 32]] {
        let mut torus = Torus::new(text);
        torus.fill(|level, plane, i, j| {
            let (growth, turn) = if plane < 2 { bend } else { rate }.mode(laplacian(wave));
            let earlier = level as f64;
            (0.1 * growth.powf(-earlier) * (phase(wave, i, j) + earlier * turn).cos()) as f32
        });
        (0..steps).for_each(|_| assert_eq!(torus.step().clamped, 0));
        // A standing pattern (32, 32) is its own mirror wave, so its projection is doubled and has no phase.
        if wave == [32, 32] {
            let (growth, turn) = bend.mode(laplacian(wave));
            let expected = 0.1 * growth.powi(steps) * (f64::from(steps) * turn).cos();
            assert!((f64::from(torus.plane(0)[0]) - expected).abs() < 2e-6, "{} {expected}", torus.plane(0)[0]);
            continue;
        }
        for (plane, scheme) in [(0, bend), (1, bend), (2, rate), (3, rate)] {
            let good = |scheme: Scheme| {
                let (size, angle) = mismatch(&torus, plane, wave, scheme, steps);
                size < 2e-4 && angle < 2e-4
            };
            assert!(good(scheme), "wave {wave:?} plane {plane}: {:?}", mismatch(&torus, plane, wave, scheme, steps));
            assert!(!good(Scheme { lambda: scheme.lambda + 0.002, ..scheme }), "control: another λ must not fit");
            assert!(!good(Scheme { restoring: scheme.restoring * 1.02, ..scheme }), "control: another κ must not fit");
            assert!(!good(Scheme { spread: scheme.spread * 1.02 * 1.02, ..scheme }), "control: another c must not fit");
        }
    }
}

/// Frequency [Hz] and damping ratio of a sequence that obeys a linear recurrence of two terms, by least squares.
fn measured(samples: &[f64], dt: f64) -> (f64, f64) {
    let (mut aa, mut ab, mut bb, mut ay, mut by) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for three in samples.windows(3) {
        let (a, b, y) = (three[1], three[0], three[2]);
        (aa, ab, bb, ay, by) = (aa + a * a, ab + a * b, bb + b * b, ay + a * y, by + b * y);
    }
    let determinant = aa * bb - ab * ab;
    let (trace, product) = ((ay * bb - by * ab) / determinant, -(by * aa - ay * ab) / determinant);
    // The roots z of z² = trace·z − product are e^(s Δt); s₁ s₂ = (2πf)², −(s₁ + s₂)/2 = ζ 2πf.
    let inside = trace * trace / 4.0 - product;
    let (sum, squared) = if inside < 0.0 {
        let (decay, turn) = (-0.5 * product.ln() / dt, (trace / (2.0 * product.sqrt())).acos() / dt);
        (2.0 * decay, decay * decay + turn * turn)
    } else {
        let [a, b] = [1.0, -1.0].map(|sign: f64| -(trace / 2.0 + sign * inside.sqrt()).ln() / dt);
        (a + b, a * b)
    };
    (squared.sqrt() / std::f64::consts::TAU, sum / (2.0 * squared.sqrt()))
}

fn released(species: &str, rate: u32) -> (f64, f64, Torus) {
    let text = format!("steps_per_second: {rate}, field: (patch_side: 8.0), stands: [(species: {species}, cells: 8)]");
    let mut torus = Torus::new(&text);
    torus.fill(|_, plane, _, _| if plane == 0 { 0.3 } else { 0.0 });
    let mut samples = vec![f64::from(torus.plane(0)[0]); 2];
    for _ in 0..rate {
        torus.step();
        samples.push(f64::from(torus.plane(0)[0]));
    }
    let (frequency, damping) = measured(&samples, 1.0 / f64::from(rate));
    (frequency, damping, torus)
}

/// √κ/2π and ζ = −30 ln(1−λ)/√κ name a swaying that the scheme has exactly, whatever the step.
#[test]
fn a_released_bend_sways_with_the_frequency_and_damping_people_set() {
    for species in ["Meadow", "Reed", "Tussock", "Lawn"] {
        for rate in [30, 60, 144, 1000] {
            let (frequency, damping, torus) = released(species, rate);
            let continuum = torus.stand.species.continuum;
            let omega = f64::from(continuum.kappa).sqrt();
            let (named, ratio) = (omega / std::f64::consts::TAU, -30.0 * (1.0 - f64::from(continuum.lambda_theta)).ln() / omega);
            println!("{species} at {rate} Hz: {named:.4} Hz named, {frequency:.4} measured; ζ {ratio:.4} named, {damping:.4} measured");
            let exact = |factor: f64| (frequency / (named * factor) - 1.0).abs() < 2e-3 && (damping / ratio - 1.0).abs() < 2e-3;
            assert!(exact(1.0), "{species} at {rate} Hz");
            assert!(!exact(1.01), "control: another frequency");
        }
    }
}
