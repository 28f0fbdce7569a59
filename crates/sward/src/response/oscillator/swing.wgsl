// Where a plant that swings by itself is at a time. Twin: swing.rs, where everything is explained. Needs oscillation.wgsl.

struct OscillatorCoefficients {
    stiffness: f32,
    damping: f32,
    scale: f32,
    curve: f32,
    spreads: vec2<f32>,
    dt: f32,
    wind: f32,
    follow: f32,
    pace: f32,
    settle: u32,
    texels: u32,
}

const SWING_GRAVITY: f32 = 9.81;
const SWING_HALF_PI: f32 = 1.5707964;
const SWING_SHORTEST: f32 = 1e-6;

struct SwingOwn {
    omega_squared: f32,
    gamma: f32,
}

struct SwingRecord {
    deviation: vec2<f32>,
    rate: f32,
    step: u32,
}

fn swing_own(co: OscillatorCoefficients, variety: u32, height: f32) -> SwingOwn {
    let halves = vec2<f32>(vec2<u32>(variety & 0xffffu, variety >> 16u)) * (1.0 / 32768.0) - 1.0;
    let k = co.stiffness * (1.0 + co.spreads.x * halves.x);
    let b = co.damping * (1.0 + co.spreads.y * halves.y);
    let length_ = max(co.scale * height, 1e-4);
    return SwingOwn((k - SWING_GRAVITY) / length_, b / (2.0 * length_));
}

fn swing_length(v: vec2<f32>) -> f32 {
    return sqrt(v.x * v.x + v.y * v.y);
}

// Deviation `behind` steps before step `now`
fn swing_at(co: OscillatorCoefficients, own: SwingOwn, record: SwingRecord, now: u32, behind: f32) -> vec2<f32> {
    let size = swing_length(record.deviation);
    let tau = (f32(bitcast<i32>(now - record.step)) - behind) * co.dt;
    var theta = size + record.rate * tau;
    if tau >= 0.0 {
        theta = oscillation_advance(size, record.rate, own.gamma, own.omega_squared, tau).x;
    }
    return record.deviation * (theta / max(size, SWING_SHORTEST));
}

// The same motion `seconds` later, as of step `now`
fn swing_later(own: SwingOwn, record: SwingRecord, seconds: f32, now: u32) -> SwingRecord {
    let size = max(swing_length(record.deviation), SWING_SHORTEST);
    let moved = oscillation_advance(size, record.rate, own.gamma, own.omega_squared, seconds);
    let turned = select(1.0, -1.0, moved.x < 0.0);
    let share = turned * max(turned * moved.x, SWING_SHORTEST) / size;
    return SwingRecord(record.deviation * share, turned * moved.y, now);
}

fn swing_limited(bend: vec2<f32>) -> vec2<f32> {
    let size = swing_length(bend);
    return bend * select(1.0, SWING_HALF_PI / size, size > SWING_HALF_PI);
}

fn swing_curved(curve: f32, bend: vec2<f32>, segment: u32, segments: u32) -> vec2<f32> {
    let size = max(swing_length(bend), SWING_SHORTEST);
    let turned = math_sin_cos(size);
    let place = (2.0 * f32(segment) + 1.0) / f32(segments) - 1.0;
    return bend * (1.0 + curve * turned.x * turned.y * place / size);
}
