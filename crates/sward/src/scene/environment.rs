//! Light from a picture of the surroundings, and the volume that it is kept in.

use super::parameters::parameters;

parameters! {
    /// A picture of the surroundings that lights the scene and is seen as its sky. Then the sun is the picture's own: `azimuth`, `elevation`,
    /// `haze` and `clouds` of the light mean nothing, `strength` still is a factor on the sun.
    pub struct Environment {
        /// Path of the picture, relative to the scene file's folder or to the folder above that: Radiance RGBE (.hdr), equirectangular, twice as
        /// wide as high, at most 4096 pixels wide. The middle of it lies towards +x, what is right of the middle towards +z.
        file: String = String::new(), "", required;
        /// Factor on all of its light.
        strength: f32 = 1.0, "" in 0.0..=100.0;
        /// Turn about the vertical, from +x towards +z.
        turn: f32 = 0.0, "rad" in -100.0..=100.0;
        /// Where among the plants its light is known.
        volume: LightVolume = LightVolume::default(), "";
    }
}

parameters! {
    /// A box of voxels round the camera's places, laid on the ground, in which is worked out once how much of the sky each place sees between
    /// plants and hills. Outside it light is that over an open field.
    pub struct LightVolume {
        /// Side of a voxel over the ground. It grows where more than 128 voxels a side would be needed.
        voxel: f32 = 0.5, "m" in 0.05..=16.0;
        /// How far ahead of the camera the volume reaches, and half as far to its sides and behind it.
        reach: f32 = 24.0, "m" in 2.0..=500.0;
        /// Height above the ground. Without it a little above the tallest plants.
        height: Option<f32> = None, "m" in 0.05..=20.0;
        /// Layers between the ground and that height.
        layers: u32 = 8, "" in 2..=32;
        /// Directions looked into from each voxel; brought to 8, 32, 72, 128, … 512.
        samples: u32 = 128, "" in 8..=512;
    }
}
