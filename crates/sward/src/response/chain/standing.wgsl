// How blades without a state stand at a place. Twin: standing.rs, where everything is explained. Needs chain, virtual_inertia.
// The host declares `fn standing_load(before: bool, index: u32) -> f32`: a moment of a virtual blade, now or a step before.

struct Standing {
    around: array<u32, 9>,
    weights: vec4<f32>,
    patch_side: f32,
    virtual_side: u32,
}

const STANDING_NONE: u32 = 0xffffffffu;

fn standing_needs_wind(s: Standing) -> bool {
    var sleeps = any(s.weights != vec4<f32>(1.0));
    for (var k = 0u; k < 9u; k++) {
        sleeps = sleeps || s.around[k] == STANDING_NONE;
    }
    return sleeps;
}

fn standing_blade(s: Standing, segments: u32, before: bool, at: vec2<i32>, steady: array<vec2<f32>, 8>) -> array<vec2<f32>, 8> {
    let side = i32(s.virtual_side);
    let over = select(vec2<i32>(0), vec2<i32>(1), at >= vec2<i32>(side)) - select(vec2<i32>(0), vec2<i32>(1), at < vec2<i32>(0));
    var around = s.around;
    let slot = around[u32((over.y + 1) * 3 + over.x + 1)];
    var found = steady;
    if slot == STANDING_NONE {
        return found;
    }
    let area = s.virtual_side * s.virtual_side;
    let own = vec2<u32>(at - over * side);
    let first = slot * 2u * segments * area + own.y * s.virtual_side + own.x;
    for (var i = 0u; i < segments; i++) {
        found[i] = vec2<f32>(standing_load(before, first + 2u * i * area), standing_load(before, first + (2u * i + 1u) * area));
    }
    return found;
}

// `steady`: moments of an upright blade in the wind of the place; they count only where standing_needs_wind says so.
fn standing_moments(s: Standing, segments: u32, before: bool, local: vec2<f32>, steady: array<vec2<f32>, 8>) -> array<vec2<f32>, 8> {
    var around = s.around;
    var asleep = true;
    for (var k = 0u; k < 9u; k++) {
        asleep = asleep && around[k] == STANDING_NONE;
    }
    var found = steady;
    if asleep {
        return found;
    }
    let at = local / s.patch_side * f32(s.virtual_side) - 0.5;
    let corner = vec2<i32>(floor(at));
    let f = at - vec2<f32>(corner);
    var a = standing_blade(s, segments, before, corner, steady);
    var b = standing_blade(s, segments, before, corner + vec2<i32>(1, 0), steady);
    var c = standing_blade(s, segments, before, corner + vec2<i32>(0, 1), steady);
    var d = standing_blade(s, segments, before, corner + vec2<i32>(1, 1), steady);
    let w = s.weights;
    let place = local / s.patch_side;
    let low = w.x + (w.y - w.x) * place.x;
    let high = w.z + (w.w - w.z) * place.x;
    let weight = low + (high - low) * place.y;
    for (var i = 0u; i < segments; i++) {
        let near = a[i] + (b[i] - a[i]) * f.x;
        let far = c[i] + (d[i] - c[i]) * f.x;
        let moved = near + (far - near) * f.y;
        found[i] = found[i] + (moved - found[i]) * weight;
    }
    return found;
}

fn standing_pose(co: ChainCoefficients, base: mat3x3<f32>, curl: f32, moments: array<vec2<f32>, 8>) -> array<vec2<f32>, 8> {
    var upright = moments;
    let virtual_base = mat3x3<f32>(vec3<f32>(1.0, 0.0, 0.0), vec3<f32>(0.0, 0.0, -1.0), vec3<f32>(0.0, 1.0, 0.0));
    for (var i = 0u; i < CHAIN_MOST_SEGMENTS; i++) {
        upright[i] = virtual_inertia_turned(base, virtual_base, upright[i]);
    }
    var pose = virtual_inertia_pose(co, base, curl, upright);
    var bends = array<vec2<f32>, 8>();
    for (var i = 0u; i < CHAIN_MOST_SEGMENTS; i++) {
        bends[i] = pose.joints[i].xy;
    }
    return bends;
}

// How far each segment leans beyond what it does by itself, ground vectors (x, z); `own` is lean and curl.
fn standing_leans(segments: u32, base: mat3x3<f32>, heading: vec2<f32>, own: vec2<f32>, bends: array<vec2<f32>, 8>) -> array<vec2<f32>, 8> {
    var bent = bends;
    var leans = array<vec2<f32>, 8>();
    var frame = base;
    for (var i = 0u; i < min(segments, CHAIN_MOST_SEGMENTS); i++) {
        frame = frame * chain_rotation(bent[i] + chain_rest_turn(segments, own.y, i));
        let d = frame[2];
        let turned = chain_bend_towards(vec3<f32>(d.x, -d.z, d.y));
        let along = (f32(i) + 0.5) / f32(segments);
        leans[i] = turned.yx - heading * (own.x + own.y * along * along);
    }
    return leans;
}

fn standing_mixed(a: array<vec2<f32>, 8>, b: array<vec2<f32>, 8>, share: f32) -> array<vec2<f32>, 8> {
    var from_ = a;
    var to = b;
    for (var i = 0u; i < CHAIN_MOST_SEGMENTS; i++) {
        from_[i] = from_[i] + (to[i] - from_[i]) * share;
    }
    return from_;
}
