use super::tile::statistics;
use super::*;
use crate::math::{self, hash, tests::validate, unit};

const DT: f64 = 1.0 / 60.0;
/// Node spacing \[m\] of cells 0.25 m wide.
const SPACING: f64 = 0.5;
const BREEZE: Source = Source::Natural { velocity: [4.0, 0.0], turbulence: 0.25 };
const SLANTED: Source = Source::Natural { velocity: [-3.0, 7.0], turbulence: 0.4 };

fn field(sources: &[Source], step: u64) -> WindField {
    WindField::at(sources, step, DT, SPACING)
}

/// Random numbers in 0..1.
fn random(index: u32, purpose: u32) -> f32 {
    unit(hash(3, 0, 0, index, purpose))
}

#[test]
fn gusts_are_as_strong_as_asked() {
    for (source, mean, deviation) in [(BREEZE, [4.0, 0.0], 1.0), (SLANTED, [-3.0, 7.0], 0.4 * 58f64.sqrt())] {
        let mut speeds = [Vec::new(), Vec::new()];
        let mut beyond = 0;
        for i in 0..20_000 {
            let field = field(&[source], u64::from(hash(8, 0, 0, i / 20, 3)));
            let velocity = field.velocity(&field.patch_phases([0; 2], 64), [i as i32 * 37, i as i32 * -91]);
            beyond += u32::from(velocity[0].hypot(velocity[1]) > field.gust_speed());
            speeds[0].push(velocity[0]);
            speeds[1].push(velocity[1]);
        }
        for axis in 0..2 {
            let (found, spread) = statistics(&speeds[axis]);
            println!("mean {found:.3} deviation {spread:.3} beyond {beyond}");
            assert!((found - mean[axis]).abs() < 0.05 * deviation, "mean {found}");
            assert!((spread / deviation - 1.0).abs() < 0.06, "deviation {spread}, asked {deviation}");
        }
        assert!((1..1000).contains(&beyond), "{beyond} of 20000 beyond the gust speed");
    }
}

#[test]
fn neighbouring_patches_agree_on_shared_nodes() {
    let field = field(&[BREEZE, SLANTED], 123_456_789);
    let intervals = 64;
    for [x, z] in [[0, 0], [-1, -1], [8000, -8000], [-1_000_000, 1_000_000], [i32::MAX, i32::MIN]] {
        let phases = |dx: i32, dz| field.patch_phases([x.wrapping_add(dx), z.wrapping_add(dz)], intervals);
        let bits = |phases: &Phases, node| field.velocity(phases, node).map(f32::to_bits);
        for i in 0..=64 {
            assert_eq!(bits(&phases(0, 0), [64, i]), bits(&phases(1, 0), [0, i]));
            assert_eq!(bits(&phases(0, 0), [i, 64]), bits(&phases(0, 1), [i, 0]));
        }
        assert_ne!(bits(&phases(0, 0), [63, 5]), bits(&phases(1, 0), [0, 5]));
    }
}

/// The breeze by the formula, in `f64`: `W₀ + Σ kᵢ T(cᵢ Rᵢ (u − wᵢ t))`.
fn breeze_by_formula(place: [f64; 2], time: f64) -> [f64; 2] {
    let octaves: [(f64, [f64; 2], f64); 3] = [(3.8, [4.0, 0.0], 0.02), (2.3, [2.0, 1.5], 0.05), (1.4, [1.0, -2.0], 0.13)];
    let start = field(&[BREEZE], 0).octaves;
    let mut sum = [4.0, 0.0];
    for ((k, w, c), start) in octaves.into_iter().zip(start) {
        let (sine, cosine) = w[1].atan2(w[0]).sin_cos();
        let [x, z] = [place[0] - w[0] * time, place[1] - w[1] * time];
        let turned = [c * (cosine * x - sine * z), c * (sine * x + cosine * z)];
        let phase = [0, 1].map(|axis| {
            let tiles = turned[axis] + f64::from(start.phase[axis]) / 4294967296.0;
            ((tiles - tiles.floor()) * 4294967296.0) as u32
        });
        let gust = Tile::shipped().sample(phase);
        sum = [0, 1].map(|axis| sum[axis] + k * f64::from(gust[axis]));
    }
    sum
}

