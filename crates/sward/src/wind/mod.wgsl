// The wind of a place, and how far plants lean in it; twin of wind/mod.rs.

// The bend at which a plant rests in a wind [m/s]: atan(k_w |W|^(4/3)) along W.
fn wind_equilibrium(wind: vec2<f32>, k_w: f32) -> vec2<f32> {
    let speed = sqrt(wind.x * wind.x + wind.y * wind.y);
    let lean = math_atan(k_w * speed * math_cbrt(speed));
    return wind * (lean / math_upper(speed, 1e-9));
}
