// Blades are turned out of bodies and off the ground. Twin: push.rs, where everything is explained. Needs chain, interaction/solid.
// The host declares `fn push_solid(index: u32) -> SolidHead`.

struct Root {
    at: vec3<f32>,
    length: f32,
    yaw: f32,
    lean: f32,
    curl: f32,
    unused: f32,
    slope: vec2<f32>,
    more_unused: vec2<f32>,
}

// Bodies that reach a patch: their first number and how many; and, once asked with push_around, how the first 32 lie to one blade, and the moment
// of the step that counts: all of them if that is NONE.
struct Obstacles {
    first: u32,
    count: u32,
    near: u32,
    standing: u32,
    moment: u32,
}

// Where a body last pushed a blade: which of the obstacles, the lowest joint that it turned, from there to where it touches the blade, and which way.
struct Pressed {
    solid: u32,
    joint: u32,
    arm: vec3<f32>,
    normal: vec3<f32>,
}

struct Pushed {
    bends: array<vec2<f32>, 8>,
    turned: u32,
    pressed: Pressed,
}

struct PushFree {
    moved: bool,
    place: vec3<f32>,
    by: u32,
}

const PUSH_BITS: u32 = 32u;
const PUSH_SWEEPS: u32 = 16u;
const PUSH_ROUNDS: u32 = 2u;
const PUSH_PATIENCE: u32 = 2u;
const PUSH_STRAIGHT: f32 = 0.02;
const PUSH_UPRIGHT: f32 = 1e-6;
const PUSH_SLACK: f32 = 1e-3;
const PUSH_TOLERANCE: f32 = 5e-4;
const PUSH_CLEAR: f32 = 1e-3;
const PUSH_ROOM: f32 = 0.02;

fn push_reaches(solid: SolidHead, root: Root) -> bool {
    let near = all(root.at.xz >= solid.low.xz - root.length) && all(root.at.xz <= solid.high.xz + root.length);
    return near && solid.low.y <= root.at.y + root.length;
}

fn push_obstacles(first: u32, count: u32) -> Obstacles {
    return Obstacles(first, count, 0u, 0u, STANDING_NONE);
}

fn push_reach(obstacles: Obstacles, root: Root) -> bool {
    var near = false;
    for (var k = 0u; k < obstacles.count && !near; k++) {
        near = push_reaches(push_solid(obstacles.first + k), root);
    }
    return near;
}

fn push_around(bodies: Obstacles, root: Root) -> Obstacles {
    var obstacles = bodies;
    for (var k = 0u; k < min(bodies.count, PUSH_BITS); k++) {
        let solid = push_solid(bodies.first + k);
        if push_reaches(solid, root) {
            obstacles.near |= 1u << k;
            obstacles.standing |= select(0u, 1u, solid_stands_on(solid, root.at, PUSH_ROOM)) << k;
        }
    }
    return obstacles;
}

fn push_at(around: Obstacles, moment: u32) -> Obstacles {
    var near = 0u;
    for (var k = 0u; k < min(around.count, PUSH_BITS); k++) {
        near |= select(0u, 1u, push_solid(around.first + k).moment == moment) << k;
    }
    return Obstacles(around.first, around.count, around.near & near, around.standing, moment);
}

fn push_next(obstacles: Obstacles, k: u32) -> u32 {
    let left = select(0u, obstacles.near >> (k & 31u), k < PUSH_BITS);
    return select(max(k, PUSH_BITS), k + firstTrailingBit(left), left != 0u);
}

fn push_nearness(obstacles: Obstacles, k: u32, root: Root, at: vec3<f32>) -> SolidNearness {
    let solid = push_solid(obstacles.first + k);
    var standing = ((obstacles.standing >> (k & 31u)) & 1u) == 1u;
    if k >= PUSH_BITS {
        if !push_reaches(solid, root) || (obstacles.moment != STANDING_NONE && solid.moment != obstacles.moment) {
            return SolidNearness(SOLID_AWAY, vec3<f32>(0.0, 1.0, 0.0));
        }
        standing = solid_stands_on(solid, root.at, PUSH_ROOM);
    }
    return solid_nearness(solid, at, standing);
}

// The first in which a point lies too deep, or none.
fn push_deep_in(obstacles: Obstacles, root: Root, at: vec3<f32>) -> u32 {
    for (var k = push_next(obstacles, 0u); k < obstacles.count; k = push_next(obstacles, k + 1u)) {
        if push_nearness(obstacles, k, root, at).distance < -PUSH_TOLERANCE {
            return k;
        }
    }
    return STANDING_NONE;
}

fn push_deep(obstacles: Obstacles, root: Root, at: vec3<f32>) -> bool {
    return push_deep_in(obstacles, root, at) != STANDING_NONE;
}

fn push_nobody() -> Pressed {
    return Pressed(STANDING_NONE, STANDING_NONE, vec3<f32>(0.0), vec3<f32>(0.0));
}

fn push_lying_under(solid: u32, tip: vec3<f32>) -> Pressed {
    return Pressed(solid, 0u, 0.5 * tip, vec3<f32>(0.0));
}

