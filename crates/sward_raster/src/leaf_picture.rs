//! Pictures of leaves and bark, with their levels, as graphics hardware filters them.

use glam::{Vec2, Vec4};
use sward::specimen::{Picture, levels};

/// A picture, linear.
pub(crate) struct LeafPicture {
    levels: Vec<([i32; 2], Vec<Vec4>)>,
}

fn linear(code: u8) -> f32 {
    let c = f32::from(code) / 255.0;
    if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
}

impl LeafPicture {
    pub(crate) fn new(picture: &Picture) -> Self {
        let level = |picture: &Picture| {
            let texels =
                picture.texels.iter().map(|[r, g, b, a]| Vec4::new(linear(*r), linear(*g), linear(*b), f32::from(*a) / 255.0)).collect();
            (picture.size.map(|side| side as i32), texels)
        };
        Self { levels: levels(picture).iter().map(level).collect() }
    }

    /// What the four pixels of a quad see at their places.
    pub(crate) fn quad(&self, uvs: [Vec2; 4]) -> [Vec4; 4] {
        let [width, height] = self.levels[0].0.map(|side| side as f32);
        let step = |to: usize| ((uvs[to] - uvs[0]) * Vec2::new(width, height)).length();
        let level = step(1).max(step(2)).max(1e-6).log2().clamp(0.0, (self.levels.len() - 1) as f32);
        let (fine, share) = (level.floor(), level.fract());
        uvs.map(|uv| {
            let near = self.at(fine as usize, uv);
            if share > 0.0 { near.lerp(self.at(fine as usize + 1, uv), share) } else { near }
        })
    }

    fn at(&self, level: usize, uv: Vec2) -> Vec4 {
        let ([width, height], texels) = &self.levels[level.min(self.levels.len() - 1)];
        let at = uv * Vec2::new(*width as f32, *height as f32) - 0.5;
        let corner = at.floor();
        let way = at - corner;
        let texel = |dx: i32, dy: i32| {
            let (x, y) = ((corner.x as i32).wrapping_add(dx).rem_euclid(*width), (corner.y as i32).wrapping_add(dy).rem_euclid(*height));
            texels[(y * width + x) as usize]
        };
        texel(0, 0).lerp(texel(1, 0), way.x).lerp(texel(0, 1).lerp(texel(1, 1), way.x), way.y)
    }
}
