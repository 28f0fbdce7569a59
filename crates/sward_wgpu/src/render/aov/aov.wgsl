// Outputs of each pixel beside its colour. Twin: picture/aov.rs of the core.

const AOV_COVERAGE: f32 = 0.5;
const AOV_UNSEEN: f32 = 65536.0;
const AOV_NEAR: f32 = 0.05;

struct Aov {
    then: mat4x4<f32>, // frame space -> clip space of the picture before
    eye: vec4<f32>,    // of that picture, m in this one's frame space; w unused
    size: vec4<f32>,   // of both, pixels; zw unused
}

@group(0) @binding(9) var<uniform> aov: Aov;

struct AovPixel {
    @location(0) depth: f32,
    @location(1) motion: vec2<f32>,
    @location(2) plant: u32,
}

// A corner of whatever is no plant.
struct AovPoint {
    @builtin(position) position: vec4<f32>,
    @location(0) now: vec4<f32>,  // clip space
    @location(1) then: vec4<f32>, // clip space of the picture before
    @location(2) @interpolate(flat) number: u32,
}

// `now` and `then`: places of the pixel's point in the clip spaces of this picture and of the one before.
fn aov_pixel(now: vec4<f32>, then: vec4<f32>, plant: u32) -> AovPixel {
    if then.w < AOV_NEAR {
        return AovPixel(now.w, vec2<f32>(AOV_UNSEEN), plant);
    }
    let way = (then.xy / then.w - now.xy / now.w) * (0.5 * aov.size.xy);
    return AovPixel(now.w, vec2<f32>(way.x, -way.y), plant);
}

// A point of frame space that was elsewhere, or there as well.
fn aov_point(now: vec3<f32>, then: vec3<f32>, number: u32) -> AovPoint {
    let clip = frame.view_projection * vec4<f32>(now, 1.0);
    return AovPoint(clip, clip, aov.then * vec4<f32>(then, 1.0), number);
}

@fragment
fn aov_fragment(point: AovPoint) -> AovPixel {
    return aov_pixel(point.now, point.then, point.number);
}
