// Terrain on a grid of rings around the camera.

@group(0) @binding(4) var<uniform> turf: ShadingTurf;

struct GroundPoint {
    @builtin(position) position: vec4<f32>,
    @location(0) place: vec3<f32>,
    @location(1) normal: vec3<f32>,
}

fn ground_place(p: vec2<f32>) -> vec3<f32> {
    return vec3<f32>(p.x, ground_height(p), p.y);
}

// `corner`: x, z in frame space and the grid's spacing there.
@vertex
fn ground_vertex(@location(0) corner: vec3<f32>) -> GroundPoint {
    let p = corner.xy;
    let reach = max(0.5 * corner.z, 0.4);
    let slope = vec2<f32>(
        ground_height(p + vec2<f32>(reach, 0.0)) - ground_height(p - vec2<f32>(reach, 0.0)),
        ground_height(p + vec2<f32>(0.0, reach)) - ground_height(p - vec2<f32>(0.0, reach)),
    ) / (2.0 * reach);
    let place = ground_place(p);
    return GroundPoint(frame.view_projection * vec4<f32>(place, 1.0), place, normalize(vec3<f32>(-slope.x, 1.0, -slope.y)));
}

@fragment
fn ground_fragment(point: GroundPoint) -> @location(0) vec4<f32> {
    let to_eye = frame.camera.xyz - point.place;
    let distance = length(to_eye);
    let view = to_eye / max(distance, 1e-3);
    let normal = normalize(point.normal);
    let p = point.place.xz + frame.phase.xy;
    let lit = shadows_soft(shadows_place(point.place, 0.06), 1.6);
    let colour = shading_ground(turf, p, normal, view, distance, frame.right.w, frame_light(), lit);
    let clear = shading_fog(distance, frame.camera.w);
    return vec4<f32>(mix(frame_air(-view), colour, clear), 1.0);
}
