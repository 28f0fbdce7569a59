// Each sample of a pixel is tone-mapped before the mean: bright rims stay smooth.

const RESOLVE_SAMPLES: i32 = 4;

@group(0) @binding(1) var samples: texture_multisampled_2d<f32>;

fn resolve_toned(pixel: vec2<i32>) -> vec3<f32> {
    var sum = vec3<f32>(0.0);
    for (var index = 0; index < RESOLVE_SAMPLES; index++) {
        sum += shading_tone(textureLoad(samples, pixel, index).rgb * frame.forward.w);
    }
    return sum / f32(RESOLVE_SAMPLES);
}
