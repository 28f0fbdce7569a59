// Leaves, blades and ground in the light of a volume. Twin: lit.rs, where everything is explained.

const LIT_TOPS: f32 = 0.7;
const LIT_LYING: f32 = 0.55;
const LIT_PASSED: vec3<f32> = vec3<f32>(1.15, 1.35, 0.40);

// Share of the volume's height at which a leaf is lit.
fn lit_rise(up: f32, far: f32, lying: f32) -> f32 {
    return mix(mix(up, max(up, LIT_LYING), lying), max(up, LIT_TOPS), far);
}

fn lit_leaf(albedo: vec3<f32>, normal: vec3<f32>, view: vec3<f32>, light: ShadingLight, lit: f32, faces: VolumeFaces, through: f32) -> vec3<f32> {
    let front = volume_facing(faces, normal);
    let back = volume_facing(faces, -normal);
    // The volume gives what the sky gives there; sun, sheen and mirrored sun stay as they are.
    let dark = ShadingLight(light.sun, light.sun_colour, vec3<f32>(0.0), vec3<f32>(0.0));
    let sun = shading_grass(albedo, normal, view, dark, lit, front.w, through);
    let flat_angle = 1.0 - max(dot(normal, view), 0.0);
    let mirror = 0.45 * 0.07 * (max(normal.y, 0.0) * flat_angle * flat_angle * flat_angle);
    return sun + front.rgb * (albedo + mirror) + albedo * LIT_PASSED * through * back.rgb;
}

fn lit_blade(style: BladeStyle, spot: BladeSpot, surface: BladeSurface, view: vec3<f32>, light: ShadingLight, lit: f32, faces: VolumeFaces) -> vec3<f32> {
    let front = volume_facing(faces, surface.normal);
    let back = volume_facing(faces, -surface.normal);
    let closed = BladeSurface(surface.albedo, surface.normal, surface.along, surface.far, 0.0);
    let sun = shading_blade_shine(style, spot, closed, view, light, lit);
    return sun + surface.albedo * front.rgb + surface.albedo * LIT_PASSED * style.tip.w * back.rgb;
}

// `floor_`: light between the plants on the ground, `tops`: light on them.
fn lit_ground(turf: ShadingTurf, p: vec2<f32>, normal: vec3<f32>, view: vec3<f32>, distance: f32, pixel: f32, light: ShadingLight, lit: f32, floor_: VolumeFaces, tops: VolumeFaces) -> vec3<f32> {
    let above = ShadingLight(light.sun, light.sun_colour, volume_facing(tops, normal).rgb, volume_facing(tops, -normal).rgb);
    return shading_ground_under(turf, p, normal, view, distance, pixel, above, lit, volume_facing(floor_, normal).rgb);
}

fn lit_earth(colour: vec3<f32>, p: vec2<f32>, normal: vec3<f32>, view: vec3<f32>, distance: f32, pixel: f32, light: ShadingLight, lit: f32, floor_: VolumeFaces) -> vec3<f32> {
    return shading_earth_under(colour, p, normal, view, distance, pixel, light, lit, volume_facing(floor_, normal).rgb);
}
