//! Twins of everything that shades, of cards and of the ground in frame space.

use glam::{Vec2, Vec3};
use sward::geometry::{billboard, blade, card, relief};
use sward::math;
use sward::shading::look::{Look, Style, Turf};
use sward::shading::sky::Light;
use sward::shading::{self, body, clump::Kind, common, foliage, grass, ground, sky, water};
use sward::terrain::EditFrame;
use sward_wgpu::compare::Tolerance;
use sward_wgpu::gpu::Gpu;

use crate::adapter::Verdict;
use crate::kernels::{By, Random, Twin, bits};

/// Vectors in and out, and a light; goes before each host text.
const VECTORS: &str = "
fn next_3() -> vec3<f32> { let v = next_v(); return vec3<f32>(v, next_f()); }
fn next_4() -> vec4<f32> { let v = next_3(); return vec4<f32>(v, next_f()); }
fn put_3(value: vec3<f32>) { put_v(value.xy); put_f(value.z); }
fn next_light() -> ShadingLight {
    let sun = next_3();
    let sun_colour = next_3();
    let sky = next_3();
    return ShadingLight(sun, sun_colour, sky, next_3());
}
";

/// GPUs reckon `pow`, `exp` and `log2` to some 1e-6 of the result, and what follows from them to a few times that.
const FEW_ROUNDINGS: Tolerance = Tolerance { p999: 2e-5, rms: 4e-6, outlier: 1e-4, share: 1e-4 };

pub(crate) fn vector(random: &mut Random, low: f32, high: f32) -> Vec3 {
    Vec3::new(random.float(low, high), random.float(low, high), random.float(low, high))
}

/// A unit vector whose height is at least `lowest`.
pub(crate) fn direction(random: &mut Random, lowest: f32) -> Vec3 {
    let (up, turn) = (random.drawn(lowest, 1.0), random.drawn(0.0, std::f32::consts::TAU));
    let level = (1.0 - up * up).max(0.0).sqrt();
    let unit = Vec3::new(level * turn.cos(), up, level * turn.sin());
    unit.to_array().map(|value| random.put(value)).into()
}

pub(crate) fn light(random: &mut Random) -> Light {
    Light {
        sun: direction(random, 0.05),
        sun_colour: vector(random, 0.0, 20.0),
        sky: vector(random, 0.0, 2.0),
        ground: vector(random, 0.0, 0.5),
    }
}

/// Compares one function; `host` is its `fn twin()`.
pub(crate) fn check(gpu: &Gpu, name: &str, host: &str, by: By, rust: impl Fn(&mut Random) -> Vec<f32>) -> Verdict {
    let host = [VECTORS, host].join("\n");
    let rust = |n: u32, input: &mut Vec<u32>| {
        let mut random = Random::new(n);
        let answer = rust(&mut random);
        input.extend(random.words);
        answer.into_iter().map(f32::to_bits).collect()
    };
    let library = &[&[math::WGSL, card::WGSL, billboard::WGSL, blade::WGSL], &shading::WGSL[..]].concat();
    Twin { name, library, host: &host, tables: &[], rust }.check(gpu, by)
}

/// Hashes are equal; noise and what is made of it to rounding.
pub(crate) fn patterns(gpu: &Gpu) -> Verdict {
    let host = "fn twin() {
        let lattice = next_w();
        put_f(shading_hash(lattice.x, lattice.y, 7u));
        let p = next_v();
        put_f(shading_noise(p, 256, 9u));
        put_3(shading_patchwork(p));
        put_f(shading_turf(p, next_f()));
    }";
    let tolerance = Tolerance { p999: 2e-5, rms: 4e-6, outlier: 1e-4, share: 1e-4 };
    check(gpu, "patterns", host, By::Absolute(tolerance), |random| {
        let lattice = [random.whole(-70_000, 70_000), random.whole(-70_000, 70_000)];
        let p = Vec2::new(random.float(-20.0, 1044.0), random.float(-20.0, 1044.0));
        let [x, y, z] = common::patchwork(p).to_array();
        let footprint = random.float(0.0, 0.1);
        vec![common::hash(lattice[0], lattice[1], 7), common::noise(p, 256, 9), x, y, z, ground::turf(p, footprint)]
    })
}

/// Fog, tone curve and code values.
pub(crate) fn tones(gpu: &Gpu) -> Verdict {
    let host = "fn twin() {
        let distance = next_f();
        put_f(shading_fog(distance, next_f()));
        let toned = shading_tone(next_3());
        put_3(toned);
        put_3(shading_encode(toned));
    }";
    check(gpu, "tones", host, By::Absolute(FEW_ROUNDINGS), |random| {
        let fog = common::fog(random.float(0.0, 4000.0), random.float(0.0, 0.05));
        let toned = common::tone(vector(random, 0.0, 30.0));
        let ([a, b, c], [d, e, f]) = (toned.to_array(), common::encode(toned).to_array());
        vec![fog, a, b, c, d, e, f]
    })
}

