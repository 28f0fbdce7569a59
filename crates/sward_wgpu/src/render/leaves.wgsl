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

// Mip level for a pixel. A pixel's print on a slanted card is long and narrow; its longer side alone would blur all blades into
// one, so the level follows the print's area and stays within two of the longer side's.
fn plants_level(at: vec2<f32>) -> f32 {
    let across = dpdx(at) * 256.0;
    let down = dpdy(at) * 256.0;
    let area = max(abs(across.x * down.y - across.y * down.x), 1e-6);
    let longer = max(max(dot(across, across), dot(down, down)), 1e-6);
    return max(max(0.5 * log2(area), 0.5 * log2(longer) - 2.0) - 0.35, 0.0);
}

@fragment
fn plants_fragment(leaf: Leaf) -> @location(0) vec4<f32> {
    let to_eye = frame.camera.xyz - leaf.place;
    let view = normalize(to_eye);
    // Cards that are nearly seen on edge are let go.
    let on_edge = smoothstep(0.03, 0.20, abs(dot(leaf.facing, view)));
    var texel = textureSampleLevel(clumps, clump_sampler, leaf.card.xy, leaf.layer, plants_level(leaf.card.xy));
    texel.a *= mix(0.35, 1.0, on_edge);
    // A rim one pixel wide, whatever the mip level: alpha becomes coverage of the four samples.
    let fading = 1.0 - smoothstep(0.65 * style.mean.w, 0.95 * style.mean.w, length(to_eye));
    let alpha = fading * clamp((texel.a - 0.5) / max(fwidth(texel.a), 0.02) + 0.5, 0.0, 1.0);
    if alpha < 0.1 {
        discard;
    }
    // Far off only the tops of plants are seen, whatever part of a card covers the pixel: they melt into the canopy's colour.
    let far = smoothstep(0.25 * style.mean.w, 0.7 * style.mean.w, length(to_eye));
    // The middle of a pixel may lie beyond the card's end.
    let along = clamp(leaf.card.z, 0.0, 1.0);
    let heading = (texel.b - 0.5) * 2.6;
    var normal = normalize(leaf.facing * cos(heading) + leaf.across * sin(heading) + vec3<f32>(0.0, 0.18, 0.0));
    normal = normal * select(-1.0, 1.0, dot(normal, view) > 0.0);
    let tint = leaf.patchwork.w;
    let dry = texel.g + style.root.w + 0.55 * leaf.patchwork.y + 0.3 * max(tint - 0.75, 0.0);
    let albedo = shading_leaf(style.root.rgb, style.tip.rgb, mix(along, 0.6, far), dry, leaf.patchwork.xyz, texel.r * (0.86 + 0.28 * tint));
    // Neighbours hide the sky and, with a low sun, the sun from all but the tips.
    let lying = leaf.card.w;
    let open = mix(mix(mix(style.mean.x, 1.0, along * sqrt(along)), 0.9, lying), 0.7, far);
    let reach = 1.0 - along;
    let through_canopy = mix(mix(exp(-style.mean.y * reach * reach / (0.25 + frame.sun.y)), 0.9, lying), 0.6, far);
    let lit = shadows_lit(shadows_place(leaf.place, 0.10), 2.2, PLANTS_MEAN_LIT) * through_canopy;
    let colour = shading_grass(albedo, normal, view, frame_light(), lit, open, style.tip.w);
    return vec4<f32>(leaf.air.rgb + colour * leaf.air.a, alpha);
}
