// One convex piece of one body over one step. Twin: contact.rs, where everything is explained.
// The host declares `fn contact_edge(index: u32) -> ContactEdge`.

struct ContactEdge {
    start: vec2<i32>,
    along: vec2<i32>,
    normal: vec2<f32>,
    metres: f32,
    unused: f32,
}

struct Contact {
    size: vec2<i32>,
    edge_first: u32,
    edge_count: u32,
    shift: u32,
    kind: u32,
    velocity: vec2<f32>,
    centre: vec2<f32>,
    yaw_rate: f32,
    spacing: f32,
    start: vec4<f32>,
    end: vec4<f32>,
    form: vec4<f32>,
    rise: f32,
    body: u32,
    highest: f32,
    stays: f32,
}

struct ContactHit {
    touches: bool,
    speed: f32,
    direction: vec2<f32>,
    along: f32,
    height: f32,
    normal: vec2<f32>,
    depth: f32,
}

const CONTACT_BAND: f32 = 0.4;

fn contact_floor(hit: ContactHit) -> f32 {
    return math_atan(hit.depth / hit.height);
}

fn contact_plane(reference: vec4<f32>, gradient: vec2<f32>, at: vec2<f32>) -> f32 {
    return reference.z + gradient.x * (at.x - reference.x) + gradient.y * (at.y - reference.y);
}

fn contact_in_radii(c: Contact, reference: vec4<f32>, at: vec2<f32>) -> vec2<f32> {
    let p = at - reference.xy;
    return vec2<f32>((c.form.x * p.x - c.form.y * p.y) * c.form.z, (c.form.y * p.x + c.form.x * p.y) * c.form.w);
}

/// Lowest underside over `at` during the step.
fn contact_underside(c: Contact, at: vec2<f32>) -> f32 {
    if c.kind == 0u {
        return min(contact_plane(c.start, c.form.xy, at), contact_plane(c.end, c.form.zw, at));
    }
    let start = contact_in_radii(c, c.start, at);
    let way = contact_in_radii(c, c.end, at) - start;
    let length_ = max(way.x * way.x + way.y * way.y, 1e-12);
    let passed = clamp(-(start.x * way.x + start.y * way.y) / length_, 0.0, 1.0);
    let nearest = start + passed * way;
    let inside = 1.0 - nearest.x * nearest.x - nearest.y * nearest.y;
    let centre = c.start.z + passed * (c.end.z - c.start.z);
    return select(centre - c.rise * sqrt(max(inside, 0.0)), 1e9, inside < 0.0);
}

fn contact_at(c: Contact, cell: vec2<i32>, ground: f32, plant_height: f32) -> ContactHit {
    var hit: ContactHit;
    hit.touches = false;
    let half_shift = c.shift - 1u;
    let point = (2 * cell + vec2<i32>(1)) << vec2<u32>(half_shift);
    let at = (vec2<f32>(cell) + 0.5) * c.spacing;
    let arm = at - c.centre;
    let velocity = c.velocity + c.yaw_rate * vec2<f32>(arm.y, -arm.x);
    hit.speed = sqrt(velocity.x * velocity.x + velocity.y * velocity.y);
    hit.depth = 1e30;
    var chosen = 1e30;
    var chosen_facing = 0.0;
    var shape = vec2<f32>(0.0);
    for (var k = 0u; k < c.edge_count; k++) {
        let edge = contact_edge(c.edge_first + k);
        let side = edge.along.x * (point.y - edge.start.y) - edge.along.y * (point.x - edge.start.x);
        if side < 0 {
            return hit;
        }
        let distance_ = f32(side) * edge.metres;
        if distance_ < hit.depth {
            hit.depth = distance_;
            hit.normal = edge.normal;
        }
        let facing = edge.normal.x * velocity.x + edge.normal.y * velocity.y;
        let closer = distance_ < chosen - 1e-4 || (distance_ <= chosen + 1e-4 && facing > chosen_facing);
        if facing >= -1e-3 * hit.speed && closer {
            chosen = distance_;
            chosen_facing = facing;
            shape = edge.normal;
        }
    }
    if chosen > CONTACT_BAND {
        shape = vec2<f32>(0.0);
    }
    let clearance = contact_underside(c, at) - ground;
    if clearance >= plant_height {
        return hit;
    }
    hit.touches = true;
    hit.height = max(min(clearance, c.highest), 0.02);
    let heading = velocity / max(hit.speed, 1e-12) + shape;
    hit.direction = heading / max(sqrt(heading.x * heading.x + heading.y * heading.y), 1e-12);
    hit.along = velocity.x * hit.direction.x + velocity.y * hit.direction.y;
    return hit;
}