/// Air, sun, clouds and ridges in all directions.
pub(crate) fn skies(gpu: &Gpu) -> Verdict {
    let host = "fn twin() {
        let direction = next_3();
        let sun = next_3();
        let haze = next_f();
        put_3(shading_air(direction, sun, haze));
        let cover = next_f();
        put_3(shading_backdrop(direction, sun, haze, cover, next_v()));
    }";
    // A skyline is a step of 1/400 of a radian: a rounding of the angle there is a hundred times larger in the colour.
    let tolerance = Tolerance { p999: 5e-4, rms: 1e-4, outlier: 5e-3, share: 1e-3 };
    check(gpu, "sky", host, By::Relative(tolerance, 0.05), |random| {
        let (direction, sun) = (direction(random, -0.3), direction(random, 0.02));
        let (haze, cover) = (random.float(0.0, 1.0), random.float(0.0, 1.0));
        let drift = Vec2::new(random.float(0.0, 256.0), random.float(0.0, 102.0));
        [sky::air(direction, sun, haze), sky::backdrop(direction, sun, haze, cover, drift)].map(|v| v.to_array()).concat()
    })
}

/// Endless water in all directions.
pub(crate) fn waters(gpu: &Gpu) -> Verdict {
    let host = "fn twin() {
        let light = next_light();
        put_3(shading_water(next_3(), light));
    }";
    check(gpu, "water", host, By::Relative(FEW_ROUNDINGS, 0.1), |random| {
        let light = light(random);
        water::water(direction(random, -1.0), &light).to_array().to_vec()
    })
}

/// Colour of leaves and light on them, from both sides.
pub(crate) fn leaves(gpu: &Gpu) -> Verdict {
    let host = "fn twin() {
        let light = next_light();
        let root = next_3();
        let tip = next_3();
        let shares = next_4();
        let patchwork = next_3();
        let albedo = shading_leaf(root, tip, shares.x, shares.y, patchwork, shares.z);
        let normal = next_3();
        let view = next_3();
        let lit = next_f();
        put_3(albedo);
        put_3(shading_grass(albedo, normal, view, light, lit, shares.w, 0.7));
    }";
    check(gpu, "leaf", host, By::Relative(FEW_ROUNDINGS, 0.1), |random| {
        let light = light(random);
        let (root, tip) = (vector(random, 0.0, 0.3), vector(random, 0.0, 0.4));
        let [along, dry, shade, open] = [0.0; 4].map(|_: f32| random.float(0.0, 1.0));
        let albedo = grass::leaf(root, tip, along, dry, vector(random, 0.0, 1.0), shade);
        let (normal, view) = (direction(random, -1.0), direction(random, -1.0));
        let lit = random.float(0.0, 1.0);
        [albedo, grass::grass(albedo, normal, view, &light, lit, open, 0.7)].map(|v| v.to_array()).concat()
    })
}

const LOOK_HOST: &str = "
const SPECIES = ShadingSpecies(vec4<f32>(0.03, 0.06, 0.014, 0.06), vec4<f32>(0.08, 0.165, 0.038, 0.6), vec4<f32>(0.164, 1.52, 70.0, 110.0));
";

/// A pixel of a card: level, coverage and light.
pub(crate) fn cards_pixels(gpu: &Gpu) -> Verdict {
    let host = [
        LOOK_HOST,
        "fn twin() {
        let across = next_v();
        put_f(shading_level(across, next_v()));
        let alpha = next_v();
        let distance = next_f();
        put_f(shading_rim(alpha.x, alpha.y, 110.0, distance));
        let light = next_light();
        let along_card = next_3();
        let facing = next_3();
        let view = next_3();
        put_f(shading_on_edge(facing, view));
        let shares = next_4();
        let patchwork = next_3();
        let texel = next_3();
        let card = ShadingCard(along_card, facing, shares.x, shares.y, patchwork, shares.z);
        put_3(shading_foliage(SPECIES, card, vec4<f32>(texel, 1.0), view, distance, light, shares.w));
    }",
    ]
    .concat();
    let style = Style::new(&Look::of(Kind::Reed), 7, 2, 64);
    check(gpu, "foliage", &host, By::Relative(Tolerance { share: 1e-3, ..FEW_ROUNDINGS }, 0.2), |random| {
        let mut pair = |high: f32| Vec2::new(random.float(-high, high), random.float(-high, high));
        let (across, down) = (pair(40.0), pair(40.0));
        let alpha = [random.float(0.0, 1.0), random.float(0.0, 1.0)];
        let distance = random.float(0.1, 120.0);
        let light = light(random);
        let (along_card, facing, view) = (direction(random, -1.0), direction(random, -1.0), direction(random, -1.0));
        // Also a little beyond root and tip, where a pixel's centre may lie.
        let (along, lying, tint, lit) = (random.float(-0.1, 1.1), random.float(0.0, 1.0), random.float(0.0, 1.0), random.float(0.0, 1.0));
        let patchwork = vector(random, 0.0, 1.0);
        let card = foliage::Card { across: along_card, facing, along, lying, patchwork, tint };
        let colour = foliage::foliage(&style, &card, vector(random, 0.0, 1.0), view, distance, &light, lit);
        let mut answer =
            vec![foliage::level(across, down), foliage::rim(alpha[0], alpha[1], 110.0, distance), foliage::on_edge(facing, view)];
        answer.extend(colour.to_array());
        answer
    })
}

