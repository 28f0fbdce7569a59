// Triangles as the faces of a depth cube map see them. Twin: raster.rs, where everything is explained. Needs math.
// Products of places take more than 32 bits: they are pairs (high, low) that stand for high · 2²⁴ + low, 0 ≤ low < 2²⁴.

const RASTER_PARTS: f32 = 256.0;
const RASTER_BEYOND: f32 = 16384.0;
const RASTER_EMPTY: f32 = 1e9;

// A triangle as the two faces across one axis see it.
struct RasterSeen {
    // Corners in 1/256 texel.
    a: vec2<i32>,
    b: vec2<i32>,
    c: vec2<i32>,
    // Twice its signed area, in (1/256 texel)².
    area: f32,
    // Where its corners are along the axis, m from the cube's middle.
    along: vec3<f32>,
}

fn raster_fine(part: vec2<f32>, half: f32, scale: f32) -> vec2<i32> {
    let texels = (part + half) * scale;
    let x = math_clamped(texels.x, -RASTER_BEYOND, RASTER_BEYOND);
    let y = math_clamped(texels.y, -RASTER_BEYOND, RASTER_BEYOND);
    return vec2<i32>(floor(vec2<f32>(x, y) * RASTER_PARTS + 0.5));
}

fn raster_carried(wide: vec2<i32>) -> vec2<i32> {
    return vec2<i32>(wide.x + (wide.y >> 24u), wide.y & 0xffffff);
}

// Of numbers within ±2²³.
fn raster_product(a: i32, b: i32) -> vec2<i32> {
    let high = vec2<i32>(a >> 12u, b >> 12u);
    let low = vec2<i32>(a & 0xfff, b & 0xfff);
    let middle = high.x * low.y + low.x * high.y;
    return raster_carried(vec2<i32>(high.x * high.y + (middle >> 12u), ((middle & 0xfff) << 12u) + low.x * low.y));
}

// Twice the signed area of a triangle, rounded once: its sign is exact.
fn raster_edge(a: vec2<i32>, b: vec2<i32>, c: vec2<i32>) -> f32 {
    let u = b - a;
    let v = c - a;
    let wide = raster_carried(raster_product(u.x, v.y) - raster_product(u.y, v.x));
    return f32(wide.x) * 16777216.0 + f32(wide.y);
}

fn raster_seen(corners: mat3x3<f32>, axis: u32, half: f32, scale: f32) -> RasterSeen {
    let right = (axis + 1u) % 3u;
    let up = (axis + 2u) % 3u;
    var seen: RasterSeen;
    seen.a = raster_fine(vec2<f32>(corners[0][right], corners[0][up]), half, scale);
    seen.b = raster_fine(vec2<f32>(corners[1][right], corners[1][up]), half, scale);
    seen.c = raster_fine(vec2<f32>(corners[2][right], corners[2][up]), half, scale);
    seen.area = raster_edge(seen.a, seen.b, seen.c);
    seen.along = vec3<f32>(corners[0][axis], corners[1][axis], corners[2][axis]);
    return seen;
}

// Columns and rows from (x, y) to (z, w) have their centres within the triangle's bounds; none where z < x or w < y.
fn raster_bounds(seen: RasterSeen, size: u32) -> vec4<i32> {
    let half = i32(RASTER_PARTS) / 2;
    // Rounds down, also below 0.
    let low = (min(min(seen.a, seen.b), seen.c) + half - 1) >> vec2<u32>(8u);
    let high = (max(max(seen.a, seen.b), seen.c) - half) >> vec2<u32>(8u);
    return vec4<i32>(max(low, vec2<i32>(0)), min(high, vec2<i32>(i32(size) - 1)));
}

// The corners' shares of a texel's centre; one of them is negative where the triangle does not cover it.
fn raster_shares(seen: RasterSeen, texel: vec2<i32>) -> vec3<f32> {
    let parts = i32(RASTER_PARTS);
    let middle = texel * parts + parts / 2;
    let edges = vec3<f32>(
        raster_edge(seen.b, seen.c, middle),
        raster_edge(seen.c, seen.a, middle),
        raster_edge(seen.a, seen.b, middle),
    );
    return select(edges, -edges, seen.area < 0.0) / abs(seen.area);
}

// Depth below one of the two faces; `sign` is 1 for the one that looks against the axis, else −1.
fn raster_depth(seen: RasterSeen, shares: vec3<f32>, half: f32, sign: f32) -> f32 {
    let parts = shares * (half - sign * seen.along);
    return parts.x + parts.y + parts.z;
}

// Unit normal, 0 where the triangle has none.
fn raster_normal(corners: mat3x3<f32>) -> vec3<f32> {
    let across = cross(corners[1] - corners[0], corners[2] - corners[0]);
    let size = sqrt(dot(across, across));
    return select(vec3<f32>(0.0), across / size, size > 0.0 && size < RASTER_EMPTY);
}
