//! The full chain about upright: its inertia, its stiffness, and its first mode. f64, + − × ÷ √ only.
//!
//! Methods §3.1: the n × n eigenproblem K φ = (2πf)² M φ in the tilts of the segments from upright. Segments are thin rods.

use super::blade::{Blade, GRAVITY, MOST_SEGMENTS};

/// A matrix of a chain; only the first n rows and columns count.
pub(super) type Square = [[f64; MOST_SEGMENTS]; MOST_SEGMENTS];

/// A way of swaying.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode {
    /// Hz.
    pub frequency: f64,
    /// Tilt of each segment from upright, rad, the largest 1.
    pub shape: [f64; MOST_SEGMENTS],
    /// What the springs alone hold, over the whole with gravity: φᵀK_sφ / φᵀKφ, 1 or more.
    pub spring_share: f64,
}

/// How far along each segment's direction the centre of segment `i` lies, m.
pub(super) fn lever(blade: &Blade, i: usize, j: usize) -> f64 {
    match j.cmp(&i) {
        std::cmp::Ordering::Less => 2.0 * blade.half_length,
        std::cmp::Ordering::Equal => blade.half_length,
        std::cmp::Ordering::Greater => 0.0,
    }
}

/// Kinetic energy is ½ Σ A_ij ḋ_i·ḋ_j in the directions d of the segments: centres that move and rods that turn, kg·m².
pub(super) fn inertia(blade: &Blade) -> Square {
    let n = blade.segments as usize;
    let mut a = [[0.0; MOST_SEGMENTS]; MOST_SEGMENTS];
    for i in 0..n {
        for j in 0..n {
            for k in 0..n {
                a[i][j] += blade.mass * lever(blade, k, i) * lever(blade, k, j);
            }
        }
        a[i][i] += blade.mass * blade.half_length * blade.half_length / 3.0;
    }
    a
}

/// Height of all centres per height of direction `j`, times weight, N·m: what gravity turns segment `j` over with.
pub(super) fn weight_lever(blade: &Blade, j: usize) -> f64 {
    let above = (blade.segments as usize - 1 - j) as f64;
    blade.mass * GRAVITY * blade.half_length * (1.0 + 2.0 * above)
}

/// Stiffness of the springs alone in the tilts of the segments, N·m/rad.
pub(super) fn springs(blade: &Blade) -> Square {
    let n = blade.segments as usize;
    let mut k = [[0.0; MOST_SEGMENTS]; MOST_SEGMENTS];
    for i in 0..n {
        let stiffness = blade.stiffness(i);
        k[i][i] += stiffness;
        if i > 0 {
            k[i - 1][i - 1] += stiffness;
            k[i - 1][i] -= stiffness;
            k[i][i - 1] -= stiffness;
        }
    }
    k
}

/// The lower triangle L of A = L Lᵀ; `None` unless A is positive definite.
pub(super) fn cholesky(a: &Square, n: usize) -> Option<Square> {
    let mut l = [[0.0; MOST_SEGMENTS]; MOST_SEGMENTS];
    for i in 0..n {
        for j in 0..=i {
            let mut rest = a[i][j];
            for k in 0..j {
                rest -= l[i][k] * l[j][k];
            }
            if i == j {
                if rest.is_nan() || rest <= 0.0 {
                    return None;
                }
                l[i][i] = rest.sqrt();
            } else {
                l[i][j] = rest / l[j][j];
            }
        }
    }
    Some(l)
}

/// x of L Lᵀ x = b.
pub(super) fn solved(l: &Square, n: usize, b: &[f64; MOST_SEGMENTS]) -> [f64; MOST_SEGMENTS] {
    let mut x = *b;
    for i in 0..n {
        for k in 0..i {
            x[i] -= l[i][k] * x[k];
        }
        x[i] /= l[i][i];
    }
    for i in (0..n).rev() {
        for k in i + 1..n {
            x[i] -= l[k][i] * x[k];
        }
        x[i] /= l[i][i];
    }
    x
}

/// A x.
fn times(a: &Square, n: usize, x: &[f64; MOST_SEGMENTS]) -> [f64; MOST_SEGMENTS] {
    let mut y = [0.0; MOST_SEGMENTS];
    for i in 0..n {
        for j in 0..n {
            y[i] += a[i][j] * x[j];
        }
    }
    y
}

fn dot(n: usize, x: &[f64; MOST_SEGMENTS], y: &[f64; MOST_SEGMENTS]) -> f64 {
    (0..n).map(|i| x[i] * y[i]).sum()
}

/// The slowest mode of the full chain about upright, by inverse iteration; `None` if it buckles. The blade's numbers are in range.
pub fn first_mode(blade: &Blade) -> Option<Mode> {
    let n = (blade.segments as usize).clamp(1, MOST_SEGMENTS);
    let (a, springs) = (inertia(blade), springs(blade));
    let mut k = springs;
    for j in 0..n {
        k[j][j] -= weight_lever(blade, j);
    }
    let factor = cholesky(&k, n)?;
    let mut shape = [0.0; MOST_SEGMENTS];
    shape[..n].fill(1.0);
    // The second mode is some six times as fast: every turn takes away a factor of 30 to 40 of it.
    for _ in 0..60 {
        let next = solved(&factor, n, &times(&a, n, &shape));
        let mut largest = next[0];
        for value in &next[..n] {
            largest = if value.abs() > largest.abs() { *value } else { largest };
        }
        shape = next.map(|value| value / largest);
    }
    let stiffness = dot(n, &shape, &times(&k, n, &shape));
    let omega = (stiffness / dot(n, &shape, &times(&a, n, &shape))).sqrt();
    let spring_share = dot(n, &shape, &times(&springs, n, &shape)) / stiffness;
    (omega.is_finite() && omega > 0.0).then_some(Mode { frequency: omega / std::f64::consts::TAU, shape, spring_share })
}