/// Ground, near and far.
pub(crate) fn grounds(gpu: &Gpu) -> Verdict {
    let host = "
    const TURF = ShadingTurf(vec4<f32>(0.024, 0.066, 0.011, 0.2), vec4<f32>(0.085, 0.2, 0.03, 0.8), vec4<f32>(0.7, 0.95, 110.0, 0.0));
    fn twin() {
        let light = next_light();
        let p = next_v();
        let normal = next_3();
        let view = next_3();
        let distance = next_f();
        put_3(shading_ground(TURF, p, normal, view, distance, 0.001, light, next_f()));
    }";
    let turf = Turf { root: [0.024, 0.066, 0.011, 0.2], tip: [0.085, 0.2, 0.03, 0.8], mean: [0.7, 0.95, 110.0, 0.0] };
    let tolerance = Tolerance { p999: 5e-4, rms: 5e-5, outlier: 2e-3, share: 1e-3 };
    check(gpu, "ground", host, By::Relative(tolerance, 0.1), |random| {
        let light = light(random);
        let p = Vec2::new(random.float(0.0, 1024.0), random.float(0.0, 1024.0));
        let (normal, view) = (direction(random, 0.5), direction(random, 0.02));
        let (distance, lit) = (random.float(0.5, 200.0), random.float(0.0, 1.0));
        ground::ground(&turf, p, normal, view, distance, 0.001, &light, lit).to_array().to_vec()
    })
}

/// Bare earth, and how its rim strays.
pub(crate) fn earths(gpu: &Gpu) -> Verdict {
    let host = "
    fn twin() {
        let light = next_light();
        let p = next_v();
        let normal = next_3();
        let view = next_3();
        let distance = next_f();
        put_3(shading_earth(vec3<f32>(0.2, 0.15, 0.1), p, normal, view, distance, 0.001, light, next_f()));
        put_v(shading_stray(p));
    }";
    let tolerance = Tolerance { p999: 5e-4, rms: 5e-5, outlier: 2e-3, share: 1e-3 };
    check(gpu, "earth", host, By::Relative(tolerance, 0.1), |random| {
        let light = light(random);
        let p = Vec2::new(random.float(0.0, 1024.0), random.float(0.0, 1024.0));
        let (normal, view) = (direction(random, 0.5), direction(random, 0.02));
        let (distance, lit) = (random.float(0.5, 200.0), random.float(0.0, 1.0));
        let earth = ground::earth(Vec3::new(0.2, 0.15, 0.1), p, normal, view, distance, 0.001, &light, lit);
        [&earth.to_array()[..], &ground::stray(p).to_array()].concat()
    })
}

/// Edits in frame space.
pub(crate) fn relief_edits(gpu: &Gpu) -> Verdict {
    let mut random = Random::new(u32::MAX);
    let heights: Vec<f32> = (0..40 * 30).map(|_| random.drawn(-3.0, 3.0)).collect();
    let frame = EditFrame { mapping: [4.0, 0.0, 11.25, 3.5], size: [40, 30] };
    let rust = |n: u32, input: &mut Vec<u32>| {
        let mut random = Random::new(n);
        let p = [random.float(-4.0, 9.0), random.float(-2.0, 8.0)];
        input.extend(random.words);
        bits([relief::edit(&frame, p, |column, row| heights[(row * 40 + column) as usize])])
    };
    let host = "
    @group(0) @binding(2) var<storage, read> heights: array<f32>;
    fn relief_load(index: i32) -> f32 { return heights[index - 7]; }
    fn twin() { put_f(relief_edit(vec4<f32>(4.0, 0.0, 11.25, 3.5), vec3<u32>(40u, 30u, 7u), next_v())); }";
    let tolerance = Tolerance { p999: 1e-4, rms: 2e-5, outlier: 5e-4, share: 0.0 };
    let tables: &[&[u8]] = &[bytemuck::cast_slice(&heights)];
    Twin { name: "relief edit", library: &[relief::WGSL], host, tables, rust }.check(gpu, By::Absolute(tolerance))
}

