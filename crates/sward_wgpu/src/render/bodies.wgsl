// Bodies: opaque meshes with lacquer, rubber, glass and chrome.

struct Body {
    transform: mat4x4<f32>, // body -> frame space
    paint: vec4<f32>,       // rgb of painted parts; w = ground height under the body
}

@group(0) @binding(4) var<storage, read> bodies: array<Body>;

struct Corner {
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) colour: vec4<f32>,
    @location(3) surface: vec2<f32>,
}

struct Skin {
    @builtin(position) position: vec4<f32>,
    @location(0) place: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) colour: vec3<f32>,
    @location(3) surface: vec3<f32>, // roughness, gloss, openness to the sky
}

@vertex
fn bodies_vertex(corner: Corner, @builtin(instance_index) instance: u32) -> Skin {
    let body = bodies[instance];
    let place = (body.transform * vec4<f32>(corner.position, 1.0)).xyz;
    let normal = (body.transform * vec4<f32>(corner.normal, 0.0)).xyz;
    let colour = mix(corner.colour.rgb, body.paint.rgb, corner.colour.a);
    // The ground darkens what is close above it.
    let open = smoothstep(-0.1, 0.9, place.y - body.paint.w);
    return Skin(frame.view_projection * vec4<f32>(place, 1.0), place, normal, colour, vec3<f32>(corner.surface, mix(0.35, 1.0, open)));
}

@fragment
fn bodies_fragment(skin: Skin) -> @location(0) vec4<f32> {
    let to_eye = frame.camera.xyz - skin.place;
    let distance = length(to_eye);
    let view = to_eye / max(distance, 1e-3);
    var normal = normalize(skin.normal);
    normal = normal * select(-1.0, 1.0, dot(normal, view) > 0.0);
    let lit = shadows_soft(shadows_place(skin.place + normal * 0.03, 0.03), 1.5);
    let colour = frame_body(skin.colour, skin.surface, normal, view, lit);
    let clear = shading_fog(distance, frame.camera.w);
    return vec4<f32>(mix(frame_air(-view), colour, clear), 1.0);
}

@vertex
fn bodies_shadow_vertex(corner: Corner, @builtin(instance_index) instance: u32) -> @builtin(position) vec4<f32> {
    let place = bodies[instance].transform * vec4<f32>(corner.position, 1.0);
    let at = (frame.shadow * place).xyz;
    return vec4<f32>(at.x * 2.0 - 1.0, 1.0 - at.y * 2.0, at.z, 1.0);
}
