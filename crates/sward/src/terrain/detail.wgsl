// Detail below the samples: octaves of gradient noise; twin of detail.rs, where everything is explained.

struct TerrainDetail {
    inverse_wavelength: f32,
    amplitude: f32,
    roughness: f32,
    octaves: u32,
    seed: u32,
    unused_a: u32,
    unused_b: u32,
    unused_c: u32,
}

const TERRAIN_DETAIL_PURPOSE: u32 = 0xde7a1100u;

fn terrain_detail_gradient(seed: u32, octave: u32, point: vec2<i32>) -> vec2<f32> {
    let bits = math_hash(seed, point.x, point.y, octave, TERRAIN_DETAIL_PURPOSE);
    return vec2<f32>(f32(bits & 0xffffu), f32(bits >> 16u)) * (1.0 / 32768.0) - 1.0;
}

// Value and slope per cell of one octave at the way `t` through a cell.
fn terrain_detail_noise(seed: u32, octave: u32, cell: vec2<i32>, t: vec2<f32>) -> vec3<f32> {
    let fade = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    let rise = 30.0 * t * t * (t * (t - 2.0) + 1.0);
    var value: array<f32, 4>;
    var slope: array<vec2<f32>, 4>;
    for (var k = 0; k < 4; k++) {
        let step_ = vec2<i32>(k & 1, k >> 1u);
        slope[k] = terrain_detail_gradient(seed, octave, cell + step_);
        value[k] = dot(slope[k], t - vec2<f32>(step_));
    }
    let low = mix(value[0], value[1], fade.x);
    let high = mix(value[2], value[3], fade.x);
    let inner = mix(mix(slope[0], slope[1], fade.x), mix(slope[2], slope[3], fade.x), fade.y);
    let x = inner.x + rise.x * mix(value[1] - value[0], value[3] - value[2], fade.y);
    let z = inner.y + rise.y * (high - low);
    return vec3<f32>(mix(low, high, fade.y), x, z);
}

// Height [m] and slope [m/m] at `local` metres from a place: a cell of the coarsest lattice and the way through it.
// Octaves finer than `resolved` metres fade out.
fn terrain_detail(detail: TerrainDetail, cell: vec2<i32>, way: vec2<f32>, local: vec2<f32>, resolved: f32) -> vec3<f32> {
    let place = way + local * detail.inverse_wavelength;
    let whole = floor(place);
    let first = cell + vec2<i32>(whole);
    let rest = clamp(place - whole, vec2<f32>(0.0), vec2<f32>(1.0));
    var sum = vec3<f32>(0.0);
    var weight = detail.amplitude;
    var scale = 1.0;
    for (var octave = 0u; octave < detail.octaves; octave++) {
        let inner = floor(rest * scale);
        let value = terrain_detail_noise(detail.seed, octave, (first << vec2<u32>(octave)) + vec2<i32>(inner), rest * scale - inner);
        let per_metre = scale * detail.inverse_wavelength;
        let seen = clamp(2.0 - resolved * per_metre, 0.0, 1.0);
        sum += seen * weight * vec3<f32>(value.x, value.yz * per_metre);
        weight *= detail.roughness;
        scale *= 2.0;
    }
    return sum;
}
