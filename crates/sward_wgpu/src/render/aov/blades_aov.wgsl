// The outputs of blades: the same corners as in the main pass, between the points of this picture and of the one before.

struct BladeTrail {
    @builtin(position) position: vec4<f32>,
    @location(0) now: vec4<f32>,  // clip space
    @location(1) then: vec4<f32>, // clip space of the picture before
    @location(2) cover: f32,
    @location(3) @interpolate(flat) number: u32,
}

@vertex
fn blades_aov_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) instance: u32) -> BladeTrail {
    var trail: BladeTrail;
    let head = strip_head(vertex, instance);
    if !head.exists {
        trail.position = strip_nowhere();
        return trail;
    }
    let corner = strip_corner(head, head.points, vertex, head.width, frame.camera.xyz, frame.right.w);
    let before = head.points + style.shape.x + 1u;
    let was = strip_corner(head, before + 1u, vertex, head.width, frame.camera.xyz, frame.right.w);
    let clip = frame.view_projection * vec4<f32>(corner.place, 1.0);
    trail.position = clip;
    trail.now = clip;
    trail.then = aov.then * vec4<f32>(was.place, 1.0);
    trail.cover = corner.cover;
    trail.number = records[before].x;
    return trail;
}

@fragment
fn blades_aov_fragment(trail: BladeTrail) -> AovPixel {
    if trail.cover < AOV_COVERAGE {
        discard;
    }
    return aov_pixel(trail.now, trail.then, trail.number);
}
