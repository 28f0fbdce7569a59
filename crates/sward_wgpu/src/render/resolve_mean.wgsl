// Where shaders cannot read samples, their mean is tone-mapped.

@group(0) @binding(1) var mean: texture_2d<f32>;

fn resolve_toned(pixel: vec2<i32>) -> vec3<f32> {
    return shading_tone(textureLoad(mean, pixel, 0).rgb * frame.forward.w);
}