fn push_free(obstacles: Obstacles, root: Root, at: vec3<f32>) -> PushFree {
    let rise = 1.0 / sqrt(1.0 + root.slope.x * root.slope.x + root.slope.y * root.slope.y);
    let normal = vec3<f32>(-root.slope.x, 1.0, -root.slope.y) * rise;
    var free = PushFree(false, at, STANDING_NONE);
    for (var round = 0u; round < PUSH_ROUNDS; round++) {
        let off = free.place - root.at;
        let ground = (off.y - PUSH_CLEAR - root.slope.x * off.x - root.slope.y * off.z) * rise;
        if ground < -PUSH_TOLERANCE {
            free = PushFree(true, free.place - ground * normal, free.by);
        }
        for (var k = push_next(obstacles, 0u); k < obstacles.count; k = push_next(obstacles, k + 1u)) {
            let found = push_nearness(obstacles, k, root, free.place);
            if found.distance < -PUSH_TOLERANCE {
                free = PushFree(true, free.place + (PUSH_SLACK - found.distance) * found.normal, k);
            }
        }
        if !free.moved {
            return free;
        }
    }
    return free;
}

fn push_touches(co: ChainCoefficients, root: Root, base: mat3x3<f32>, obstacles: Obstacles, posture: array<vec2<f32>, 8>) -> bool {
    var bends = posture;
    var frame = base;
    var at = root.at;
    let length_ = root.length / f32(co.segments);
    var deep = push_deep(obstacles, root, root.at);
    for (var point = 0u; point < 2u * min(co.segments, CHAIN_MOST_SEGMENTS) && !deep; point++) {
        let i = point / 2u;
        if (point & 1u) == 0u {
            frame = frame * chain_rotation(bends[i] + chain_rest_turn(co.segments, root.curl, i));
        }
        at += 0.5 * length_ * frame[2];
        deep = push_deep(obstacles, root, at);
    }
    return deep;
}

// The bend that turns joint j so that `point` comes as far along the way to `goal` as that one is.
fn push_turn(co: ChainCoefficients, curl: f32, j: u32, below: mat3x3<f32>, frame: mat3x3<f32>, joint: vec3<f32>, point: vec3<f32>, goal: vec3<f32>) -> vec2<f32> {
    let way = goal - point;
    let far = math_upper(sqrt(dot(way, way)), 1e-9);
    let normal = way / far;
    let arm = point - joint;
    let lever = math_upper(sqrt(dot(arm, arm)), 1e-9);
    let u = arm / lever;
    let wanted = math_clamped(dot(normal, u) + far / lever, -1.0, 1.0);
    var side = u - normal * dot(normal, u);
    if dot(side, side) <= PUSH_STRAIGHT * PUSH_STRAIGHT {
        side = frame[0] - normal * dot(normal, frame[0]);
    }
    let rest = sqrt(1.0 - wanted * wanted) / math_upper(sqrt(dot(side, side)), 1e-9);
    let w = wanted * normal + rest * side;
    let d = frame[2];
    let share = (dot(u, d) + dot(w, d)) / math_upper(1.0 + dot(u, w), 1e-3);
    let turned = d - share * (u + w) + 2.0 * dot(u, d) * w;
    let size = math_upper(sqrt(dot(turned, turned)), 1e-9);
    let bend = chain_bend_towards((turned / size) * below) - chain_rest_turn(co.segments, curl, j);
    let bent = sqrt(bend.x * bend.x + bend.y * bend.y);
    return bend * select(1.0, CHAIN_BEND_LIMIT / bent, bent > CHAIN_BEND_LIMIT);
}

// No frame is kept in an array: software and small GPUs are slow at those, and walking up again costs little.
fn push_sweep(co: ChainCoefficients, root: Root, base: mat3x3<f32>, obstacles: Obstacles, lower: u32, posture: array<vec2<f32>, 8>, pressed: Pressed) -> Pushed {
    let length_ = root.length / f32(co.segments);
    var result = Pushed(posture, 0u, pressed);
    var frame = base;
    var place = root.at;
    for (var i = 0u; i < min(co.segments, CHAIN_MOST_SEGMENTS); i++) {
        frame = frame * chain_rotation(result.bends[i] + chain_rest_turn(co.segments, root.curl, i));
        for (var half = 1u; half <= 2u; half++) {
            let point = place + 0.5 * f32(half) * length_ * frame[2];
            let free = push_free(obstacles, root, point);
            if !free.moved {
                continue;
            }
            let j = i - min(i, lower);
            var below = base;
            place = root.at;
            for (var k = 0u; k < j; k++) {
                below = below * chain_rotation(result.bends[k] + chain_rest_turn(co.segments, root.curl, k));
                place += length_ * below[2];
            }
            if free.by != STANDING_NONE && j <= result.pressed.joint {
                let way = free.place - point;
                result.pressed = Pressed(free.by, j, free.place - place, way / math_upper(sqrt(dot(way, way)), 1e-9));
            }
            frame = below * chain_rotation(result.bends[j] + chain_rest_turn(co.segments, root.curl, j));
            result.bends[j] = push_turn(co, root.curl, j, below, frame, place, point, free.place);
            frame = below * chain_rotation(result.bends[j] + chain_rest_turn(co.segments, root.curl, j));
            for (var k = j + 1u; k <= i; k++) {
                place += length_ * frame[2];
                frame = frame * chain_rotation(result.bends[k] + chain_rest_turn(co.segments, root.curl, k));
            }
            result.turned |= 1u << j;
        }
        place += length_ * frame[2];
    }
    return result;
}

