//! A picture ever smaller, for whatever sees it from afar.

use super::Picture;

/// Alpha from which on a texel of a leaf counts as there, of 255.
const THERE: u8 = 128;

/// A picture and its halves down to one texel. Colours are weighted by alpha, so what is transparent does not show; alpha is raised until as large a share
/// of the texels is there as in the whole picture, so leaves do not thin out far off.
pub fn levels(picture: &Picture) -> Vec<Picture> {
    let share = there(picture, 1.0);
    let mut levels = vec![picture.clone()];
    let mut plain = picture.clone();
    while plain.size != [1, 1] {
        plain = half(&plain);
        let mut level = plain.clone();
        let opaque = picture.texels.iter().all(|texel| texel[3] == 255);
        if !opaque {
            let gain = gain(&plain, share);
            level.texels.iter_mut().for_each(|texel| texel[3] = raised(texel[3], gain));
        }
        levels.push(level);
    }
    levels
}

fn raised(alpha: u8, gain: f32) -> u8 {
    let raised = f32::from(alpha) * gain + 0.5;
    if raised < 255.0 { raised as u8 } else { 255 }
}

/// Share of texels that are there when alpha is raised.
fn there(picture: &Picture, gain: f32) -> f32 {
    let count = picture.texels.iter().filter(|texel| raised(texel[3], gain) >= THERE).count();
    count as f32 / picture.texels.len().max(1) as f32
}

/// By how much alpha is to be raised.
fn gain(picture: &Picture, share: f32) -> f32 {
    let (mut low, mut high) = (0.5, 4.0);
    for _ in 0..12 {
        let middle = 0.5 * (low + high);
        if there(picture, middle) < share { low = middle } else { high = middle }
    }
    high
}

fn half(picture: &Picture) -> Picture {
    let size = picture.size.map(|side| (side / 2).max(1));
    let at = |x: u32, y: u32| {
        let [x, y] = [x.min(picture.size[0] - 1), y.min(picture.size[1] - 1)];
        picture.texels[(y * picture.size[0] + x) as usize]
    };
    let texel = |index: u32| {
        let (x, y) = (2 * (index % size[0]), 2 * (index / size[0]));
        let four = [at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)];
        let alpha: u32 = four.iter().map(|texel| u32::from(texel[3])).sum();
        // Fully transparent texels keep a colour, too.
        let weigh = |texel: &[u8; 4], part: usize| u32::from(texel[part]) * (u32::from(texel[3]) * 16 + 1);
        let weights = alpha * 16 + 4;
        let part = |part: usize| ((four.iter().map(|texel| weigh(texel, part)).sum::<u32>() + weights / 2) / weights) as u8;
        [part(0), part(1), part(2), ((alpha + 2) / 4) as u8]
    };
    Picture { size, texels: (0..size[0] * size[1]).map(texel).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn leaves_do_not_thin_out() {
        let disc = |index: usize| {
            let (x, y) = ((index % 64) as f32 - 31.5, (index / 64 % 64) as f32 - 31.5);
            let inside = (x.rem_euclid(9.0) - 4.5).hypot(y.rem_euclid(9.0) - 4.5) < 2.0;
            if inside { [40, 120, 20, 255] } else { [255, 0, 255, 0] }
        };
        let picture = Picture { size: [64, 64], texels: (0..64 * 64).map(disc).collect() };
        let levels = levels(&picture);
        assert_eq!(levels.len(), 7);
        let whole = there(&picture, 1.0);
        for level in &levels[..3] {
            assert!((there(level, 1.0) - whole).abs() < 0.15, "{:?}: {} of {whole}", level.size, there(level, 1.0));
            let shown = level.texels.iter().filter(|texel| texel[3] >= THERE);
            shown.for_each(|texel| assert!(texel[0] < 80 && texel[1] > 100, "{texel:?}"));
        }
        // Control: plain halves thin out.
        let plain = half(&half(&half(&picture)));
        assert!(there(&plain, 1.0) < 0.6 * whole, "{}", there(&plain, 1.0));
    }
}