/// Lacquer, rubber, glass and chrome.
pub(crate) fn bodies(gpu: &Gpu) -> Verdict {
    let host = "fn twin() {
        let light = next_light();
        let colour = next_3();
        let surface = next_3();
        let normal = next_3();
        let view = next_3();
        let haze = next_f();
        put_3(shading_body(colour, surface, normal, view, light, haze, next_f()));
    }";
    // The highlight of a mirror is a power of 20 000: near its rim a rounding of the angle is that many times larger.
    let tolerance = Tolerance { p999: 1e-3, rms: 2e-4, outlier: 2e-2, share: 1e-3 };
    check(gpu, "body", host, By::Relative(tolerance, 0.2), |random| {
        let light = light(random);
        let (colour, surface) = (vector(random, 0.0, 1.0), vector(random, 0.03, 1.0));
        let (normal, view) = (direction(random, -1.0), direction(random, -1.0));
        let (haze, lit) = (random.float(0.0, 1.0), random.float(0.0, 1.0));
        body::body(colour, surface, normal, view, &light, haze, lit).to_array().to_vec()
    })
}

/// Cards along upright, leaning and lying stems.
pub(crate) fn rungs(gpu: &Gpu) -> Verdict {
    let host = "fn twin() {
        let base = next_3();
        let here = next_3();
        let low = next_3();
        let high = next_3();
        let turn = next_f();
        let rung = card_rung(base, here, low, high, turn, 0.45, 6.0, next_f());
        put_3(rung.middle);
        put_3(rung.across);
        put_3(rung.facing);
        put_v(vec2<f32>(rung.width, rung.lying));
    }";
    // Where a card lies across its own heading, a rounding decides to which side it spreads.
    let tolerance = Tolerance { p999: 1e-5, rms: 1e-3, outlier: 1e-4, share: 1e-3 };
    check(gpu, "card", host, By::Absolute(tolerance), |random| {
        let base = vector(random, -20.0, 20.0);
        let mut joint = |from: Vec3| {
            let step = Vec3::new(random.drawn(-0.1, 0.1), random.drawn(0.0, 0.1), random.drawn(-0.1, 0.1));
            (from + step).to_array().map(|value| random.put(value)).into()
        };
        let here: Vec3 = joint(base);
        let low: Vec3 = joint(here);
        let high: Vec3 = joint(low);
        let turn = random.float(0.0, 9.0);
        let rung = card::rung([base, here, low, high], turn, 0.45, 6.0, random.float(0.15, 1.0));
        let mut answer = [rung.middle, rung.across, rung.facing].map(|v| v.to_array()).concat();
        answer.extend([rung.width, rung.lying]);
        answer
    })
}

/// Heights in frame space on hills of 60 m, kilometres away and mirrored, to 0.1 mm of a place rounded to 0.1 mm.
pub(crate) fn reliefs(gpu: &Gpu) -> Verdict {
    let mut random = Random::new(u32::MAX);
    let heights: Vec<f32> = (0..40 * 30).map(|_| random.drawn(0.0, 60.0)).collect();
    let frame = relief::ReliefFrame {
        mapping: [0.04, 0.03, 11.25, 27.5],
        size: [40, 30],
        detail: sward::terrain::Detail::NONE.kernel,
        detail_anchor: ([0; 2], [0.0; 2]),
    };
    let rust = |n: u32, input: &mut Vec<u32>| {
        let mut random = Random::new(n);
        let p = [random.float(-2000.0, 2000.0), random.float(-2000.0, 2000.0)];
        input.extend(random.words);
        bits([relief::height(&frame, p, |index| heights[index as usize])])
    };
    let host = "
    @group(0) @binding(2) var<storage, read> heights: array<f32>;
    fn relief_load(index: i32) -> f32 { return heights[index]; }
    fn twin() { put_f(relief_height(vec4<f32>(0.04, 0.03, 11.25, 27.5), vec2<u32>(40u, 30u), next_v())); }";
    let tolerance = Tolerance { p999: 1e-3, rms: 2e-4, outlier: 2e-3, share: 0.0 };
    let tables: &[&[u8]] = &[bytemuck::cast_slice(&heights)];
    Twin { name: "relief", library: &[relief::WGSL], host, tables, rust }.check(gpu, By::Absolute(tolerance))
}

/// One percent more fog must be noticed.
pub(crate) fn denser_fog_is_found(gpu: &Gpu) -> Verdict {
    let host = "fn twin() {
        let distance = next_f();
        put_f(shading_fog(distance, 1.01 * next_f()));
    }";
    let found = check(gpu, "denser fog", host, By::Absolute(FEW_ROUNDINGS), |random| {
        vec![common::fog(random.float(0.0, 4000.0), random.float(0.0, 0.05))]
    });
    crate::adapter::ensure(found.is_err(), || "one percent more fog is not found".to_owned())
}
