// Terrain on a grid of rings around the camera.

@group(0) @binding(4) var<uniform> turf: ShadingTurf;

@group(0) @binding(5) var<uniform> growth: GrowthBlock;
// Shades of masks, sixteen a word; from `first_edge` on edges.
@group(0) @binding(6) var<storage, read> growth_words: array<vec4<u32>>;

fn growth_edge(index: u32) -> vec4<f32> {
    return bitcast<vec4<f32>>(growth_words[growth.first_edge + index]);
}

fn growth_texel(index: u32) -> f32 {
    let word = growth_words[index / 16u][(index / 4u) % 4u];
    return f32((word >> (8u * (index % 4u))) & 255u) / 255.0;
}

// Colour of bare ground times its share, and that share.
fn growth_bare(at: vec2<f32>, blur: f32) -> vec4<f32> {
    var bare = vec4<f32>(0.0);
    for (var k = 0u; k < growth.count; k++) {
        bare = growth_taken(growth.records[k], at, blur, bare);
    }
    return bare;
}

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
    var colour = frame_ground(turf, p, normal, view, distance, lit, point.place);
    if growth.count > 0u {
        let blur = distance * frame.right.w / sqrt(max(dot(normal, view), 0.03));
        let bare = growth_bare(point.place.xz + shading_stray(p), blur);
        if bare.w > 0.0 {
            let earth = frame_earth(bare.rgb / bare.w, p, normal, view, distance, lit, point.place);
            colour = mix(colour, earth, bare.w);
        }
    }
    let clear = shading_fog(distance, frame.camera.w);
    return vec4<f32>(mix(frame_air(-view), colour, clear), 1.0);
}
