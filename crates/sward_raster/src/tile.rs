//! A square of the picture being drawn: four samples a pixel, depth-tested before anything is shaded.

use glam::{Vec2, Vec3};
use sward::shading::common::{encode, hash, tone};

use crate::triangle::{SAMPLES, Triangle};

/// Pixels along each side of a tile.
pub(crate) const SIDE: u32 = 64;
/// Quads along each side.
const QUADS: usize = SIDE as usize / 2;

/// Centres of the four pixels of a quad, 1/256 pixel.
pub(crate) const CENTRES: [[i64; 2]; 4] = [[128, 128], [384, 128], [128, 384], [384, 384]];

/// Two by two pixels under a triangle. Lanes: left to right, then down.
pub(crate) struct Quad {
    /// The first of its pixels, in the picture.
    pub(crate) first: [i64; 2],
    /// Weights of the triangle's corners at the lanes' centres.
    pub(crate) weights: [Vec3; 4],
    /// Bit 4 · lane + sample: covered, and nothing in front.
    pub(crate) visible: u16,
}

impl Quad {
    /// Whether any sample of a lane is visible.
    #[inline]
    pub(crate) fn lane(&self, lane: usize) -> bool {
        (self.visible >> (4 * lane)) & 15 != 0
    }
}

/// What shading a quad gave: a colour for each lane, and the samples that take it.
#[derive(Default)]
pub(crate) struct Shaded<T = Vec3> {
    pub(crate) colours: [T; 4],
    /// As [`Quad::visible`]; lanes or samples left out stay as they were.
    pub(crate) samples: u16,
}

/// A tile's samples, quad by quad, lane by lane.
pub(crate) struct Tile<T = Vec3> {
    /// First pixel, in the picture.
    pub(crate) corner: [i64; 2],
    depths: Vec<[f32; 16]>,
    colours: Vec<[T; 16]>,
}

/// Values of a + sample offset for the 16 samples of a quad.
#[inline]
fn offsets(across: i64, down: i64) -> [i64; 16] {
    let mut out = [0; 16];
    for (lane, [x, y]) in [[0, 0], [256, 0], [0, 256], [256, 256]].into_iter().enumerate() {
        for (sample, [sx, sy]) in SAMPLES.into_iter().enumerate() {
            out[4 * lane + sample] = across * (x + sx) + down * (y + sy);
        }
    }
    out
}

impl<T: Copy + Default> Tile<T> {
    /// An empty tile whose first pixel is `corner`.
    pub(crate) fn new(corner: [i64; 2]) -> Self {
        Self { corner, depths: vec![[0.0; 16]; QUADS * QUADS], colours: vec![[T::default(); 16]; QUADS * QUADS] }
    }

    /// Shades the visible part of a triangle, quad by quad.
    pub(crate) fn draw(&mut self, triangle: &Triangle, mut shade: impl FnMut(&Quad) -> Shaded<T>) {
        self.draw_all(triangle, |quad, depths, stored| {
            let quad = Quad { visible: quad.visible & nearer(depths, stored), ..quad };
            (quad.visible != 0).then(|| {
                let shaded = shade(&quad);
                (Shaded { samples: shaded.samples & quad.visible, ..shaded }, *depths)
            })
        });
    }

    /// The same of a triangle whose depth is known only when it is shaded: that of each lane.
    pub(crate) fn draw_deep(&mut self, triangle: &Triangle, mut shade: impl FnMut(&Quad) -> (Shaded<T>, [f32; 4])) {
        self.draw_all(triangle, |quad, _, stored| {
            let (shaded, depths) = shade(&quad);
            let depths: [f32; 16] = std::array::from_fn(|sample| depths[sample / 4]);
            let samples = shaded.samples & quad.visible & nearer(&depths, stored);
            (samples != 0).then_some((Shaded { samples, ..shaded }, depths))
        });
    }

    /// Hands every quad that a triangle covers over, with the depths of its samples and those stored; the answer is what to store.
    #[inline]
    fn draw_all(&mut self, triangle: &Triangle, mut shade: impl FnMut(Quad, &[f32; 16], &[f32; 16]) -> Option<(Shaded<T>, [f32; 16])>) {
        let side = i64::from(SIDE);
        let low = [0, 1].map(|axis| ((triangle.low[axis] - self.corner[axis]).max(0)) / 2);
        let high = [0, 1].map(|axis| (triangle.high[axis] - self.corner[axis]).min(side - 1));
        if (0..2).any(|axis| high[axis] < 2 * low[axis]) {
            return;
        }
        let over: [[i64; 16]; 3] = [0, 1, 2].map(|k| offsets(triangle.a[k], triangle.b[k]));
        let most = [0, 1, 2].map(|k| over[k].iter().copied().max().unwrap_or(0));
        let deeper: [f32; 16] = std::array::from_fn(|s| {
            let lane = s / 4;
            let [x, y] = SAMPLES[s % 4];
            triangle.depth[1] * (x + 256 * (lane as i64 % 2)) as f32 + triangle.depth[2] * (y + 256 * (lane as i64 / 2)) as f32
        });
        for row in low[1]..=high[1] / 2 {
            let y = (self.corner[1] + 2 * row) * 256;
            for column in low[0]..=high[0] / 2 {
                let x = (self.corner[0] + 2 * column) * 256;
                let edges = [0, 1, 2].map(|k| triangle.edge(k, x, y));
                if (0..3).any(|k| edges[k] + most[k] + triangle.rule[k] < 0) {
                    continue;
                }
                let index = row as usize * QUADS + column as usize;
                let visible = covered(triangle, &over, edges);
                if visible == 0 {
                    continue;
                }
                let depths = depths_at(triangle, &deeper, x, y);
                let quad = Quad { first: [x / 256, y / 256], weights: centres(triangle, edges), visible };
                if let Some((shaded, depths)) = shade(quad, &depths, &self.depths[index]) {
                    self.store(index, shaded.samples, &depths, &shaded.colours);
                }
            }
        }
    }

