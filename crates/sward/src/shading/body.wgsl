// Light on bodies: lacquer, rubber, glass and chrome.

// What a mirror facing `direction` would see.
fn shading_mirrored(direction: vec3<f32>, roughness: f32, light: ShadingLight, haze: f32) -> vec3<f32> {
    return shading_reflected(direction, roughness, light, shading_sky(shading_mirror_level(direction), light.sun, haze));
}

// Where a mirror looks in the sky: never below the horizon.
fn shading_mirror_level(direction: vec3<f32>) -> vec3<f32> {
    return normalize(vec3<f32>(direction.x, max(direction.y, 0.02), direction.z));
}

// What a mirror facing `direction` would see of a sky that has the radiance `seen` in the level direction.
fn shading_reflected(direction: vec3<f32>, roughness: f32, light: ShadingLight, seen: vec3<f32>) -> vec3<f32> {
    let above = mix(seen, light.sky, roughness);
    return mix(light.ground * 0.8, above, smoothstep(-0.08 - 0.4 * roughness, 0.06 + 0.4 * roughness, direction.y));
}

// Radiance of a body. `normal` faces the viewer. `surface`: roughness, gloss, openness to the sky; `lit`: share of the sun that arrives.
fn shading_body(colour: vec3<f32>, surface: vec3<f32>, normal: vec3<f32>, view: vec3<f32>, light: ShadingLight, haze: f32, lit: f32) -> vec3<f32> {
    let mirrored = shading_mirrored(reflect(-view, normal), surface.x, light, haze);
    return shading_body_seeing(colour, surface, normal, view, light, lit, mirrored);
}

// The same; `mirrored`: what a mirror there would see.
fn shading_body_seeing(colour: vec3<f32>, surface: vec3<f32>, normal: vec3<f32>, view: vec3<f32>, light: ShadingLight, lit_: f32, mirrored: vec3<f32>) -> vec3<f32> {
    let roughness = surface.x;
    let gloss = surface.y;
    let open = surface.z;
    let lit = lit_ * max(dot(normal, light.sun), 0.0);
    let half_way = normalize(light.sun + view);
    let grazing = pow(1.0 - max(dot(normal, view), 0.0), 5.0);
    let fresnel = gloss + (1.0 - gloss) * grazing * (1.0 - roughness) * (1.0 - roughness);
    let sharp = 2.0 / max(roughness * roughness * roughness * roughness, 1e-4);
    let lobe = min((sharp + 8.0) * 0.0398, 60.0) * pow(max(dot(normal, half_way), 0.0), sharp);
    let sky = mix(light.ground, light.sky, 0.5 + 0.5 * normal.y) * open;
    let diffuse = colour * (1.0 - fresnel) * (light.sun_colour * (lit * 0.31830987) + sky);
    let mirror = mirrored * fresnel * open;
    let tinted = mix(vec3<f32>(1.0), colour * 1.6, step(0.3, gloss));
    return diffuse + tinted * (mirror + light.sun_colour * (lit * lobe * gloss));
}
