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
    @location(7) above: f32,        // height over the root
}

@vertex
fn plants_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) instance: u32) -> Leaf {
    var leaf: Leaf;
    let index = instance * style.shape.w + vertex / style.shape.z;
    let plant = plants[index];
    let gone = plants_gone(plant, frame.camera.xyz);
    if plant.height <= 0.0 || gone >= 1.0 || plants_unseen(plant) {
        leaf.position = plants_nowhere();
        return leaf;
    }
    let bent = plants_bend(plant, index, vertex % style.shape.z, plants_keep(gone));
    leaf.position = frame.view_projection * vec4<f32>(bent.place, 1.0);
    leaf.place = bent.place;
    leaf.across = bent.across;
    leaf.facing = bent.facing;
    leaf.card = vec4<f32>(plants_across(plant, bent.side), 1.0 - bent.along, bent.along, bent.lying);
    leaf.patchwork = vec4<f32>(shading_patchwork(plant.root.xz + frame.phase.xy), plant.tint);
    let away = bent.place - frame.camera.xyz;
    let clear = shading_fog(length(away), frame.camera.w);
    leaf.air = vec4<f32>(frame_air(normalize(away)) * (1.0 - clear), clear);
    leaf.layer = plant.layer;
    leaf.above = bent.place.y - plant.root.y;
    return leaf;
}

// A card's picture at a place; where the card is nearly seen on edge, alpha is less.
fn leaves_texel(at: vec2<f32>, layer: u32, facing: vec3<f32>, view: vec3<f32>) -> vec4<f32> {
    let level = shading_level(dpdx(at) * 256.0, dpdy(at) * 256.0);
    var texel = textureSampleLevel(clumps, clump_sampler, at, layer, level);
    texel.a *= shading_on_edge(facing, view);
    return texel;
}

// Share of the pixel that a leaf of this alpha covers.
fn leaves_coverage(alpha: f32, distance: f32) -> f32 {
    return shading_rim(alpha, fwidth(alpha), style.mean.w, distance);
}

@fragment
fn plants_fragment(leaf: Leaf) -> @location(0) vec4<f32> {
    let to_eye = frame.camera.xyz - leaf.place;
    let distance = length(to_eye);
    let view = normalize(to_eye);
    let texel = leaves_texel(leaf.card.xy, leaf.layer, leaf.facing, view);
    let alpha = leaves_coverage(texel.a, distance);
    if alpha < 0.1 {
        discard;
    }
    let species = ShadingSpecies(style.root, style.tip, style.mean);
    let card = ShadingCard(leaf.across, leaf.facing, leaf.card.z, leaf.card.w, leaf.patchwork.xyz, leaf.patchwork.w);
    let lit = shadows_lit(shadows_place(leaf.place, 0.10), 2.2, SHADING_MEAN_LIT);
    let colour = frame_foliage(species, card, texel, view, distance, lit, leaf.place, leaf.above);
    return vec4<f32>(leaf.air.rgb + colour * leaf.air.a, alpha);
}
