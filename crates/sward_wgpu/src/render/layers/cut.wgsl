// Plants cut into layers: every triangle of a mesh is drawn once, into the part of the texture that its leaf's layer has. Light of sky and sun apart; depth
// from the layer's own. Twin: cut.rs of sward_raster.

struct Cut {
    place: mat4x4<f32>, // mesh -> frame space
    eye: vec4<f32>,     // frame space; w = layers, the wood's not counted
    right: vec4<f32>,   // w = left side of the window
    up: vec4<f32>,      // w = its bottom
    forward: vec4<f32>, // w = its right side
    grid: vec4<f32>,    // top of the window; columns and rows of the texture; tint
    crown: vec4<f32>,   // middle of the crown; 1 / its radius
    size: vec4<f32>,    // pixels of a layer; depth of the wood's
    edges: array<vec4<f32>, 4>,  // depths between layers
    depths: array<vec4<f32>, 4>, // of layers
}

struct Finish {
    colour: vec4<f32>, // rgb; w = alpha below which nothing is
    kind: vec4<f32>,   // 1 wood; 1 seen from both sides; 1 with a picture; share of light let through
}

@group(0) @binding(4) var<uniform> cut: Cut;
@group(0) @binding(5) var<uniform> finish: Finish;
@group(0) @binding(6) var picture: texture_2d<f32>;
@group(0) @binding(7) var picture_sampler: sampler;

struct CutPoint {
    @builtin(position) position: vec4<f32>,
    @location(0) place: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) card: vec4<f32>,   // u, v, openness, depth from the eye
    @location(3) @interpolate(flat) part: vec4<f32>, // column, row, depth of the layer, chance
}

@vertex
fn layers_cut_vertex(@location(0) position: vec3<f32>, @location(1) normal: vec4<f32>, @location(2) uv: vec2<f32>, @location(3) root: vec3<f32>) -> CutPoint {
    let place = (cut.place * vec4<f32>(position, 1.0)).xyz;
    let from_eye = place - cut.eye.xyz;
    let count = u32(cut.eye.w);
    var layer = count;
    var depth = cut.size.z;
    if finish.kind.x < 0.5 {
        let away = dot((cut.place * vec4<f32>(root, 1.0)).xyz - cut.eye.xyz, cut.forward.xyz);
        layer = 0u;
        for (var k = 0u; k + 1u < count; k++) {
            layer += select(0u, 1u, away >= cut.edges[k >> 2u][k & 3u]);
        }
        depth = cut.depths[layer >> 2u][layer & 3u];
    }
    let columns = u32(cut.grid.y);
    let part = vec2<f32>(f32(layer % columns), f32(layer / columns));
    let seen = vec3<f32>(dot(from_eye, cut.right.xyz), dot(from_eye, cut.up.xyz), dot(from_eye, cut.forward.xyz));
    // Within the layer's part of the texture, times the depth: from the left, and from the top.
    let across = (seen.x - cut.right.w * seen.z) / (cut.forward.w - cut.right.w);
    let down = (cut.grid.x * seen.z - seen.y) / (cut.grid.x - cut.up.w);
    var point: CutPoint;
    point.position = vec4<f32>(
        2.0 * (part.x * seen.z + across) / cut.grid.y - seen.z,
        seen.z - 2.0 * (part.y * seen.z + down) / cut.grid.z,
        0.05,
        seen.z,
    );
    point.place = place;
    point.normal = (cut.place * vec4<f32>(normal.xyz, 0.0)).xyz;
    point.card = vec4<f32>(uv, max(normal.w, 0.0), seen.z);
    let cell = vec3<i32>(floor(root * 512.0));
    point.part = vec4<f32>(part, depth, shading_hash(cell.x + 7 * cell.y, cell.z, 31u));
    return point;
}

struct CutPixel {
    @location(0) sky: vec4<f32>, // light of the sky; the share of the pixel's samples to cover
    @location(1) sun: vec4<f32>, // light of the sun, where it shines; how far behind the layer it is
}

@fragment
fn layers_cut_fragment(point: CutPoint, @builtin(front_facing) front: bool) -> CutPixel {
    // What reaches beyond its layer's part of the texture lies in another's.
    let within = floor(point.position.xy / cut.size.xy);
    var alpha = 1.0;
    var texel = vec4<f32>(1.0);
    if finish.kind.z > 0.5 {
        texel = textureSample(picture, picture_sampler, point.card.xy);
        alpha = clamp((texel.a - finish.colour.w) / max(fwidth(texel.a), 0.02) + 0.5, 0.0, 1.0);
    }
    if any(within != point.part.xy) || alpha < 0.125 || point.card.w < 0.02 {
        discard;
    }
    let view = normalize(cut.eye.xyz - point.place);
    let outwards = (point.place - cut.crown.xyz) * cut.crown.w;
    let wood = finish.kind.x > 0.5;
    let open = clamp(point.card.z, 0.0, 1.0); // a pixel's middle may lie outside of the triangle
    let own = normalize(point.normal + vec3<f32>(0.0, 1e-6, 0.0));
    let normal = select(shading_crown_normal(own, outwards / max(length(outwards), 1.0), view), own * select(-1.0, 1.0, dot(own, view) > 0.0), wood);
    let plain = finish.colour.rgb * texel.rgb;
    let albedo = select(shading_crown_colour(plain, point.part.w, cut.grid.w, open), plain, wood);
    let through = finish.kind.w;
    let sky = frame_crown_sky(albedo, normal, open, through, point.place);
    let sun = shading_crown_sun(albedo, normal, view, frame_light(), through);
    // The nearest number of samples; leaves behind show through the others.
    return CutPixel(vec4<f32>(sky, alpha - 0.125), vec4<f32>(sun, point.card.w - point.part.z));
}
