// A damped oscillator, exactly. Twin: oscillation.rs, where each function is documented.

// C and S of methods 2, decay included
fn oscillation_decayed(gamma: f32, omega_squared: f32, tau: f32) -> vec2<f32> {
    let squared = omega_squared - gamma * gamma;
    let x = squared * tau * tau;
    if abs(x) < 0.01 {
        let decay = math_exp(-gamma * tau);
        return vec2<f32>(decay * (1.0 + x * (x / 24.0 - 0.5)), decay * tau * (1.0 + x * (x / 120.0 - 1.0 / 6.0)));
    }
    if squared > 0.0 {
        let frequency = sqrt(squared);
        let turned = math_sin_cos(frequency * tau);
        let decay = math_exp(-gamma * tau);
        return vec2<f32>(decay * turned.y, decay * turned.x / frequency);
    }
    let rate = sqrt(-squared);
    let fast = gamma + rate;
    let slowly = math_exp(-(omega_squared / fast) * tau);
    let quickly = math_exp(-fast * tau);
    return vec2<f32>(0.5 * (slowly + quickly), 0.5 * (slowly - quickly) / rate);
}

// (a, b, c, d): x' = a x + b v, v' = c x + d v
fn oscillation_transition(gamma_in: f32, omega_squared_in: f32, tau: f32) -> vec4<f32> {
    let gamma = math_clamped(gamma_in, 0.0, 1e6);
    let omega_squared = math_clamped(omega_squared_in, 0.0, 1e12);
    let cs = oscillation_decayed(gamma, omega_squared, math_clamped(tau, 0.0, 1e6));
    return vec4<f32>(cs.x + gamma * cs.y, cs.y, -omega_squared * cs.y, cs.x - gamma * cs.y);
}

// (deviation, velocity) after tau seconds
fn oscillation_advance(deviation: f32, velocity: f32, gamma: f32, omega_squared: f32, tau: f32) -> vec2<f32> {
    let t = oscillation_transition(gamma, omega_squared, tau);
    let x = math_clamped(deviation, -1e9, 1e9);
    let v = math_clamped(velocity, -1e9, 1e9);
    return vec2<f32>(t.x * x + t.y * v, t.z * x + t.w * v);
}
