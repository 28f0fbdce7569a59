// Blades without a state. Twin: virtual_inertia.rs, where each function is documented. Needs chain.wgsl.

const VIRTUAL_INERTIA_TURNS: u32 = 3u;
const VIRTUAL_INERTIA_LEAST_SLOPE: f32 = 0.25;

fn virtual_inertia_weight_moment(co: ChainCoefficients, frame: mat3x3<f32>) -> vec2<f32> {
    return co.half_length * co.weight * vec2<f32>(frame[1].y, -frame[0].y);
}

// Moments of a virtual blade, N m
fn virtual_inertia_moments(blade: ChainCoefficients, base: mat3x3<f32>, bent: ChainState) -> array<vec2<f32>, 8> {
    var co = blade;
    var state = bent;
    var held = array<vec2<f32>, 8>();
    var frame = base;
    for (var i = 0u; i < min(co.segments, CHAIN_MOST_SEGMENTS); i++) {
        let bend = state.joints[i].xy;
        frame = frame * chain_rotation(bend);
        held[i] = co.joints[i].stiffness * bend - virtual_inertia_weight_moment(co, frame);
    }
    return held;
}

fn virtual_inertia_turned(base: mat3x3<f32>, virtual_base: mat3x3<f32>, moment: vec2<f32>) -> vec2<f32> {
    return ((virtual_base * vec3<f32>(moment, 0.0)) * base).xy;
}

// Where turned moments and weight hold a blade; rates are 0
fn virtual_inertia_pose(blade: ChainCoefficients, base: mat3x3<f32>, curl: f32, moments: array<vec2<f32>, 8>) -> ChainState {
    var co = blade;
    var held = moments;
    var state = ChainState();
    var below = base;
    for (var i = 0u; i < min(co.segments, CHAIN_MOST_SEGMENTS); i++) {
        let spring = co.joints[i].stiffness;
        let lever = co.weight * co.half_length;
        let heavy = lever / spring;
        let rest = chain_rest_turn(co.segments, curl, i);
        var bend = vec2<f32>(0.0);
        var turn = chain_rotation(rest);
        let rise = vec3<f32>(below[0].y, below[1].y, below[2].y);
        for (var k = 0u; k < VIRTUAL_INERTIA_TURNS; k++) {
            let own = rise * turn;
            let slope = math_upper(1.0 - heavy * own.z, VIRTUAL_INERTIA_LEAST_SLOPE);
            let weight = lever * vec2<f32>(own.y, -own.x);
            bend = bend + ((held[i] + weight) / spring - bend) / slope;
            let size = sqrt(bend.x * bend.x + bend.y * bend.y);
            bend = bend * select(1.0, CHAIN_BEND_LIMIT / size, size > CHAIN_BEND_LIMIT);
            turn = chain_rotation(bend + rest);
        }
        state.joints[i] = vec4<f32>(bend, 0.0, 0.0);
        below = below * turn;
    }
    return state;
}
