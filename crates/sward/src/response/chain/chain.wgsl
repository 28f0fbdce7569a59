// One step of one blade as the simplified chain. Twin: joint.rs and frame.rs, where each function is documented.

struct ChainJoint {
    stiffness: f32,
    inertia: f32,
    damping: f32,
    reach: f32,
}

struct ChainCoefficients {
    segments: u32,
    drag_thirds: u32,
    half_length: f32,
    weight: f32,
    drag: f32,
    unused_0: f32,
    unused_1: f32,
    unused_2: f32,
    joints: array<ChainJoint, 8>,
}

// Per joint: bend (x, y) [rad], rate (x, y) [rad/s]
struct ChainState {
    joints: array<vec4<f32>, 8>,
}

struct ChainLoad {
    moment: vec2<f32>,
    stiffness: f32,
    damping: f32,
}

const CHAIN_MOST_SEGMENTS: u32 = 8u;
const CHAIN_BEND_LIMIT: f32 = 2.0;
const CHAIN_RATE_LIMIT: f32 = 60.0;
const CHAIN_LEAST_STIFFNESS: f32 = 0.05;

fn chain_planted(yaw: f32, tilt: f32) -> mat3x3<f32> {
    let y = math_sin_cos(yaw);
    let t = math_sin_cos(tilt);
    return mat3x3<f32>(
        vec3<f32>(y.y * t.y, -t.x, y.x * t.y),
        vec3<f32>(y.x, 0.0, -y.y),
        vec3<f32>(y.y * t.x, t.y, y.x * t.x),
    );
}

fn chain_rotation(bend: vec2<f32>) -> mat3x3<f32> {
    let a = bend.x;
    let b = bend.y;
    let angle = math_upper(sqrt(a * a + b * b), 1e-9);
    let half = math_sin_cos(0.5 * angle);
    let sine = half.x / angle;
    let s = 2.0 * sine * half.y;
    let c = 2.0 * sine * sine;
    return mat3x3<f32>(
        vec3<f32>(1.0 - c * b * b, c * a * b, -s * b),
        vec3<f32>(c * a * b, 1.0 - c * a * a, s * a),
        vec3<f32>(s * b, -s * a, 1.0 - c * (a * a + b * b)),
    );
}

// The rotation vector that brings z to a unit `direction`
fn chain_bend_towards(direction: vec3<f32>) -> vec2<f32> {
    let across = sqrt(direction.x * direction.x + direction.y * direction.y);
    return math_atan2(across, direction.z) / math_upper(across, 1e-9) * vec2<f32>(-direction.y, direction.x);
}

fn chain_raised(speed: f32, thirds: u32) -> f32 {
    let root = math_cbrt(speed);
    let low = select(root, 1.0, thirds == 0u);
    let high = select(speed, root * root, thirds == 2u);
    return select(high, low, thirds < 2u);
}

fn chain_load(co: ChainCoefficients, reach: f32, frame: mat3x3<f32>, air: vec3<f32>) -> ChainLoad {
    let speed = sqrt(air.x * air.x + air.y * air.y + air.z * air.z);
    let rise = co.drag * chain_raised(speed, co.drag_thirds);
    // A row vector times a matrix: the force along each of the frame's axes.
    let force = (rise * air - vec3<f32>(0.0, co.weight, 0.0)) * frame;
    let l = co.half_length;
    let power = 1.0 + f32(co.drag_thirds) * (1.0 / 3.0);
    let stiffness = l * (rise * speed - co.weight * frame[2].y);
    return ChainLoad(vec2<f32>(-l * force.y, l * force.x), stiffness, l * l * rise * power * reach);
}

fn chain_stopped(joint: vec4<f32>) -> vec4<f32> {
    var bend = joint.xy;
    var rate = joint.zw;
    let size = sqrt(bend.x * bend.x + bend.y * bend.y);
    if size > CHAIN_BEND_LIMIT {
        let along = bend / size;
        bend = CHAIN_BEND_LIMIT * along;
        rate = rate - math_upper(rate.x * along.x + rate.y * along.y, 0.0) * along;
    }
    let fast = sqrt(rate.x * rate.x + rate.y * rate.y);
    rate = rate * select(1.0, CHAIN_RATE_LIMIT / fast, fast > CHAIN_RATE_LIMIT);
    return vec4<f32>(bend, rate);
}

fn chain_swung(joint: ChainJoint, load: ChainLoad, dt: f32, state: vec4<f32>) -> vec4<f32> {
    let stiffness = math_upper(joint.stiffness + load.stiffness, CHAIN_LEAST_STIFFNESS * joint.stiffness);
    let damping = joint.damping + load.damping;
    let t = oscillation_transition(0.5 * damping / joint.inertia, stiffness / joint.inertia, dt);
    let wanted = (joint.stiffness * state.xy - load.moment - load.damping * state.zw) / stiffness;
    let away = vec2<f32>(math_clamped(wanted.x, -1e9, 1e9), math_clamped(wanted.y, -1e9, 1e9));
    return chain_stopped(vec4<f32>(state.xy - away + t.x * away + t.y * state.zw, t.z * away + t.w * state.zw));
}

// By how much joint i is turned at rest where a blade curls
fn chain_rest_turn(segments: u32, curl: f32, i: u32) -> vec2<f32> {
    let n = f32(segments);
    return vec2<f32>(0.0, curl * select(2.0 * f32(i), 0.25, i == 0u) / (n * n));
}

fn chain_step(blade: ChainCoefficients, base: mat3x3<f32>, curl: f32, wind: vec3<f32>, dt: f32, state: ChainState) -> ChainState {
    var co = blade;
    var next = state;
    var frame = base;
    var spin = vec3<f32>(0.0);
    var end = vec3<f32>(0.0);
    for (var i = 0u; i < min(co.segments, CHAIN_MOST_SEGMENTS); i++) {
        let joint = next.joints[i];
        let turn = chain_rotation(joint.xy + chain_rest_turn(co.segments, curl, i));
        frame = frame * turn;
        spin = spin * turn + vec3<f32>(joint.zw, 0.0);
        let centre = frame * vec3<f32>(spin.y * co.half_length, -spin.x * co.half_length, 0.0);
        let reach = co.joints[i].reach;
        let load = chain_load(co, reach, frame, wind - reach * (end + centre));
        end = end + 2.0 * centre;
        next.joints[i] = chain_swung(co.joints[i], load, dt, joint);
    }
    return next;
}

// Joints 0 (the root) to 8, m from the root; entries beyond the tip repeat it
fn chain_joints(blade: ChainCoefficients, base: mat3x3<f32>, curl: f32, bent: ChainState) -> array<vec3<f32>, 9> {
    var places = array<vec3<f32>, 9>();
    var state = bent;
    var frame = base;
    for (var i = 0u; i < CHAIN_MOST_SEGMENTS; i++) {
        places[i + 1u] = places[i];
        if i < blade.segments {
            frame = frame * chain_rotation(state.joints[i].xy + chain_rest_turn(blade.segments, curl, i));
            places[i + 1u] = places[i] + 2.0 * blade.half_length * frame[2];
        }
    }
    return places;
}
