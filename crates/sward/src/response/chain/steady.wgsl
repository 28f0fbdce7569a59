// How an upright blade stands in steady wind. Twin: steady.rs.
// The host declares `fn steady_load(index: u32) -> vec2<f32>`.

const STEADY_SPEEDS: u32 = 64u;
const STEADY_TOP: f32 = 64.0;

struct SteadyBlade {
    bends: array<vec2<f32>, 8>,
    moments: array<vec2<f32>, 8>,
}

fn steady_at(wind: vec2<f32>) -> SteadyBlade {
    var found: SteadyBlade;
    let speed = sqrt(wind.x * wind.x + wind.y * wind.y);
    let place = math_lower(sqrt(speed * (1.0 / STEADY_TOP)) * f32(STEADY_SPEEDS - 1u), f32(STEADY_SPEEDS - 1u));
    let below = min(u32(place), STEADY_SPEEDS - 2u);
    let along = wind.yx / math_upper(speed, 1e-9);
    for (var i = 0u; i < CHAIN_MOST_SEGMENTS; i++) {
        let a = steady_load(below * CHAIN_MOST_SEGMENTS + i);
        let b = steady_load((below + 1u) * CHAIN_MOST_SEGMENTS + i);
        let value = a + (b - a) * (place - f32(below));
        found.bends[i] = value.x * along;
        found.moments[i] = value.y * along;
    }
    return found;
}