fn distance(a: [f32; 2], b: [f64; 2]) -> f64 {
    (f64::from(a[0]) - b[0]).hypot(f64::from(a[1]) - b[1])
}

#[test]
fn nodes_and_places_between_follow_the_formula_for_a_day() {
    let mut worst: [f64; 2] = [0.0; 2];
    for i in 0..3000 {
        // Up to 24 hours, up to 16 km away.
        let step = u64::from(hash(5, 0, 0, i, 1) % 5_184_000);
        let patch = [2, 3].map(|purpose| (random(i, purpose) * 1000.0) as i32 - 500);
        let node = [4, 5].map(|purpose| (random(i, purpose) * 64.0) as i32);
        let field = field(&[BREEZE], step);
        let phases = field.patch_phases(patch, 64);
        let place = [0, 1].map(|axis| f64::from(patch[axis] * 64 + node[axis]) * SPACING);
        let exact = breeze_by_formula(place, step as f64 * DT);
        worst[0] = worst[0].max(distance(field.velocity(&phases, node), exact));
        let local = [random(i, 6) * 300.0 - 150.0, random(i, 7) * 300.0 - 150.0];
        let corner = patch.map(|along| f64::from(along * 64) * SPACING);
        let exact = breeze_by_formula([corner[0] + f64::from(local[0]), corner[1] + f64::from(local[1])], step as f64 * DT);
        worst[1] = worst[1].max(distance(field.velocity_local(&phases, local), exact));
    }
    println!("error {:.2e} m/s at nodes, {:.2e} m/s between", worst[0], worst[1]);
    assert!(worst[0] < 5e-4 && worst[1] < 5e-4, "{worst:?}");
    let late = field(&[BREEZE], 5_184_000).velocity(&Phases::default(), [0; 2]);
    assert!(distance(late, breeze_by_formula([0.0; 2], 1.0)) > 1e-3, "the comparison must notice another wind");
}

#[test]
fn phases_never_jump() {
    let advance = |step: u64| -> Vec<[u32; 2]> {
        let (now, next) = (field(&[SLANTED], step), field(&[SLANTED], step.wrapping_add(1)));
        let pairs = now.octaves.iter().zip(&next.octaves);
        pairs.map(|(a, b)| [0, 1].map(|axis| b.phase[axis].wrapping_sub(a.phase[axis]))).collect()
    };
    let first = advance(0);
    assert_eq!(first.len(), 3);
    for step in (5_184_000..5_184_100).chain([1 << 32, (1 << 53) + 1, u64::MAX]) {
        for (a, b) in first.iter().zip(advance(step)) {
            // Each step adds the same, to the last bit of rounding.
            assert!((0..2).all(|axis| b[axis].wrapping_sub(a[axis]).wrapping_add(1) <= 2), "step {step}");
        }
    }
}

#[test]
fn uniform_wind_is_exact_and_sources_add_up() {
    let steady = Source::Uniform { velocity: [1.25, -0.1] };
    let wind = field(&[steady], 77);
    assert_eq!(wind.velocity(&wind.patch_phases([5, 6], 64), [7, 8]), [1.25, -0.1]);
    assert_eq!(wind.velocity_local(&wind.patch_phases([5, 6], 64), [7.5, 8.0]), [1.25, -0.1]);
    assert_eq!(wind.gust_speed(), (1.25f32 * 1.25 + 0.1 * 0.1).sqrt());
    assert_eq!(field(&[], 0).velocity(&Phases::default(), [3, 4]), [0.0; 2]);
    assert_eq!(field(&[steady, BREEZE, steady], 0).mean, [6.5, -0.2]);
    assert_eq!(field(&[steady, BREEZE, SLANTED], 0).octaves.len(), 6);
    let many = field(&[BREEZE, SLANTED, BREEZE], 0);
    assert_eq!((many.octaves.len(), many.dropped), (MAX_OCTAVES, 1));
    let weakest = many.octaves.iter().map(|octave| octave.amplitude).fold(f32::MAX, f32::min);
    assert_eq!(weakest, 1.4);
    let calm = [Source::Natural { velocity: [0.0; 2], turbulence: 1.0 }, Source::Natural { velocity: [f32::NAN; 2], turbulence: 1.0 }];
    assert_eq!(field(&calm, 9).velocity(&Phases { octaves: [[1; 2]; MAX_OCTAVES], ..Default::default() }, [3, 4]), [0.0; 2]);
}

