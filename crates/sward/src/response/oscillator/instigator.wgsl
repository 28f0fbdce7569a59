// How far a body makes a plant lean, and where to. Twin: instigator.rs, where everything is explained. Needs contact.wgsl, swing.wgsl.

const INSTIGATOR_BISECTIONS: u32 = 20u;
const INSTIGATOR_LOWEST: f32 = 0.02;
const INSTIGATOR_MIDDLE: f32 = 1e-4;

struct Push {
    tilt: f32,
    outward: vec2<f32>,
    pace: f32,
    lever: f32,
    aside: f32,
}

fn instigator_is_clear(root: vec2<f32>, way: vec2<f32>) -> bool {
    let squared = way.x * way.x + way.y * way.y;
    let nearest = math_clamped(-(root.x * way.x + root.y * way.y) / squared, 0.0, 1.0);
    let p = root + nearest * way;
    return p.x * p.x + p.y * p.y >= 1.0;
}

// H: least tilt of a rod outside a raised ellipsoid
fn instigator_least_tilt(share: f32, clearance: f32, radius: f32, half_: f32, rod: f32) -> f32 {
    if share >= 1.0 || clearance >= rod {
        return 0.0;
    }
    let raised = clearance / half_;
    let root = vec2<f32>(share, -(1.0 + raised));
    let reach = vec2<f32>(rod / radius, rod / half_);
    if instigator_is_clear(root, vec2<f32>(0.0, reach.y)) {
        return 0.0;
    }
    let beyond = sqrt(share * share + 2.0 * raised + raised * raised);
    let tangent = vec2<f32>((1.0 + raised) - share * beyond, (1.0 + raised) * beyond + share) * vec2<f32>(radius, half_);
    var inside = vec2<f32>(0.0, 1.0);
    var outside = tangent / swing_length(tangent);
    for (var k = 0u; k < INSTIGATOR_BISECTIONS; k++) {
        let sum = inside + outside;
        let middle = sum / swing_length(sum);
        if instigator_is_clear(root, middle * reach) {
            outside = middle;
        } else {
            inside = middle;
        }
    }
    return math_atan2(outside.x, outside.y);
}

// From the root to where the tangent touches
fn instigator_tangent_length(share: f32, clearance: f32, radius: f32, half_: f32) -> f32 {
    let up = 1.0 + clearance / half_;
    let beyond = sqrt(max(share * share + up * up - 1.0, 0.0));
    let way = vec2<f32>(up - share * beyond, up * beyond + share) * vec2<f32>(radius, half_);
    return swing_length(way) * beyond / (1.0 + beyond * beyond);
}

// What a piece asks of a plant; tilt 0 where it does not reach it
fn instigator_push(co: OscillatorCoefficients, contact: Contact, at: vec2<f32>, ground: f32, rod: f32, facing: vec2<f32>) -> Push {
    let arm = at - contact.centre;
    let velocity = contact.velocity + contact.yaw_rate * vec2<f32>(arm.y, -arm.x);
    let speed = swing_length(velocity);
    if contact.kind == 0u {
        return instigator_push_flat(contact, at, ground, rod, velocity, speed);
    }
    let start = contact_in_radii(contact, contact.start, at);
    let way = contact_in_radii(contact, contact.end, at) - start;
    let passed = math_clamped(-(start.x * way.x + start.y * way.y) / max(way.x * way.x + way.y * way.y, 1e-12), 0.0, 1.0);
    let share = swing_length(start + passed * way);
    let middle = contact.start.xyz + passed * (contact.end.xyz - contact.start.xyz);
    let off = at - middle.xy;
    let away = swing_length(off);
    var wide = 1.0 / max(contact.form.z, contact.form.w);
    if share > 1e-4 {
        wide = away / share;
    }
    let clearance = max(middle.z - contact.rise - ground, 0.0);
    let tilt = instigator_least_tilt(share, clearance, wide, contact.rise, rod);
    if tilt <= 0.0 {
        return Push();
    }
    var outward = facing;
    if away > INSTIGATOR_MIDDLE {
        outward = off / away;
    } else if speed > 1e-4 {
        outward = velocity / speed;
    }
    let rising = (contact.end.z - contact.start.z) / co.dt;
    let lever = min(instigator_tangent_length(share, clearance, wide, contact.rise), rod);
    return Push(tilt, outward, 2.0 * sqrt(speed * speed + rising * rising) / min(wide, contact.rise), lever, 1.0);
}

fn instigator_push_flat(contact: Contact, at: vec2<f32>, ground: f32, rod: f32, velocity: vec2<f32>, speed: f32) -> Push {
    let clearance = max(contact_underside(contact, at) - ground, INSTIGATOR_LOWEST);
    if clearance >= rod {
        return Push();
    }
    let place = at * (f32(1u << contact.shift) / contact.spacing);
    var depth = 3e38;
    var outward = vec2<f32>(0.0);
    var inside = true;
    for (var k = 0u; k < contact.edge_count; k++) {
        let edge = contact_edge(contact.edge_first + k);
        let off = place - vec2<f32>(edge.start);
        let distance_ = (f32(edge.along.x) * off.y - f32(edge.along.y) * off.x) * edge.metres;
        inside = inside && distance_ > 0.0;
        let facing = edge.normal.x * velocity.x + edge.normal.y * velocity.y;
        if facing >= -1e-3 * speed && distance_ < depth {
            depth = distance_;
            outward = edge.normal;
        }
    }
    if !inside || depth > 1e38 {
        return Push();
    }
    let under = math_atan2(sqrt(rod * rod - clearance * clearance), clearance);
    let out = math_atan(depth / clearance);
    let tilt = min(under, out);
    let lever = min(clearance / max(math_sin_cos(tilt).y, 1e-3), rod);
    return Push(tilt, outward, speed / clearance, lever, select(0.0, 1.0, out < under));
}
