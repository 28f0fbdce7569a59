// Billboards of n segments: the spine. Twin: billboard.rs (Chen & Johan, Fig. 5).

const BILLBOARD_CLEARANCE: f32 = 1e-3;

/// Offset of the end of a segment from its start.
fn billboard_segment(bend: vec2<f32>, length_: f32) -> vec3<f32> {
    let tilt = sqrt(bend.x * bend.x + bend.y * bend.y);
    let turn = math_sin_cos(tilt);
    let along = select(1.0, turn.x / tilt, tilt > 1e-6);
    return vec3<f32>(bend.x * along * length_, turn.y * length_, bend.y * along * length_);
}
