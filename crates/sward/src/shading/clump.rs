//! Pictures of grass clumps, painted by code: many curved, tapered blades on a transparent card.
//!
//! Channels of a texel, 0..=255: R shade of the blade (its brightness), G dryness (0 green, 255 straw), B the direction the
//! blade faces (0 = 75° to the card's left, 255 = 75° to its right), A coverage. Row 0 is the top of the card.
//! Every picture is a pure function of kind and variant.

pub use super::clump_levels::{Painted, painted};

/// Texels along each side of a clump picture.
pub const SIDE: usize = 256;
/// Pictures per kind.
pub const VARIANTS: u32 = 4;
/// Mip levels of a clump picture: 256, 128, … 1.
pub const LEVELS: usize = 9;
/// What grows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// Short mown turf.
    Lawn,
    /// Knee-high hay meadow with seed heads.
    Meadow,
    /// Tall broad-leaved reed with plumes.
    Reed,
    /// Stiff arching tufts.
    Tussock,
}

/// All kinds, in the order of their texture layers.
pub const KINDS: [Kind; 4] = [Kind::Lawn, Kind::Meadow, Kind::Reed, Kind::Tussock];

/// First texture layer of a kind; its variants follow.
pub fn first_layer(kind: Kind) -> u32 {
    VARIANTS * kind as u32
}

/// A painted clump: RGBA, [`SIDE`] × [`SIDE`] texels, row-major.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Clump {
    /// Texels, see the module's text for the channels.
    pub rgba: Vec<[u8; 4]>,
}

/// What makes a kind look like itself. Lengths are shares of the card.
struct Habit {
    blades: u32,
    heads: u32,
    /// Half width at the root, texels.
    half_width: [f32; 2],
    height: [f32; 2],
    /// Half width of the strip the roots stand on.
    roots: f32,
    /// How far a tip leans out, at the edge of the strip.
    lean: f32,
    /// How much the tip bows down.
    droop: [f32; 2],
    dryness: [f32; 2],
    plume: f32,
}

fn habit(kind: Kind) -> Habit {
    match kind {
        Kind::Lawn => Habit {
            blades: 130,
            heads: 0,
            half_width: [0.8, 1.5],
            height: [0.45, 0.97],
            roots: 0.47,
            lean: 0.07,
            droop: [0.0, 0.12],
            dryness: [0.0, 0.35],
            plume: 0.0,
        },
        Kind::Meadow => Habit {
            blades: 74,
            heads: 3,
            half_width: [1.1, 2.3],
            height: [0.34, 0.88],
            roots: 0.34,
            lean: 0.32,
            droop: [0.02, 0.36],
            dryness: [0.0, 0.50],
            plume: 0.15,
        },
        Kind::Reed => Habit {
            blades: 40,
            heads: 2,
            half_width: [1.2, 2.5],
            height: [0.45, 0.94],
            roots: 0.32,
            lean: 0.34,
            droop: [0.05, 0.42],
            dryness: [0.0, 0.45],
            plume: 0.17,
        },
        Kind::Tussock => Habit {
            blades: 84,
            heads: 3,
            half_width: [1.0, 1.8],
            height: [0.45, 0.95],
            roots: 0.13,
            lean: 0.52,
            droop: [0.05, 0.40],
            dryness: [0.1, 0.8],
            plume: 0.06,
        },
    }
}

/// A small deterministic source of numbers (PCG-style permuted congruential step).
struct Dice(u32);

impl Dice {
    fn unit(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        let word = ((self.0 >> ((self.0 >> 28) + 4)) ^ self.0).wrapping_mul(277_803_737);
        ((word >> 22 ^ word) >> 8) as f32 / 16_777_216.0
    }

    fn between(&mut self, range: [f32; 2]) -> f32 {
        range[0] + (range[1] - range[0]) * self.unit()
    }
}

/// One blade or stem, in card coordinates: x to the right, y up, both 0..1.
struct Stroke {
    root: f32,
    height: f32,
    lean: f32,
    droop: f32,
    half_width: f32,
    shade: f32,
    dryness: f32,
    facing: f32,
}

impl Stroke {
    /// Centre line at `s` from root (0) to tip (1).
    fn point(&self, s: f32) -> [f32; 2] {
        let out = self.lean * s * s;
        let up = self.height * (s - self.droop * s * s * s);
        [(self.root + out).clamp(0.012, 0.988), up]
    }
}

/// Paints one clump. `variant` may be any number; [`VARIANTS`] of them are used.
pub fn paint(kind: Kind, variant: u32) -> Clump {
    let habit = habit(kind);
    let mut dice = Dice(0x9e37_79b9 ^ (variant.wrapping_mul(0x85eb_ca6b)).wrapping_add(kind as u32 * 7919));
    let mut clump = Clump { rgba: vec![[0; 4]; SIDE * SIDE] };
    for index in 0..habit.blades {
        let depth = index as f32 / habit.blades as f32;
        let stroke = blade(&habit, &mut dice, depth);
        clump.draw(&stroke, false);
    }
    for _ in 0..habit.heads {
        let stem = stem(&habit, &mut dice);
        clump.draw(&stem, true);
        clump.draw_plume(&stem, habit.plume, kind, &mut dice);
    }
    clump.fill_gaps();
    clump
}

/// Blades further back (`depth` 0) are darker and are painted first.
fn blade(habit: &Habit, dice: &mut Dice, depth: f32) -> Stroke {
    let side = 2.0 * dice.unit() - 1.0;
    let old = dice.unit();
    Stroke {
        root: 0.5 + side * habit.roots,
        height: dice.between(habit.height),
        lean: habit.lean * (0.55 * side + 0.9 * (dice.unit() - 0.5)),
        droop: dice.between(habit.droop),
        half_width: dice.between(habit.half_width),
        shade: 0.50 + 0.30 * depth + 0.20 * dice.unit(),
        dryness: habit.dryness[0] + (habit.dryness[1] - habit.dryness[0]) * old * old * old + if old > 0.87 { 0.45 } else { 0.0 },
        facing: dice.unit(),
    }
}

