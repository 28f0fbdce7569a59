//! Where the picture is taken from.

use super::parameters::parameters;

parameters! {
    /// The camera. Heights (y) are above the ground at that place.
    pub struct Camera {
        /// Position of the eye.
        eye: [f64; 3] = [0.0, 1.7, -8.0], "m" in -1000000.0..=1000000.0;
        /// The point looked at.
        target: [f64; 3] = [0.0, 0.6, 4.0], "m" in -1000000.0..=1000000.0;
        /// Vertical opening angle.
        field_of_view: f32 = 0.8, "rad" in 0.05..=2.5;
        /// A flight: places at increasing times. They replace eye and target.
        keys: Vec<CameraKey> = Vec::new(), "";
        /// Name of the interactor to follow. Then eye and target are offsets in its frame: +z ahead of it, y above it.
        follow: Option<String> = None, "";
    }
}

parameters! {
    /// A place of the camera at a time.
    pub struct CameraKey {
        /// Time.
        time: f64 = 0.0, "s" in 0.0..=1000000000.0, required;
        /// Position of the eye.
        eye: [f64; 3] = [0.0, 1.7, -8.0], "m" in -1000000.0..=1000000.0, required;
        /// The point looked at.
        target: [f64; 3] = [0.0, 0.6, 4.0], "m" in -1000000.0..=1000000.0, required;
    }
}
