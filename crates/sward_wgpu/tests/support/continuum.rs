//! Twins of the continuum kernels: bend, propagate, limit, fade, rest and lags.

use sward::interaction::{self, Hit};
use sward::lanes::Scalar;
use sward::math;
use sward::response::continuum::{
    Coefficients, LagCoefficients, Rest, Rows, WGSL, bends, cascade, contact, deviation, fade_row, from_history, limit_row, look_up_offset,
    rates,
};
use sward::scene::Species;
use sward_wgpu::compare::Tolerance;
use sward_wgpu::gpu::Gpu;

use crate::adapter::Verdict;
use crate::kernels::{By, Random, Twin, bits};
use crate::maths::ROUNDING;

fn library() -> Vec<&'static str> {
    let mut library = vec![math::WGSL, interaction::WGSL];
    library.extend(WGSL);
    library
}

/// What the library asks of its host; none of it is called here.
const UNUSED: &str = "
fn contact_edge(index: u32) -> ContactEdge { return ContactEdge(); }
fn rest_node(index: u32) -> vec2<f32> { return vec2<f32>(0.0); }
";

fn coefficients(species: Species) -> Coefficients {
    Coefficients::new(&species.continuum(), 1.0 / 60.0, 0.25, 0.4).0
}

fn unit_vector(random: &mut Random) -> [f32; 2] {
    let (sine, cosine) = math::sin_cos(random.drawn(-3.2, 3.2));
    [random.put(cosine), random.put(sine)]
}

fn hit(random: &mut Random) -> Hit {
    let fast = random.bits().is_multiple_of(8);
    Hit {
        speed: if fast { random.float(0.0, 1e-4) } else { random.float(0.01, 30.0) },
        direction: unit_vector(random),
        along: random.float(0.0, 30.0),
        height: random.float(0.02, 0.24),
        normal: unit_vector(random),
        depth: random.float(0.0, 1.2),
    }
}

/// Two bodies on one cell of sloping ground. Which case of a push applies, and which body's push wins, are comparisons that a rounding
/// may turn; rates are Δ/Δt, sixty times as coarse as bends.
pub(crate) fn bend(gpu: &Gpu) -> Verdict {
    let co = coefficients(Species::Meadow);
    let rust = |n: u32, input: &mut Vec<u32>| {
        let mut random = Random::new(n);
        let bend = [random.float(-1.1, 1.1), random.float(-1.1, 1.1)];
        let slope = [random.float(-0.8, 0.8), random.float(-0.8, 0.8)];
        let hits = [hit(&mut random), hit(&mut random)];
        input.extend(random.words);
        let held = contact(&co, bend, slope, &hits);
        held.map_or_else(Vec::new, |held| bits([held.bend[0], held.bend[1], held.rate[0] / 60.0, held.rate[1] / 60.0]))
    };
    let host = format!(
        "{UNUSED}
    @group(0) @binding(2) var<storage, read> co: ContinuumCoefficients;
    fn next_hit() -> ContactHit {{
        var hit: ContactHit;
        hit.touches = true;
        hit.speed = next_f();
        hit.direction = next_v();
        hit.along = next_f();
        hit.height = next_f();
        hit.normal = next_v();
        hit.depth = next_f();
        return hit;
    }}
    fn twin() {{
        let bend = next_v();
        let slope = next_v();
        var touch: ContinuumTouch;
        touch = continuum_gather(co, bend, touch, next_hit(), 0u);
        touch = continuum_gather(co, bend, touch, next_hit(), 1u);
        let held = continuum_contact(co, bend, touch, slope);
        put_v(held.bend);
        put_v(held.rate / 60.0);
    }}"
    );
    let tables: &[&[u8]] = &[bytemuck::bytes_of(&co)];
    let tolerance = Tolerance { p999: 1e-5, rms: 2e-3, outlier: 1e-4, share: 1e-4 };
    Twin { name: "bend", library: &library(), host: &host, tables, rust }.check(gpu, By::Absolute(tolerance))
}

