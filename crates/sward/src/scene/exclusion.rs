//! Where nothing grows, and where less: exclusions and masks.

use super::parameters::{choices, parameters};

choices! {
    /// A piece of ground.
    pub enum Area {
        /// A rectangle: the floor of a building.
        Box(Rectangle),
        /// A disc.
        Disc(Disc),
        /// A polygon, concave ones too.
        Polygon(Outline),
        /// A strip along a line: a road, a path, a ditch.
        Road(Road),
    }
}

parameters! {
    /// A rectangle on the ground.
    pub struct Rectangle {
        /// Centre (x, z).
        at: [f64; 2] = [0.0, 0.0], "m" in -1000000.0..=1000000.0;
        /// Width (x) and length (z) before it is turned.
        size: [f32; 2] = [8.0, 12.0], "m" in 0.01..=10000.0, required;
        /// Turn about the vertical; positive turns +z towards +x.
        yaw: f32 = 0.0, "rad" in -100.0..=100.0;
    }
}

parameters! {
    /// A disc on the ground.
    pub struct Disc {
        /// Centre (x, z).
        at: [f64; 2] = [0.0, 0.0], "m" in -1000000.0..=1000000.0;
        /// Radius.
        radius: f32 = 3.0, "m" in 0.01..=10000.0, required;
    }
}

parameters! {
    /// A polygon on the ground.
    pub struct Outline {
        /// Corners (x, z) in order, either way round: 3 to 256 of them.
        points: Vec<[f64; 2]> = vec![[0.0, 0.0], [0.0, 4.0], [4.0, 0.0]], "m" in -1000000.0..=1000000.0, required;
    }
}

parameters! {
    /// A strip along a line of straight pieces; its ends and bends are round.
    pub struct Road {
        /// Points (x, z) of the middle: 2 to 256 of them.
        points: Vec<[f64; 2]> = vec![[0.0, 0.0], [0.0, 10.0]], "m" in -1000000.0..=1000000.0, required;
        /// Width.
        width: f32 = 4.0, "m" in 0.01..=1000.0;
    }
}

parameters! {
    /// Ground on which nothing grows.
    pub struct Exclusion {
        /// Where.
        area: Area = Area::Disc(Disc::default()), "", required;
        /// Width of a margin outside the area in which plants grow fewer and lower the nearer they are to it.
        soft: f32 = 0.0, "m" in 0.0..=100.0;
        /// Height of its underside above the ground, as of a bridge: plants that stay below it grow.
        above: f32 = 0.0, "m" in 0.0..=100.0;
        /// Names of the stands it keeps away; none named: all.
        stands: Vec<String> = Vec::new(), "";
        /// Colour of the bare ground, linear RGB: share of light that it sends back.
        colour: [f32; 3] = [0.17, 0.125, 0.08], "" in 0.0..=1.0;
    }
}

parameters! {
    /// Pictures laid on the ground that say how much grows, and how it lies: PNGs of at most 2048 pixels a side, at least one of the three. Row 0 is the
    /// edge of least z, column 0 that of least x; between pixels is interpolated. Of masks that overlap the last one says how plants lie.
    pub struct Mask {
        /// Path of a grey picture (8 or 16 bits) of how much grows, relative to the scene file's folder or to the folder above that. White (255) changes
        /// nothing, black (0) is bare ground.
        path: String = String::new(), "";
        /// Path of a coloured picture (8 bits) of the direction in which plants grow: red is along x, green along z, blue up, 128 is none of it.
        /// (128, 128, 255) is upright, as in a normal map.
        direction: String = String::new(), "";
        /// Path of a grey picture of how messy they are: black, all lean alike; white, each up to 0.6 rad some way of its own.
        messiness: String = String::new(), "";
        /// Position (x, z) of the corner of least x and z.
        at: [f64; 2] = [0.0, 0.0], "m" in -1000000.0..=1000000.0;
        /// Width (x) and length (z) of the whole picture.
        size: [f32; 2] = [64.0, 64.0], "m" in 0.1..=100000.0, required;
        /// How far height follows the picture: 0 only the number of plants does, 1 half grey means half as high.
        height: f32 = 0.5, "" in 0.0..=1.0;
        /// Shade outside the picture: 1 is white.
        outside: f32 = 1.0, "" in 0.0..=1.0;
        /// Names of the stands it holds for; none named: all.
        stands: Vec<String> = Vec::new(), "";
        /// Colour of the bare ground, linear RGB: share of light that it sends back.
        colour: [f32; 3] = [0.17, 0.125, 0.08], "" in 0.0..=1.0;
    }
}
