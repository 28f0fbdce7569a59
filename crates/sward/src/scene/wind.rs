//! Sources of wind; their sum is the velocity of the air.

use super::fluid::Fluid;
use super::parameters::{choices, parameters};
use super::path::{Path, Still};

/// Most footprints of one scene: the kernels have room for no more.
pub const MAX_FOOTPRINTS: usize = 8;

choices! {
    /// Something that moves the air.
    pub enum WindSource {
        /// The same velocity everywhere and always.
        Uniform(Uniform),
        /// A mean velocity with travelling gusts.
        Natural(Natural),
        /// The wind of a place, which may move: of a helicopter, a fan, a whirl. At most 8 of them.
        Footprint(Footprint),
        /// Air that flows, with eddies, gusts that are pushed in, and wakes of bodies. At most 2 of them.
        Fluid(Fluid),
    }
}

parameters! {
    /// Steady wind.
    pub struct Uniform {
        /// Velocity of the air in x and z.
        velocity: [f32; 2] = [4.0, 0.0], "m/s" in -60.0..=60.0;
    }
}

parameters! {
    /// Wind with gusts of three sizes that travel over the ground.
    pub struct Natural {
        /// Mean velocity of the air in x and z.
        velocity: [f32; 2] = [4.0, 0.0], "m/s" in -60.0..=60.0;
        /// Standard deviation of the gusts over the mean speed.
        turbulence: f32 = 0.25, "" in 0.0..=1.0;
    }
}

choices! {
    /// How the air moves in a footprint.
    pub enum Flow {
        /// Away from the centre, fastest at it and still at the radius.
        Outward,
        /// Round the centre, from +x towards +z.
        Swirl,
        /// As painted in an image.
        Image(FlowImage),
    }
}

parameters! {
    /// A square PNG, 2 to 512 pixels a side: red and green are the direction along x and z (0 is -1, 255 is +1), blue is the strength.
    pub struct FlowImage {
        /// Path of the picture, relative to the scene file's folder or to the folder above that. Its first row lies towards -z.
        path: String = String::new(), "", required;
    }
}

parameters! {
    /// Wind of a place.
    pub struct Footprint {
        /// How the air moves.
        flow: Flow = Flow::Outward, "";
        /// Where it ends, from the centre; half the side of an image.
        radius: f32 = 12.0, "m" in 0.5..=500.0;
        /// Its strength on the ground; negative blows the other way.
        speed: f32 = 15.0, "m/s" in -60.0..=60.0;
        /// Height of what makes it above the ground; keys of the path may say another in `clearance`.
        height: f32 = 0.0, "m" in 0.0..=1000.0;
        /// At this height nothing of it is left on the ground; below it the strength grows evenly.
        ceiling: f32 = 30.0, "m" in 0.1..=1000.0;
        /// Where it goes; images turn with it.
        path: Path = Path::Still(Still::default()), "";
        /// Name of an interactor that it stays with instead, at the height of that one.
        follow: Option<String> = None, "";
    }
}