/// One cell of the wave: next state of bends up to 1.1 rad and rates up to 8 rad/s, of which the rates are the coarser.
pub(crate) fn propagate(gpu: &Gpu) -> Verdict {
    let co = coefficients(Species::Reed);
    let rust = |n: u32, input: &mut Vec<u32>| {
        let mut random = Random::new(n);
        // The cell now, before, and its neighbours along −x, +x, −z, +z.
        let cells =
            [0; 6].map(|_: u32| [random.float(-1.1, 1.1), random.float(-1.1, 1.1), random.float(-8.0, 8.0), random.float(-8.0, 8.0)]);
        let rest = [random.float(-0.3, 0.3), random.float(-0.3, 0.3)];
        input.extend(random.words);
        let [now, old, left, right, before, after] = cells;
        let middle = [0, 1, 2, 3].map(|k| [left[k], now[k], right[k]]);
        let around = |x: usize, z: usize| Rows {
            before: [&before[x..=x], &before[z..=z]],
            middle: [&middle[x], &middle[z]],
            after: [&after[x..=x], &after[z..=z]],
        };
        let [mut a, mut b, mut c, mut d] = old.map(|value| [value]);
        let ([mut keep, mut spread], mut square) = ([[0.0]; 2], [0]);
        rates(Scalar, &co, &around(2, 3), [&mut c, &mut d], [&mut keep, &mut spread], &mut square);
        bends(Scalar, &co, &around(0, 1), [&rest[..1], &rest[1..]], [&keep, &spread], [&mut a, &mut b], &mut square);
        bits([a[0], b[0], c[0], d[0]])
    };
    let host = format!(
        "{UNUSED}
    @group(0) @binding(2) var<storage, read> co: ContinuumCoefficients;
    fn next_cell() -> ContinuumCell {{
        let bend = next_v();
        return ContinuumCell(bend, next_v());
    }}
    fn twin() {{
        let present = next_cell();
        let old = next_cell();
        let left = next_cell();
        let right = next_cell();
        let before = next_cell();
        let after = next_cell();
        let around = ContinuumCell((left.bend + right.bend) + (before.bend + after.bend), (left.rate + right.rate) + (before.rate + after.rate));
        let next = continuum_propagate(co, present, old, around, next_v());
        put_v(next.bend);
        put_v(next.rate);
    }}"
    );
    let tables: &[&[u8]] = &[bytemuck::bytes_of(&co)];
    let tolerance = Tolerance { p999: 6e-6, rms: 1e-6, outlier: 1e-5, share: 0.0 };
    Twin { name: "propagate", library: &library(), host: &host, tables, rust }.check(gpu, By::Absolute(tolerance))
}

/// Limits on slopes, fading, and the deviation that sleep goes by (squared, so relative to its size).
pub(crate) fn limit(gpu: &Gpu) -> Verdict {
    let rust = |n: u32, input: &mut Vec<u32>| {
        let mut random = Random::new(n);
        let cell = [random.float(-2.0, 2.0), random.float(-2.0, 2.0), random.float(-80.0, 80.0), random.float(-80.0, 80.0)];
        let slope = [random.float(-2.0, 2.0), random.float(-2.0, 2.0)];
        let rest = [random.float(-0.3, 0.3), random.float(-0.3, 0.3)];
        let keep = random.float(0.0, 1.0);
        input.extend(random.words);
        let [mut a, mut b, mut c, mut d] = cell.map(|value| [value]);
        let mut next = [&mut a[..], &mut b[..], &mut c[..], &mut d[..]];
        limit_row(&mut next, [&slope[..1], &slope[1..]], &[]);
        fade_row(&mut next, [&rest[..1], &rest[1..]], keep);
        bits([a[0], b[0], c[0], d[0], deviation([a[0], b[0], c[0], d[0]], rest)])
    };
    let host = format!(
        "{UNUSED}
    fn twin() {{
        let bend = next_v();
        let cell = ContinuumCell(bend, next_v());
        let limited = continuum_limited(cell, next_v());
        let rest = next_v();
        let next = continuum_faded(limited.cell, rest, next_f());
        put_v(next.bend);
        put_v(next.rate);
        put_f(continuum_deviation(next, rest));
    }}"
    );
    Twin { name: "limit", library: &library(), host: &host, tables: &[], rust }.check(gpu, By::Relative(ROUNDING, 1.0))
}

