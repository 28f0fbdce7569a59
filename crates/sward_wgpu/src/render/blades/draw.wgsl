// Blades in the main pass and in the shadow pass.

struct BladePoint {
    @builtin(position) position: vec4<f32>,
    @location(0) place: vec3<f32>,
    @location(1) across: vec3<f32>,
    @location(2) facing: vec3<f32>,
    @location(3) spot: vec4<f32>,      // side −1..1, along 0..1, share of the pixel covered, tint
    @location(4) patchwork: vec3<f32>,
    @location(5) ground: vec3<f32>,    // normal at the root
    @location(6) air: vec4<f32>,       // light the air adds, and what it leaves of the blade's
    @location(7) above: f32,           // height over the root
}

@vertex
fn blades_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) instance: u32) -> BladePoint {
    var point: BladePoint;
    let head = strip_head(vertex, instance);
    if !head.exists {
        point.position = strip_nowhere();
        return point;
    }
    let corner = strip_corner(head, head.points, vertex, head.width, frame.camera.xyz, frame.right.w);
    point.position = frame.view_projection * vec4<f32>(corner.place, 1.0);
    point.place = corner.place;
    point.across = corner.across;
    point.facing = corner.facing;
    point.spot = vec4<f32>(corner.side, corner.along, corner.cover, head.tint);
    point.patchwork = shading_patchwork(head.root.xz + frame.phase.xy);
    point.ground = normalize(vec3<f32>(-head.slope.x, 1.0, -head.slope.y));
    point.above = corner.place.y - head.root.y;
    let away = corner.place - frame.camera.xyz;
    let clear = shading_fog(length(away), frame.camera.w);
    point.air = vec4<f32>(frame_air(normalize(away)) * (1.0 - clear), clear);
    return point;
}

@fragment
fn blades_fragment(point: BladePoint) -> @location(0) vec4<f32> {
    let to_eye = frame.camera.xyz - point.place;
    let distance = length(to_eye);
    let spot = BladeSpot(point.facing, point.across, point.spot.x, point.spot.y, point.ground, point.patchwork, point.spot.w);
    let lit = shadows_lit(shadows_place(point.place, 0.10), 2.2, SHADING_MEAN_LIT);
    let colour = frame_blade(style, spot, to_eye / max(distance, 1e-9), distance, lit, point.place, point.above);
    return vec4<f32>(point.air.rgb + colour * point.air.a, point.spot.z);
}

// Width of a blade in the shadow map, where none is narrower than a texel.
fn blades_shadow_width(width: f32) -> f32 {
    return max(width, frame.sky.w);
}

@vertex
fn blades_shadow_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) instance: u32) -> @builtin(position) vec4<f32> {
    let head = strip_head(vertex, instance);
    let centre = (frame.shadow * vec4<f32>(head.root, 1.0)).xyz;
    let inside = max(abs(centre.x - 0.5), abs(centre.y - 0.5)) <= 0.52;
    let width = blades_shadow_width(head.width);
    // As many as together take as much light as all.
    if !head.exists || !inside || fract(head.tint * 37.3) * width > head.width {
        return strip_nowhere();
    }
    let corner = strip_corner(head, head.points, vertex, width, frame.camera.xyz, 0.0);
    let at = (frame.shadow * vec4<f32>(corner.place, 1.0)).xyz;
    return vec4<f32>(at.x * 2.0 - 1.0, 1.0 - at.y * 2.0, at.z, 1.0);
}
