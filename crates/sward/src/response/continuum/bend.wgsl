// Direct bending: what a body does to the cell under it. Twin: bend.rs (Chen & Johan eq. 1, 10-12).

struct ContinuumCoefficients {
    base_speed: f32,
    speed_gain: f32,
    speed_cap: f32,
    spread: f32,
    rate_spread: f32,
    damping: f32,
    rate_damping: f32,
    restoring: f32,
    rate_restoring: f32,
    step: f32,
    plant_height: f32,
    turn: f32,
    turn_cosine: f32,
    turn_sine: f32,
    approach: f32,
    unused: f32,
}

struct ContinuumCell {
    bend: vec2<f32>,
    rate: vec2<f32>,
}

/// The strongest push and the highest floor met so far in one cell, and of which contacts they are.
struct ContinuumTouch {
    strongest: f32,
    hit: ContactHit,
    floor: f32,
    deepest: ContactHit,
    pusher: u32,
    deeper: u32,
}

const CONTINUUM_HALF_PI: f32 = 1.5707964;
const CONTINUUM_RATE_LIMIT: f32 = 60.0;
const CONTINUUM_OVER_THE_TOP: f32 = 0.35;
const CONTINUUM_HOLDING: f32 = 1e-4;

fn continuum_length(v: vec2<f32>) -> f32 {
    return sqrt(v.x * v.x + v.y * v.y);
}

fn continuum_scaled_to(v: vec2<f32>, wanted: f32) -> vec2<f32> {
    let now = continuum_length(v);
    if now > 1e-12 {
        return v * (wanted / now);
    }
    return v;
}

fn continuum_bend_limit(slope: vec2<f32>, bend: vec2<f32>) -> f32 {
    let along = (slope.x * bend.x + slope.y * bend.y) / max(continuum_length(bend), 1e-12);
    return clamp(CONTINUUM_HALF_PI - math_atan(along), 0.05, CONTINUUM_HALF_PI);
}

fn continuum_push(co: ContinuumCoefficients, bend: vec2<f32>, hit: ContactHit) -> f32 {
    if hit.speed < CONTINUUM_HOLDING {
        return 0.0;
    }
    let t = clamp(bend.x * hit.direction.x + bend.y * hit.direction.y, -1.57, 1.57);
    return math_atan(math_tan(t) + hit.along * co.step / hit.height) - t;
}

fn continuum_gather(co: ContinuumCoefficients, bend: vec2<f32>, so_far: ContinuumTouch, hit: ContactHit, number: u32) -> ContinuumTouch {
    var touch = so_far;
    let delta = continuum_push(co, bend, hit);
    if !touch.hit.touches || delta > touch.strongest {
        touch.strongest = delta;
        touch.hit = hit;
        touch.pusher = number;
    }
    let floor_ = contact_floor(hit);
    if !touch.deepest.touches || floor_ > touch.floor {
        touch.floor = floor_;
        touch.deepest = hit;
        touch.deeper = number;
    }
    return touch;
}

fn continuum_turned(co: ContinuumCoefficients, bend: vec2<f32>, direction: vec2<f32>) -> vec2<f32> {
    let size = continuum_length(bend);
    if bend.x * direction.x + bend.y * direction.y >= size * co.turn_cosine {
        return direction * size;
    }
    let cross_ = bend.x * direction.y - bend.y * direction.x;
    let sine = select(-co.turn_sine, co.turn_sine, cross_ >= 0.0);
    return vec2<f32>(bend.x * co.turn_cosine - bend.y * sine, bend.x * sine + bend.y * co.turn_cosine);
}

fn continuum_driven(co: ContinuumCoefficients, bend: vec2<f32>, hit: ContactHit, delta: f32, slope: vec2<f32>) -> ContinuumCell {
    let d = hit.direction;
    let moved = bend + delta * d;
    var rate = d * delta / co.step;
    var next = moved;
    if bend.x * d.x + bend.y * d.y >= 0.0 {
        next = continuum_scaled_to(moved, max(continuum_length(moved), continuum_length(bend)));
    } else if continuum_length(bend) >= CONTINUUM_OVER_THE_TOP {
        next = continuum_turned(co, bend, d);
        rate = (next - bend) / co.step;
    }
    let limit = continuum_bend_limit(slope, next);
    if continuum_length(next) > limit {
        next = continuum_scaled_to(next, limit);
    }
    if continuum_length(rate) > CONTINUUM_RATE_LIMIT {
        rate = continuum_scaled_to(rate, CONTINUUM_RATE_LIMIT);
    }
    return ContinuumCell(next, rate);
}

fn continuum_floored(co: ContinuumCoefficients, bend: vec2<f32>, touch: ContinuumTouch, slope: vec2<f32>) -> vec2<f32> {
    let size = continuum_length(bend);
    var along = touch.deepest.normal;
    if size >= 1e-3 {
        along = bend / size;
    }
    let lowest = min(continuum_bend_limit(slope, along), touch.floor);
    if size >= lowest {
        return bend;
    }
    return along * min(lowest, size + co.approach);
}

/// The cell after contact; only for a touch whose `hit.touches`.
fn continuum_contact(co: ContinuumCoefficients, bend: vec2<f32>, touch: ContinuumTouch, slope: vec2<f32>) -> ContinuumCell {
    var held = ContinuumCell(bend, vec2<f32>(0.0));
    if touch.hit.speed >= CONTINUUM_HOLDING {
        held = continuum_driven(co, bend, touch.hit, touch.strongest, slope);
    }
    held.bend = continuum_floored(co, held.bend, touch, slope);
    return held;
}

/// Which contact bends the cell, and how high it touches it.
fn continuum_by(touch: ContinuumTouch) -> u32 {
    return select(touch.deeper, touch.pusher, touch.strongest > 0.0);
}

fn continuum_height(touch: ContinuumTouch) -> f32 {
    return select(touch.deepest.height, touch.hit.height, touch.strongest > 0.0);
}
