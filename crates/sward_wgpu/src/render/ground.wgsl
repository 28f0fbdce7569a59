// Terrain on a grid of rings around the camera.

struct Turf {
    root: vec4<f32>, // rgb root colour; w = mean dryness of the leaves
    tip: vec4<f32>,  // rgb tip colour; w = share of light let through
    mean: vec4<f32>, // x mean shade, y cover by plants near the camera, z distance where plants end, w share of the plant's height seen
}

@group(0) @binding(4) var<uniform> turf: Turf;

struct GroundPoint {
    @builtin(position) position: vec4<f32>,
    @location(0) place: vec3<f32>,
    @location(1) normal: vec3<f32>,
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
    let place = vec3<f32>(p.x, ground_height(p), p.y);
    return GroundPoint(frame.view_projection * vec4<f32>(place, 1.0), place, normalize(vec3<f32>(-slope.x, 1.0, -slope.y)));
}

@fragment
fn ground_fragment(point: GroundPoint) -> @location(0) vec4<f32> {
    let to_eye = frame.camera.xyz - point.place;
    let distance = length(to_eye);
    let view = to_eye / max(distance, 1e-3);
    let normal = normalize(point.normal);
    let p = point.place.xz + frame.phase.xy;
    let light = frame_light();
    let patchwork = shading_patchwork(p);
    // The longer side of a pixel's print on the ground.
    let footprint = distance * frame.right.w / max(dot(normal, view), 0.03);
    let grain = shading_turf(p, footprint);
    let dry = turf.root.w + 0.55 * patchwork.y * (1.0 - turf.root.w);
    let leaf = shading_leaf(turf.root.rgb, turf.tip.rgb, 0.72, dry, patchwork, turf.mean.x);
    let lit = shadows_soft(shadows_place(point.place, 0.06), 1.6);
    // Under near plants lies litter and shade; from afar only the canopy's mean is seen.
    let bare = 1.0 - smoothstep(0.35 * turf.mean.z, 0.9 * turf.mean.z, distance);
    let canopy = shading_canopy(leaf, normal, view, light, lit, turf.tip.w) * mix(1.0, grain, 0.6);
    let litter = mix(vec3<f32>(0.060, 0.046, 0.022), leaf * 0.7, 0.55) * grain;
    let shaded = litter * (light.sun_colour * (lit * 0.12 * max(dot(normal, light.sun), 0.0)) + light.sky * 0.20);
    let colour = mix(canopy * mix(1.5, 1.0, turf.mean.y), shaded, bare * turf.mean.y);
    let clear = shading_fog(distance, frame.camera.w);
    return vec4<f32>(mix(frame_air(-view), colour, clear), 1.0);
}