#[test]
fn rows_hold_the_same_bits_as_nodes() {
    let field = field(&[SLANTED, BREEZE], 4242);
    let phases = field.patch_phases([-3, 12], 64);
    let (mut x, mut z) = (vec![0.0; 65], vec![0.0; 65]);
    field.velocity_row(&phases, [-1, 9], &mut x, &mut z);
    for i in 0..65 {
        assert_eq!([x[i], z[i]].map(f32::to_bits), field.velocity(&phases, [i as i32 - 1, 9]).map(f32::to_bits));
    }
}

#[test]
fn plants_lean_as_the_drag_law_says() {
    for i in 0..20_000 {
        let wind = [random(i, 1) * 120.0 - 60.0, random(i, 2) * 120.0 - 60.0];
        let k_w = random(i, 3);
        let speed = f64::from(wind[0]).hypot(f64::from(wind[1]));
        let lean = (f64::from(k_w) * speed.powf(4.0 / 3.0)).atan();
        let exact = [0, 1].map(|axis| lean * f64::from(wind[axis]) / speed);
        assert!(distance(equilibrium(wind, k_w), exact) < 1e-6, "{wind:?}");
    }
    assert_eq!(equilibrium([0.0, 0.0], 0.1), [0.0, 0.0]);
    let mut last = 0.0;
    for exponent in -45..3 {
        let bend = equilibrium([0.0, 10f32.powi(exponent)], 0.0385)[1];
        assert!(bend >= last && bend.is_finite(), "1e{exponent}: {bend} after {last}");
        last = bend;
    }
    assert!((1.5..=std::f32::consts::FRAC_PI_2).contains(&last));
}

#[test]
fn the_twins_are_valid_and_lay_out_structs_alike() {
    let tile = "fn wind_tile_load(index: u32) -> vec2<f32> { return vec2<f32>(f32(index)); }";
    let host = "@group(0) @binding(0) var<uniform> wind: WindBlock;";
    validate(&[math::WGSL, WGSL, tile, host]).unwrap();
    assert!(validate(&[math::WGSL, WGSL]).is_err());
    let module = naga::front::wgsl::parse_str(&[math::WGSL, WGSL, tile].concat()).unwrap();
    let offsets = |name: &str| -> Vec<usize> {
        let (_, found) = module.types.iter().find(|(_, t)| t.name.as_deref() == Some(name)).unwrap();
        let naga::TypeInner::Struct { members, span } = &found.inner else {
            return Vec::new();
        };
        members.iter().map(|member| member.offset).chain([*span]).map(|bytes| bytes as usize).collect()
    };
    use std::mem::{offset_of, size_of};
    let octave = [
        offset_of!(Octave, step_x),
        offset_of!(Octave, step_z),
        offset_of!(Octave, phase),
        offset_of!(Octave, per_metre_x),
        offset_of!(Octave, per_metre_z),
        offset_of!(Octave, amplitude),
        offset_of!(Octave, reserved),
        size_of::<Octave>(),
    ];
    assert_eq!(offsets("WindOctave"), octave);
    let block = [
        offset_of!(WindBlock, mean),
        offset_of!(WindBlock, count),
        offset_of!(WindBlock, intervals),
        offset_of!(WindBlock, octaves),
        offset_of!(WindBlock, footprint_count),
        offset_of!(WindBlock, fluid_count),
        offset_of!(WindBlock, unused),
        offset_of!(WindBlock, unused) + 4,
        offset_of!(WindBlock, footprints),
        offset_of!(WindBlock, fluids),
        size_of::<WindBlock>(),
    ];
    assert_eq!(offsets("WindBlock"), block);
    let wind = field(&[BREEZE], 5).block(64);
    assert_eq!((wind.count, wind.intervals, wind.octaves[3]), (3, 64, Octave::default()));
}
