//! Smaller copies of a clump picture that stay as dense as the original.

use std::sync::OnceLock;

use super::clump::{Clump, KINDS, Kind, VARIANTS, first_layer, paint};

/// Alpha at which a texel counts as covered.
const CUTOFF: u8 = 128;

/// What is drawn of a clump.
#[derive(Debug)]
pub struct Painted {
    /// Its [`Clump::levels`].
    pub levels: Vec<Vec<u8>>,
    /// Its [`Clump::mean`].
    pub mean: [f32; 4],
}

/// A clump as it is drawn; painted when it is first asked for, and kept while the program runs. Of `variant` the remainder by [`VARIANTS`] counts.
pub fn painted(kind: Kind, variant: u32) -> &'static Painted {
    static ALL: [OnceLock<Painted>; KINDS.len() * VARIANTS as usize] = [const { OnceLock::new() }; KINDS.len() * VARIANTS as usize];
    let variant = variant % VARIANTS;
    ALL[(first_layer(kind) + variant) as usize].get_or_init(|| {
        let clump = paint(kind, variant);
        Painted { levels: clump.levels(), mean: clump.mean() }
    })
}

impl Clump {
    /// The picture and its smaller copies down to 1 × 1, as bytes.
    ///
    /// Plain averaging makes thin blades vanish with distance; each level's alpha is scaled until the same share of the card
    /// stays covered.
    pub fn levels(&self) -> Vec<Vec<u8>> {
        let target = covered(&self.rgba, 1.0);
        let mut level = self.rgba.clone();
        let mut chain = vec![level.concat()];
        while level.len() > 1 {
            level = halve(&level);
            let gain = gain_for(&level, target);
            let shown: Vec<[u8; 4]> = level.iter().map(|t| [t[0], t[1], t[2], (f32::from(t[3]) * gain).min(255.0) as u8]).collect();
            chain.push(shown.concat());
        }
        chain
    }
}

/// Halves a square picture; paint counts by its coverage.
fn halve(texels: &[[u8; 4]]) -> Vec<[u8; 4]> {
    let side = texels.len().isqrt();
    let half = side / 2;
    let mut out = Vec::with_capacity(half * half);
    for row in 0..half {
        for column in 0..half {
            let at = 2 * row * side + 2 * column;
            let four = [texels[at], texels[at + 1], texels[at + side], texels[at + side + 1]];
            let weight: u32 = four.iter().map(|t| u32::from(t[3]) + 1).sum();
            let mean = |channel: usize| {
                let sum: u32 = four.iter().map(|t| u32::from(t[channel]) * (u32::from(t[3]) + 1)).sum();
                (sum / weight) as u8
            };
            out.push([mean(0), mean(1), mean(2), ((weight - 4) / 4) as u8]);
        }
    }
    out
}

/// Share of texels whose alpha times `gain` reaches the cutoff.
fn covered(texels: &[[u8; 4]], gain: f32) -> f32 {
    let count = texels.iter().filter(|t| f32::from(t[3]) * gain >= f32::from(CUTOFF)).count();
    count as f32 / texels.len().max(1) as f32
}

fn gain_for(texels: &[[u8; 4]], target: f32) -> f32 {
    let (mut low, mut high) = (0.25, 8.0);
    for _ in 0..14 {
        let middle = 0.5 * (low + high);
        if covered(texels, middle) < target { low = middle } else { high = middle }
    }
    // Very small levels cannot hit the share exactly; they must not turn solid.
    high.min(4.0)
}
