// Light on leaves: reflected, let through, and lost between the stems.

struct ShadingLight {
    sun: vec3<f32>,        // unit, towards the sun
    sun_colour: vec3<f32>, // irradiance of a surface facing the sun
    sky: vec3<f32>,        // mean radiance of the upper half
    ground: vec3<f32>,     // mean radiance of the lower half
}

const SHADING_STRAW: vec3<f32> = vec3<f32>(0.36, 0.29, 0.14);

// Colour of a leaf. `along` 0 root .. 1 tip, `dry` 0..1, `patchwork` from shading_patchwork, `shade` of the blade.
fn shading_leaf(root: vec3<f32>, tip: vec3<f32>, along: f32, dry: f32, patchwork: vec3<f32>, shade: f32) -> vec3<f32> {
    let yellow = vec3<f32>(1.0 + 0.34 * patchwork.x, 1.0 + 0.08 * patchwork.x, 1.0 - 0.30 * patchwork.x);
    let green = mix(root, tip, along) * yellow;
    let straw = SHADING_STRAW * (0.55 + 0.45 * along);
    return mix(green, straw, clamp(dry, 0.0, 1.0)) * (shade * patchwork.z);
}

// Radiance of a leaf. `normal` faces the viewer; `lit` is the share of sunlight that reaches it; `open` the share of sky.
// Leaves let through yellower light than they reflect, and more of it than any wall would.
fn shading_grass(albedo: vec3<f32>, normal: vec3<f32>, view: vec3<f32>, light: ShadingLight, lit: f32, open: f32, through: f32) -> vec3<f32> {
    let facing = dot(normal, light.sun);
    let front = max(facing, 0.0);
    let back = max(-facing, 0.0);
    let passed = albedo * vec3<f32>(1.15, 1.35, 0.40) * through;
    let half_way = normalize(light.sun + view);
    let shine = pow(max(dot(normal, half_way), 0.0), 18.0) * front;
    let sky = mix(light.ground, light.sky, 0.5 + 0.5 * normal.y);
    // Lying leaves seen at a flat angle mirror the sky, more of it towards the sun: that is what makes a track shine.
    let flat_angle = 1.0 - max(dot(normal, view), 0.0);
    let towards = max(dot(normalize(light.sun.xz + vec2<f32>(1e-6, 0.0)), normalize(-view.xz + vec2<f32>(1e-6, 0.0))), 0.0);
    let mirrored = 0.45 * light.sky + light.sun_colour * (0.012 + 0.028 * towards * towards);
    let mirror = mirrored * (0.07 * open * max(normal.y, 0.0) * flat_angle * flat_angle * flat_angle);
    let diffuse = albedo * (light.sun_colour * (lit * front * 0.31830987) + sky * open);
    return diffuse + passed * light.sun_colour * (lit * back * 0.31830987) + light.sun_colour * (lit * shine * 0.035) + mirror;
}
