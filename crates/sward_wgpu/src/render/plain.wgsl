// Light of sun and sky as the scene's settings give them. In a picture of the surroundings: surroundings.wgsl, with the same functions.

// Colour that the air adds between the eye and far away, by direction of the ray.
fn frame_air(ray: vec3<f32>) -> vec3<f32> {
    if frame.detail.w > 0.0 {
        return shading_water(ray, frame_light());
    }
    return shading_air(ray, frame.sun.xyz, frame.sun.w);
}

fn frame_backdrop(ray: vec3<f32>) -> vec3<f32> {
    if frame.detail.w > 0.0 {
        return shading_water(ray, frame_light());
    }
    return shading_backdrop(ray, frame.sun.xyz, frame.sun.w, frame.sun_colour.w, frame.phase.zw);
}

// `above`: height of `place` over its root.
fn frame_foliage(species: ShadingSpecies, card: ShadingCard, texel: vec4<f32>, view: vec3<f32>, distance: f32, lit: f32, place: vec3<f32>, above: f32) -> vec3<f32> {
    return shading_foliage(species, card, texel, view, distance, frame_light(), lit);
}

fn frame_blade(style: BladeStyle, spot: BladeSpot, view: vec3<f32>, distance: f32, lit: f32, place: vec3<f32>, above: f32) -> vec3<f32> {
    return shading_blade(style, spot, view, distance, frame_light(), lit);
}

fn frame_ground(turf: ShadingTurf, p: vec2<f32>, normal: vec3<f32>, view: vec3<f32>, distance: f32, lit: f32, place: vec3<f32>) -> vec3<f32> {
    return shading_ground(turf, p, normal, view, distance, frame.right.w, frame_light(), lit);
}

fn frame_earth(colour: vec3<f32>, p: vec2<f32>, normal: vec3<f32>, view: vec3<f32>, distance: f32, lit: f32, place: vec3<f32>) -> vec3<f32> {
    return shading_earth(colour, p, normal, view, distance, frame.right.w, frame_light(), lit);
}

// Light of the sky on a crown's leaf or wood.
fn frame_crown_sky(albedo: vec3<f32>, normal: vec3<f32>, open: f32, through: f32, place: vec3<f32>) -> vec3<f32> {
    let front = mix(frame.ground.rgb, frame.sky.rgb, 0.5 + 0.5 * normal.y);
    let back = mix(frame.ground.rgb, frame.sky.rgb, 0.5 - 0.5 * normal.y);
    return shading_crown_sky(albedo, front, back, open, through);
}

fn frame_body(colour: vec3<f32>, surface: vec3<f32>, normal: vec3<f32>, view: vec3<f32>, lit: f32) -> vec3<f32> {
    return shading_body(colour, surface, normal, view, frame_light(), frame.sun.w, lit);
}
