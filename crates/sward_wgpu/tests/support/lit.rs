//! Twins of the light of surroundings and of the volume among the plants.

use glam::{Vec2, Vec3, Vec4};
use sward::scene::Blade;
use sward::shading::blade::{self, BladeStyle};
use sward::shading::clump::Kind;
use sward::shading::environment;
use sward::shading::look::{Look, Turf};
use sward::shading::volume::{self, Faces, lit};
use sward_wgpu::compare::Tolerance;
use sward_wgpu::gpu::Gpu;

use crate::adapter::{Verdict, ensure};
use crate::kernels::{By, Random};
use crate::shading::{check, direction, light, vector};

/// Six sides; goes before each host text.
const SIDES: &str = "
fn next_faces() -> VolumeFaces {
    var faces: VolumeFaces;
    for (var side = 0u; side < 6u; side++) { faces.sides[side] = next_4(); }
    return faces;
}
";

/// A few roundings.
const FEW: Tolerance = Tolerance { p999: 2e-5, rms: 4e-6, outlier: 1e-4, share: 1e-4 };

fn faces(random: &mut Random) -> Faces {
    std::array::from_fn(|_| Vec4::from([0.0; 4].map(|_: f32| random.float(0.0, 1.5))))
}

/// Where a direction lies in the picture, colour of air, disc of the sun.
pub(crate) fn surroundings(gpu: &Gpu) -> Verdict {
    let host = "fn twin() {
        let direction = next_3();
        let place = environment_place(direction, next_f());
        // Left and right end of the picture are one place.
        put_v(vec2<f32>(abs(place.x - 0.5), place.y));
        var horizon: array<vec4<f32>, 5>;
        for (var k = 0; k < 5; k++) { horizon[k] = vec4<f32>(next_3(), 0.0); }
        put_3(environment_air(horizon, direction));
        let sun = next_3();
        put_3(environment_disc(direction, sun, vec3<f32>(3.0, 2.0, 1.0), next_f()));
    }";
    check(gpu, "surroundings", host, By::Absolute(Tolerance { p999: 1e-4, rms: 1e-4, outlier: 1e-3, share: 1e-3 }), |random| {
        let direction = direction(random, -1.0);
        let place = environment::place(direction, random.float(-4.0, 4.0));
        let horizon: [Vec3; 5] = std::array::from_fn(|_| vector(random, -0.5, 1.0));
        let air = environment::air(&horizon, direction);
        let sun = self::direction(random, 0.0);
        let disc = environment::disc(direction, sun, Vec3::new(3.0, 2.0, 1.0), random.float(0.2, 0.9));
        [&[(place.x - 0.5).abs(), place.y][..], &air.to_array(), &disc.to_array()].concat()
    })
}

/// Leaves, from both sides. Control: light from above that comes from below.
pub(crate) fn leaves(gpu: &Gpu) -> Verdict {
    let host = [
        SIDES,
        "fn twin() {
        let faces = next_faces();
        let light = next_light();
        let albedo = next_3();
        let normal = next_3();
        let view = next_3();
        let shares = next_4();
        let facing = volume_facing(faces, normal);
        put_3(facing.rgb);
        put_f(facing.w);
        put_3(volume_mean(faces));
        put_f(lit_rise(shares.x, shares.y, shares.z));
        put_3(lit_leaf(albedo, normal, view, light, shares.w, faces, 0.7));
    }",
    ]
    .concat();
    let twin = |swapped: bool, random: &mut Random| {
        let mut faces = faces(random);
        if swapped {
            faces.swap(2, 3);
        }
        let light = light(random);
        let albedo = vector(random, 0.0, 0.4);
        let (normal, view) = (direction(random, -1.0), direction(random, -1.0));
        let [up, far, lying, share] = [0.0; 4].map(|_: f32| random.float(0.0, 1.0));
        let leaf = lit::leaf(albedo, normal, view, &light, share, &faces, 0.7);
        let facing = volume::facing(&faces, normal);
        [&facing.to_array()[..], &volume::mean(&faces).to_array(), &[lit::rise(up, far, lying)], &leaf.to_array()].concat()
    };
    check(gpu, "leaves in a volume", &host, By::Relative(FEW, 0.1), |random| twin(false, random))?;
    let upside_down = check(gpu, "leaves upside down", &host, By::Relative(FEW, 0.1), |random| twin(true, random));
    ensure(upside_down.is_err(), || "control: light from below and from above are the same".to_owned())
}

