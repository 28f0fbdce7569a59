// A convex piece of a body as a solid. Twin: solid.rs, where everything is explained. Needs math.
// The host declares `fn solid_plane(index: u32) -> vec4<f32>`.

struct SolidHead {
    first: u32,
    count: u32,
    moment: u32,
    body: u32,
    low: vec4<f32>,
    high: vec4<f32>,
    centre: vec4<f32>,
    turn: vec4<f32>,
    radii: vec4<f32>,
}

struct SolidNearness {
    distance: f32,
    normal: vec3<f32>,
}

const SOLID_AWAY: f32 = 1e3;

fn solid_ellipsoid_nearness(solid: SolidHead, at: vec3<f32>) -> SolidNearness {
    let p = at - solid.centre.xyz;
    let cosine = solid.turn.x;
    let sine = solid.turn.y;
    let own = vec3<f32>(cosine * p.x - sine * p.z, p.y, sine * p.x + cosine * p.z);
    let part = own / solid.radii.xyz;
    let gradient = part / solid.radii.xyz;
    let share = sqrt(dot(part, part));
    let rise = math_upper(sqrt(dot(gradient, gradient)), 1e-9);
    let n = gradient / rise;
    return SolidNearness(share * (share - 1.0) / rise, vec3<f32>(cosine * n.x + sine * n.z, n.y, -sine * n.x + cosine * n.z));
}

fn solid_nearness(solid: SolidHead, at: vec3<f32>, standing: bool) -> SolidNearness {
    let beside = any(at.xz < solid.low.xz) || any(at.xz > solid.high.xz);
    if beside || at.y > solid.high.y || (at.y < solid.low.y && !standing) {
        return SolidNearness(SOLID_AWAY, vec3<f32>(0.0, 1.0, 0.0));
    }
    if solid.count == 0u {
        return solid_ellipsoid_nearness(solid, at);
    }
    var nearest = SolidNearness(-SOLID_AWAY, vec3<f32>(0.0, 1.0, 0.0));
    for (var k = solid.first + select(0u, 1u, standing); k < solid.first + solid.count; k++) {
        let plane = solid_plane(k);
        let distance_ = dot(plane.xyz, at) - plane.w;
        if distance_ > nearest.distance {
            nearest = SolidNearness(distance_, plane.xyz);
        }
    }
    return nearest;
}

// Whether plants rooted here cannot pass below it.
fn solid_stands_on(solid: SolidHead, root: vec3<f32>, room: f32) -> bool {
    if solid.count == 0u {
        return false;
    }
    let plane = solid_plane(solid.first);
    return dot(plane.xyz, root) - plane.w < room;
}
