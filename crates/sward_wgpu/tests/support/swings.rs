//! Plants that swing by themselves: where they are, how far bodies push them, what a step makes of both, and whole runs.

use sward::math;
use sward::response::oscillation;
use sward::response::oscillator::{self, OscillatorCoefficients, Own, Plant, Push, Record, least_tilt, touch};
use sward::world::World;
use sward_wgpu::compare::Tolerance;
use sward_wgpu::gpu::Gpu;

use crate::adapter::{Verdict, ensure};
use crate::kernels::{By, Random, Twin, bits};
use crate::runs::{Backend, Run, agree, world};

const STUBS: &str = "fn air_load(index: u32) -> f32 { return f32(index); }
fn contact_edge(index: u32) -> ContactEdge { var edge: ContactEdge; return edge; }
fn next_swing() -> OscillatorCoefficients {
    var co: OscillatorCoefficients;
    co.stiffness = next_f(); co.damping = next_f(); co.scale = next_f(); co.curve = next_f(); co.spreads = next_v(); co.dt = next_f();
    co.wind = next_f(); co.follow = next_f(); co.pace = next_f(); co.settle = next_u(); co.texels = next_u();
    return co;
}
fn next_record() -> SwingRecord {
    let deviation = next_v();
    let rate = next_f();
    return SwingRecord(deviation, rate, next_u());
}
";

fn library() -> Vec<&'static str> {
    [&[math::WGSL, sward::interaction::WGSL, oscillation::WGSL], &oscillator::WGSL[..]].concat()
}

/// A stand of any kind.
fn coefficients(random: &mut Random) -> OscillatorCoefficients {
    let rate = [30.0, 60.0, 240.0][random.bits() as usize % 3];
    let (length, angular) = (random.drawn(0.05, 1.4), std::f32::consts::TAU * random.drawn(0.6, 5.0));
    let co = OscillatorCoefficients {
        stiffness: 9.81 + angular * angular * length,
        damping: 2.0 * random.drawn(0.02, 5.0) * angular * length,
        scale: 1.0,
        curve: random.drawn(0.0, 1.0),
        spreads: [0.1, 0.2],
        dt: 1.0 / rate,
        wind: random.drawn(0.0, 0.1),
        follow: 0.1,
        pace: 12.0 / rate,
        settle: 500,
        texels: 0,
    };
    random.words.extend_from_slice(bytemuck::cast_slice(bytemuck::bytes_of(&co)));
    co
}

/// A plant left at step `now` less a few.
fn record(random: &mut Random, now: u32) -> Record {
    let ago = random.bits() % 90;
    let held = [0, random.bits() % 256][random.bits() as usize % 2];
    let deviation = [random.float(-1.2, 1.2), random.float(-1.2, 1.2)];
    let rate = random.float(-8.0, 8.0);
    let stamp = (now.wrapping_sub(ago) << 8) | held;
    random.words.push(stamp);
    Record { deviation, rate, stamp }
}

/// Where plants are at any moment, also of steps whose number has wrapped. Control: a step later.
pub(crate) fn poses(gpu: &Gpu) -> Verdict {
    let compare = |later: u32| {
        let rust = |n: u32, input: &mut Vec<u32>| {
            let mut random = Random::new(n);
            let now = [1000, 0x0100_0010, u32::MAX - 3][n as usize % 3];
            let co = coefficients(&mut random);
            let record = record(&mut random, now);
            let (variety, height) = (random.any(), random.float(0.05, 1.4));
            let behind = random.float(0.0, 1.0);
            random.words.push(now);
            input.extend(random.words);
            let [x, z] = record.at(&co, &Own::of(&co, variety, height), now.wrapping_add(later), behind);
            let bend = oscillator::limited([x, z]);
            bits([[x, z], oscillator::curved(co.curve, bend, n % 4, 4)].concat())
        };
        let host = [
            STUBS,
            "fn twin() {
            let n = in_at / READS;
            let co = next_swing();
            let record = next_record();
            let variety = next_u();
            let own = swing_own(co, variety, next_f());
            let behind = next_f();
            let deviation = swing_at(co, own, record, next_u(), behind);
            put_v(deviation);
            put_v(swing_curved(co.curve, swing_limited(deviation), n % 4u, 4u));
        }",
        ]
        .concat();
        let tolerance = Tolerance { p999: 2e-5, rms: 2e-5, outlier: 1e-3, share: 1e-4 };
        Twin { name: "swings", library: &library(), host: &host, tables: &[], rust }.check(gpu, By::Absolute(tolerance))
    };
    compare(0)?;
    ensure(compare(1).is_err(), || "a step later is not found".to_owned())
}