/// Blades.
pub(crate) fn blades(gpu: &Gpu) -> Verdict {
    let host = [
        SIDES,
        "fn twin() {
        let style = BladeStyle(next_4(), next_4(), next_4(), vec4<u32>(7u, 0u, 0u, 0u));
        let faces = next_faces();
        let light = next_light();
        let facing = next_3();
        let across = next_3();
        let ground = next_3();
        let patchwork = next_3();
        let shares = next_3();
        let spot = BladeSpot(facing, across, shares.x, shares.y, ground, patchwork, shares.z);
        let view = next_3();
        let distance = next_f();
        let surface = shading_blade_surface(style, spot, view, distance);
        put_3(lit_blade(style, spot, surface, view, light, next_f(), faces));
    }",
    ]
    .concat();
    check(gpu, "blades in a volume", &host, By::Relative(Tolerance { share: 1e-3, ..FEW }, 0.2), |random| {
        let mut style = BladeStyle::new(&Blade::default(), &Look::of(Kind::Meadow), [7, 0, 0, 0]);
        for row in [&mut style.root, &mut style.tip, &mut style.light] {
            row.iter_mut().for_each(|value| *value = random.put(*value));
        }
        let faces = faces(random);
        let light = light(random);
        let (facing, across, ground) = (direction(random, -1.0), direction(random, -1.0), direction(random, 0.5));
        let patchwork = vector(random, 0.0, 1.0);
        let [side, along, tint] = [random.float(-1.0, 1.0), random.float(0.0, 1.0), random.float(0.0, 1.0)];
        let spot = blade::Spot { facing, across, side, along, ground, patchwork, tint };
        let (view, distance) = (direction(random, -1.0), random.float(0.1, 120.0));
        let surface = blade::surface(&style, &spot, view, distance);
        lit::blade(&style, &spot, &surface, view, &light, random.float(0.0, 1.0), &faces).to_array().to_vec()
    })
}

/// Ground and bare earth.
pub(crate) fn grounds(gpu: &Gpu) -> Verdict {
    let host = [
        SIDES,
        "const TURF = ShadingTurf(vec4<f32>(0.024, 0.066, 0.011, 0.2), vec4<f32>(0.085, 0.2, 0.03, 0.8), vec4<f32>(0.7, 0.95, 110.0, 0.0));
    fn twin() {
        let below = next_faces();
        let tops = next_faces();
        let light = next_light();
        let p = next_v();
        let normal = next_3();
        let view = next_3();
        let distance = next_f();
        let lit = next_f();
        put_3(lit_ground(TURF, p, normal, view, distance, 0.001, light, lit, below, tops));
        put_3(lit_earth(vec3<f32>(0.2, 0.15, 0.1), p, normal, view, distance, 0.001, light, lit, below));
    }",
    ]
    .concat();
    let turf = Turf { root: [0.024, 0.066, 0.011, 0.2], tip: [0.085, 0.2, 0.03, 0.8], mean: [0.7, 0.95, 110.0, 0.0] };
    let tolerance = Tolerance { p999: 5e-4, rms: 5e-5, outlier: 2e-3, share: 1e-3 };
    check(gpu, "ground in a volume", &host, By::Relative(tolerance, 0.1), |random| {
        let (below, tops) = (faces(random), faces(random));
        let light = light(random);
        let p = Vec2::new(random.float(0.0, 1024.0), random.float(0.0, 1024.0));
        let (normal, view) = (direction(random, 0.5), direction(random, 0.02));
        let (distance, lit) = (random.float(0.5, 200.0), random.float(0.0, 1.0));
        let ground = lit::ground(&turf, p, normal, view, distance, 0.001, &light, lit, (&below, &tops));
        let earth = lit::earth(Vec3::new(0.2, 0.15, 0.1), p, normal, view, distance, 0.001, &light, lit, &below);
        [ground.to_array(), earth.to_array()].concat()
    })
}
