// How plants that swing stand in the wind. Twin: air.rs, where everything is explained.
// The host declares `fn air_load(index: u32) -> f32`: a texel's value.

struct Air {
    around: array<u32, 9>,
    weights: vec4<f32>,
    patch_side: f32,
}

const AIR_NONE: u32 = 0xffffffffu;

fn air_asleep(co: OscillatorCoefficients, air: Air) -> bool {
    var asleep = true;
    for (var k = 0u; k < 9u; k++) {
        asleep = asleep && air.around[k] == AIR_NONE;
    }
    return asleep || co.texels == 0u;
}

// Whether the moment's wind must be known
fn air_asks(co: OscillatorCoefficients, air: Air) -> bool {
    var asks = any(air.weights != vec4<f32>(1.0)) || co.texels == 0u;
    for (var k = 0u; k < 9u; k++) {
        asks = asks || air.around[k] == AIR_NONE;
    }
    return asks;
}

fn air_texel(co: OscillatorCoefficients, air: Air, at: vec2<i32>, behind: f32, still: vec2<f32>) -> vec2<f32> {
    let side = i32(co.texels);
    let over = select(vec2<i32>(0), vec2<i32>(1), at >= vec2<i32>(side)) - select(vec2<i32>(0), vec2<i32>(1), at < vec2<i32>(0));
    var around = air.around;
    let slot = around[u32((over.y + 1) * 3 + over.x + 1)];
    if slot == AIR_NONE {
        return still;
    }
    let area = co.texels * co.texels;
    let own = vec2<u32>(at - over * side);
    let first = slot * 4u * area + own.y * co.texels + own.x;
    let now = vec2<f32>(air_load(first), air_load(first + area));
    let before = vec2<f32>(air_load(first + 2u * area), air_load(first + 3u * area));
    return now + (before - now) * behind;
}

// `still`: tilt in the moment's wind; it counts where air_asks says so
fn air_at(co: OscillatorCoefficients, air: Air, local: vec2<f32>, behind: f32, still: vec2<f32>) -> vec2<f32> {
    if air_asleep(co, air) {
        return still;
    }
    let at = local / air.patch_side * f32(co.texels) - 0.5;
    let corner = vec2<i32>(floor(at));
    let f = at - vec2<f32>(corner);
    let a = air_texel(co, air, corner, behind, still);
    let b = air_texel(co, air, corner + vec2<i32>(1, 0), behind, still);
    let c = air_texel(co, air, corner + vec2<i32>(0, 1), behind, still);
    let d = air_texel(co, air, corner + vec2<i32>(1, 1), behind, still);
    let w = air.weights;
    let place = local / air.patch_side;
    let near = w.x + (w.y - w.x) * place.x;
    let far = w.z + (w.w - w.z) * place.x;
    let weight = near + (far - near) * place.y;
    let low = a + (b - a) * f.x;
    let high = c + (d - c) * f.x;
    let tilt = low + (high - low) * f.y;
    if air_asks(co, air) {
        return still + (tilt - still) * weight;
    }
    return tilt;
}
