// Light on leaves and wood of shrubs and trees; that of the sun apart, since shadows move over it. Twin: crown.rs.

// Normal of a leaf as light sees it: its own, turned towards where its part of the crown faces; facing the viewer.
fn shading_crown_normal(own: vec3<f32>, outwards: vec3<f32>, view: vec3<f32>) -> vec3<f32> {
    let facing = own * select(-1.0, 1.0, dot(own, view) > 0.0);
    return normalize(facing + 0.7 * outwards + vec3<f32>(0.0, 1e-4, 0.0));
}

// Colour of a leaf that differs from leaf to leaf by `chance` and from plant to plant by `tint`, 0..1; less of it deep in the crown.
fn shading_crown_colour(colour: vec3<f32>, chance: f32, tint: f32, open: f32) -> vec3<f32> {
    let warm = 0.22 * (chance - 0.5) + 0.16 * (tint - 0.5);
    let bright = (0.82 + 0.36 * chance) * mix(0.72, 1.0, open);
    return colour * bright * vec3<f32>(1.0 + 1.3 * warm, 1.0 + 0.3 * warm, 1.0 - 0.9 * warm);
}

// Radiance in full sun; `through`: share of light let through, 0 for wood.
fn shading_crown_sun(albedo: vec3<f32>, normal: vec3<f32>, view: vec3<f32>, light: ShadingLight, through: f32) -> vec3<f32> {
    let facing = dot(normal, light.sun);
    let front = max(facing, 0.0);
    let back = max(-facing, 0.0);
    let passed = albedo * vec3<f32>(1.15, 1.35, 0.40) * through;
    let half_way = normalize(light.sun + view);
    let shine = pow(max(dot(normal, half_way), 0.0), 14.0) * front * through;
    return light.sun_colour * ((albedo * front + passed * back) * 0.31830987 + shine * 0.05);
}

// Radiance by the sky: `front` and `back` what it would make of white surfaces facing either way, `open` the share of it seen.
fn shading_crown_sky(albedo: vec3<f32>, front: vec3<f32>, back: vec3<f32>, open: f32, through: f32) -> vec3<f32> {
    // What leaves throw at each other is green.
    let around = mix(albedo * 2.2, vec3<f32>(1.0), open);
    return albedo * (front + back * vec3<f32>(1.15, 1.35, 0.40) * (0.5 * through)) * (open + 0.10 * (1.0 - open)) * around;
}
