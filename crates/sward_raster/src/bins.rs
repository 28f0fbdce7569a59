//! Which things may be seen in which tile: a counting sort by tile that keeps the things' order.

use crate::each::each;

/// Tiles from a corner to another one, inclusive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Rect {
    pub(crate) low: [u16; 2],
    pub(crate) high: [u16; 2],
}

impl Rect {
    /// The tiles of side `side` pixels under `low..=high` pixels of a picture; `None` if it lies outside.
    pub(crate) fn under(low: [f32; 2], high: [f32; 2], size: [u32; 2], side: u32) -> Option<Self> {
        let last = size.map(|pixels| pixels.saturating_sub(1) as f32);
        // Also false where a number is NaN.
        let inside = (0..2).all(|axis| high[axis] >= 0.0 && low[axis] <= last[axis]);
        let tile = |pixel: f32, axis: usize| (pixel.clamp(0.0, last[axis]) as u32 / side) as u16;
        inside.then(|| Self { low: [tile(low[0], 0), tile(low[1], 1)], high: [tile(high[0], 0), tile(high[1], 1)] })
    }
}

/// Things looked at together.
const CHUNK: usize = 4096;

/// Where each of some things may be seen.
pub(crate) fn rects<T: Sync>(things: &[T], rect: impl Fn(usize, &T) -> Option<Rect> + Sync + Send) -> Vec<Option<Rect>> {
    let chunks = things.chunks(CHUNK).enumerate().collect();
    let rects = each(chunks, |(chunk, things): (usize, &[T])| {
        things.iter().enumerate().map(|(index, thing)| rect(chunk * CHUNK + index, thing)).collect::<Vec<_>>()
    });
    rects.into_iter().flatten().collect()
}

/// Things by tile.
#[derive(Debug, Default)]
pub(crate) struct Bins {
    /// Where each tile's things begin in `items`; one more at the end.
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Bins {
    /// Sorts things, each of which may be seen in a rectangle of tiles, into `columns × rows` tiles.
    pub(crate) fn new(rects: &[Option<Rect>], columns: usize, rows: usize) -> Self {
        let mut starts = vec![0_u32; columns * rows + 1];
        let tiles = |rect: Rect| {
            (rect.low[1]..=rect.high[1])
                .flat_map(move |y| (rect.low[0]..=rect.high[0]).map(move |x| usize::from(y) * columns + usize::from(x)))
        };
        for rect in rects.iter().flatten() {
            tiles(*rect).for_each(|tile| starts[tile + 1] += 1);
        }
        for tile in 0..columns * rows {
            starts[tile + 1] += starts[tile];
        }
        let mut next = starts.clone();
        let mut items = vec![0; starts[columns * rows] as usize];
        for (index, rect) in rects.iter().enumerate() {
            for tile in rect.iter().copied().flat_map(tiles) {
                items[next[tile] as usize] = index as u32;
                next[tile] += 1;
            }
        }
        Self { starts, items }
    }

    /// The things of a tile, in their order.
    pub(crate) fn of(&self, tile: usize) -> &[u32] {
        &self.items[self.starts[tile] as usize..self.starts[tile + 1] as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn things_are_in_every_tile_they_touch_and_in_order() {
        let rect = |low, high| Rect::under(low, high, [100, 50], 32);
        let rects = [rect([-9.0, -9.0], [40.0, 3.0]), rect([120.0, 0.0], [130.0, 9.0]), rect([33.0, 30.0], [33.5, 33.0])];
        assert_eq!(rects[1], None);
        assert_eq!(rect([f32::NAN, 0.0], [f32::NAN, 1.0]), None);
        let bins = Bins::new(&rects, 4, 2);
        let found: Vec<&[u32]> = (0..8).map(|tile| bins.of(tile)).collect();
        assert_eq!(found, [&[0][..], &[0, 2], &[], &[], &[], &[2], &[], &[]]);
    }
}
