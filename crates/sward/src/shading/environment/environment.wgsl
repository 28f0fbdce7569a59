// Directions in a picture of the surroundings, and what follows from it for air and sun. Twin: environment/mod.rs.

// Where a direction (unit) lies in a picture that is turned by `turn`: u once round, v from straight up to straight down.
fn environment_place(direction: vec3<f32>, turn: f32) -> vec2<f32> {
    let round = (math_atan2(direction.z, direction.x) - turn) * 0.15915494 + 0.5;
    return vec2<f32>(round - floor(round), math_atan2(length(direction.xz), direction.y) * 0.31830987);
}

// Colour that the air adds between the eye and far away: the horizon's.
fn environment_air(horizon: array<vec4<f32>, 5>, ray: vec3<f32>) -> vec3<f32> {
    let way = ray.xz / max(length(ray.xz), 1e-6);
    let waves = horizon[0].rgb + horizon[1].rgb * way.x + horizon[2].rgb * way.y
        + horizon[3].rgb * (way.x * way.x - way.y * way.y) + horizon[4].rgb * (2.0 * way.x * way.y);
    return max(waves, 0.15 * horizon[0].rgb);
}

// The disc of the sun: `disc` is its radiance, `cosine` that of its radius.
fn environment_disc(direction: vec3<f32>, sun: vec3<f32>, disc: vec3<f32>, cosine: f32) -> vec3<f32> {
    return disc * smoothstep(-0.2, 0.2, (dot(direction, sun) - cosine) / (1.0 - cosine));
}
