//! The shape of the ground.

use super::parameters::{choices, parameters};

choices! {
    /// The shape of the ground.
    pub enum Terrain {
        /// A level plane.
        Flat(Flat),
        /// Heights from a grey PNG or a GeoTIFF.
        Image(Image),
    }
}

parameters! {
    /// Level ground.
    pub struct Flat {
        /// Height of the plane.
        height: f32 = 0.0, "m" in -10000.0..=10000.0;
    }
}

parameters! {
    /// Heights from a 16-bit grey PNG, or a TIFF of one channel. Beside a PNG, a text file of the same name ending in `.toml` gives the size of a
    /// pixel and the lowest and highest height. A TIFF holds the heights themselves; the size of a pixel comes from its GeoTIFF tags (degrees become metres at the
    /// middle latitude; projected metres are taken as they are, so EPSG:3857 is stretched by 1 / cos latitude), or from `metres_per_pixel_x` and
    /// `metres_per_pixel_y` in such a text file. Samples without data take the nearest height. Row 0 is the north edge (least z), column 0 the west edge (least x); outside, the terrain is mirrored.
    pub struct Image {
        /// Path of the picture, relative to the scene file's folder or to the folder above that.
        path: String = String::new(), "", required;
        /// Factor on all three dimensions: 0.5 makes hills half as wide, half as long and half as high.
        scale: f64 = 1.0, "" in 0.0001..=1000.0;
        /// Authored position (x, z) of the picture's centre.
        offset: [f64; 2] = [0.0, 0.0], "m" in -1000000.0..=1000000.0;
    }
}