// Where the tip is, from the root
fn push_tip(co: ChainCoefficients, root: Root, base: mat3x3<f32>, posture: array<vec2<f32>, 8>) -> vec3<f32> {
    var bends = posture;
    var frame = base;
    var at = vec3<f32>(0.0);
    for (var i = 0u; i < min(co.segments, CHAIN_MOST_SEGMENTS); i++) {
        frame = frame * chain_rotation(bends[i] + chain_rest_turn(co.segments, root.curl, i));
        at += (root.length / f32(co.segments)) * frame[2];
    }
    return at;
}

fn push_heading(k: u32) -> vec2<f32> {
    let h = 0.70710678;
    var headings = array<vec2<f32>, 8>(
        vec2<f32>(1.0, 0.0), vec2<f32>(h, h), vec2<f32>(h, -h), vec2<f32>(0.0, 1.0),
        vec2<f32>(0.0, -1.0), vec2<f32>(-h, h), vec2<f32>(-h, -h), vec2<f32>(-1.0, 0.0),
    );
    return headings[k];
}

// The bends with which a blade lies straight: halfway or nearly flat, turned from where `tip` is.
fn push_lying(co: ChainCoefficients, root: Root, base: mat3x3<f32>, nearly_flat: bool, turn: vec2<f32>, tip: vec3<f32>) -> array<vec2<f32>, 8> {
    let upright = tip.x * tip.x + tip.z * tip.z < PUSH_UPRIGHT * PUSH_UPRIGHT;
    let way = select(tip.xz, base[0].xz, upright);
    let p = way / math_upper(sqrt(way.x * way.x + way.y * way.y), 1e-9);
    let tilt = select(vec2<f32>(0.8660254, 0.5), vec2<f32>(0.9961947, 0.08715574), nearly_flat);
    let across = vec2<f32>(turn.x * p.x - turn.y * p.y, turn.y * p.x + turn.x * p.y);
    let rise = tilt.y + tilt.x * (root.slope.x * across.x + root.slope.y * across.y);
    let direction = vec3<f32>(tilt.x * across.x, rise, tilt.x * across.y);
    let first = chain_bend_towards((direction / sqrt(dot(direction, direction))) * base);
    var lying = array<vec2<f32>, 8>();
    for (var i = 0u; i < min(co.segments, CHAIN_MOST_SEGMENTS); i++) {
        lying[i] = select(vec2<f32>(0.0), first, i == 0u) - chain_rest_turn(co.segments, root.curl, i);
    }
    return lying;
}

// One call of each function, whichever way a blade goes: all of them are inlined, and the kernel grows with each.
fn push_out(co: ChainCoefficients, root: Root, base: mat3x3<f32>, obstacles: Obstacles, posture: array<vec2<f32>, 8>) -> Pushed {
    var result = Pushed(posture, 0u, push_nobody());
    var last = 0u;
    for (var k = 0u; k < obstacles.count; k++) {
        last = max(last, push_solid(obstacles.first + k).moment);
    }
    for (var moment = 0u; moment <= last; moment++) {
        let present = push_at(obstacles, moment);
        let over = push_deep_in(present, root, root.at);
        let stood_on = over != STANDING_NONE;
        // A root that is stood on lies nearly flat; who finds no way out lies down straight, if it can.
        for (var number = select(0u, PUSH_SWEEPS + 8u, stood_on); number < PUSH_SWEEPS + 16u; number++) {
            let lies = number >= PUSH_SWEEPS;
            var tried = Pushed(result.bends, 0u, result.pressed);
            if lies {
                let k = number - PUSH_SWEEPS;
                tried.bends = push_lying(co, root, base, k >= 8u, push_heading(k % 8u), push_tip(co, root, base, result.bends));
                tried.pressed = push_nobody();
            }
            var swept = tried;
            if !stood_on {
                swept = push_sweep(co, root, base, present, select(number / PUSH_PATIENCE % co.segments, 0u, lies), tried.bends, tried.pressed);
            }
            if lies && swept.turned == 0u {
                let under = push_lying_under(select(result.pressed.solid, over, stood_on), push_tip(co, root, base, tried.bends));
                result = Pushed(tried.bends, (1u << co.segments) - 1u, under);
            } else if !lies {
                result = Pushed(swept.bends, result.turned | swept.turned, swept.pressed);
            }
            if swept.turned == 0u {
                break;
            }
        }
    }
    return result;
}
