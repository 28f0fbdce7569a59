//! Chains: the oscillator in closed form, one step of a blade, its joints, and the blade without a state.

use sward::math;
use sward::response::chain::{self, Blade, ChainCoefficients, ChainState, DragLaw, calibrate};
use sward::response::oscillation;
use sward_wgpu::compare::Tolerance;
use sward_wgpu::gpu::Gpu;

use crate::adapter::{Verdict, ensure};
use crate::kernels::{By, Random, Twin, bits};

/// All cases of damping, as shares of what they are.
pub(crate) fn oscillations(gpu: &Gpu) -> Verdict {
    let rust = |n: u32, input: &mut Vec<u32>| {
        let mut random = Random::new(n);
        let (x, v) = (random.float(-2.0, 2.0), random.float(-30.0, 30.0));
        let frequency = random.drawn(0.3, 60.0);
        let gamma = random.put(frequency * [0.0, 0.1, 0.9, 1.0, 1.1, 30.0][n as usize % 6]);
        let omega_squared = random.put(frequency * frequency);
        let answer = oscillation::advance(x, v, gamma, omega_squared, random.float(0.001, 0.1));
        input.extend(random.words);
        bits(answer)
    };
    let host = "fn twin() {
        let x = next_f();
        let v = next_f();
        let gamma = next_f();
        let omega_squared = next_f();
        put_v(oscillation_advance(x, v, gamma, omega_squared, next_f()));
    }";
    let tolerance = Tolerance { p999: 5e-5, rms: 5e-5, outlier: 1e-3, share: 1e-4 };
    let library = &[math::WGSL, oscillation::WGSL];
    Twin { name: "oscillation", library, host, tables: &[], rust }.check(gpu, By::Relative(tolerance, 1.0))
}

/// A blade of any species, or one of its own.
fn blade(random: &mut Random) -> ChainCoefficients {
    let species = [
        (2, 0.0125, 1.25e-5, [4.4e-5, 3.1e-5], 0.25, 1.5e-5),
        (4, 0.05, 1.12e-4, [6e-3, 3.3e-3], 0.15, 1.6e-4),
        (7, 0.0857, 4.3e-4, [0.20, 0.099], 0.10, 9e-4),
        (3, 0.05, 2e-4, [1.6e-2, 9.6e-3], 0.20, 5e-4),
    ];
    let (segments, half_length, mass, [root, tip], damping_ratio, drag) = species[(random.bits() % 4) as usize];
    let vary = f64::from(random.drawn(1.0, 1.3));
    let law = [DragLaw::Linear, DragLaw::FourThirds, DragLaw::FiveThirds, DragLaw::Square][(random.bits() % 4) as usize];
    let blade = Blade {
        segments,
        half_length,
        mass,
        stiffness_root: root * vary,
        stiffness_tip: tip * vary,
        damping_ratio,
        drag,
        law,
        frequency: None,
    };
    calibrate(&blade).expect("it stands")
}

const COEFFICIENTS: &str = "
fn next_blade() -> ChainCoefficients {
    var co: ChainCoefficients;
    co.segments = next_u();
    co.drag_thirds = next_u();
    co.half_length = next_f();
    co.weight = next_f();
    co.drag = next_f();
    in_at += 3u;
    for (var i = 0u; i < 8u; i++) {
        let stiffness = next_f();
        let inertia = next_f();
        let damping = next_f();
        co.joints[i] = ChainJoint(stiffness, inertia, damping, next_f());
    }
    return co;
}
fn next_state() -> ChainState {
    var state: ChainState;
    for (var i = 0u; i < 8u; i++) {
        let bend = next_v();
        state.joints[i] = vec4<f32>(bend, next_v());
    }
    return state;
}
fn put_state(state: ChainState) {
    for (var i = 0u; i < 8u; i++) {
        put_v(state.joints[i].xy);
        put_v(0.1 * state.joints[i].zw);
    }
}
";

