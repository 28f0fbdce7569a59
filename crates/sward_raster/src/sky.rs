//! The backdrop: behind everything, only where nothing else is.

use glam::Vec4Swizzles;

use crate::sight::Sight;
use crate::tile::{Tile, ray};

/// Fills what is left of a tile.
pub(crate) fn draw(sight: &Sight<'_>, tile: &mut Tile) {
    let frame = &sight.frame;
    let axes = [frame.forward.xyz(), frame.right.xyz(), frame.up.xyz()];
    let shade = |pixel| {
        let ray = ray(axes, pixel, sight.pixels());
        sight.backdrop(ray)
    };
    tile.fill(shade, sight.size);
}
