// Plants in the main pass: leaves lit by sun and sky.

struct Leaf {
    @builtin(position) position: vec4<f32>,
    @location(0) place: vec3<f32>,
    @location(1) across: vec3<f32>, // along the card, unit
    @location(2) facing: vec3<f32>, // out of the card, unit
    @location(3) card: vec4<f32>,   // u, v, along 0..1, how much it lies down 0..1
    @location(4) patchwork: vec4<f32>, // shading_patchwork, tint
    @location(5) air: vec4<f32>,    // light the air adds, and what it leaves of the leaf's
    @location(6) @interpolate(flat) layer: u32,
}

@vertex
fn plants_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) instance: u32) -> Leaf {
    var leaf: Leaf;
    let index = instance * style.shape.w + vertex / style.shape.z;
    let plant = plants[index];
    let distance = length(plant.root - frame.camera.xyz);
    // Plants end at slightly different distances, so that no front is seen.
    let gone = smoothstep(style.mean.z, style.mean.w, distance + (plant.tint - 0.5) * 0.3 * (style.mean.w - style.mean.z));
    if plant.height <= 0.0 || gone >= 1.0 || plants_unseen(plant) {
        leaf.position = plants_nowhere();
        return leaf;
    }
    let bent = plants_bend(plant, index, vertex % style.shape.z, 1.0 - 0.85 * gone);
    leaf.position = frame.view_projection * vec4<f32>(bent.place, 1.0);
    leaf.place = bent.place;
    leaf.across = bent.across;
    leaf.facing = bent.facing;
    let flip = select(1.0, -1.0, fract(plant.tint * 64.0) < 0.5);
    leaf.card = vec4<f32>(0.5 + 0.5 * bent.side * flip, 1.0 - bent.along, bent.along, bent.lying);
    leaf.patchwork = vec4<f32>(shading_patchwork(plant.root.xz + frame.phase.xy), plant.tint);
    let away = bent.place - frame.camera.xyz;
    let clear = shading_fog(length(away), frame.camera.w);
    leaf.air = vec4<f32>(frame_air(normalize(away)) * (1.0 - clear), clear);
    leaf.layer = plant.layer;
    return leaf;
}

@fragment
fn plants_fragment(leaf: Leaf) -> @location(0) vec4<f32> {
    let to_eye = frame.camera.xyz - leaf.place;
    let distance = length(to_eye);
    let view = normalize(to_eye);
    let level = shading_level(dpdx(leaf.card.xy) * 256.0, dpdy(leaf.card.xy) * 256.0);
    var texel = textureSampleLevel(clumps, clump_sampler, leaf.card.xy, leaf.layer, level);
    texel.a *= shading_on_edge(leaf.facing, view);
    let alpha = shading_rim(texel.a, fwidth(texel.a), style.mean.w, distance);
    if alpha < 0.1 {
        discard;
    }
    let species = ShadingSpecies(style.root, style.tip, style.mean);
    let card = ShadingCard(leaf.across, leaf.facing, leaf.card.z, leaf.card.w, leaf.patchwork.xyz, leaf.patchwork.w);
    let lit = shadows_lit(shadows_place(leaf.place, 0.10), 2.2, SHADING_MEAN_LIT);
    let colour = shading_foliage(species, card, texel, view, distance, frame_light(), lit);
    return vec4<f32>(leaf.air.rgb + colour * leaf.air.a, alpha);
}
