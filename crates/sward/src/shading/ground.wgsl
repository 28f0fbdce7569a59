// Ground: bare turf near by, and the mean of a whole canopy further away.

// Share of the sun that upright leaves of random heading send to the viewer: x reflected, y let through.
// For leaf normals spread evenly over the half turn that faces the viewer, weighted by what is seen of them:
// with p the angle between the two horizontal directions, ((pi - p) cos p + sin p) / 4 and (sin p - p cos p) / 4.
fn shading_canopy_split(view: vec3<f32>, sun: vec3<f32>) -> vec2<f32> {
    let a = normalize(view.xz + vec2<f32>(1e-5, 0.0));
    let b = normalize(sun.xz + vec2<f32>(1e-5, 0.0));
    let cosine = clamp(dot(a, b), -1.0, 1.0);
    let angle = acos(cosine);
    let sine = sqrt(1.0 - cosine * cosine);
    let level = sqrt(max(1.0 - sun.y * sun.y, 0.0));
    return level * 0.25 * vec2<f32>((3.14159265 - angle) * cosine + sine, sine - angle * cosine);
}

// Radiance of a canopy seen from so far away that single leaves vanish. `albedo` is the leaves' mean colour.
fn shading_canopy(albedo: vec3<f32>, normal: vec3<f32>, view: vec3<f32>, light: ShadingLight, lit: f32, through: f32) -> vec3<f32> {
    let split = shading_canopy_split(view, light.sun);
    let top = max(dot(normal, light.sun), 0.0);
    let front = 0.75 * split.x + 0.25 * top;
    // Looking down, one sees the shaded depth between the tips.
    let depth = 1.0 - 0.45 * max(dot(normal, view), 0.0);
    let passed = albedo * vec3<f32>(1.15, 1.35, 0.40) * (through * 0.64 * split.y);
    let sky = mix(light.ground, light.sky, 0.62);
    return (light.sun_colour * (lit * 0.31830987 * 0.33) * (albedo * front + passed) + albedo * sky * 0.45) * depth;
}

// Brightness pattern of turf, about 1; waves shorter than `footprint` metres (one pixel on the ground) are left out.
fn shading_turf(p: vec2<f32>, footprint: f32) -> f32 {
    var sum = 0.0;
    sum += (shading_noise(p * 0.5, 512, 21u) - 0.5) * 0.25 * (1.0 - smoothstep(0.5, 2.0, footprint));
    sum += (shading_noise(p * 2.0, 2048, 22u) - 0.5) * 0.40 * (1.0 - smoothstep(0.12, 0.5, footprint));
    sum += (shading_noise(p * 8.0, 8192, 23u) - 0.5) * 0.50 * (1.0 - smoothstep(0.03, 0.12, footprint));
    sum += (shading_noise(p * 32.0, 32768, 24u) - 0.5) * 0.60 * (1.0 - smoothstep(0.008, 0.03, footprint));
    sum += (shading_noise(p * vec2<f32>(128.0, 64.0), 65536, 25u) - 0.5) * 0.9 * (1.0 - smoothstep(0.003, 0.012, footprint));
    return max(1.0 + sum, 0.15);
}

// What plants look like from afar.
struct ShadingTurf {
    root: vec4<f32>, // rgb root colour; w = mean dryness of the leaves
    tip: vec4<f32>,  // rgb tip colour; w = share of light let through
    mean: vec4<f32>, // x mean shade, y cover by plants near the camera, z distance where plants end, w unused
}

// Radiance of the ground at `p` (metres modulo SHADING_PERIOD). `pixel`: height of one pixel at distance 1; `lit`: share of the sun.
fn shading_ground(turf: ShadingTurf, p: vec2<f32>, normal: vec3<f32>, view: vec3<f32>, distance: f32, pixel: f32, light: ShadingLight, lit: f32) -> vec3<f32> {
    return shading_ground_under(turf, p, normal, view, distance, pixel, light, lit, light.sky * 0.20);
}

// The same; `floor_`: what white ground between the plants would send back of the sky's light.
fn shading_ground_under(turf: ShadingTurf, p: vec2<f32>, normal: vec3<f32>, view: vec3<f32>, distance: f32, pixel: f32, light: ShadingLight, lit: f32, floor_: vec3<f32>) -> vec3<f32> {
    let patchwork = shading_patchwork(p);
    // The longer side of a pixel's print on the ground.
    let footprint = distance * pixel / max(dot(normal, view), 0.03);
    let grain = shading_turf(p, footprint);
    let dry = turf.root.w + 0.55 * patchwork.y * (1.0 - turf.root.w);
    let leaf = shading_leaf(turf.root.rgb, turf.tip.rgb, 0.72, dry, patchwork, turf.mean.x);
    // Under near plants lies litter and shade; from afar only the canopy's mean is seen.
    let bare = 1.0 - smoothstep(0.35 * turf.mean.z, 0.9 * turf.mean.z, distance);
    let canopy = shading_canopy(leaf, normal, view, light, lit, turf.tip.w) * mix(1.0, grain, 0.6);
    let litter = mix(vec3<f32>(0.060, 0.046, 0.022), leaf * 0.7, 0.55) * grain;
    let shaded = litter * (light.sun_colour * (lit * 0.12 * max(dot(normal, light.sun), 0.0)) + floor_);
    return mix(canopy * mix(1.5, 1.0, turf.mean.y), shaded, bare * turf.mean.y);
}

// Radiance of bare earth: `colour` is what it sends back of light. The rest as in shading_ground.
fn shading_earth(colour: vec3<f32>, p: vec2<f32>, normal: vec3<f32>, view: vec3<f32>, distance: f32, pixel: f32, light: ShadingLight, lit: f32) -> vec3<f32> {
    return shading_earth_under(colour, p, normal, view, distance, pixel, light, lit, mix(light.sky, light.ground, 0.25) * 0.85);
}

// The same; `floor_`: what white ground would send back of the sky's light.
fn shading_earth_under(colour: vec3<f32>, p: vec2<f32>, normal: vec3<f32>, view: vec3<f32>, distance: f32, pixel: f32, light: ShadingLight, lit: f32, floor_: vec3<f32>) -> vec3<f32> {
    let footprint = distance * pixel / max(dot(normal, view), 0.03);
    let grain = shading_turf(p, footprint);
    let broad = 0.80 + 0.40 * shading_noise(p * 0.25, 256, 31u);
    let albedo = colour * (broad * (0.45 + 0.55 * grain));
    return albedo * (light.sun_colour * (lit * 0.31830987 * max(dot(normal, light.sun), 0.0)) + floor_);
}

fn shading_stray_along(p: vec2<f32>, salt: u32) -> f32 {
    return 0.30 * (shading_noise(p, 1024, salt) - 0.5) + 0.22 * (shading_noise(p * 4.0, 4096, salt + 2u) - 0.5);
}

// How far the rim of bare ground strays at `p`, m: no road has an edge like a ruler's.
fn shading_stray(p: vec2<f32>) -> vec2<f32> {
    return vec2<f32>(shading_stray_along(p, 32u), shading_stray_along(p, 33u));
}
