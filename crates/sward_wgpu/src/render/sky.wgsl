// The backdrop: one triangle behind everything.

struct SkyPoint {
    @builtin(position) position: vec4<f32>,
    @location(0) ray: vec3<f32>,
}

fn sky_point(index: u32) -> SkyPoint {
    let corner = vec2<f32>(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0);
    let ray = frame.forward.xyz + corner.x * frame.right.xyz + corner.y * frame.up.xyz;
    return SkyPoint(vec4<f32>(corner, 0.0, 1.0), ray);
}

@vertex
fn sky_vertex(@builtin(vertex_index) index: u32) -> SkyPoint {
    return sky_point(index);
}

@fragment
fn sky_fragment(point: SkyPoint) -> @location(0) vec4<f32> {
    let ray = normalize(point.ray);
    return vec4<f32>(frame_backdrop(ray), 1.0);
}
