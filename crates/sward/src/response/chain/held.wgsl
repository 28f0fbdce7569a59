// One blade of a patch that bodies reach. Twin: held.rs, where everything is explained. Needs chain, standing, push.
// The host declares `fn held_stands(root: Root, base: mat3x3<f32>, before: bool) -> array<vec2<f32>, 8>`, where virtual blades would have it, and
// `fn held_wind(root: Root) -> vec2<f32>`.

struct HeldBlade {
    state: ChainState,
    before: array<vec2<f32>, 8>,
    hold: f32,
    hold_before: f32,
}

struct Holding {
    obstacles: Obstacles,
    dt: f32,
    keep: f32,
    pixels: f32,
    all: bool,
    handing: bool,
}

// Where a body pushed the blade of the last `held_step`, and none if that is STANDING_NONE.
var<private> held_pressed: Pressed;

const HELD_NEAR: f32 = 0.06;
const HELD_SLOW: f32 = 0.5;
const HELD_FADE: f32 = 0.3;
const HELD_MOTION: f32 = 0.5;
const HELD_FRAMES: f32 = 60.0;

fn held_bends(state: ChainState) -> array<vec2<f32>, 8> {
    var joints = state.joints;
    var bends = array<vec2<f32>, 8>();
    for (var i = 0u; i < CHAIN_MOST_SEGMENTS; i++) {
        bends[i] = joints[i].xy;
    }
    return bends;
}

fn held_swing(co: ChainCoefficients, by: Holding, root: Root, base: mat3x3<f32>, blade: HeldBlade) -> HeldBlade {
    var next = blade;
    next.hold_before = blade.hold;
    if blade.hold > 0.0 {
        next.before = held_bends(blade.state);
        let air = held_wind(root);
        next.state = chain_step(co, base, root.curl, vec3<f32>(air.x, 0.0, air.y), by.dt, blade.state);
    }
    return next;
}

fn held_take(co: ChainCoefficients, blade: HeldBlade, now_: array<vec2<f32>, 8>, before: array<vec2<f32>, 8>, dt: f32) -> HeldBlade {
    var next = blade;
    var stands = now_;
    var stood = before;
    for (var i = 0u; i < min(co.segments, CHAIN_MOST_SEGMENTS); i++) {
        next.state.joints[i] = vec4<f32>(stands[i], (stands[i] - stood[i]) / dt);
    }
    next.before = before;
    next.hold = 1.0;
    next.hold_before = 1.0;
    return next;
}

fn held_stay(blade: HeldBlade, posture: array<vec2<f32>, 8>, segments: u32) -> HeldBlade {
    var next = blade;
    var shown = posture;
    if blade.hold < 1.0 {
        for (var i = 0u; i < min(segments, CHAIN_MOST_SEGMENTS); i++) {
            next.state.joints[i] = vec4<f32>(shown[i], next.state.joints[i].zw);
        }
        next.hold = 1.0;
    }
    return next;
}

fn held_push_out(co: ChainCoefficients, root: Root, base: mat3x3<f32>, obstacles: Obstacles, blade: HeldBlade) -> HeldBlade {
    var next = blade;
    let pushed = push_out(co, root, base, obstacles, held_bends(blade.state));
    held_pressed = pushed.pressed;
    var bends = pushed.bends;
    for (var i = 0u; i < min(co.segments, CHAIN_MOST_SEGMENTS); i++) {
        let still = ((pushed.turned >> i) & 1u) == 1u;
        next.state.joints[i] = vec4<f32>(bends[i], select(next.state.joints[i].zw, vec2<f32>(0.0), still));
    }
    return next;
}

fn held_settled(co: ChainCoefficients, root: Root, base: mat3x3<f32>, blade: HeldBlade, virtual_pose: array<vec2<f32>, 8>, dt: f32) -> bool {
    var own = blade.state.joints;
    var before = blade.before;
    var off = array<vec2<f32>, 8>();
    // Now, and a step before.
    for (var moment = 0u; moment < 2u; moment++) {
        var posture = virtual_pose;
        if moment == 1u {
            posture = held_stands(root, base, true);
        }
        var stands = push_out(co, root, base, push_obstacles(0u, 0u), posture).bends;
        let most = select(HELD_NEAR, HELD_SLOW * dt, moment == 1u);
        var largest = 0.0;
        for (var i = 0u; i < min(co.segments, CHAIN_MOST_SEGMENTS); i++) {
            let now_ = own[i].xy - stands[i];
            let change = off[i] - before[i] + stands[i];
            let x = select(now_, change, moment == 1u);
            off[i] = now_;
            largest = math_upper(largest, x.x * x.x + x.y * x.y);
        }
        if largest > most * most {
            return false;
        }
    }
    return true;
}

fn held_go_back(co: ChainCoefficients, by: Holding, root: Root, base: mat3x3<f32>, blade: HeldBlade, stands: array<vec2<f32>, 8>) -> HeldBlade {
    var next = blade;
    if blade.hold >= 1.0 && !by.handing && !held_settled(co, root, base, blade, stands, by.dt) {
        return next;
    }
    let way = push_tip(co, root, base, held_bends(blade.state)) - push_tip(co, root, base, stands);
    let pixels = by.pixels * sqrt(dot(way, way));
    let share = math_lower(by.dt / HELD_FADE, HELD_MOTION * HELD_FRAMES * by.dt / math_upper(pixels, 1e-6));
    next.hold = math_upper(blade.hold - share, 0.0);
    return next;
}

fn held_step(co: ChainCoefficients, by: Holding, root: Root, blade: HeldBlade) -> HeldBlade {
    let pushed = push_reach(by.obstacles, root);
    let all = by.all && !by.handing;
    held_pressed = push_nobody();
    var next = blade;
    if root.length <= 0.0 || (blade.hold <= 0.0 && !pushed && !all) {
        next.hold_before = 0.0;
        return next;
    }
    let base = chain_planted(root.yaw, root.lean);
    let around = push_around(by.obstacles, root);
    let stands = held_stands(root, base, false);
    next = held_swing(co, by, root, base, blade);
    var shown = held_bends(next.state);
    if next.hold < 1.0 {
        shown = standing_mixed(stands, shown, next.hold);
    }
    let touched = pushed && push_touches(co, root, base, around, shown);
    if touched || all {
        if next.hold <= 0.0 {
            next = held_take(co, next, stands, held_stands(root, base, true), by.dt);
        } else {
            next = held_stay(next, shown, co.segments);
        }
    }
    if next.hold >= 1.0 {
        var obstacles = push_obstacles(0u, 0u);
        if touched {
            obstacles = around;
        }
        next = held_push_out(co, root, base, obstacles, next);
    }
    if next.hold > 0.0 && !touched && !all {
        next = held_go_back(co, by, root, base, next, stands);
    }
    next.hold *= by.keep;
    return next;
}
