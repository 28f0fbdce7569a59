//! Layers farther off show what the first one did some time ago.
//!
//! Chen & Johan 2015, §3.5, eq. 3–5; methods §5. Differs from the paper: its lag changes sign with the wind, needs the future and jumps; here the
//! layer that the wind meets first shows the present, the others the past, and the wind that lags are made of changes slowly.

use crate::math::{lower, upper};

/// Slowest passage through the layers, m/s, and longest, s.
const PASSAGE: [f32; 2] = [0.5, 3.0];
/// How fast a lag that is shown may change, s a second.
const CHANGE: f32 = 0.5;
/// Time in which the mean wind is followed, s.
const FOLLOWED: f32 = 2.0;

/// V_D: how fast motion passes through layers the deepest of which lies `deepest` \[m\] behind the first, m/s.
fn passage(deepest: f32) -> f32 {
    upper(PASSAGE[0], deepest / PASSAGE[1])
}

/// Lags of layers at `depths` \[m from the first\] in a mean wind that blows away from the viewer at `away` \[m/s\], s: 0 for the layer that the wind
/// meets first.
pub fn lags(depths: &[f32], away: f32) -> Vec<f32> {
    let passage = passage(depths.iter().fold(0.0, |most, depth| upper(most, *depth)));
    let own = |depth: f32| depth * away / (away * away + passage * passage);
    let least = depths.iter().map(|depth| own(*depth)).fold(f32::MAX, lower);
    depths.iter().map(|depth| own(*depth) - least).collect()
}

/// The mean wind that lags are made of \[m/s, x and z\], `dt` \[s\] later: it follows `wind`, but never so fast that a lag of plants `deep` \[m\] changes by more
/// than half a second a second, from wherever they are seen.
pub fn drifted(drift: [f32; 2], wind: [f32; 2], deep: f32, dt: f32) -> [f32; 2] {
    let passage = passage(deep);
    let change = [0, 1].map(|axis| (wind[axis] - drift[axis]) * lower(dt / FOLLOWED, 1.0));
    let length = (change[0] * change[0] + change[1] * change[1]).sqrt();
    // The steepest slope of a lag is deep / V_D², of a difference of two likewise.
    let most = CHANGE * dt * passage * passage / upper(deep, 1e-3);
    let share = if length > most { most / length } else { 1.0 };
    [0, 1].map(|axis| drift[axis] + change[axis] * share)
}