    #[inline]
    fn store(&mut self, index: usize, samples: u16, depths: &[f32; 16], colours: &[T; 4]) {
        for sample in 0..16 {
            if samples >> sample & 1 == 1 {
                self.depths[index][sample] = depths[sample];
                self.colours[index][sample] = colours[sample / 4];
            }
        }
    }

    /// The four samples of a pixel of the tile, row by row, and which of them are covered.
    pub(crate) fn samples(&self, pixel: [usize; 2]) -> (&[T], [bool; 4]) {
        let [x, y] = pixel;
        let (index, lane) = ((y / 2) * QUADS + x / 2, (y % 2) * 2 + x % 2);
        let depths = &self.depths[index][4 * lane..4 * lane + 4];
        (&self.colours[index][4 * lane..4 * lane + 4], std::array::from_fn(|sample| depths[sample] > 0.0))
    }

    #[inline]
    fn pixel(&self, index: usize, lane: usize) -> [i64; 2] {
        let (row, column) = (index / QUADS, index % QUADS);
        [self.corner[0] + (2 * column + lane % 2) as i64, self.corner[1] + (2 * row + lane / 2) as i64]
    }
}

impl Tile {
    /// Shades what nothing has covered; `shade` gets a pixel of the picture.
    pub(crate) fn fill(&mut self, shade: impl Fn([i64; 2]) -> Vec3, size: [u32; 2]) {
        for index in 0..QUADS * QUADS {
            for lane in 0..4 {
                let [x, y] = self.pixel(index, lane);
                let samples = &self.depths[index][4 * lane..4 * lane + 4];
                if x >= i64::from(size[0]) || y >= i64::from(size[1]) || samples.iter().all(|depth| *depth > 0.0) {
                    continue;
                }
                let colour = shade([x, y]);
                for sample in 4 * lane..4 * lane + 4 {
                    if self.depths[index][sample] == 0.0 {
                        self.colours[index][sample] = colour;
                    }
                }
            }
        }
    }

    /// Display values of the tile, [`SIDE`]² RGBA, row-major: each sample is tone-mapped before the mean, so bright rims stay smooth.
    pub(crate) fn resolve(&self, exposure: f32) -> Vec<u8> {
        let side = SIDE as usize;
        let mut rgba = vec![255; 4 * side * side];
        for (index, colours) in self.colours.iter().enumerate() {
            for (lane, four) in colours.chunks_exact(4).enumerate() {
                let first = tone(four[0] * exposure);
                let toned = |colour: &Vec3| if *colour == four[0] { first } else { tone(*colour * exposure) };
                let mean = (first + toned(&four[1]) + toned(&four[2]) + toned(&four[3])) * 0.25;
                let [x, y] = self.pixel(index, lane);
                // Half a code value of noise hides the steps in a smooth sky.
                let grain = (hash(x as i32, y as i32, 5) - 0.5) / 255.0;
                let at = 4 * ((y - self.corner[1]) as usize * side + (x - self.corner[0]) as usize);
                for (channel, value) in encode(mean).to_array().into_iter().enumerate() {
                    rgba[at + channel] = ((value + grain).clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
                }
            }
        }
        rgba
    }
}

#[inline]
fn depths_at(triangle: &Triangle, deeper: &[f32; 16], x: i64, y: i64) -> [f32; 16] {
    let depth = triangle.depth_at(x, y);
    let [least, most] = triangle.depths;
    let mut depths = *deeper;
    for at in &mut depths {
        let here = depth + *at;
        let here = if here > least { here } else { least };
        *at = if here < most { here } else { most };
    }
    depths
}

/// Samples inside all three edges.
#[inline]
fn covered(triangle: &Triangle, over: &[[i64; 16]; 3], edges: [i64; 3]) -> u16 {
    let base = [0, 1, 2].map(|k| edges[k] + triangle.rule[k]);
    let mut mask = 0;
    for sample in 0..16 {
        let outside = (base[0] + over[0][sample]) | (base[1] + over[1][sample]) | (base[2] + over[2][sample]);
        mask |= u16::from(outside >= 0) << sample;
    }
    mask
}

/// Samples with nothing in front.
#[inline]
fn nearer(depths: &[f32; 16], stored: &[f32; 16]) -> u16 {
    let mut mask = 0;
    for sample in 0..16 {
        mask |= u16::from(depths[sample] >= stored[sample]) << sample;
    }
    mask
}

/// Weights at the centres of the four pixels.
#[inline]
pub(crate) fn centres(triangle: &Triangle, edges: [i64; 3]) -> [Vec3; 4] {
    let mut weights = [Vec3::ZERO; 4];
    for (lane, [x, y]) in CENTRES.into_iter().enumerate() {
        let mut at = [0.0; 3];
        for k in 0..3 {
            at[k] = (edges[k] + triangle.a[k] * x + triangle.b[k] * y) as f32;
        }
        weights[lane] = triangle.weights(at);
    }
    weights
}

/// The direction a pixel's centre is seen in: `frame` gives the middle, and half the picture's width and height as vectors.
pub(crate) fn ray([forward, right, up]: [Vec3; 3], pixel: [i64; 2], size: Vec2) -> Vec3 {
    let ndc = Vec2::new((pixel[0] as f32 + 0.5) / size.x * 2.0 - 1.0, 1.0 - (pixel[1] as f32 + 0.5) / size.y * 2.0);
    (forward + ndc.x * right + ndc.y * up).normalize()
}

#[cfg(test)]
mod tests;
