// Crossed cards along a spine. Twin: card.rs.

// Across a card at one joint: its corners stand at middle ± 0.5 width across.
struct CardRung {
    middle: vec3<f32>,
    across: vec3<f32>, // along the card, unit
    facing: vec3<f32>, // out of the card, unit
    width: f32,
    lying: f32,        // how much it lies down, 0..1
}

// `base`, `here`: the first joint and this one; `low`, `high`: its neighbours. `turn`: heading of the card, rad. `lift`: cards that lie
// are stacked, in steps of 18 mm. `keep`: share of its size that a fading plant keeps.
fn card_rung(base: vec3<f32>, here: vec3<f32>, low: vec3<f32>, high: vec3<f32>, turn: f32, width: f32, lift: f32, keep: f32) -> CardRung {
    let tangent = normalize(high - low + vec3<f32>(0.0, 1e-5, 0.0));
    let heading = math_sin_cos(turn);
    let flat_side = vec3<f32>(heading.y, 0.0, heading.x);
    // Turn the side with the stem, then let lying cards spread on the ground instead of standing on edge.
    let carried = flat_side - dot(flat_side, tangent) / max(1.0 + tangent.y, 0.1) * (tangent + vec3<f32>(0.0, 1.0, 0.0));
    let level = normalize(vec3<f32>(-tangent.z, 0.0, tangent.x) + vec3<f32>(1e-4, 0.0, 0.0));
    let spread = level * select(-1.0, 1.0, dot(carried, level) > 0.0);
    let lying = smoothstep(0.35, 0.95, 1.0 - tangent.y);
    let across = normalize(mix(carried, spread + 0.25 * carried * vec3<f32>(1.0, 0.0, 1.0), lying));
    let middle = base + (here - base) * keep + vec3<f32>(0.0, lying * 0.018 * lift, 0.0);
    return CardRung(middle, across, normalize(cross(across, tangent)), width * mix(1.0, 1.35, lying) * keep, lying);
}