fn stem(habit: &Habit, dice: &mut Dice) -> Stroke {
    let side = 2.0 * dice.unit() - 1.0;
    Stroke {
        root: 0.5 + 0.8 * side * habit.roots,
        height: 0.80 + 0.15 * dice.unit(),
        lean: 0.5 * habit.lean * (side + dice.unit() - 0.5),
        droop: 0.03 + 0.05 * dice.unit(),
        half_width: 0.75,
        shade: 0.65 + 0.2 * dice.unit(),
        dryness: 0.30 + 0.35 * dice.unit(),
        facing: dice.unit(),
    }
}

impl Clump {
    fn draw(&mut self, stroke: &Stroke, stem: bool) {
        let steps = (stroke.height * SIDE as f32 * 1.2) as u32 + 8;
        for step in 0..=steps {
            let s = step as f32 / steps as f32;
            // A blade is widest at a third of its length and ends in a point.
            let taper = if stem { 1.0 - 0.3 * s } else { (1.0 - s * s * s) * (0.72 + 0.84 * s * (1.0 - s)) };
            let shade = stroke.shade * (0.80 + 0.20 * s);
            let dryness = stroke.dryness + 0.25 * s * s * s;
            self.disc(stroke.point(s), stroke.half_width * taper, [1.0, 1.0], [shade, dryness, stroke.facing]);
        }
    }

    /// Small spikelets around the upper end of a stem.
    fn draw_plume(&mut self, stem: &Stroke, length: f32, kind: Kind, dice: &mut Dice) {
        let (spikelets, spread, radius) = if kind == Kind::Reed { (80, 0.026, 0.85) } else { (44, 0.017, 0.75) };
        for _ in 0..spikelets {
            let along = dice.unit();
            let [x, y] = stem.point(1.0 - along * length / stem.height.max(0.1));
            let width = spread * (1.0 - (2.0 * along - 0.9).abs()).max(0.15);
            let at = [x + width * (2.0 * dice.unit() - 1.0), y + 0.012 * (dice.unit() - 0.3)];
            let paint = [0.45 + 0.3 * dice.unit(), 0.55 + 0.3 * dice.unit(), dice.unit()];
            self.disc(at, radius * (0.8 + 0.6 * dice.unit()), [0.8, 2.4], paint);
        }
    }

    /// Covers an upright ellipse of `radius` texels (stretched by `stretch`), softly at the rim.
    fn disc(&mut self, at: [f32; 2], radius: f32, stretch: [f32; 2], paint: [f32; 3]) {
        let side = SIDE as f32;
        let (x, y) = (at[0] * side, (1.0 - at[1]) * side);
        let (reach_x, reach_y) = (radius * stretch[0] + 1.0, radius * stretch[1] + 1.0);
        let first = |centre: f32, reach: f32| (centre - reach).clamp(0.0, side - 1.0) as usize;
        let last = |centre: f32, reach: f32| (centre + reach).clamp(0.0, side - 1.0) as usize;
        for row in first(y, reach_y)..=last(y, reach_y) {
            for column in first(x, reach_x)..=last(x, reach_x) {
                let across = (column as f32 + 0.5 - x) / stretch[0];
                let along = (row as f32 + 0.5 - y) / stretch[1];
                let cover = (radius + 0.5 - (across * across + along * along).sqrt()).clamp(0.0, 1.0);
                if cover > 0.0 {
                    self.blend(row * SIDE + column, cover, across / (radius + 0.5), paint);
                }
            }
        }
    }

    /// Lays one blade's paint over a texel. Blades are folded along the middle: their halves face different ways.
    fn blend(&mut self, index: usize, cover: f32, across: f32, [shade, dryness, facing]: [f32; 3]) {
        let rib = if across.abs() < 0.25 { 1.08 } else { 1.0 };
        let new = [shade * rib, dryness, (facing + 0.22 * across).clamp(0.0, 1.0)];
        let texel = &mut self.rgba[index];
        for channel in 0..3 {
            let old = f32::from(texel[channel]) / 255.0;
            let mixed = if texel[3] == 0 { new[channel] } else { old + (new[channel] - old) * cover };
            texel[channel] = (mixed.clamp(0.0, 1.0) * 255.0) as u8;
        }
        texel[3] = texel[3].max((cover * 255.0) as u8);
    }

    /// Gives empty texels the mean paint, so that filtering never mixes in black.
    fn fill_gaps(&mut self) {
        let mean = self.mean();
        for texel in self.rgba.iter_mut().filter(|texel| texel[3] == 0) {
            for channel in 0..3 {
                texel[channel] = (mean[channel] * 255.0) as u8;
            }
        }
    }

    /// Mean shade, dryness and facing of what is covered, and the covered share of the card; all 0..=1.
    pub fn mean(&self) -> [f32; 4] {
        let mut sum = [0.0f64; 4];
        for texel in &self.rgba {
            let weight = f64::from(texel[3]);
            for channel in 0..3 {
                sum[channel] += f64::from(texel[channel]) * weight;
            }
            sum[3] += weight;
        }
        let weight = sum[3].max(1.0) * 255.0;
        let cover = sum[3] / (255.0 * self.rgba.len().max(1) as f64);
        [(sum[0] / weight) as f32, (sum[1] / weight) as f32, (sum[2] / weight) as f32, cover as f32]
    }
}
