// How a point lies to a body seen as a depth cube map. Twin: distance_map.rs, where everything is explained. Needs math.
// The host declares `fn distance_map_load(index: u32) -> vec4<f32>`.

struct DistanceMapHead {
    first: u32,
    size: u32,
    moment: u32,
    body: u32,
    centre: vec4<f32>,
    axes: array<vec4<f32>, 3>,
}

struct DistanceMapSide {
    distance: f32,
    depth: f32,
    normal: vec3<f32>,
}

struct DistanceMapSides {
    inside: bool,
    seen: array<DistanceMapSide, 6>,
}

struct DistanceMapNearness {
    distance: f32,
    normal: vec3<f32>,
}

const DISTANCE_MAP_EMPTY: f32 = 1e9;
const DISTANCE_MAP_STEEP: f32 = 4.0;

fn distance_map_to_body(head: DistanceMapHead, at: vec3<f32>) -> vec3<f32> {
    let off = at - head.centre.xyz;
    return vec3<f32>(dot(head.axes[0].xyz, off), dot(head.axes[1].xyz, off), dot(head.axes[2].xyz, off));
}

fn distance_map_to_world(head: DistanceMapHead, v: vec3<f32>) -> vec3<f32> {
    return v.x * head.axes[0].xyz + v.y * head.axes[1].xyz + v.z * head.axes[2].xyz;
}

fn distance_map_looked_up(head: DistanceMapHead, face: u32, at: vec2<f32>, steep: f32) -> vec4<f32> {
    let size = max(head.size, 1u);
    let whole = floor(at);
    let part = at - whole;
    var least = vec4<f32>(DISTANCE_MAP_EMPTY, 0.0, 1.0, 0.0);
    var most = 0.0;
    var mean = vec4<f32>(0.0);
    for (var k = 0u; k < 4u; k++) {
        let place = vec2<i32>(whole) + vec2<i32>(i32(k % 2u), i32(k / 2u));
        let beside = any(place < vec2<i32>(0)) || any(place >= vec2<i32>(i32(size)));
        var texel = vec4<f32>(DISTANCE_MAP_EMPTY, 0.0, 1.0, 0.0);
        if !beside {
            texel = distance_map_load(head.first + (face * size + u32(place.y)) * size + u32(place.x));
        }
        let weight = select(1.0 - part.x, part.x, k % 2u == 1u) * select(1.0 - part.y, part.y, k / 2u == 1u);
        mean += weight * texel;
        least = select(least, texel, texel.x < least.x);
        most = math_upper(most, texel.x);
    }
    return select(mean, least, most - least.x > steep || least.x >= DISTANCE_MAP_EMPTY);
}

fn distance_map_side(head: DistanceMapHead, face: u32, at: vec3<f32>) -> DistanceMapSide {
    let axis = face / 2u;
    let half = head.centre.w;
    let sign = select(-1.0, 1.0, face % 2u == 0u);
    let scale = 0.5 * f32(head.size) / half;
    let place = (vec2<f32>(at[(axis + 1u) % 3u], at[(axis + 2u) % 3u]) + half) * scale - 0.5;
    let texel = distance_map_looked_up(head, face, place, DISTANCE_MAP_STEEP / scale);
    if texel.x >= DISTANCE_MAP_EMPTY {
        return DistanceMapSide(DISTANCE_MAP_EMPTY, DISTANCE_MAP_EMPTY, vec3<f32>(0.0, 1.0, 0.0));
    }
    let normal = texel.yzw / math_upper(sqrt(dot(texel.yzw, texel.yzw)), 1e-6);
    let away = texel.x - (half - sign * at[axis]);
    return DistanceMapSide(away, away * math_upper(sign * normal[axis], 0.0), normal);
}

fn distance_map_sides(head: DistanceMapHead, at: vec3<f32>) -> DistanceMapSides {
    var sides = DistanceMapSides();
    let own = distance_map_to_body(head, at);
    if !all(abs(own) < vec3<f32>(head.centre.w)) {
        return sides;
    }
    for (var face = 0u; face < 6u; face++) {
        let seen = distance_map_side(head, face, own);
        sides.seen[face] = seen;
        if seen.distance >= 0.0 {
            return sides;
        }
    }
    sides.inside = true;
    return sides;
}

fn distance_map_contact_at(head: DistanceMapHead, at: vec3<f32>) -> DistanceMapNearness {
    var sides = distance_map_sides(head, at);
    if !sides.inside {
        let own = distance_map_to_body(head, at);
        let half = vec3<f32>(head.centre.w);
        let off = own - min(max(own, -half), half);
        let away = sqrt(dot(off, off));
        if away > 0.0 {
            return DistanceMapNearness(away, distance_map_to_world(head, off / away));
        }
        return DistanceMapNearness(away, vec3<f32>(0.0, 1.0, 0.0));
    }
    var nearest = sides.seen[0];
    for (var face = 1u; face < 6u; face++) {
        if sides.seen[face].depth > nearest.depth {
            nearest = sides.seen[face];
        }
    }
    return DistanceMapNearness(nearest.depth, distance_map_to_world(head, nearest.normal));
}
