// A pixel of a blade. Twin: blade.rs (Belyaev et al. 2011, §2.3), where everything is explained.

struct BladeStyle {
    root: vec4<f32>,  // rgb; w = dryness
    tip: vec4<f32>,   // rgb; w = translucency
    light: vec4<f32>, // exponent of the sun's falloff, light of the sky at the root, silhouette, distance where plants end
    shape: vec4<u32>, // pieces, vec4s of a record, vec4 of the first record, level
}

struct BladeSpot {
    facing: vec3<f32>,
    across: vec3<f32>,
    side: f32,   // −1 .. 1
    along: f32,  // 0 root .. 1 tip
    ground: vec3<f32>,
    patchwork: vec3<f32>,
    tint: f32,
}

// What of a blade does not depend on light.
struct BladeSurface {
    albedo: vec3<f32>,
    normal: vec3<f32>,
    along: f32,
    far: f32,
    open: f32,
}

fn shading_blade_surface(style: BladeStyle, spot: BladeSpot, view: vec3<f32>, distance: f32) -> BladeSurface {
    let far = smoothstep(0.25 * style.light.w, 0.7 * style.light.w, distance);
    let along = clamp(spot.along, 0.0, 1.0);
    var normal = normalize(spot.facing + spot.across * (0.55 * spot.side));
    normal = normal * select(1.0, -1.0, dot(normal, view) < 0.0);
    let dry = style.root.w + 0.55 * spot.patchwork.y + 0.9 * max(spot.tint - 0.86, 0.0) / 0.14 * sqrt(style.root.w);
    let shade = 0.80 + 0.40 * fract(spot.tint * 7.0);
    let albedo = shading_leaf(style.root.rgb, style.tip.rgb, mix(along, 0.6, far), dry, spot.patchwork, shade);
    let open = mix(style.light.y + along * (1.0 - style.light.y), 0.75, far);
    return BladeSurface(albedo, normal, along, far, open);
}

fn shading_blade(style: BladeStyle, spot: BladeSpot, view: vec3<f32>, distance: f32, light: ShadingLight, lit: f32) -> vec3<f32> {
    return shading_blade_shine(style, spot, shading_blade_surface(style, spot, view, distance), view, light, lit);
}

fn shading_blade_shine(style: BladeStyle, spot: BladeSpot, surface: BladeSurface, view: vec3<f32>, light: ShadingLight, lit: f32) -> vec3<f32> {
    let albedo = surface.albedo;
    let normal = surface.normal;
    let along = surface.along;
    let far = surface.far;
    let open = surface.open;
    let sun = light.sun_colour * (lit * mix(pow(along, style.light.x), 0.6, far));
    let facing = dot(normal, light.sun);
    let front = max(facing, 0.0);
    let back = max(-facing, 0.0);
    let sky = mix(light.ground, light.sky, 0.5 + 0.5 * normal.y);
    let passed = albedo * vec3<f32>(1.15, 1.35, 0.40) * style.tip.w;
    let glance = max(dot(normal, normalize(light.sun + view)), 0.0);
    let glance_2 = glance * glance;
    let glance_8 = glance_2 * glance_2 * glance_2 * glance_2;
    let shine = glance_8 * glance_8 * front;
    let flat_angle = 1.0 - max(dot(spot.ground, view), 0.0);
    let flat_2 = flat_angle * flat_angle;
    let rim = flat_2 * flat_2 * flat_2 * flat_2 * flat_2;
    let third = along * along * along;
    let silhouette = (0.35 * light.sky + light.sun_colour * (0.08 * lit)) * (style.light.z * third * third * rim * (1.0 - far));
    return albedo * (sun * (front * 0.31830987) + sky * open) + passed * sun * (back * 0.31830987) + sun * (0.04 * shine) + silhouette;
}

// Share of a pixel that a blade covers where it is narrower than a pixel.
fn shading_blade_coverage(width: f32, pixel: f32, tint: f32) -> f32 {
    let share = width / max(pixel, 1e-9);
    let chance = fract(tint * 61.7) - 0.5;
    return clamp(share + select(0.0, 0.24 * chance, share < 1.0), 0.0, 1.0);
}
