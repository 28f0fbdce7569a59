// HDR -> one display value per pixel.

@vertex
fn resolve_vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return vec4<f32>(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

@fragment
fn resolve_fragment(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let pixel = vec2<i32>(position.xy);
    // Half a code value of noise hides the steps in a smooth sky.
    let grain = shading_hash(pixel.x, pixel.y, 5u) - 0.5;
    return vec4<f32>(shading_encode(resolve_toned(pixel)) + grain / 255.0, 1.0);
}
