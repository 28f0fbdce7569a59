// Directions between directions. Twin: vector.rs. Needs math.

const SPRINGS_OPPOSITE: f32 = -0.9999;
const SPRINGS_NEAR: f32 = 1e-3;

fn springs_size(a: vec3<f32>) -> f32 {
    return sqrt(dot(a, a));
}

fn springs_unit(a: vec3<f32>) -> vec3<f32> {
    let long = springs_size(a);
    if long > 1e-9 {
        return a / long;
    }
    return vec3<f32>(0.0, 1.0, 0.0);
}

fn springs_along(a: vec3<f32>, b: vec3<f32>, share: f32) -> vec3<f32> {
    let sine = springs_size(cross(a, b));
    if sine < SPRINGS_NEAR {
        return springs_unit(a + share * (b - a));
    }
    let angle = math_atan2(sine, dot(a, b));
    return springs_unit(a * (math_sin_cos(angle * (1.0 - share)).x / sine) + b * (math_sin_cos(angle * share).x / sine));
}

fn springs_between(a: vec3<f32>, b: vec3<f32>, share: f32) -> vec3<f32> {
    if dot(a, b) < SPRINGS_OPPOSITE {
        let middle = select(vec3<f32>(1.0, 0.0, 0.0), vec3<f32>(0.0, 1.0, 0.0), a.y * a.y < 0.5);
        if share < 0.5 {
            return springs_along(a, middle, 2.0 * share);
        }
        return springs_along(middle, b, 2.0 * share - 1.0);
    }
    return springs_along(a, b, share);
}
