//! Pictures of clumps with their smaller copies, and how they are read: bilinear, and linear between levels, clamped at the rim.

use sward::math::clamped;
use sward::shading::clump::{Kind, LEVELS, VARIANTS, first_layer, painted};
use sward::shading::look::Look;

/// One level of one picture; alpha apart, since most places of a card are empty.
#[derive(Default)]
struct Level {
    side: usize,
    /// Coverage of each texel, its right, its lower and its lower right neighbour: one look instead of four.
    alpha: Vec<[u8; 4]>,
    paint: Vec<[u8; 4]>,
}

impl Level {
    /// From texels, row by row.
    fn new(paint: Vec<[u8; 4]>) -> Self {
        let side = paint.len().isqrt().max(1);
        let around = |at: usize| {
            let (right, down) = ((at % side + 1).min(side - 1) - at % side, ((at / side + 1).min(side - 1) - at / side) * side);
            [at, at + right, at + down, at + down + right].map(|texel| paint[texel][3])
        };
        Self { side, alpha: (0..paint.len()).map(around).collect(), paint }
    }

    /// The texel before a place, and how far the place is from it.
    #[inline]
    fn place(&self, u: f32, v: f32) -> ([usize; 2], [f32; 2]) {
        let (side, last) = (self.side as f32, (self.side - 1) as f32);
        let (x, y) = (clamped(u * side - 0.5, 0.0, last), clamped(v * side - 0.5, 0.0, last));
        let (column, row) = (x as i32, y as i32);
        ([column as usize, row as usize], [x - column as f32, y - row as f32])
    }

    #[inline]
    fn alpha(&self, u: f32, v: f32) -> f32 {
        let ([column, row], [x, y]) = self.place(u, v);
        let [a, b, c, d] = self.alpha[row * self.side + column].map(f32::from);
        let (top, bottom) = (a + (b - a) * x, c + (d - c) * x);
        (top + (bottom - top) * y) * (1.0 / 255.0)
    }

    #[inline]
    fn paint(&self, u: f32, v: f32) -> [f32; 3] {
        let ([column, row], [x, y]) = self.place(u, v);
        let (right, down) = ((column + 1).min(self.side - 1), (row + 1).min(self.side - 1));
        let (top, bottom) = (row * self.side, down * self.side);
        let texels = [top + column, top + right, bottom + column, bottom + right].map(|texel| self.paint[texel]);
        [0, 1, 2].map(|channel| {
            let [a, b, c, d] = texels.map(|texel| f32::from(texel[channel]));
            let (top, bottom) = (a + (b - a) * x, c + (d - c) * x);
            (top + (bottom - top) * y) * (1.0 / 255.0)
        })
    }
}

/// One picture.
pub(crate) struct Clump {
    levels: Vec<Level>,
}

impl Clump {
    fn new(kind: Kind, variant: u32) -> Self {
        let texels = |bytes: &Vec<u8>| bytes.as_chunks::<4>().0.to_vec();
        Self { levels: painted(kind, variant).levels.iter().map(|bytes| Level::new(texels(bytes))).collect() }
    }

    /// How the picture is read at a level, 0 the finest.
    #[inline]
    pub(crate) fn between(&self, level: f32) -> Between<'_> {
        let level = level.clamp(0.0, (LEVELS - 1) as f32);
        let first = level as usize;
        Between { fine: &self.levels[first], coarse: &self.levels[(first + 1).min(LEVELS - 1)], way: level - first as f32 }
    }
}

/// A picture between two of its levels.
#[derive(Clone, Copy)]
pub(crate) struct Between<'a> {
    fine: &'a Level,
    coarse: &'a Level,
    way: f32,
}

impl Between<'_> {
    /// Coverage at (u, v), v down, 0..=1.
    #[inline]
    pub(crate) fn alpha(&self, u: f32, v: f32) -> f32 {
        let near = self.fine.alpha(u, v);
        if self.way > 0.0 { near + (self.coarse.alpha(u, v) - near) * self.way } else { near }
    }

    /// Shade, dryness and facing at (u, v), 0..=1.
    #[inline]
    pub(crate) fn paint(&self, u: f32, v: f32) -> [f32; 3] {
        let (near, far) = (self.fine.paint(u, v), self.coarse.paint(u, v));
        [0, 1, 2].map(|channel| near[channel] + (far[channel] - near[channel]) * self.way)
    }
}

/// The pictures that some looks need, by layer.
pub(crate) struct Clumps {
    layers: Vec<Option<Clump>>,
    empty: Clump,
}

impl Clumps {
    pub(crate) fn new(looks: &[Look]) -> Self {
        let mut wanted: Vec<(u32, Kind, u32)> = Vec::new();
        for look in looks {
            for variant in 0..VARIANTS {
                let layer = first_layer(look.kind) + variant;
                if !wanted.iter().any(|(known, ..)| *known == layer) {
                    wanted.push((layer, look.kind, variant));
                }
            }
        }
        let painted = crate::each::each(wanted, |(layer, kind, variant)| (layer, Clump::new(kind, variant)));
        let mut clumps = Self { layers: Vec::new(), empty: nothing() };
        for (layer, clump) in painted {
            let at = layer as usize;
            clumps.layers.resize_with(clumps.layers.len().max(at + 1), || None);
            clumps.layers[at] = Some(clump);
        }
        clumps
    }

    /// The picture of a layer; an empty one if no look has it.
    pub(crate) fn layer(&self, layer: u32) -> &Clump {
        self.layers.get(layer as usize).and_then(Option::as_ref).unwrap_or(&self.empty)
    }
}

fn nothing() -> Clump {
    Clump { levels: (0..LEVELS).map(|_| Level::new(vec![[0; 4]])).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sward::shading::clump::SIDE;

    #[test]
    fn reading_between_texels_and_levels_is_linear() {
        let texels = |side: usize, value: u8| vec![[value; 4]; side * side];
        let mut levels: Vec<Level> = (0..LEVELS).map(|index| Level::new(texels(SIDE >> index, 100))).collect();
        let mut first = texels(SIDE, 100);
        first[1][3] = 255;
        (levels[0], levels[1]) = (Level::new(first), Level::new(texels(SIDE / 2, 200)));
        let clump = Clump { levels };
        let side = SIDE as f32;
        let close = |a: f32, b: f32| assert!((a - b).abs() < 1e-4, "{a} {b}");
        // Texel centres, halfway between two, beyond the rim, between levels.
        close(clump.between(0.0).alpha(1.5 / side, 0.5 / side), 1.0);
        close(clump.between(0.0).alpha(1.0 / side, 0.5 / side), 177.5 / 255.0);
        close(clump.between(0.0).alpha(-3.0, -3.0), 100.0 / 255.0);
        close(clump.between(0.25).paint(0.5, 0.5)[0], 125.0 / 255.0);
        close(clump.between(99.0).alpha(0.5, 0.5), 100.0 / 255.0);
    }
}
