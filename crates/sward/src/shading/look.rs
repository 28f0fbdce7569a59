//! How a species looks: colours, pictures, and what follows from them for plants and for the ground between them.

use bytemuck::{Pod, Zeroable};

use super::clump::{Kind, VARIANTS, first_layer, painted};

/// How a species looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// Which pictures.
    pub kind: Kind,
    /// Linear RGB albedo at the root.
    pub root: [f32; 3],
    /// Linear RGB albedo at the tip.
    pub tip: [f32; 3],
    /// Share of straw added to every leaf, 0..=1.
    pub dryness: f32,
    /// Share of light that leaves let through, 0..=1.
    pub through: f32,
    /// Distances at which plants begin to shrink and are gone, metres.
    pub fade: [f32; 2],
}

impl Look {
    /// Good values for a kind of plant.
    pub fn of(kind: Kind) -> Self {
        let (root, tip, dryness, through) = match kind {
            Kind::Lawn => ([0.026, 0.075, 0.012], [0.075, 0.205, 0.028], 0.0, 0.75),
            Kind::Meadow => ([0.024, 0.066, 0.011], [0.085, 0.200, 0.030], 0.05, 0.80),
            Kind::Reed => ([0.030, 0.060, 0.014], [0.080, 0.165, 0.038], 0.06, 0.60),
            Kind::Tussock => ([0.045, 0.060, 0.016], [0.140, 0.170, 0.048], 0.24, 0.65),
        };
        Self { kind, root, tip, dryness, through, fade: [70.0, 110.0] }
    }

    /// The picture layer for a chance number in 0..1.
    pub fn layer(&self, chance: f32) -> u32 {
        first_layer(self.kind) + ((chance * VARIANTS as f32) as u32).min(VARIANTS - 1)
    }

    /// How much of the ground near the camera lies in the shade of these plants, 0..=1. Lawn is too short to shade it.
    pub fn cover(&self) -> f32 {
        match self.kind {
            Kind::Lawn => 0.2,
            Kind::Tussock => 0.75,
            Kind::Meadow | Kind::Reed => 0.95,
        }
    }
}

/// `Style` of `plants.wgsl`: a look, and how its plants are put together.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct Style {
    /// Colour at the root; w = dryness added to every leaf.
    pub root: [f32; 4],
    /// Colour at the tip; w = share of light let through.
    pub tip: [f32; 4],
    /// Share of the sky seen by roots, how fast sunlight fades towards them, distances where plants begin to fade and are gone, m.
    pub mean: [f32; 4],
    /// Segments, cards (0: a sheet of as many pieces along each side), vertices per plant, plants per instance.
    pub shape: [u32; 4],
}

impl Style {
    /// The style of plants with `cards` cards of `segments` segments; with no cards, of sheets of `segments` × `segments` pieces.
    pub fn new(look: &Look, segments: u32, cards: u32, plants_per_instance: u32) -> Self {
        let closed = look.cover();
        let vertices = if cards == 0 { (segments + 1) * (segments + 1) } else { 2 * (segments + 1) * cards };
        Self {
            root: [look.root[0], look.root[1], look.root[2], look.dryness],
            tip: [look.tip[0], look.tip[1], look.tip[2], look.through],
            mean: [1.0 - 0.88 * closed, 1.6 * closed, look.fade[0], look.fade[1]],
            shape: [segments, cards, vertices, plants_per_instance],
        }
    }
}

/// `Turf` of `ground.wgsl`: what plants look like from afar.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct Turf {
    /// Colour at the root; w = mean dryness of the leaves.
    pub root: [f32; 4],
    /// Colour at the tip; w = share of light let through.
    pub tip: [f32; 4],
    /// Mean shade, cover by plants near the camera, distance where plants end (m), unused.
    pub mean: [f32; 4],
}

impl Turf {
    /// The ground takes the mean colour of all plants on it, each by the share of ground it covers; of meadow where there are none.
    pub fn of(looks: &[Look]) -> Self {
        let meadow = [Look::of(super::clump::Kind::Meadow)];
        let looks = if looks.is_empty() { &meadow } else { looks };
        let all: f32 = looks.iter().map(Look::cover).sum();
        let mut turf = Self { root: [0.0; 4], tip: [0.0; 4], mean: [0.0; 4] };
        for look in looks {
            let share = look.cover() / all;
            let mean = painted(look.kind, 0).mean;
            let root = [look.root[0], look.root[1], look.root[2], (look.dryness + mean[1]).min(1.0)];
            let tip = [look.tip[0], look.tip[1], look.tip[2], look.through];
            for k in 0..4 {
                turf.root[k] += share * root[k];
                turf.tip[k] += share * tip[k];
            }
            turf.mean[0] += share * mean[0];
        }
        let most = |of: fn(&Look) -> f32| looks.iter().map(of).fold(0.0, f32::max);
        (turf.mean[1], turf.mean[2]) = (most(Look::cover), most(|look| look.fade[1]));
        turf
    }
}
