// Plants: crossed cards bent along their joints.

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
    shape: vec4<u32>, // segments, cards, vertices per plant, plants per instance
}

@group(0) @binding(4) var<storage, read> plants: array<Plant>;
@group(0) @binding(5) var<storage, read> joints: array<vec4<f32>>;
@group(0) @binding(6) var<uniform> style: Style;
@group(0) @binding(7) var clumps: texture_2d_array<f32>;
@group(0) @binding(8) var clump_sampler: sampler;

struct Bent { place: vec3<f32>, across: vec3<f32>, facing: vec3<f32>, along: f32, side: f32, lying: f32 }

// Corner `corner` of a plant: card, joint and side follow from its number.
fn plants_bend(plant: Plant, index: u32, corner: u32, keep: f32) -> Bent {
    let segments = style.shape.x;
    let per_card = 2u * (segments + 1u);
    let card = corner / per_card;
    let joint = (corner % per_card) / 2u;
    let side = f32(corner & 1u) * 2.0 - 1.0;
    let first = index * (segments + 1u);
    let base = joints[first].xyz;
    let here = joints[first + joint].xyz;
    let low = joints[first + select(joint - 1u, 0u, joint == 0u)].xyz;
    let high = joints[first + min(joint + 1u, segments)].xyz;
    let turn = plant.yaw + f32(card) * 3.14159265 / f32(style.shape.y);
    let rung = card_rung(base, here, low, high, turn, plant.width, f32(card + 1u) * f32(joint), keep);
    let place = rung.middle + rung.across * (0.5 * rung.width * side);
    return Bent(place, rung.across, rung.facing, f32(joint) / f32(segments), side, rung.lying);
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