/// The least tilt under an ellipsoid. Where a rod all but lies, rounding decides some hundredths of a degree.
pub(crate) fn tilts(gpu: &Gpu) -> Verdict {
    let rust = |n: u32, input: &mut Vec<u32>| {
        let mut random = Random::new(n);
        let (share, clearance, radius) = (random.float(0.0, 1.05), random.float(-0.1, 0.5).max(0.0), random.float(0.1, 2.0));
        random.words[1] = clearance.to_bits();
        let (half, rod) = (random.float(0.05, 1.5), random.float(0.03, 1.5));
        input.extend(random.words);
        bits([least_tilt(share, clearance, radius, half, rod)])
    };
    let host =
        [STUBS, "fn twin() { let a = next_v(); let b = next_v(); put_f(instigator_least_tilt(a.x, a.y, b.x, b.y, next_f())); }"].concat();
    let tolerance = Tolerance { p999: 1e-4, rms: 5e-5, outlier: 1e-3, share: 1e-4 };
    Twin { name: "least tilts", library: &library(), host: &host, tables: &[], rust }.check(gpu, By::Absolute(tolerance))
}

/// What bodies make of a plant in a step: some stay, some leave within it. Control: one that stays leaves.
pub(crate) fn touches(gpu: &Gpu) -> Verdict {
    let compare = |stays: f32| {
        let rust = |n: u32, input: &mut Vec<u32>| {
            let mut random = Random::new(n);
            let co = coefficients(&mut random);
            let record = record(&mut random, 5000);
            let (variety, height) = (random.any(), random.float(0.05, 1.4));
            let wind = [random.float(-0.2, 0.2), random.float(-0.2, 0.2)];
            let pushes: Vec<(u32, Push, f32)> = (0..3)
                .map(|k| {
                    let tilt = random.float(-0.5, 1.5);
                    let (sine, cosine) = math::sin_cos(random.drawn(0.0, std::f32::consts::TAU));
                    let outward = [random.put(cosine), random.put(sine)];
                    let pace = random.float(0.0, 30.0);
                    (k, Push { tilt, outward, pace, lever: 0.1 * (k + 1) as f32, aside: 1.0 }, if k == 2 { stays } else { 1.0 })
                })
                .collect();
            input.extend(random.words);
            let plant = Plant { own: Own::of(&co, variety, height), record, wind, inertia: 1e-4, length: height };
            let touched = touch(&co, &plant, pushes.into_iter().filter(|(_, push, _)| push.tilt > 0.0), 5000);
            let next = touched.map_or(record, |touched| touched.record);
            let (_, leaning) = touched.and_then(|touched| touched.leaning).unwrap_or_default();
            bits([next.deviation[0], next.deviation[1], 0.02 * next.rate, (next.stamp >> 8) as f32, leaning.moment, leaning.lever])
        };
        let host = [
            STUBS,
            "fn twin() {
            let co = next_swing();
            let record = next_record();
            let variety = next_u();
            let height = next_f();
            let own = swing_own(co, variety, height);
            let plant = TouchPlant(own, record, next_v(), 1e-4, height);
            var staying: Gathered;
            var leaving: Gathered;
            for (var k = 0u; k < 3u; k++) {
                let tilt = next_f();
                let outward = next_v();
                let push = Push(tilt, outward, next_f(), 0.1 * f32(k + 1u), 1.0);
                if tilt > 0.0 && k == 2u { leaving = touch_add(leaving, push, k); }
                if tilt > 0.0 && k < 2u { staying = touch_add(staying, push, k); }
            }
            let next = touch_step(co, plant, staying, leaving, 0.25, 5000u);
            put_v(next.record.deviation);
            put_f(0.02 * next.record.rate);
            put_f(f32(next.record.stamp >> 8u));
            put_f(next.leaning.moment);
            put_f(next.leaning.lever);
        }",
        ]
        .concat();
        // Whether a body holds a plant, and which way round it turns, rounding may decide.
        let tolerance = Tolerance { p999: 1e-4, rms: 2e-2, outlier: 1e-3, share: 5e-4 };
        Twin { name: "touches", library: &library(), host: &host, tables: &[], rust }.check(gpu, By::Absolute(tolerance))
    };
    compare(0.25)?;
    ensure(compare(1.0).is_err(), || "leaving is not found".to_owned())
}

