//! Wind painted by hand: directions and strengths around a middle, as the scene format's flow images have them.
//!
//! Chen & Johan 2010, §5.3: shapes of wind that an animator designs; methods §1.7a.

use std::io::Cursor;

/// Texels along a side.
pub const SIDE: usize = 48;

/// Path by which a scene names what is being painted, until it is saved.
pub const PATH: &str = "painted wind.png";

/// A square of air.
#[derive(Clone, Debug, PartialEq)]
pub struct Painting {
    /// Direction times strength, 0 to 1, row by row; x along a row, z from row to row.
    pub air: Vec<[f32; 2]>,
}

/// How a stroke paints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Brush {
    /// Radius, of the side.
    pub radius: f32,
    /// Strength of the wind, 0 to 1.
    pub strength: f32,
    /// Whether it takes wind away instead.
    pub erases: bool,
}

impl Default for Brush {
    fn default() -> Self {
        Self { radius: 0.12, strength: 0.8, erases: false }
    }
}

impl Default for Painting {
    fn default() -> Self {
        Self { air: vec![[0.0; 2]; SIDE * SIDE] }
    }
}

impl Painting {
    /// Middle of a texel, 0 to 1.
    fn middle(index: usize) -> [f32; 2] {
        [index % SIDE, index / SIDE].map(|at| (at as f32 + 0.5) / SIDE as f32)
    }

    /// A painting whose air is a function of the place, -1 to 1.
    fn of(air: impl Fn([f32; 2]) -> [f32; 2]) -> Self {
        Self { air: (0..SIDE * SIDE).map(|index| air(Self::middle(index).map(|at| 2.0 * at - 1.0))).collect() }
    }

    /// Away from the middle.
    pub fn outward() -> Self {
        Self::of(|[x, z]| {
            let away = x.hypot(z);
            [x, z].map(|part| part / away.max(1e-3) * (1.0 - away).max(0.0))
        })
    }

    /// Round the middle.
    pub fn swirl() -> Self {
        Self::of(|[x, z]| {
            let away = x.hypot(z);
            [-z, x].map(|part| part / away.max(1e-3) * (1.0 - away).max(0.0))
        })
    }

    /// A stroke from one place to another, 0 to 1 in x and z: the air goes along with the brush.
    pub fn stroke(&mut self, from: [f32; 2], to: [f32; 2], brush: &Brush) {
        let way = [to[0] - from[0], to[1] - from[1]];
        let length = way[0].hypot(way[1]);
        if length < 1e-6 && !brush.erases {
            return;
        }
        let wind = if brush.erases { [0.0; 2] } else { way.map(|part| part / length * brush.strength) };
        for (index, air) in self.air.iter_mut().enumerate() {
            let at = Self::middle(index);
            // How far the texel is from the stroke.
            let off = [at[0] - from[0], at[1] - from[1]];
            let along = ((off[0] * way[0] + off[1] * way[1]) / (length * length).max(1e-12)).clamp(0.0, 1.0);
            let away = (off[0] - along * way[0]).hypot(off[1] - along * way[1]) / brush.radius.max(1e-3);
            let share = (1.0 - away * away).max(0.0);
            (0..2).for_each(|axis| air[axis] += (wind[axis] - air[axis]) * share);
        }
    }

    /// Evens out what is next to each other.
    pub fn smooth(&mut self) {
        let before = self.air.clone();
        for (index, air) in self.air.iter_mut().enumerate() {
            let (x, z) = ((index % SIDE) as i32, (index / SIDE) as i32);
            let (mut sum, mut count) = ([0.0; 2], 0.0);
            for (dx, dz) in [(0, 0), (1, 0), (-1, 0), (0, 1), (0, -1)] {
                let inside = |at: i32| (0..SIDE as i32).contains(&at);
                if inside(x + dx) && inside(z + dz) {
                    let near = before[(z + dz) as usize * SIDE + (x + dx) as usize];
                    sum = [sum[0] + near[0], sum[1] + near[1]];
                    count += 1.0;
                }
            }
            *air = sum.map(|part| part / count);
        }
    }

    /// As a picture that scenes read: red and green are the direction, blue is the strength.
    ///
    /// # Errors
    /// What the encoder says.
    pub fn png(&self) -> Result<Vec<u8>, String> {
        let pixel = |air: &[f32; 2]| {
            let strength = air[0].hypot(air[1]);
            let way = if strength > 1e-4 { air.map(|part| part / strength) } else { [0.0; 2] };
            let [x, z] = way.map(|part| ((part + 1.0) * 127.5).round() as u8);
            [x, z, (strength.min(1.0) * 255.0).round() as u8]
        };
        let bytes: Vec<u8> = self.air.iter().flat_map(pixel).collect();
        let picture = image::RgbImage::from_raw(SIDE as u32, SIDE as u32, bytes).ok_or("the painting has no picture")?;
        let mut out = Cursor::new(Vec::new());
        picture.write_to(&mut out, image::ImageFormat::Png).map_err(|error| error.to_string())?;
        Ok(out.into_inner())
    }

    /// From such a picture of any size.
    ///
    /// # Errors
    /// It is no picture that can be read.
    pub fn from_png(bytes: &[u8]) -> Result<Self, String> {
        let picture =
            image::load_from_memory_with_format(bytes, image::ImageFormat::Png).map_err(|error| format!("is no readable PNG: {error}"))?;
        let picture = picture.resize_exact(SIDE as u32, SIDE as u32, image::imageops::FilterType::Triangle).into_rgb8();
        let air = |pixel: &image::Rgb<u8>| {
            let [x, z] = [pixel.0[0], pixel.0[1]].map(|value| f32::from(value) / 127.5 - 1.0);
            let length = x.hypot(z);
            let strength = f32::from(pixel.0[2]) / 255.0;
            if length < 0.02 { [0.0; 2] } else { [x, z].map(|part| part / length * strength) }
        };
        Ok(Self { air: picture.pixels().map(air).collect() })
    }

    /// The air at a place, 0 to 1 in x and z.
    pub fn at(&self, [x, z]: [f32; 2]) -> [f32; 2] {
        let texel = |at: f32| ((at.clamp(0.0, 1.0) * SIDE as f32) as usize).min(SIDE - 1);
        self.air[texel(z) * SIDE + texel(x)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stroke_blows_along_its_way_and_nowhere_else() {
        let mut painting = Painting::default();
        painting.stroke([0.2, 0.5], [0.8, 0.5], &Brush::default());
        let [x, z] = painting.at([0.5, 0.5]);
        assert!(x > 0.7 && z.abs() < 1e-6, "{x} {z}");
        assert_eq!(painting.at([0.5, 0.9]), [0.0; 2], "control");
        painting.stroke([0.2, 0.5], [0.8, 0.5], &Brush { erases: true, radius: 0.3, ..Brush::default() });
        assert!(painting.at([0.5, 0.5])[0] < 0.1);
    }

    #[test]
    fn what_is_saved_is_read_again() {
        let painting = Painting::swirl();
        let again = Painting::from_png(&painting.png().expect("encodes")).expect("reads");
        let worst = painting.air.iter().zip(&again.air).flat_map(|(a, b)| [(a[0] - b[0]).abs(), (a[1] - b[1]).abs()]).fold(0.0, f32::max);
        assert!(worst < 0.012, "{worst}");
        let mut images = sward::wind::Images::default();
        images.add_png(&painting.png().expect("encodes")).expect("a scene reads it too");
        assert_ne!(Painting::outward(), painting, "control");
    }
}
