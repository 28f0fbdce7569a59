//! Level ground: what is known without computing.

use std::f32::consts::PI;
use std::time::Instant;

use glam::{Vec3, Vec4};
use sward::picture::volume::{Inputs, Lighting, transport};
use sward::shading::environment::{Sphere, place};
use sward::shading::volume::{Faces, Spot, Volume, facing, mean};
use sward::world::World;

use crate::Test;
use crate::scenes::{dome, near, small, surroundings, white, world};

pub(crate) const TESTS: &[Test] = &[
    ("bare_ground_sees_the_whole_sky", bare_ground),
    ("roots_are_darker_than_tips", roots_and_tips),
    ("denser_plants_are_darker", denser),
    ("the_rim_is_an_open_field", rim),
    ("parts_of_the_sphere_add_up", parts),
    ("between_six_sides", sides),
    ("green_light_between_plants", green),
    ("a_volume_takes_a_few_seconds", seconds),
    ("same_bits_on_one_thread", threads),
];

const MEADOW: &str = "stands: [(species: Meadow, clumping: 0)]";

fn middle(volume: &Volume, up: f32) -> Faces {
    volume.faces(Spot { across: [0.5; 2], up })
}

pub(crate) fn volume(world: &World) -> Volume {
    Lighting::of(world).expect("a volume").volume
}

/// Without plants the whole sky is seen, and light is that of the sky to rounding.
fn bare_ground() {
    let bare = volume(&world("stands: []", dome(), small()));
    for up in [0.0, 0.5, 1.0] {
        let faces = middle(&bare, up);
        assert!(near(faces[2].w, 1.0, 0.01) && near(faces[2].x, 1.0, 0.01), "{up}: {}", faces[2]);
        // A wall sees half of the sky, and half of what the ground sends back; a ceiling sees the ground alone.
        assert!(near(faces[0].w, 0.5, 0.02) && faces[3].w < 0.01, "{up}: {faces:?}");
        assert!(faces[3].x < 0.1, "{up}: {faces:?}");
    }
}

/// Between plants less of the sky is seen than above them, and ever more of it upwards.
fn roots_and_tips() {
    let meadow = volume(&world(MEADOW, white(), small()));
    let shares: Vec<f32> = (0..=10).map(|up| middle(&meadow, up as f32 / 10.0)[2].w).collect();
    assert!(shares.is_sorted(), "{shares:?}");
    assert!(shares[0] < 0.5 && shares[0] > 0.02 && near(shares[10], 1.0, 0.01), "{shares:?}");
    let light = middle(&meadow, 1.0)[2].x;
    assert!(near(light, 1.0, 0.02), "above the plants: {light}");
    // Control: without plants the roots' share is that of the tips.
    let bare = volume(&world("stands: []", white(), small()));
    assert!(middle(&bare, 0.0)[2].w > 0.98);
}

fn denser() {
    let at_root = |cover: f32| {
        let text = format!("stands: [(species: Meadow, clumping: 0, cover: {cover})]");
        middle(&volume(&world(&text, white(), small())), 0.0)[2].w
    };
    let shares = [1.0, 0.5, 0.2, 0.05].map(at_root);
    assert!(shares.is_sorted(), "{shares:?}");
    assert!(shares[3] > shares[0] + 0.4, "{shares:?}");
}

/// Outside the volume light is that over an open field, even where the middle is bare.
fn rim() {
    let text = "stands: [(species: Meadow, clumping: 0)], exclusions: [(area: Disc(at: (0, -4), radius: 3))]";
    let cleared = volume(&world(text, white(), small()));
    let open = cleared.faces(Spot { across: [-7.0, 0.3], up: 0.0 })[2].w;
    let corner = cleared.faces(Spot { across: [1.0, 1.0], up: 0.0 })[2].w;
    assert!(near(open, corner, 1e-6), "{open} {corner}");
    let clearing = middle(&cleared, 0.0)[2].w;
    let meadow = middle(&volume(&world(MEADOW, white(), small())), 0.0)[2].w;
    assert!(near(open, meadow, 0.35), "an open field {open}, a real one {meadow}");
    assert!(clearing > 2.0 * open, "control: the clearing {clearing}, the field {open}");
}

/// The parts of all directions make a whole sphere, and a half of it for each face; light as bright everywhere is as bright as that.
fn parts() {
    for samples in [8, 32, 128, 512] {
        let sphere = Sphere::new(&white(), samples);
        assert_eq!(sphere.directions.len() as u32, samples);
        for face in 0..6 {
            let facing: f32 = sphere.facing.iter().map(|part| part[face]).sum();
            let light: Vec3 = sphere.irradiance.iter().map(|part| part[face]).sum();
            assert!(near(facing, PI, 2e-3) && near(light.x, PI, 2e-3), "{samples}, {face}: {facing} {light}");
        }
        let all: Vec3 = sphere.light.iter().sum();
        assert!(near(all.y, 4.0 * PI, 1e-4), "{samples}: {all}");
    }
    let place = place(Vec3::X, 0.0);
    assert!(near(place.x, 0.5, 1e-6) && near(place.y, 0.5, 1e-6), "{place}");
}

fn sides() {
    let faces: Faces = std::array::from_fn(|side| Vec4::splat(1.0 + side as f32));
    for (side, normal) in sward::shading::environment::FACES.into_iter().enumerate() {
        assert_eq!(facing(&faces, normal), faces[side]);
    }
    assert_eq!(mean(&faces), Vec3::splat(3.5));
    let even: Faces = [Vec4::ONE; 6];
    let slanted = facing(&even, Vec3::new(0.6, -0.48, 0.64));
    assert!(near(slanted.x, 1.0, 1e-6), "{slanted}");
}

/// Leaves take more blue than green: light between them turns green, light above them does not.
fn green() {
    let meadow = volume(&world(MEADOW, white(), small()));
    let greenness = |up: f32| {
        let light = mean(&middle(&meadow, up));
        light.y / light.z
    };
    assert!(greenness(0.1) > 1.1 && greenness(0.1) > greenness(1.0), "{} {}", greenness(0.1), greenness(1.0));
    let above = middle(&meadow, 1.0)[2];
    assert!(near(above.y, above.z, 0.01), "control: {above}");
}

/// 64 × 64 × 8 voxels.
fn seconds() {
    let mut meadow = world(MEADOW, white(), small());
    meadow.scene.camera.target = [0.0, 0.6, -8.0 + 1e-9];
    let volume = sward::scene::LightVolume { voxel: 0.5, reach: 32.0, layers: 8, ..Default::default() };
    meadow.scene.light.environment.as_mut().expect("surroundings").volume = volume;
    let begun = Instant::now();
    let inputs = Inputs::of(&meadow).expect("inputs");
    let (prepared, key) = (begun.elapsed(), inputs.key());
    let mut told = Vec::new();
    let made = transport::volume(&inputs, &mut |share| told.push(share));
    println!("{:?} voxels: inputs {prepared:?}, volume {:?}, key {key:032x}", made.size, begun.elapsed() - prepared);
    assert!(told.is_sorted() && told.last() == Some(&1.0), "{told:?}");
    assert!(begun.elapsed().as_secs_f64() < 60.0, "far too slow");
}

/// The same on one thread as on all.
fn threads() {
    let of = || volume(&world(MEADOW, surroundings(|[x, up, _]| [0.5 + 0.4 * x, 1.0, 1.0 + 0.5 * up]), small()));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool");
    assert!(pool.install(of) == of());
}
