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
const SWING_FREE: u32 = 128u;
const SWING_FULL_TURN: f32 = 127.0;

struct SwingOwn {
    omega_squared: f32,
    gamma: f32,
}

struct SwingRecord {
    deviation: vec2<f32>,
    rate: f32,
    stamp: u32, // 24 bits of the step's number, then SWING_FREE or how far a body turned it in that step
}

fn swing_own(co: OscillatorCoefficients, variety: u32, height: f32) -> SwingOwn {
    let halves = vec2<f32>(vec2<u32>(variety & 0xffffu, variety >> 16u)) * (1.0 / 32768.0) - 1.0;
    let k = co.stiffness * (1.0 + co.spreads.x * halves.x);
    let b = co.damping * (1.0 + co.spreads.y * halves.y);
    let length_ = max(co.scale * height, 1e-4);
    let over = 1.0 / length_;
    return SwingOwn((k - SWING_GRAVITY) * over, 0.5 * b * over);
}

fn swing_length(v: vec2<f32>) -> f32 {
    return sqrt(v.x * v.x + v.y * v.y);
}

fn swing_stamp_held(now: u32, turn: f32) -> u32 {
    let parts = i32(floor(math_clamped(turn, -1.0, 1.0) * SWING_FULL_TURN + 0.5));
    return (now << 8u) | (bitcast<u32>(parts) & 0xffu);
}

fn swing_is_held(record: SwingRecord) -> bool {
    return (record.stamp & 0xffu) != SWING_FREE;
}

fn swing_steps_to(record: SwingRecord, now: u32) -> i32 {
    return bitcast<i32>((now << 8u) - (record.stamp & 0xffffff00u)) >> 8u;
}

fn swing_is_aged(co: OscillatorCoefficients, record: SwingRecord, now: u32) -> bool {
    return bitcast<u32>(swing_steps_to(record, now)) > co.settle;
}

fn swing_own_rate(own: SwingOwn, record: SwingRecord, size: f32) -> f32 {
    if !swing_is_held(record) {
        return record.rate;
    }
    let frequency = sqrt(own.omega_squared);
    return math_clamped(record.rate, -frequency * size, frequency * (SWING_HALF_PI - size));
}

// Deviation `behind` steps before step `now`
fn swing_at(co: OscillatorCoefficients, own: SwingOwn, record: SwingRecord, now: u32, behind: f32) -> vec2<f32> {
    let size = swing_length(record.deviation);
    let steps = f32(swing_steps_to(record, now)) - behind;
    let scale = 1.0 / max(size, SWING_SHORTEST);
    if steps >= 0.0 {
        let free = oscillation_advance(size, swing_own_rate(own, record, size), own.gamma, own.omega_squared, steps * co.dt).x;
        return record.deviation * free * scale;
    }
    let share = max(size + record.rate * steps * co.dt, 0.0) * scale;
    var turn = 0.0;
    if swing_is_held(record) {
        turn = f32(bitcast<i32>(record.stamp << 24u) >> 24u) * (co.pace / SWING_FULL_TURN);
    }
    let turned = math_sin_cos(turn * steps);
    let d = record.deviation;
    return share * vec2<f32>(turned.y * d.x - turned.x * d.y, turned.x * d.x + turned.y * d.y);
}

// How fast the deviation changes at step `now`
fn swing_rate_at(co: OscillatorCoefficients, own: SwingOwn, record: SwingRecord, now: u32) -> vec2<f32> {
    let size = swing_length(record.deviation);
    let steps = max(f32(swing_steps_to(record, now)), 0.0);
    var rate = record.rate;
    if steps > 0.0 {
        rate = oscillation_advance(size, swing_own_rate(own, record, size), own.gamma, own.omega_squared, steps * co.dt).y;
    }
    return record.deviation * (rate / max(size, SWING_SHORTEST));
}

// The same motion `seconds` after it was let go, as of step `now`
fn swing_later(own: SwingOwn, record: SwingRecord, seconds: f32, now: u32) -> SwingRecord {
    let size = max(swing_length(record.deviation), SWING_SHORTEST);
    let moved = oscillation_advance(size, swing_own_rate(own, record, size), own.gamma, own.omega_squared, seconds);
    let turned = select(1.0, -1.0, moved.x < 0.0);
    let share = turned * max(turned * moved.x, SWING_SHORTEST) / size;
    return SwingRecord(record.deviation * share, turned * moved.y, (now << 8u) | SWING_FREE);
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
