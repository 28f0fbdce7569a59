//! Everything a volume of light follows from. Two scenes with the same inputs have the same volume, bit for bit.

use glam::Vec3;

use super::leaves::Haze;
use super::relief::relief;
use super::room::Room;
use super::stored::Hash;
use crate::picture::subject::looks;
use crate::shading::environment::{Sphere, Sun};
use crate::world::World;

/// What the ground between plants sends back of light, linear RGB: litter and short growth.
const SOIL: [f32; 3] = [0.060, 0.055, 0.025];
/// What hills far away send back.
const HILLS: [f32; 3] = [0.08, 0.11, 0.04];

/// What goes in.
#[derive(Clone, Debug, PartialEq)]
pub struct Inputs {
    /// Where the voxels are.
    pub room: Room,
    /// Directions, and the light of the surroundings from them, without the sun.
    pub sphere: Sphere,
    /// The sun, as it shines on the scene.
    pub sun: Sun,
    /// Height of the ground at each column, m above the first one's; row by row.
    pub ground: Vec<f32>,
    /// Tangent of the skyline's height, `sphere.round` directions for each column; none on level ground.
    pub skyline: Vec<f32>,
    /// Levels of leaves between the ground and the height of the volume.
    pub levels: u32,
    /// Share of light that leaves take per metre, 1/m: level by level, row by row.
    pub leaves: Vec<f32>,
    /// The same in an open field, level by level.
    pub open: Vec<f32>,
    /// What leaves send on of the light that meets them, linear RGB.
    pub albedo: [f32; 3],
    /// What the ground sends back, linear RGB.
    pub soil: [f32; 3],
    /// What hills far away send back, linear RGB.
    pub hills: [f32; 3],
}

impl Inputs {
    /// Those of a world as it stands; `None` where it has no surroundings.
    pub fn of(world: &World) -> Option<Self> {
        let (light, environment) = (&world.scene.light, world.model.environment.as_ref()?);
        let settings = &light.environment.as_ref()?.volume;
        let tallest = world.model.stands.iter().map(|stand| stand.species.height[1]).fold(0.0, f32::max);
        let room = Room::of(&world.scene, settings, tallest);
        let sphere = Sphere::new(environment, settings.samples);
        let levels = 2 * (room.size[2] - 1);
        let haze = Haze::of(world, &looks(world), &room, levels as usize);
        let (ground, skyline) = relief(&world.model.terrain, &room, sphere.round);
        let shining = environment.light(light.strength, light.azimuth, light.elevation);
        Some(Self {
            sun: Sun { direction: shining.sun, irradiance: shining.sun_colour },
            room,
            sphere,
            ground,
            skyline,
            levels,
            leaves: haze.lost,
            open: haze.open,
            albedo: haze.albedo,
            soil: SOIL,
            hills: HILLS,
        })
    }

    /// One column of an open, level field.
    pub(super) fn field(&self) -> Self {
        let room = Room { size: [1, 1, self.room.size[2]], ..self.room };
        Self {
            room,
            ground: vec![0.0],
            skyline: Vec::new(),
            leaves: self.open.clone(),
            sphere: self.sphere.clone(),
            open: self.open.clone(),
            ..*self
        }
    }

    /// A hash of all of it, and of the way a volume is worked out and stored.
    pub fn key(&self) -> u128 {
        let mut hash = Hash::new();
        let Self { room, sphere, sun, ground, skyline, levels, leaves, open, albedo, soil, hills } = self;
        let Room { corner, voxel, size, height } = room;
        hash.f64s(corner);
        hash.f64s(voxel);
        hash.u32s(size);
        hash.u32s(&[sphere.round, sphere.rows, *levels]);
        let vectors = |hash: &mut Hash, vectors: &[Vec3]| vectors.iter().for_each(|vector| hash.f32s(&vector.to_array()));
        hash.f32s(&[*height]);
        vectors(&mut hash, &sphere.directions);
        sphere.facing.iter().for_each(|facing| hash.f32s(facing));
        sphere.irradiance.iter().for_each(|faces| vectors(&mut hash, faces));
        vectors(&mut hash, &sphere.light);
        vectors(&mut hash, &[sun.direction, sun.irradiance]);
        [ground, skyline, leaves, open].into_iter().for_each(|values| {
            hash.u32s(&[values.len() as u32]);
            hash.f32s(values);
        });
        [albedo, soil, hills].into_iter().for_each(|colour| hash.f32s(colour));
        hash.value()
    }
}
