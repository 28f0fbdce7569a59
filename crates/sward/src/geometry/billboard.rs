//! Billboards of n segments: a plant is a spine of joints carrying crossed cards.
//!
//! Chen & Johan 2010, §3 and Fig. 5; methods §1.5. Segment i is tilted by β_i from the vertical, so a steady bend is straight.
//! Joints below the terrain are lifted onto it (+1 mm). Twin: `billboard.wgsl`.

use crate::math;

/// The spine in WGSL; needs `math` before it.
pub const WGSL: &str = include_str!("billboard.wgsl");

/// Height by which a joint clears the ground, m.
pub const CLEARANCE: f32 = 1e-3;

/// Offset of the end of a segment of `length` m from its start, tilted by `bend` [rad, ground-plane vector]: continuous at 0.
pub fn segment(bend: [f32; 2], length: f32) -> [f32; 3] {
    let tilt = (bend[0] * bend[0] + bend[1] * bend[1]).sqrt();
    let (sine, cosine) = math::sin_cos(tilt);
    let along = if tilt > 1e-6 { sine / tilt } else { 1.0 };
    [bend[0] * along * length, cosine * length, bend[1] * along * length]
}

/// Most that a plant bends that leans by itself, rad.
const FLAT: f32 = 1.55;

/// Bend of a segment of a plant that leans by itself, rad along x and z: within a quarter turn.
pub fn leaning(bend: [f32; 2], lean: [f32; 2]) -> [f32; 2] {
    if lean == [0.0; 2] {
        return bend;
    }
    let [x, z] = [bend[0] + lean[0], bend[1] + lean[1]];
    let size = (x * x + z * z).sqrt();
    let share = if size > FLAT { FLAT / size } else { 1.0 };
    [x * share, z * share]
}

/// Bend of an upper segment some share of a step ago, from what is known now: the cascade's own step, taken back.
///
/// `here` is its bend now, `below` that of the segment under it now and then \[rad\]. `gains` as of
/// [`crate::response::continuum::LagCoefficients::past`]; `behind` in steps, 0 to 1.
pub fn earlier(here: [f32; 2], below: [[f32; 2]; 2], gains: [f32; 4], behind: f32) -> [f32; 2] {
    let squared = |bend: [f32; 2]| bend[0] * bend[0] + bend[1] * bend[1];
    let recovering = squared(below[0]) < squared(here);
    let (gain, share) = if recovering { (gains[1], gains[3]) } else { (gains[0], gains[2]) };
    let axis = |k: usize| here[k] - behind * gain * (below[0][k] - here[k]) + share * (below[1][k] - below[0][k]);
    [axis(0), axis(1)]
}

/// Joints of a spine, root first: `bends[i]` of each segment, plant `height` m, `ground(x, z)` m at the same coordinates as `root`.
pub fn spine(root: [f32; 3], height: f32, bends: &[[f32; 2]], ground: impl Fn(f32, f32) -> f32) -> Vec<[f32; 3]> {
    let length = height / bends.len() as f32;
    let mut joints = vec![root];
    let mut at = root;
    for bend in bends {
        let step = segment(*bend, length);
        at = [at[0] + step[0], at[1] + step[1], at[2] + step[2]];
        let floor = ground(at[0], at[2]) + CLEARANCE;
        at[1] = math::upper(at[1], floor);
        joints.push(at);
    }
    joints
}
