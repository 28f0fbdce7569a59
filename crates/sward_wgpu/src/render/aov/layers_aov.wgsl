// The outputs of layers: the same corners as in the main pass, between the waves of this picture and of the one before. Draws, notes and planes of that one lie
// behind those of this.

struct LayerTrail {
    @builtin(position) position: vec4<f32>,
    @location(0) place: vec3<f32>,
    @location(1) then: vec3<f32>,
    @location(2) uv: vec2<f32>,
    @location(3) @interpolate(flat) index: u32,
}

@vertex
fn layers_aov_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) index: u32) -> LayerTrail {
    let draw = layers[index];
    let share = layers_share(draw, vertex);
    let corner = layers_corner(draw, share);
    let was = layers_corner(layers[index + arrayLength(&layers) / 2u], share);
    return LayerTrail(frame.view_projection * vec4<f32>(corner.place, 1.0), corner.place, was.place, corner.uv, index);
}

struct LayerOutputs {
    @location(0) depth: f32,
    @location(1) motion: vec2<f32>,
    @location(2) plant: u32,
    @builtin(frag_depth) at: f32,
}

@fragment
fn layers_aov_fragment(trail: LayerTrail) -> LayerOutputs {
    let texel = layers_texel(trail.uv);
    if texel.alpha < AOV_COVERAGE || layers[trail.index].which.y == 0u {
        discard;
    }
    let now = frame.view_projection * vec4<f32>(layers_place(layers[trail.index].eye, trail.place, texel.behind), 1.0);
    let then = aov.then * vec4<f32>(layers_place(layers[trail.index].eye, trail.then, texel.behind), 1.0);
    let pixel = aov_pixel(now, then, layers[trail.index].which.x);
    return LayerOutputs(pixel.depth, pixel.motion, pixel.plant, clamp(now.z / now.w, 0.0, 1.0));
}
