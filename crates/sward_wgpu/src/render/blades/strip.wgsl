// Strips of blades: what all passes that draw them share.

@group(0) @binding(4) var<storage, read> records: array<vec4<u32>>;
@group(0) @binding(5) var<storage, read> found: array<u32, 4>;
@group(0) @binding(6) var<uniform> style: BladeStyle;

// A blade's record, without its points.
struct BladeHead {
    root: vec3<f32>,
    yaw: f32,
    width: f32,
    tint: f32,
    twist: f32,
    slope: vec2<f32>,
    points: u32,    // where they begin
    exists: bool,
}

struct BladeCorner {
    place: vec3<f32>,
    across: vec3<f32>,
    facing: vec3<f32>,
    side: f32,
    along: f32,
    cover: f32,
}

// The blade of a vertex: instances draw BLADES_PER_INSTANCE blades.
fn strip_head(vertex: u32, instance: u32) -> BladeHead {
    let slot = instance * BLADES_PER_INSTANCE + vertex / (2u * style.shape.x + 1u);
    let first = style.shape.z + slot * style.shape.y;
    let exists = slot < found[style.shape.w] && first < arrayLength(&records);
    let at = select(style.shape.z, first, exists);
    let a = bitcast<vec4<f32>>(records[at]);
    let b = bitcast<vec4<f32>>(records[at + 1u]);
    let slope = bitcast<vec2<f32>>(records[at + 2u].xy);
    return BladeHead(a.xyz, b.x, b.y, b.z, b.w, slope, at + BLADE_HEAD, exists);
}

fn strip_point(at: u32) -> vec3<f32> {
    return bitcast<vec3<f32>>(records[at].xyz);
}

// Corner of a strip whose points begin at `points`. `narrowest`: width below which it is not drawn, as a share of the distance to `eye`.
fn strip_corner(head: BladeHead, points: u32, vertex: u32, width: f32, eye: vec3<f32>, narrowest: f32) -> BladeCorner {
    let pieces = style.shape.x;
    let corner = vertex % (2u * pieces + 1u);
    let k = corner / 2u;
    let point = strip_point(points + k);
    let along = f32(k) / f32(pieces);
    let way = strip_point(points + min(k + 1u, pieces)) - strip_point(points + max(k, 1u) - 1u);
    let size = length(way);
    let tangent = select(vec3<f32>(0.0, 1.0, 0.0), way / size, size > 1e-20);
    let turn = math_sin_cos(head.yaw);
    let across = blade_across(vec2<f32>(turn.y, turn.x), tangent, head.twist * along);
    let side = select(f32(corner & 1u) * 2.0 - 1.0, 0.0, k == pieces);
    let own = width * blade_profile(along);
    let pixel = narrowest * distance(point, eye);
    let cover = shading_blade_coverage(own, pixel, head.tint);
    return BladeCorner(point + across * (0.5 * max(own, pixel) * side), across, cross(across, tangent), side, along, cover);
}

// Outside the clip volume.
fn strip_nowhere() -> vec4<f32> {
    return vec4<f32>(0.0, 0.0, -2.0, 1.0);
}
