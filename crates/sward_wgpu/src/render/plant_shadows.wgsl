// Plants in the shadow pass.

struct Shade {
    @builtin(position) position: vec4<f32>,
    @location(0) card: vec2<f32>,
    @location(1) @interpolate(flat) layer: u32,
}

@vertex
fn plants_shadow_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) instance: u32) -> Shade {
    var shade: Shade;
    let index = instance * style.shape.w + vertex / style.shape.z;
    let plant = plants[index];
    let centre = (frame.shadow * vec4<f32>(plant.root, 1.0)).xyz;
    if plant.height <= 0.0 || max(abs(centre.x - 0.5), abs(centre.y - 0.5)) > 0.52 {
        shade.position = plants_nowhere();
        return shade;
    }
    let bent = plants_bend(plant, index, vertex % style.shape.z, 1.0);
    let at = (frame.shadow * vec4<f32>(bent.place, 1.0)).xyz;
    shade.position = vec4<f32>(at.x * 2.0 - 1.0, 1.0 - at.y * 2.0, at.z, 1.0);
    shade.card = vec2<f32>(plants_across(plant, bent.side), 1.0 - bent.along);
    shade.layer = plant.layer;
    return shade;
}

@fragment
fn plants_shadow_fragment(shade: Shade) {
    if textureSample(clumps, clump_sampler, shade.card, shade.layer).a < 0.5 {
        discard;
    }
}
