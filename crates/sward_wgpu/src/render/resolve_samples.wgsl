// A pixel's samples, as the main pass left them.

const RESOLVE_SAMPLES: i32 = 4;

@group(0) @binding(1) var samples: texture_multisampled_2d<f32>;

fn resolve_sample(pixel: vec2<i32>, index: i32) -> vec3<f32> {
    return textureLoad(samples, pixel, index).rgb;
}
