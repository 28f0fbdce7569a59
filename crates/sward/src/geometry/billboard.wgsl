// Billboards of n segments: the spine, and its bend between two steps. Twin: billboard.rs (Chen & Johan, Fig. 5).

const BILLBOARD_CLEARANCE: f32 = 1e-3;
const BILLBOARD_FLAT: f32 = 1.55;

/// Offset of the end of a segment from its start.
fn billboard_segment(bend: vec2<f32>, length_: f32) -> vec3<f32> {
    let tilt = sqrt(bend.x * bend.x + bend.y * bend.y);
    let turn = math_sin_cos(tilt);
    let along = select(1.0, turn.x / tilt, tilt > 1e-6);
    return vec3<f32>(bend.x * along * length_, turn.y * length_, bend.y * along * length_);
}

/// Bend of a segment of a plant that leans by itself: within a quarter turn.
fn billboard_leaning(bend: vec2<f32>, lean: vec2<f32>) -> vec2<f32> {
    if all(lean == vec2<f32>(0.0)) {
        return bend;
    }
    let both = bend + lean;
    let size = sqrt(both.x * both.x + both.y * both.y);
    return both * select(1.0, BILLBOARD_FLAT / size, size > BILLBOARD_FLAT);
}

/// Bend of an upper segment some share of a step ago: the cascade's own step, taken back.
fn billboard_earlier(here: vec2<f32>, below_now: vec2<f32>, below_then: vec2<f32>, gains: vec4<f32>, behind: f32) -> vec2<f32> {
    let recovering = below_now.x * below_now.x + below_now.y * below_now.y < here.x * here.x + here.y * here.y;
    let pair = select(gains.xz, gains.yw, recovering);
    return here - behind * pair.x * (below_now - here) + pair.y * (below_then - below_now);
}