/// One step in any wind, and the joints after it. Control: one percent more wind.
pub(crate) fn steps(gpu: &Gpu) -> Verdict {
    let compare = |more: f32| {
        let rust = |n: u32, input: &mut Vec<u32>| {
            let mut random = Random::new(n);
            let co = blade(&mut random);
            input.extend_from_slice(bytemuck::cast_slice(bytemuck::bytes_of(&co)));
            let mut state = ChainState::default();
            for (i, joint) in state.joints.iter_mut().enumerate() {
                let there = if i < co.segments as usize { 1.0 } else { 0.0 };
                *joint = [1.0, 1.0, 8.0, 8.0].map(|most: f32| random.drawn(-most, most) * there);
            }
            input.extend_from_slice(bytemuck::cast_slice(bytemuck::bytes_of(&state)));
            let (yaw, tilt) = (random.float(0.0, std::f32::consts::TAU), random.float(0.0, 0.5));
            let wind = [random.drawn(-20.0, 20.0), random.drawn(-2.0, 2.0), random.drawn(-20.0, 20.0)];
            wind.iter().for_each(|along| {
                random.put(*along);
            });
            input.extend(random.words);
            let base = chain::planted(yaw, tilt);
            let next = chain::step(&co, &base, 2.0 * tilt, wind.map(|along| along * more), 1.0 / 60.0, &state);
            let joints = chain::joints(&base, 2.0 * tilt, &co, &next.bends());
            let scaled = next.joints.map(|[x, z, fast_x, fast_z]| [x, z, 0.1 * fast_x, 0.1 * fast_z]);
            bits([scaled.as_flattened(), joints.as_flattened()].concat())
        };
        let host = [
            COEFFICIENTS,
            "fn twin() {
                let co = next_blade();
                let state = next_state();
                let yaw = next_f();
                let tilt = next_f();
                let base = chain_planted(yaw, tilt);
                let level = next_v();
                let next = chain_step(co, base, 2.0 * tilt, vec3<f32>(level, next_f()), 1.0 / 60.0, state);
                put_state(next);
                var places = chain_joints(co, base, 2.0 * tilt, next);
                for (var k = 0u; k < 9u; k++) { put_v(places[k].xy); put_f(places[k].z); }
            }",
        ]
        .concat();
        let tolerance = Tolerance { p999: 2e-4, rms: 1e-4, outlier: 2e-3, share: 1e-4 };
        let library = &[math::WGSL, oscillation::WGSL, chain::WGSL[0], chain::WGSL[1]];
        Twin { name: "chain", library, host: &host, tables: &[], rust }.check(gpu, By::Absolute(tolerance))
    };
    compare(1.0)?;
    ensure(compare(1.01).is_err(), || "one percent more wind is not found".to_owned())
}

/// Moments of a virtual blade, turned into a planted one's frame, and how they hold it. Control: planted one percent more slanted.
pub(crate) fn poses(gpu: &Gpu) -> Verdict {
    poses_of(gpu, 1.0)?;
    ensure(poses_of(gpu, 1.01).is_err(), || "one percent more slant is not found".to_owned())
}

fn poses_of(gpu: &Gpu, more: f32) -> Verdict {
    let rust = |n: u32, input: &mut Vec<u32>| {
        let mut random = Random::new(n);
        let co = blade(&mut random);
        input.extend_from_slice(bytemuck::cast_slice(bytemuck::bytes_of(&co)));
        let mut state = ChainState::default();
        for joint in state.joints.iter_mut().take(co.segments as usize) {
            (joint[0], joint[1]) = (random.drawn(-0.6, 0.6), random.drawn(-0.6, 0.6));
        }
        input.extend_from_slice(bytemuck::cast_slice(bytemuck::bytes_of(&state)));
        let (yaw, tilt) = (random.float(0.0, std::f32::consts::TAU), random.float(0.0, 0.4));
        input.extend(random.words);
        let base = chain::planted(yaw, tilt * more);
        let moments = chain::moments(&co, &chain::UPRIGHT, &state.bends()).map(|moment| chain::turned(&base, &chain::UPRIGHT, moment));
        let pose = chain::pose(&co, &base, 3.0 * tilt, &moments);
        bits(pose.as_flattened().to_vec())
    };
    let host = [
        COEFFICIENTS,
        "fn twin() {
            let co = next_blade();
            let state = next_state();
            let yaw = next_f();
            let tilt = next_f();
                let base = chain_planted(yaw, tilt);
            let upright = chain_planted(0.0, 0.0);
            var moments = virtual_inertia_moments(co, upright, state);
            for (var i = 0u; i < 8u; i++) { moments[i] = virtual_inertia_turned(base, upright, moments[i]); }
            let pose = virtual_inertia_pose(co, base, 3.0 * tilt, moments);
            for (var i = 0u; i < 8u; i++) { put_v(pose.joints[i].xy); }
        }",
    ]
    .concat();
    let tolerance = Tolerance { p999: 2e-5, rms: 1e-5, outlier: 1e-3, share: 1e-4 };
    let library = &[math::WGSL, oscillation::WGSL, chain::WGSL[0], chain::WGSL[1]];
    Twin { name: "virtual inertia", library, host: &host, tables: &[], rust }.check(gpu, By::Absolute(tolerance))
}
