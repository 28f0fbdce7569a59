// Recovery by directions. Twin: recover.rs, where everything is explained. Needs math, sheet.

fn springs_time_left(co: SpringsCoefficients, steps: u32) -> f32 {
    return math_clamped(1.0 - f32(steps) * co.dt / co.recover, 0.0, 1.0);
}

fn springs_share_left(co: SpringsCoefficients, steps: u32) -> f32 {
    let t = springs_time_left(co, steps);
    return select(t * t * (3.0 - 2.0 * t), t * t * t, co.cubic == 1u);
}