/// Which cells count as limited; some of their numbers are none, and those are over no limit.
pub(crate) fn limited(gpu: &Gpu) -> Verdict {
    let rust = |n: u32, input: &mut Vec<u32>| {
        let mut random = Random::new(n);
        let gap = random.bits() % 8;
        let mut number = |k: u32, most: f32| {
            let value = random.drawn(-most, most);
            random.put(if k == gap { f32::NAN } else { value })
        };
        let cell = [number(0, 1.4), number(1, 1.4), number(2, 60.0), number(3, 60.0)];
        input.extend(random.words);
        let [mut a, mut b, mut c, mut d] = cell.map(|value| [value]);
        vec![limit_row(&mut [&mut a[..], &mut b[..], &mut c[..], &mut d[..]], [&[], &[]], &[])]
    };
    let host = format!(
        "{UNUSED}
    fn twin() {{
        let bend = next_v();
        put_u(u32(continuum_limited(ContinuumCell(bend, next_v()), vec2<f32>(0.0)).clamped));
    }}"
    );
    Twin { name: "limited", library: &library(), host: &host, tables: &[], rust }.check(gpu, By::Bits)
}

/// β_eq between nodes, halo cells included.
pub(crate) fn rest(gpu: &Gpu) -> Verdict {
    let mut random = Random::new(u32::MAX);
    let values: Vec<[f32; 2]> = (0..35 * 35).map(|_| [random.drawn(-0.6, 0.6), random.drawn(-0.6, 0.6)]).collect();
    let field = Rest::Nodes { width: 35, values: values.clone() };
    let rust = |n: u32, input: &mut Vec<u32>| {
        let mut random = Random::new(n);
        let (i, j) = (random.whole(-1, 65), random.whole(-1, 65));
        input.extend(random.words);
        bits(field.at(i, j))
    };
    let host = "
    @group(0) @binding(2) var<storage, read> nodes: array<vec2<f32>>;
    fn rest_node(index: u32) -> vec2<f32> { return nodes[index]; }
    fn contact_edge(index: u32) -> ContactEdge { return ContactEdge(); }
    fn twin() { put_v(rest_at(0u, 35u, next_w())); }";
    let tables: &[&[u8]] = &[bytemuck::cast_slice(&values)];
    Twin { name: "rest", library: &library(), host, tables, rust }.check(gpu, By::Absolute(ROUNDING))
}

/// One segment of the cascade, the ring places of `history`, and how far the look-up reaches. Whether a plant recovers is a
/// comparison of two squares that a rounding may turn.
pub(crate) fn lags(gpu: &Gpu) -> Verdict {
    let species = Species::Reed.continuum();
    let history = sward::scene::Continuum { lag: sward::scene::Lag::History, ..species };
    let lag = LagCoefficients::new(&history, 2, 1.0 / 60.0);
    let rust = |n: u32, input: &mut Vec<u32>| {
        let mut random = Random::new(n);
        let (below, here) = ([random.float(-1.1, 1.1), random.float(-1.1, 1.1)], [random.float(-1.1, 1.1), random.float(-1.1, 1.1)]);
        let still = random.bits().is_multiple_of(8);
        let top = if still { 2e-3 } else { 20.0 };
        let rate = [random.float(-top, top), random.float(-top, top)];
        let speed = random.float(0.5, 10.0);
        input.extend(random.words);
        let mut upper = here;
        cascade(&lag, [&below[..1], &below[1..]], &mut upper);
        // The ring holds its own places: the answer says which one was taken.
        let top = from_history(&lag, 1, |back| [if back == 0 { 1e9 } else { 0.0 } + back as f32, 0.0]);
        let recover = from_history(&lag, 1, |back| [back as f32, 0.0]);
        let [x, z] = look_up_offset(&lag, 1, below, rate, speed);
        bits([upper[0], upper[1], top[0], recover[0], x, z])
    };
    let host = format!(
        "{UNUSED}
    @group(0) @binding(2) var<storage, read> lag: LagCoefficients;
    fn twin() {{
        let below = next_v();
        put_v(lag_cascade(lag, below, next_v()));
        put_f(f32(lag_steps(lag, 1u, lag.gamma_top)));
        put_f(f32(lag_steps(lag, 1u, lag.gamma_recover)));
        let rate = next_v();
        put_v(lag_look_up_offset(lag, 1u, below, rate, next_f()));
    }}"
    );
    let tables: &[&[u8]] = &[bytemuck::bytes_of(&lag)];
    let tolerance = Tolerance { p999: 2e-6, rms: 1e-2, outlier: 1e-5, share: 2e-5 };
    Twin { name: "lag", library: &library(), host: &host, tables, rust }.check(gpu, By::Absolute(tolerance))
}
