// A pixel of a plant's card: its mip level, coverage and light.

// Share of the sun that neighbours leave to a leaf, on average: holds where the shadow map does not reach.
const SHADING_MEAN_LIT: f32 = 0.62;

// What a look says about leaves.
struct ShadingSpecies {
    root: vec4<f32>, // rgb; w = dryness added to every leaf
    tip: vec4<f32>,  // rgb; w = share of light let through
    mean: vec4<f32>, // x share of the sky seen by roots, y how fast sunlight fades towards them, zw = distances where plants begin to fade and are gone
}

// A place on a card.
struct ShadingCard {
    across: vec3<f32>,
    facing: vec3<f32>,
    along: f32,            // 0 root .. 1 tip
    lying: f32,            // 0 .. 1
    patchwork: vec3<f32>,
    tint: f32,
}

// Mip level for a pixel. A pixel's print on a slanted card is long and narrow; its longer side alone would blur all blades into
// one, so the level follows the print's area and stays within two of the longer side's.
fn shading_level(across: vec2<f32>, down: vec2<f32>) -> f32 {
    let area = max(abs(across.x * down.y - across.y * down.x), 1e-6);
    let longer = max(max(dot(across, across), dot(down, down)), 1e-6);
    return max(max(0.5 * log2(area), 0.5 * log2(longer) - 2.0) - 0.35, 0.0);
}

// Cards that are nearly seen on edge are let go.
fn shading_on_edge(facing: vec3<f32>, view: vec3<f32>) -> f32 {
    return mix(0.35, 1.0, smoothstep(0.03, 0.20, abs(dot(facing, view))));
}

// A rim one pixel wide, whatever the mip level: alpha becomes coverage of the four samples.
fn shading_rim(alpha: f32, change: f32, gone: f32, distance: f32) -> f32 {
    let fading = 1.0 - smoothstep(0.65 * gone, 0.95 * gone, distance);
    return fading * clamp((alpha - 0.5) / max(change, 0.02) + 0.5, 0.0, 1.0);
}

// What of a leaf does not depend on how the sky lights it.
struct ShadingSurface {
    albedo: vec3<f32>,
    normal: vec3<f32>,
    far: f32,     // 0 .. 1 where plants melt into the canopy
    open: f32,    // share of the sky that neighbours leave
    reached: f32, // share of the sun that they leave
}

// The leaf that `texel` shows.
fn shading_surface(species: ShadingSpecies, card: ShadingCard, texel: vec4<f32>, view: vec3<f32>, distance: f32, light: ShadingLight) -> ShadingSurface {
    // Far off only the tops of plants are seen, whatever part of a card covers the pixel: they melt into the canopy's colour.
    let far = smoothstep(0.25 * species.mean.w, 0.7 * species.mean.w, distance);
    // Where a pixel's centre lies outside its triangle, the place is extrapolated: below the root there is no square root.
    let along = clamp(card.along, 0.0, 1.0);
    let heading = (texel.b - 0.5) * 2.6;
    let facing = math_sin_cos(heading);
    var normal = normalize(card.facing * facing.y + card.across * facing.x + vec3<f32>(0.0, 0.18, 0.0));
    normal = normal * select(-1.0, 1.0, dot(normal, view) > 0.0);
    let dry = texel.g + species.root.w + 0.55 * card.patchwork.y + 0.3 * max(card.tint - 0.75, 0.0);
    let shade = texel.r * (0.86 + 0.28 * card.tint);
    let albedo = shading_leaf(species.root.rgb, species.tip.rgb, mix(along, 0.6, far), dry, card.patchwork, shade);
    // Neighbours hide the sky and, with a low sun, the sun from all but the tips.
    let open = mix(mix(mix(species.mean.x, 1.0, along * sqrt(along)), 0.9, card.lying), 0.7, far);
    let reach = 1.0 - along;
    let reached = mix(mix(math_exp(-species.mean.y * reach * reach / (0.25 + light.sun.y)), 0.9, card.lying), 0.6, far);
    return ShadingSurface(albedo, normal, far, open, reached);
}

// Radiance of the leaf that `texel` shows. `lit`: share of the sun that arrives at the plant.
fn shading_foliage(species: ShadingSpecies, card: ShadingCard, texel: vec4<f32>, view: vec3<f32>, distance: f32, light: ShadingLight, lit: f32) -> vec3<f32> {
    let leaf = shading_surface(species, card, texel, view, distance, light);
    return shading_grass(leaf.albedo, leaf.normal, view, light, lit * leaf.reached, leaf.open, species.tip.w);
}
