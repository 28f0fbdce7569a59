// The outputs of plants: the same corners and leaves as in the main pass, between the joints of this picture and of the one before.

@group(0) @binding(10) var<storage, read> plants_then: array<Plant>; // `layer` is the plant's number
@group(0) @binding(11) var<storage, read> joints_then: array<vec4<f32>>;

struct Trail {
    @builtin(position) position: vec4<f32>,
    @location(0) now: vec4<f32>,  // clip space
    @location(1) then: vec4<f32>, // clip space of the picture before
    @location(2) place: vec3<f32>,
    @location(3) facing: vec3<f32>,
    @location(4) card: vec2<f32>,
    @location(5) @interpolate(flat) layer: u32,
    @location(6) @interpolate(flat) number: u32,
}

@vertex
fn plants_aov_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) instance: u32) -> Trail {
    var trail: Trail;
    let index = instance * style.shape.w + vertex / style.shape.z;
    let plant = plants[index];
    let gone = plants_gone(plant, frame.camera.xyz);
    if plant.height <= 0.0 || gone >= 1.0 || plants_unseen(plant) {
        trail.position = plants_nowhere();
        return trail;
    }
    let corner = vertex % style.shape.z;
    let bent = plants_bend(plant, index, corner, plants_keep(gone));
    let before = plants_then[index];
    let clip = frame.view_projection * vec4<f32>(bent.place, 1.0);
    trail.position = clip;
    trail.now = clip;
    trail.then = aov.then * vec4<f32>(plants_bend_then(before, index, corner).place, 1.0);
    trail.place = bent.place;
    trail.facing = bent.facing;
    trail.card = vec2<f32>(plants_across(plant, bent.side), 1.0 - bent.along);
    trail.layer = plant.layer;
    trail.number = before.layer;
    return trail;
}

@fragment
fn plants_aov_fragment(trail: Trail) -> AovPixel {
    let to_eye = frame.camera.xyz - trail.place;
    let texel = leaves_texel(trail.card, trail.layer, trail.facing, normalize(to_eye));
    let coverage = leaves_coverage(texel.a, length(to_eye));
    if coverage < AOV_COVERAGE {
        discard;
    }
    return aov_pixel(trail.now, trail.then, trail.number);
}
