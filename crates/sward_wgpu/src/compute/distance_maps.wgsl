// Depth cube maps of bodies, drawn from their triangles: each texel remembers the triangle it sees, then writes what that looks like.
//
// A thread draws a triangle along one axis, on both faces. Large ones it leaves to whole workgroups. Twin of DistanceMap::new. Needs raster.

struct MapDraw {
    // First of its texels, and of its winners.
    first: u32,
    winners: u32,
    // Texels along a side.
    size: u32,
    // Half of the cube's edge, m.
    half: f32,
    // Texels to the metre.
    scale: f32,
}

struct LargeTriangles {
    count: atomic<u32>,
    // Three times the triangle's number, and the axis.
    items: array<u32>,
}

@group(0) @binding(0) var<storage, read> maps: array<MapDraw>;
// Three numbers a point, m from the cube's middle.
@group(0) @binding(1) var<storage, read> points: array<f32>;
// Three points and the map.
@group(0) @binding(2) var<storage, read> triangles: array<vec4<u32>>;
// Per texel, one more than the number of the triangle it sees; 0: none.
@group(0) @binding(3) var<storage, read_write> winners: array<atomic<u32>>;
@group(0) @binding(4) var<storage, read_write> large: LargeTriangles;
@group(0) @binding(5) var<storage, read_write> texels: array<vec4<f32>>;

// Texels that one thread goes through at most.
const MAPS_SMALL: i32 = 64;

fn point(index: u32) -> vec3<f32> {
    return vec3<f32>(points[3u * index], points[3u * index + 1u], points[3u * index + 2u]);
}

fn corners_of(number: u32) -> mat3x3<f32> {
    let triangle = triangles[number];
    return mat3x3<f32>(point(triangle.x), point(triangle.y), point(triangle.z));
}

// A triangle as a texel of one face may see it.
struct Offer {
    number: u32,
    depth: f32,
    normal: f32,
}

// The nearer one, of two equally near the one that faces the face more, of those the first.
fn is_before(a: Offer, b: Offer) -> bool {
    if a.depth != b.depth {
        return a.depth < b.depth;
    }
    if abs(a.normal) != abs(b.normal) {
        return abs(a.normal) > abs(b.normal);
    }
    return a.number < b.number;
}

fn offer_of(number: u32, map: MapDraw, axis: u32, sign: f32, texel: vec2<i32>) -> Offer {
    let corners = corners_of(number);
    let seen = raster_seen(corners, axis, map.half, map.scale);
    return Offer(number, raster_depth(seen, raster_shares(seen, texel), map.half, sign), raster_normal(corners)[axis]);
}

// Leaves the better of two triangles at a texel, whichever comes first.
fn meet(map: MapDraw, axis: u32, sign: f32, texel: vec2<i32>, mine: Offer) {
    let face = 2u * axis + select(0u, 1u, sign < 0.0);
    let place = map.winners + (face * map.size + u32(texel.y)) * map.size + u32(texel.x);
    var there = atomicLoad(&winners[place]);
    loop {
        if there != 0u && !is_before(mine, offer_of(there - 1u, map, axis, sign, texel)) {
            return;
        }
        let swap = atomicCompareExchangeWeak(&winners[place], there, mine.number + 1u);
        if swap.exchanged {
            return;
        }
        there = swap.old_value;
    }
}

// Every `lanes`-th texel of a triangle's bounds; false where all of them are too many for one thread.
fn draw(item: u32, lane: i32, lanes: i32) -> bool {
    let number = item / 3u;
    let axis = item % 3u;
    let map = maps[triangles[number].w];
    let corners = corners_of(number);
    let seen = raster_seen(corners, axis, map.half, map.scale);
    let bounds = raster_bounds(seen, map.size);
    let sides = bounds.zw - bounds.xy + 1;
    let normal = raster_normal(corners);
    if any(sides < vec2<i32>(1)) || seen.area == 0.0 || all(normal == vec3<f32>(0.0)) {
        return true;
    }
    if lanes == 1 && sides.x * sides.y > MAPS_SMALL {
        return false;
    }
    for (var k = lane; k < sides.x * sides.y; k += lanes) {
        let texel = bounds.xy + vec2<i32>(k % sides.x, k / sides.x);
        let shares = raster_shares(seen, texel);
        for (var sign = 1.0; sign > -2.0 && all(shares >= vec3<f32>(0.0)); sign -= 2.0) {
            let depth = raster_depth(seen, shares, map.half, sign);
            if depth < RASTER_EMPTY {
                meet(map, axis, sign, texel, Offer(number, depth, normal[axis]));
            }
        }
    }
    return true;
}

@compute @workgroup_size(64)
fn draw_pass(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let item = (group.y * groups.x + group.x) * 64u + lane;
    if item < 3u * arrayLength(&triangles) && !draw(item, 0, 1) {
        large.items[atomicAdd(&large.count, 1u)] = item;
    }
}

@compute @workgroup_size(64)
fn large_pass(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    for (var k = group.x; k < atomicLoad(&large.count); k += groups.x) {
        draw(large.items[k], i32(lane), 64);
    }
}

@compute @workgroup_size(64)
fn write_pass(@builtin(global_invocation_id) id: vec3<u32>) {
    let map = maps[id.y];
    let area = map.size * map.size;
    if id.x >= 6u * area || map.first + id.x >= arrayLength(&texels) {
        return;
    }
    let winner = atomicLoad(&winners[map.winners + id.x]);
    var seen = vec4<f32>(RASTER_EMPTY, 0.0, 1.0, 0.0);
    if winner != 0u {
        let face = id.x / area;
        let sign = select(1.0, -1.0, face % 2u == 1u);
        let place = vec2<i32>(vec2<u32>(id.x % map.size, id.x / map.size % map.size));
        let depth = offer_of(winner - 1u, map, face / 2u, sign, place).depth;
        let normal = raster_normal(corners_of(winner - 1u));
        seen = vec4<f32>(depth, select(normal, -normal, sign * normal[face / 2u] < 0.0));
    }
    texels[map.first + id.x] = seen;
}
