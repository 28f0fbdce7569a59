// Plants: what cards (cards.wgsl) and sheets (sheet_grids.wgsl) have in common.

struct Plant {
    root: vec3<f32>,
    height: f32,
    yaw: f32,
    width: f32,
    tint: f32,
    layer: u32,
}

struct Style {
    root: vec4<f32>,  // rgb; w = dryness added to every leaf
    tip: vec4<f32>,   // rgb; w = share of light let through
    mean: vec4<f32>,  // x share of the sky seen by roots, y how fast sunlight fades towards them, zw = distances where plants begin to fade and are gone
    shape: vec4<u32>, // segments, cards (0: a sheet of as many pieces along each side), vertices per plant, plants per instance
}

@group(0) @binding(4) var<storage, read> plants: array<Plant>;
@group(0) @binding(5) var<storage, read> joints: array<vec4<f32>>;
@group(0) @binding(6) var<uniform> style: Style;
@group(0) @binding(7) var clumps: texture_2d_array<f32>;
@group(0) @binding(8) var clump_sampler: sampler;

// A corner of a plant's picture: where it stands, and its place in the picture.
struct Bent { place: vec3<f32>, across: vec3<f32>, facing: vec3<f32>, along: f32, side: f32, lying: f32 }

// How far a plant seen from `eye` is gone, 0 to 1. Plants end at slightly different distances, so that no front is seen.
fn plants_gone(plant: Plant, eye: vec3<f32>) -> f32 {
    let distance = length(plant.root - eye);
    return smoothstep(style.mean.z, style.mean.w, distance + (plant.tint - 0.5) * 0.3 * (style.mean.w - style.mean.z));
}

// What the fading leaves of a plant's size.
fn plants_keep(gone: f32) -> f32 {
    return 1.0 - 0.85 * gone;
}

// Across a card's picture: half of the plants show it turned around.
fn plants_across(plant: Plant, side: f32) -> f32 {
    return 0.5 + 0.5 * side * select(1.0, -1.0, fract(plant.tint * 64.0) < 0.5);
}

// Whether the whole plant lies outside the picture's sides or behind the eye, cheaply and on the safe side.
fn plants_unseen(plant: Plant) -> bool {
    let clip = frame.view_projection * vec4<f32>(plant.root, 1.0);
    let reach = plant.height + plant.width;
    let stretch = length(vec3<f32>(frame.view_projection[0].x, frame.view_projection[1].x, frame.view_projection[2].x));
    return clip.w < -reach || abs(clip.x) > clip.w + reach * (stretch + 1.0);
}

// Outside the clip volume.
fn plants_nowhere() -> vec4<f32> {
    return vec4<f32>(0.0, 0.0, -2.0, 1.0);
}
