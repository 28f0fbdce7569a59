// The sky's outputs: infinitely far, so that only turning the camera moves it. Its depth is written as 0, which no surface has.

@vertex
fn sky_aov_vertex(@builtin(vertex_index) index: u32) -> SkyPoint {
    return sky_point(index);
}

@fragment
fn sky_aov_fragment(point: SkyPoint) -> AovPixel {
    let pixel = aov_pixel(frame.view_projection * vec4<f32>(point.ray, 0.0), aov.then * vec4<f32>(point.ray, 0.0), 0u);
    return AovPixel(0.0, pixel.motion, 0u);
}
