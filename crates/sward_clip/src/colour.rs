//! From the picture's RGB to the planes of a clip: BT.709, limited range, one sample of colour for two by two pixels.
//!
//! ITU-R BT.709-6, §3.2 to 3.5, for eight bits: luma 16 to 235, colour differences 16 to 240 around 128. The pixels keep the transfer
//! function they have, which is that of sRGB; [`CODES`] says so to players. A sample of colour is the mean of its four pixels and so lies
//! amid them. AV1 has no word for that place; it is what players take where nothing is said.

/// Colour primaries, transfer characteristics and matrix coefficients as numbered by ITU-T H.273: BT.709, sRGB, BT.709.
pub(crate) const CODES: [u8; 3] = [1, 13, 1];

/// Bits behind the point of a weight.
const BITS: u32 = 16;

/// Weights of red, green and blue in luma.
const LUMA: [i32; 3] = [fixed(219.0 * 0.2126), fixed(219.0 * 0.7152), fixed(219.0 * 0.0722)];
/// In the difference of blue from luma. The sum is exactly zero: grey has no colour.
const BLUE: [i32; 3] = [-fixed(224.0 * 0.2126 / 1.8556), fixed(224.0 * 0.2126 / 1.8556) - fixed(112.0), fixed(112.0)];
/// In the difference of red from luma.
const RED: [i32; 3] = [fixed(112.0), fixed(224.0 * 0.0722 / 1.5748) - fixed(112.0), -fixed(224.0 * 0.0722 / 1.5748)];

/// A weight for samples of 0 to 255, as a whole number; not negative.
const fn fixed(weight: f64) -> i32 {
    (weight / 255.0 * (1 << BITS) as f64 + 0.5) as i32
}

/// A frame as the encoder takes it. Rows from the top, without gaps.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Planes {
    /// Luma of every pixel.
    pub(crate) luma: Vec<u8>,
    /// How far blue differs from luma, for each two by two pixels.
    pub(crate) blue: Vec<u8>,
    /// How far red differs.
    pub(crate) red: Vec<u8>,
    /// Pixels in a row; even.
    pub(crate) width: usize,
}

impl Planes {
    /// Those of a picture of `width` pixels a row in RGB, eight bits each. Width and height are even.
    pub(crate) fn new(rgb: &[u8], width: usize) -> Self {
        let luma = rgb.chunks_exact(3).map(|pixel| sample(&LUMA, [pixel[0], pixel[1], pixel[2]].map(i32::from), 16, 0)).collect();
        let (mut blue, mut red) = (Vec::with_capacity(rgb.len() / 12), Vec::with_capacity(rgb.len() / 12));
        for two_rows in rgb.chunks_exact(2 * 3 * width) {
            let (upper, lower) = two_rows.split_at(3 * width);
            for (upper, lower) in upper.chunks_exact(6).zip(lower.chunks_exact(6)) {
                let four = [0, 1, 2].map(|c| [upper[c], upper[c + 3], lower[c], lower[c + 3]].map(i32::from).iter().sum());
                blue.push(sample(&BLUE, four, 128, 2));
                red.push(sample(&RED, four, 128, 2));
            }
        }
        Self { luma, blue, red, width }
    }
}

/// The weighted sum of red, green and blue, which are sums over 2^`more` pixels, rounded, above `zero`.
fn sample(weights: &[i32; 3], rgb: [i32; 3], zero: i32, more: u32) -> u8 {
    let sum: i32 = weights.iter().zip(rgb).map(|(weight, value)| weight * value).sum();
    let bits = BITS + more;
    (zero + ((sum + (1 << (bits - 1))) >> bits)).clamp(0, 255) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Four pixels of one colour.
    fn of(rgb: [u8; 3]) -> [u8; 3] {
        let planes = Planes::new(&rgb.repeat(4), 2);
        assert_eq!((planes.luma.len(), planes.blue.len(), planes.red.len()), (4, 1, 1));
        [planes.luma[0], planes.blue[0], planes.red[0]]
    }

    /// The colour bars of BT.709 at full amplitude, as every table of them has them.
    #[test]
    fn the_corners_of_the_cube_are_where_the_standard_puts_them() {
        for (rgb, wanted) in [
            ([0, 0, 0], [16, 128, 128]),
            ([255, 255, 255], [235, 128, 128]),
            ([255, 0, 0], [63, 102, 240]),
            ([0, 255, 0], [173, 42, 26]),
            ([0, 0, 255], [32, 240, 118]),
            ([255, 255, 0], [219, 16, 138]),
            ([0, 255, 255], [188, 154, 16]),
            ([255, 0, 255], [78, 214, 230]),
        ] {
            assert_eq!(of(rgb), wanted, "{rgb:?}");
        }
        // Control: the weights of standard definition would give another red.
        assert_ne!(of([255, 0, 0]), [81, 90, 240]);
    }

    #[test]
    fn grey_has_no_colour() {
        for grey in 0..=255 {
            let [_, blue, red] = of([grey; 3]);
            assert_eq!((blue, red), (128, 128), "{grey}");
        }
    }

    #[test]
    fn colour_is_the_mean_of_four_pixels_and_luma_is_of_each() {
        let (dark, light) = ([10, 60, 20], [90, 200, 40]);
        let planes = Planes::new(&[dark, light, light, dark].concat(), 2);
        assert_eq!(planes.luma[0], planes.luma[3]);
        assert_ne!(planes.luma[0], planes.luma[1]);
        assert_eq!([planes.blue[0], planes.red[0]], of([50, 130, 30])[1..]);
        // The upper left pixel alone would be another colour.
        assert_ne!([planes.blue[0], planes.red[0]], of(dark)[1..]);
    }
}
