//! What makes a bush a bush and a tree a tree: numbers, level by level.

use super::blade::Detail;
use super::branch::Run;
use crate::math::{clamped, exp_f64, ln_f64};

/// How branches of a level run, and what they bear.
#[derive(Clone, Copy, Debug)]
pub(super) struct Level {
    pub(super) run: Run,
    pub(super) sides: u32,
    /// Radius at the start as a share of the length, at most.
    pub(super) thickness: f32,
    /// Branches that each bears, on average.
    pub(super) children: f32,
    /// Where the first stands, as a share of the length.
    pub(super) first: f32,
    /// Their angles from it, at its start and at its tip, rad.
    pub(super) angles: [f32; 2],
    /// Their length as a share of its own.
    pub(super) ratio: f32,
    /// Whether their lengths make an oval crown; else they get shorter towards the tip.
    pub(super) oval: bool,
    /// Share of the length, from the tip, that bears leaves.
    pub(super) leafy: f32,
}

/// A plant with branches, as high as 1.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    /// How many stems come out of the ground.
    pub(super) stems: u32,
    /// How far apart they start, and how far the outermost lean, rad.
    pub(super) spread: f32,
    pub(super) lean: f32,
    /// Stems and all that they bear.
    pub(super) levels: Vec<Level>,
    pub(super) detail: Detail,
    /// Area of all leaves.
    pub(super) leaf_area: f32,
    /// A leaf's half width as a share of its length.
    pub(super) half: f32,
    /// Height of the crown's middle: leaves look away from it.
    pub(super) middle: f32,
    /// About how far the crown reaches from there.
    pub(super) radius: f32,
    /// Linear colours of leaves: in the shade, most, and the youngest.
    pub(super) greens: [[f32; 3]; 3],
    pub(super) bark: [f32; 3],
}

fn power(base: f32, exponent: f32) -> f32 {
    exp_f64(ln_f64(f64::from(base)) * f64::from(exponent)) as f32
}

/// How many levels of twigs there are after `limbs` until there are about `twigs`, and how many each bears.
fn branching(twigs: f32, limbs: f32) -> (u32, f32) {
    let mut levels = 1;
    while power(twigs / limbs, 1.0 / levels as f32) > 11.0 && levels < 5 {
        levels += 1;
    }
    (levels, power(twigs / limbs, 1.0 / levels as f32))
}

fn detail(triangles: u32) -> Detail {
    match triangles {
        0..100_000 => Detail::Two,
        100_000..2_000_000 => Detail::Four,
        _ => Detail::Six,
    }
}

/// Twigs that so many triangles allow.
fn twigs(triangles: u32, detail: Detail) -> f32 {
    0.72 * triangles as f32 / (11.0 * detail.triangles() as f32)
}

/// The levels above limbs of a length, until twigs reach from one to the next in a crown of a volume.
fn spray(limb: Level, limb_length: f32, twigs: f32, limbs: f32, volume: f32, rich: bool) -> Vec<Level> {
    let (count, each) = branching(twigs, limbs);
    let reach = if rich { 2.2 } else { 1.7 } * crate::math::cbrt(volume / twigs);
    let ratio = clamped(power(reach / limb_length, 1.0 / count as f32), 0.3, 0.62);
    let mut levels = vec![Level { children: each, ratio, leafy: if count == 1 { 0.45 } else { 0.0 }, ..limb }];
    for number in 0..count {
        let last = number + 1 == count;
        let segments = if last { 1 + u32::from(rich) } else { 4 + u32::from(rich) };
        let sides = if last { 3 } else { if rich { 5 - u32::from(number > 0) } else { 3 } };
        let run = Run { segments, rise: 0.35, bend: 0.55, tip: 0.25, flare: 0.0 };
        let leafy = if last {
            0.85
        } else if number + 2 == count {
            0.3
        } else {
            0.0
        };
        let children = if last { 0.0 } else { each };
        levels.push(Level { run, sides, thickness: 0.016, children, first: 0.2, angles: [1.05, 0.6], ratio, oval: false, leafy });
    }
    levels
}

/// A round bush.
pub(super) fn bush(triangles: u32) -> Plan {
    let detail = detail(triangles);
    let rich = triangles > 200_000;
    let twigs = twigs(triangles, detail);
    let stems = if triangles < 6000 {
        9
    } else if rich {
        26
    } else {
        16
    };
    let run = Run { segments: if rich { 9 } else { 6 }, rise: 0.35, bend: 0.5, tip: 0.2, flare: 0.15 };
    let limb = Level {
        run,
        sides: if rich { 8 } else { 5 },
        thickness: 0.016,
        children: 0.0,
        first: 0.05,
        angles: [1.0, 0.6],
        ratio: 0.5,
        oval: false,
        leafy: 0.0,
    };
    Plan {
        stems,
        spread: 0.1,
        lean: 1.02,
        levels: spray(limb, 0.8, twigs, stems as f32, 0.95, rich),
        detail,
        leaf_area: if rich { 8.0 } else { 5.0 },
        half: 0.27,
        middle: 0.35,
        radius: 0.62,
        greens: [[0.032, 0.085, 0.018], [0.055, 0.135, 0.024], [0.105, 0.2, 0.036]],
        bark: [0.115, 0.082, 0.055],
    }
}

/// A broad-leaved tree.
pub(super) fn tree(triangles: u32) -> Plan {
    let detail = detail(triangles);
    let rich = triangles > 200_000;
    let twigs = twigs(triangles, detail);
    let limbs = if triangles < 6000 {
        14.0
    } else if rich {
        34.0
    } else {
        24.0
    };
    let trunk = Level {
        run: Run { segments: if rich { 22 } else { 12 }, rise: 0.12, bend: 0.16, tip: 0.12, flare: 0.65 },
        sides: if rich { 16 } else { 8 },
        thickness: 0.021,
        children: limbs,
        first: 0.26,
        angles: [1.3, 0.62],
        ratio: 0.42,
        oval: true,
        leafy: 0.0,
    };
    let limb = Level {
        run: Run { segments: if rich { 10 } else { 6 }, rise: 0.32, bend: 0.38, tip: 0.18, flare: 0.25 },
        sides: if rich { 9 } else { 5 },
        thickness: 0.019,
        children: 0.0,
        first: 0.22,
        angles: [1.0, 0.55],
        ratio: 0.5,
        oval: false,
        leafy: 0.0,
    };
    let mut levels = vec![trunk];
    levels.extend(spray(limb, 0.36, twigs, limbs, 0.17, rich));
    Plan {
        stems: 1,
        spread: 0.0,
        lean: 0.05,
        levels,
        detail,
        leaf_area: if rich { 3.2 } else { 1.8 },
        half: 0.3,
        middle: 0.58,
        radius: 0.36,
        greens: [[0.03, 0.075, 0.014], [0.05, 0.118, 0.02], [0.088, 0.17, 0.03]],
        bark: [0.13, 0.1, 0.075],
    }
}
