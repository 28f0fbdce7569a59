// A pixel's mean, where shaders cannot read samples.

const RESOLVE_SAMPLES: i32 = 1;

@group(0) @binding(1) var mean: texture_2d<f32>;

fn resolve_sample(pixel: vec2<i32>, index: i32) -> vec3<f32> {
    return textureLoad(mean, pixel, 0).rgb;
}
