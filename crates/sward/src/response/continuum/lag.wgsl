// Upper segments follow the lowest one late. Twin: lag.rs (Chen & Johan eq. 7-9, and the cascade).

struct LagCoefficients {
    segments: u32,
    kind: u32,
    gain_top: f32,
    gain_recover: f32,
    gamma_top: f32,
    gamma_recover: f32,
    ring: u32,
    rate: f32,
}

fn lag_delay(lag: LagCoefficients, segment: u32, gamma: f32) -> f32 {
    return gamma * f32(segment) / f32(lag.segments - 1u);
}

/// One step of the cascade for one segment: `below` is the new bend of the segment under it.
fn lag_cascade(lag: LagCoefficients, below: vec2<f32>, here: vec2<f32>) -> vec2<f32> {
    let recovering = below.x * below.x + below.y * below.y < here.x * here.x + here.y * here.y;
    return here + select(lag.gain_top, lag.gain_recover, recovering) * (below - here);
}

/// Steps back in the ring for a delay.
fn lag_steps(lag: LagCoefficients, segment: u32, gamma: f32) -> u32 {
    return min(u32(lag_delay(lag, segment, gamma) * lag.rate + 0.5), lag.ring - 1u);
}

fn lag_look_up_offset(lag: LagCoefficients, segment: u32, bend: vec2<f32>, rate: vec2<f32>, speed: f32) -> vec2<f32> {
    let size = sqrt(rate.x * rate.x + rate.y * rate.y);
    if size < 1e-3 {
        return vec2<f32>(0.0);
    }
    let recovering = bend.x * rate.x + bend.y * rate.y < 0.0;
    let delay = lag_delay(lag, segment, select(lag.gamma_top, lag.gamma_recover, recovering));
    let reach = min(delay, CONTINUUM_HALF_PI / size) * speed / size;
    return reach * rate;
}