/// Feet, balls that hop and vanish, a box, on hills and among limits of growth, in gusts.
pub(crate) const SWINGS: &str = r#"(version: 1, field: (patch_side: 16), terrain: Image(path: "assets/jacksboro.png", scale: 0.03125),
    stands: [(species: Meadow, cells: 64, response: Oscillator())], wind: [Natural()],
    exclusions: [(area: Road(points: [(-30, 2), (0, 3), (30, -4)], width: 2), soft: 0.8)],
    edits: [(time: 1.5, at: (2, 3), radius: 7, change: Raise(height: 0.4))],
    interactors: [
        (shape: Sphere(radius: 0.8), path: Circle(centre: (0, 2), radius: 3, speed: 3)),
        (shape: Ellipsoid(radii: (0.3, 0.2, 0.6)), path: Keyframes(repeat: true, keys: [(time: 0, at: (2, 6)), (time: 0.5, at: (2, 6), clearance: 0.8),
            (time: 1, at: (4, 6), clearance: 0)])),
        (shape: Box(size: (2, 1, 3)), clearance: 0.1, path: Keyframes(keys: [(time: 0, at: (-6, 3)), (time: 4, at: (6, 8))])),
        (shape: Sphere(radius: 1), path: Still(at: (5, 3)), from: 0.3, until: 1.7777),
    ], camera: (eye: (0, 2, 0), target: (4, 1, 8)), budget: (patches: 9, focus_distance: 14))"#;

/// A ball on level ground without wind: patches wake, and sleep when all is at rest.
const LEVEL: &str = "(version: 1, field: (patch_side: 8), stands: [(species: Lawn, cells: 32, response: Oscillator(damping: 1))],
    interactors: [(shape: Sphere(radius: 0.5), path: Circle(centre: (0, 2), radius: 3, speed: 6), until: 1)])";

fn held(world: &World) -> usize {
    let stand = &world.state.stands[0];
    let now = (world.state.step as u32) << 8;
    let records = stand.awake.values().flat_map(|awake| {
        stand.cells.now[awake.slot as usize].chunks_exact(stand.cells.now[awake.slot as usize].len() / 4).nth(3).into_iter().flatten()
    });
    records.filter(|stamp| stamp.to_bits() & !0xff == now).count()
}

pub(crate) fn run(gpu: &Gpu) -> Verdict {
    Run { name: "swings", scene: SWINGS, shows: |world| world.state.stands[0].counters.resampled > 0 && held(world) > 20 }.check(gpu)?;
    Run { name: "level", scene: LEVEL, shows: |world| world.state.stands[0].counters.slept > 1 }.check(gpu)?;
    // Control: plants one percent stiffer.
    let (mut cpu, mut other) = (world(SWINGS)?, world(SWINGS)?);
    if let Some(oscillator) = &mut other.model.stands[0].oscillator {
        oscillator.coefficients.stiffness *= 1.01;
    }
    Backend::Cpu.run(gpu, &mut cpu, 120)?;
    Backend::on(gpu, &other)?.run(gpu, &mut other, 120)?;
    ensure(agree("one percent stiffer", &cpu, &other, false).is_err(), || "one percent more is not found".to_owned())
}

/// Cost follows what bodies reach: a thousand plants let go add no invocation.
pub(crate) fn released_plants_cost_nothing(gpu: &Gpu) -> Verdict {
    let scene = |until: f64| {
        format!(
            "(version: 1, field: (patch_side: 16), stands: [(species: Meadow, cells: 64, response: Oscillator())],
            interactors: [(shape: Box(size: (12, 1, 12)), path: Still(at: (8, 8)), until: {until})])"
        )
    };
    let mut costs = Vec::new();
    for until in [0.5, 9.0] {
        let mut world = world(&scene(until))?;
        let mut step = sward_wgpu::compute::GpuStep::new(gpu, &world)?;
        for _ in 0..60 {
            step.step(gpu, &mut world)?;
        }
        let before = step.work;
        for _ in 0..30 {
            step.step(gpu, &mut world)?;
        }
        step.wait(gpu, &mut world)?;
        ensure(world.state.stands[0].awake.len() == 1, || "the patch is awake".to_owned())?;
        costs.push((step.work.invocations - before.invocations, step.work.dispatches - before.dispatches));
    }
    println!("30 steps: invocations and dispatches {:?} with plants let go, {:?} with plants held", costs[0], costs[1]);
    ensure(costs[0] == (0, 0), || format!("{:?}", costs[0]))?;
    ensure(costs[1].0 >= 30 * 2304, || format!("{:?}", costs[1]))
}
