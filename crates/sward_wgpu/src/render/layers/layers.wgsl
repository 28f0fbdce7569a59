// Layers in the main pass and in the shadow map: textures of cut plants on grids that the waves move.

@group(0) @binding(4) var<storage, read> layers: array<LayerDraw>;
@group(0) @binding(5) var<storage, read> layer_notes: array<vec2<f32>>;
@group(0) @binding(6) var<storage, read> layer_touches: array<vec2<f32>>;
@group(0) @binding(7) var layer_sky: texture_2d<f32>;
@group(0) @binding(8) var layer_sun: texture_2d<f32>;
@group(0) @binding(11) var layer_sampler: sampler;

fn layers_note(index: u32) -> vec2<f32> {
    return layer_notes[index];
}

fn layers_touch(index: u32) -> vec2<f32> {
    return layer_touches[index];
}

struct LayerPoint {
    @builtin(position) position: vec4<f32>,
    @location(0) place: vec3<f32>,
    @location(1) uv: vec2<f32>,
    @location(2) air: vec4<f32>, // light the air adds, and what it leaves of the layer's
    @location(3) @interpolate(flat) index: u32,
}

// Corners of a grid of two triangles a piece.
fn layers_share(draw: LayerDraw, vertex: u32) -> vec2<f32> {
    let piece = vertex / 6u;
    let columns = u32(draw.window.z);
    let corner = vec2<u32>((0x32u >> (vertex % 6u)) & 1u, (0x2cu >> (vertex % 6u)) & 1u);
    return vec2<f32>(vec2<u32>(piece % columns, piece / columns) + corner) / draw.window.zw;
}

@vertex
fn layers_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) index: u32) -> LayerPoint {
    let draw = layers[index];
    let corner = layers_corner(draw, layers_share(draw, vertex));
    let away = corner.place - frame.camera.xyz;
    let clear = shading_fog(length(away), frame.camera.w);
    let air = vec4<f32>(frame_air(normalize(away)) * (1.0 - clear), clear);
    return LayerPoint(frame.view_projection * vec4<f32>(corner.place, 1.0), corner.place, corner.uv, air, index);
}

// What a layer shows at a pixel.
struct LayerTexel { sky: vec3<f32>, sun: vec3<f32>, alpha: f32, behind: f32 }

fn layers_texel(uv: vec2<f32>) -> LayerTexel {
    let sky = textureSampleLevel(layer_sky, layer_sampler, uv, 0.0);
    let sun = textureSampleLevel(layer_sun, layer_sampler, uv, 0.0);
    let alpha = 1.0 - sky.a; // cuts hold what they leave uncovered
    let whole = 1.0 / max(alpha, 1e-3);
    return LayerTexel(sky.rgb * whole, sun.rgb * whole, alpha, sun.a * whole);
}

// A point of frame space that lies `behind` a layer's point as its cut saw it.
fn layers_place(eye: vec4<f32>, place: vec3<f32>, behind: f32) -> vec3<f32> {
    return place + (place - eye.xyz) * (behind / eye.w);
}

// The share of a pixel's samples that a layer is to cover. Devices give equal shares the same samples, so two layers that cover half of a pixel each would leave
// half of it empty: leaves cover what two layers of alpha cover together.
fn layers_covers(leaves: bool, share: f32, alpha: f32, pixel: vec2<u32>) -> f32 {
    let covered = select(alpha, alpha * (2.0 - alpha), leaves);
    // While cuts change, between two numbers of samples, pixel by pixel in Bayer's order.
    let mixed = vec2<u32>(pixel.x ^ pixel.y, pixel.y) & vec2<u32>(7u);
    let spread = (mixed & vec2<u32>(1u)) << vec2<u32>(4u) | (mixed & vec2<u32>(2u)) << vec2<u32>(1u) | (mixed & vec2<u32>(4u)) >> vec2<u32>(2u);
    let off = f32(2u * spread.x + spread.y) / 63.0 - 0.5;
    return covered * share - 0.125 + off * min(4.0 * (1.0 - share), 0.25);
}

struct LayerPixel {
    @location(0) colour: vec4<f32>, // a: the share of the pixel's samples to cover
    @builtin(frag_depth) depth: f32,
}

@fragment
fn layers_fragment(point: LayerPoint) -> LayerPixel {
    let texel = layers_texel(point.uv);
    if texel.alpha < 0.125 {
        discard;
    }
    let place = layers_place(layers[point.index].eye, point.place, texel.behind);
    let lit = shadows_lit(shadows_place(place, 0.12), 2.2, SHADING_MEAN_LIT);
    let colour = point.air.rgb + (texel.sky + texel.sun * lit) * point.air.a;
    let clip = frame.view_projection * vec4<f32>(place, 1.0);
    let covered = layers_covers(layers[point.index].which.w == 1u, layers[point.index].forward.w, texel.alpha, vec2<u32>(point.position.xy));
    return LayerPixel(vec4<f32>(colour, covered), clamp(clip.z / clip.w, 0.0, 1.0));
}

struct LayerShade {
    @builtin(position) position: vec4<f32>,
    @location(0) place: vec3<f32>,
    @location(1) uv: vec2<f32>,
    @location(2) @interpolate(flat) index: u32,
}

@vertex
fn layers_shadow_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) index: u32) -> LayerShade {
    let draw = layers[index];
    let corner = layers_corner(draw, layers_share(draw, vertex));
    let at = (frame.shadow * vec4<f32>(corner.place, 1.0)).xyz;
    return LayerShade(vec4<f32>(at.x * 2.0 - 1.0, 1.0 - at.y * 2.0, at.z, 1.0), corner.place, corner.uv, index);
}

@fragment
fn layers_shadow_fragment(shade: LayerShade) -> @builtin(frag_depth) f32 {
    let texel = layers_texel(shade.uv);
    if texel.alpha < 0.5 {
        discard;
    }
    return clamp((frame.shadow * vec4<f32>(layers_place(layers[shade.index].eye, shade.place, texel.behind), 1.0)).z, 0.0, 1.0);
}
