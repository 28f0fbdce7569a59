// Light under water. Twin: water.rs, which sinks the light of sun and sky too.

const SHADING_SCATTERED: vec3<f32> = vec3<f32>(0.020, 0.125, 0.150);

// Radiance of endless water seen along `ray` (unit), under the light that has come down to the eye.
fn shading_water(ray: vec3<f32>, light: ShadingLight) -> vec3<f32> {
    let up = 0.5 + 0.5 * ray.y;
    let arrived = light.sky + light.sun_colour * (0.20 * light.sun.y);
    return arrived * SHADING_SCATTERED * (0.35 + 1.3 * up * up);
}
