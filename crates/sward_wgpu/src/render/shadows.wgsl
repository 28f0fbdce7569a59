// Reading the sun's shadow map.

@group(0) @binding(2) var shadow_map: texture_depth_2d;
@group(0) @binding(3) var shadow_sampler: sampler_comparison;

// Where a point lies in the shadow map. `push` metres towards the sun keep a surface from shading itself.
fn shadows_place(position: vec3<f32>, push: f32) -> vec3<f32> {
    return (frame.shadow * vec4<f32>(position + frame.sun.xyz * push, 1.0)).xyz;
}

// How sure the map is: 1 inside, falling to 0 at its rim.
fn shadows_trust(place: vec3<f32>) -> f32 {
    let rim = max(abs(place.x - 0.5), abs(place.y - 0.5));
    return frame.ground.w * (1.0 - smoothstep(0.42, 0.49, rim)) * step(place.z, 1.0);
}

// Share of the sun that arrives, four taps; `beyond` holds where the map ends.
fn shadows_lit(place: vec3<f32>, spread: f32, beyond: f32) -> f32 {
    let texel = spread / 2048.0;
    var lit = 0.0;
    for (var tap = 0u; tap < 4u; tap++) {
        let offset = vec2<f32>(f32(tap & 1u) - 0.5, f32(tap >> 1u) - 0.5) * texel;
        lit += textureSampleCompareLevel(shadow_map, shadow_sampler, place.xy + offset, place.z);
    }
    return mix(beyond, 0.25 * lit, shadows_trust(place));
}

// The same over a wider area, nine taps: soft rims on bare surfaces.
fn shadows_soft(place: vec3<f32>, spread: f32) -> f32 {
    let texel = spread / 2048.0;
    var lit = 0.0;
    for (var tap = 0; tap < 9; tap++) {
        let offset = vec2<f32>(f32(tap % 3) - 1.0, f32(tap / 3) - 1.0) * texel;
        lit += textureSampleCompareLevel(shadow_map, shadow_sampler, place.xy + offset, place.z);
    }
    return mix(1.0, lit / 9.0, shadows_trust(place));
}
