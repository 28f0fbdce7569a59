// Sky, sun and clouds: single scattering in a thin shell, by hand-fitted air masses. Twin of the colour part: sky.rs.

const SHADING_SUN: f32 = 20.0;
const SHADING_RAYLEIGH: vec3<f32> = vec3<f32>(0.049, 0.115, 0.281);

fn shading_air_mass(up: f32) -> f32 {
    let y = max(up, 0.0);
    return 1.0 / (y + 0.028 * exp(-9.0 * y));
}

fn shading_mie(haze: f32) -> f32 {
    return 0.012 + 0.075 * haze;
}

// Share of the sun's light that arrives through `share` of the air along its way.
fn shading_sun_share(sun_up: f32, haze: f32, share: f32) -> vec3<f32> {
    let depth = SHADING_RAYLEIGH + vec3<f32>(shading_mie(haze));
    return exp(-depth * (share * shading_air_mass(sun_up)));
}

// Radiance of clear air towards `direction` (unit).
fn shading_sky(direction: vec3<f32>, sun: vec3<f32>, haze: f32) -> vec3<f32> {
    let mie = shading_mie(haze);
    let cosine = dot(direction, sun);
    let up = clamp(direction.y, 0.0, 1.0);
    let depth = SHADING_RAYLEIGH + vec3<f32>(mie);
    let opacity = vec3<f32>(1.0) - exp(-depth * shading_air_mass(direction.y));
    let rayleigh = 0.0597 * (1.0 + cosine * cosine);
    let g = 0.70;
    let forward = 0.0796 * (1.0 - g * g) / pow(1.0 + g * g - 2.0 * g * cosine, 1.5);
    let phase = (SHADING_RAYLEIGH * rayleigh + vec3<f32>(mie * forward)) / depth;
    let share = mix(1.55, 0.18, sqrt(up));
    let direct = phase * shading_sun_share(sun.y, haze, share);
    // Light scattered many times has lost its direction and most of its colour.
    let diffuse = vec3<f32>(0.026, 0.030, 0.038) * (0.35 + 0.65 * shading_sun_share(sun.y, haze, 0.5));
    return SHADING_SUN * opacity * (direct + diffuse * (1.0 - 0.5 * up));
}

// Colour that the air adds between the eye and far away, by direction of the ray.
fn shading_air(ray: vec3<f32>, sun: vec3<f32>, haze: f32) -> vec3<f32> {
    let air = shading_sky(normalize(vec3<f32>(ray.x, max(ray.y, 0.0) + 0.03, ray.z)), sun, haze);
    // Near the sun the glow of near air is softer than that of the whole sky behind it.
    return air * (0.80 / (1.0 + 0.10 * dot(air, vec3<f32>(0.3, 0.6, 0.1))));
}

// The disc and its glare.
fn shading_sun_disc(direction: vec3<f32>, sun: vec3<f32>, haze: f32) -> vec3<f32> {
    let cosine = dot(direction, sun);
    let disc = smoothstep(0.99988, 0.99996, cosine);
    let glare = 0.06 * exp(-(1.0 - cosine) * 1200.0) + 0.008 * exp(-(1.0 - cosine) * 80.0);
    return SHADING_SUN * shading_sun_share(sun.y, haze, 1.2) * (6.0 * disc + glare * (1.0 + haze));
}

fn shading_cloud_density(p: vec2<f32>) -> f32 {
    var sum = 0.0;
    var weight = 0.5;
    var q = p;
    for (var octave = 0u; octave < 5u; octave++) {
        sum += weight * shading_noise(q, 256, 40u + octave);
        weight *= 0.5;
        q = vec2<f32>(0.8 * q.x - 0.6 * q.y, 0.6 * q.x + 0.8 * q.y) * 2.03 + 7.3;
    }
    return sum;
}

// Clouds over clear air: returns colour and how much of the air behind is hidden.
fn shading_clouds(direction: vec3<f32>, sun: vec3<f32>, haze: f32, cover: f32, drift: vec2<f32>) -> vec4<f32> {
    let up = max(direction.y, 0.0);
    let plane = direction.xz / (up + 0.10);
    let density = shading_cloud_density(plane * 0.9 + drift);
    let threshold = mix(0.68, 0.30, cover);
    let body = smoothstep(threshold, threshold + 0.22, density);
    let toward = direction.xz + sun.xz * 0.06;
    let lit = shading_cloud_density((toward / (up + 0.10)) * 0.9 + drift);
    let depth = clamp((lit - threshold) * 3.2, 0.0, 1.0);
    let cosine = dot(direction, sun);
    let silver = 0.10 + 0.55 * pow(max(0.5 + 0.5 * cosine, 0.0), 9.0);
    let light = SHADING_SUN * 1.5 * shading_sun_share(sun.y, haze, 1.2) * silver * exp(-2.2 * depth);
    let shade = shading_sky(vec3<f32>(0.0, 1.0, 0.0), sun, haze) * 1.1 + 0.25 * shading_sky(normalize(vec3<f32>(direction.x, 0.05, direction.z)), sun, haze);
    // Far clouds sink into the haze of the horizon.
    let near = smoothstep(0.015, 0.22, up);
    return vec4<f32>(light + shade, body * near * (0.92 - 0.3 * (1.0 - depth)));
}

// Ridges at the edge of the world: elevation of the skyline as the tangent of its angle, for a ridge of `salt`.
fn shading_ridge(direction: vec3<f32>, salt: u32, base: f32, relief: f32) -> f32 {
    let turn = atan2(direction.z, direction.x) * (64.0 / 6.2831853) + 32.0;
    let p = vec2<f32>(turn, 0.5);
    let shape = 0.55 * shading_noise(p * 0.5, 32, salt) + 0.28 * shading_noise(p, 64, salt + 1u)
        + 0.12 * shading_noise(p * 4.0, 256, salt + 2u) + 0.05 * shading_noise(p * 16.0, 1024, salt + 3u);
    return base + relief * shape;
}

// The whole backdrop: air, sun, clouds and two blue ridges.
fn shading_backdrop(direction: vec3<f32>, sun: vec3<f32>, haze: f32, cover: f32, drift: vec2<f32>) -> vec3<f32> {
    let air = shading_sky(direction, sun, haze);
    let clouds = shading_clouds(direction, sun, haze, cover, drift);
    var colour = mix(air + shading_sun_disc(direction, sun, haze), clouds.rgb, clouds.a);
    let slope = direction.y / max(length(direction.xz), 1e-4);
    let level = shading_sky(normalize(vec3<f32>(direction.x, 0.02, direction.z)), sun, haze);
    let soft = 0.0012;
    let far = smoothstep(-soft, soft, shading_ridge(direction, 71u, 0.012, 0.055) - slope);
    colour = mix(colour, level * vec3<f32>(0.66, 0.72, 0.84), far);
    let near = smoothstep(-soft, soft, shading_ridge(direction, 91u, -0.006, 0.045) - slope);
    return mix(colour, level * vec3<f32>(0.50, 0.57, 0.64), near);
}
