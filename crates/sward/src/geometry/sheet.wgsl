// A sheet drawn as a grid of points: where its corners stand, and which way they face. Twin: sheet.rs.

const SHEET_LIFT: f32 = 0.18;

struct SheetCorner {
    place: vec3<f32>,
    across: vec3<f32>, // along the rows, unit
    facing: vec3<f32>, // out of the sheet, unit
    lying: f32,        // how much it lies down, 0..1
}

// The points of the grid around one of them, m; at a rim the point itself stands for what is missing.
struct SheetAround {
    here: vec3<f32>,
    left: vec3<f32>,
    right: vec3<f32>,
    low: vec3<f32>,
    high: vec3<f32>,
}

struct SheetOf {
    root: vec3<f32>, // middle of the foot, m
    width: f32,
    height: f32,
    tint: f32,
}

// `side`: from −1 at the first column to 1 at the last; `along`: from 0 at the root to 1; `keep`: share of its size that a fading plant keeps.
fn sheet_corner(plant: SheetOf, around: SheetAround, side: f32, along: f32, keep: f32) -> SheetCorner {
    let tangent = normalize(around.high - around.low + vec3<f32>(0.0, 1e-5, 0.0));
    let carried = normalize(around.right - around.left + vec3<f32>(1e-5, 0.0, 0.0));
    let level = normalize(vec3<f32>(-tangent.z, 0.0, tangent.x) + vec3<f32>(1e-4, 0.0, 0.0));
    let spread = level * select(-1.0, 1.0, dot(carried, level) > 0.0);
    let lying = smoothstep(0.35, 0.95, 1.0 - tangent.y);
    let across = normalize(mix(carried, spread, lying));
    let spreading = (across * (1.0 + 0.35 * lying) - carried) * (0.5 * plant.width * keep * side);
    let lift = lying * SHEET_LIFT * plant.height * along * (0.5 + plant.tint);
    let place = plant.root + (around.here - plant.root) * keep + spreading + vec3<f32>(0.0, lift, 0.0);
    let facing = normalize(cross(across, tangent) + vec3<f32>(0.0, 0.0, 1e-6));
    return SheetCorner(place, across, facing, lying);
}
