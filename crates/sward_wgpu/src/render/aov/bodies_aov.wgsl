// The outputs of bodies.

struct BodyThen {
    transform: mat4x4<f32>, // body -> frame space, in the picture before
    number: vec4<u32>,      // x: of the body in the scene, from 1
}

@group(0) @binding(10) var<storage, read> bodies_then: array<BodyThen>;

// `then`: where the corner was in the body.
@vertex
fn bodies_aov_vertex(corner: Corner, @location(4) then: vec3<f32>, @builtin(instance_index) instance: u32) -> AovPoint {
    let body = bodies_then[instance];
    let now = (bodies[instance].transform * vec4<f32>(corner.position, 1.0)).xyz;
    return aov_point(now, (body.transform * vec4<f32>(then, 1.0)).xyz, body.number.x);
}
