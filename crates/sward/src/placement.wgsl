// Which plants stand where: a pure function of (seed, patch, cell). Twin: placement.rs, where everything is explained.

const PLACEMENT_PRESENT: u32 = 1u;
const PLACEMENT_PLACE_X: u32 = 2u;
const PLACEMENT_PLACE_Z: u32 = 3u;
const PLACEMENT_HEIGHT: u32 = 4u;
const PLACEMENT_YAW: u32 = 5u;
const PLACEMENT_TINT: u32 = 6u;
const PLACEMENT_CLUMP: u32 = 7u;
const PLACEMENT_VARIETY: u32 = 8u;
const PLACEMENT_LEAN_X: u32 = 9u;
const PLACEMENT_LEAN_Z: u32 = 10u;
const PLACEMENT_BLADE: u32 = 16u;
const PLACEMENT_MOST_LEAN: f32 = 1.2;
const PLACEMENT_MESSY: f32 = 0.6;

struct PlacementParameters {
    seed: u32,
    cells: u32,
    spacing: f32,
    cover: f32,
    height: vec2<f32>,
    clumping: f32,
    clumps: u32,
    lean: vec2<f32>,
    messiness: f32,
    unused: f32,
}

struct PlacedPlant {
    present: bool,
    root: vec2<f32>,
    height: f32,
    yaw: f32,
    tint: f32,
    lean: vec2<f32>,
}

fn placement_corner(p: PlacementParameters, patch_: vec2<i32>, corner: vec2<u32>) -> f32 {
    let over = corner / p.clumps;
    let at = corner - over * p.clumps;
    let owner = patch_ + vec2<i32>(over);
    return math_unit(math_hash(p.seed, owner.x, owner.y, at.y * p.clumps + at.x, PLACEMENT_CLUMP));
}

fn placement_clump(p: PlacementParameters, patch_: vec2<i32>, cell: vec2<u32>) -> f32 {
    let scale = f32(p.clumps) / f32(p.cells);
    let at = (vec2<f32>(cell) + 0.5) * scale;
    let corner = vec2<u32>(at);
    let f = at - vec2<f32>(corner);
    let s = f * f * (3.0 - 2.0 * f);
    let a = placement_corner(p, patch_, corner);
    let b = placement_corner(p, patch_, corner + vec2<u32>(1u, 0u));
    let c = placement_corner(p, patch_, corner + vec2<u32>(0u, 1u));
    let d = placement_corner(p, patch_, corner + vec2<u32>(1u, 1u));
    let low = a + (b - a) * s.x;
    let high = c + (d - c) * s.x;
    return low + (high - low) * s.y;
}

fn placement_random(p: PlacementParameters, patch_: vec2<i32>, index: u32, purpose: u32) -> f32 {
    return math_unit(math_hash(p.seed, patch_.x, patch_.y, index, purpose));
}

// How the plant of a cell leans: as all do, and some way of its own.
fn placement_scattered(p: PlacementParameters, patch_: vec2<i32>, index: u32) -> vec2<f32> {
    let chance = vec2<f32>(placement_random(p, patch_, index, PLACEMENT_LEAN_X), placement_random(p, patch_, index, PLACEMENT_LEAN_Z));
    let lean = p.lean + p.messiness * PLACEMENT_MESSY * (2.0 * chance - 1.0);
    let length_ = length(lean);
    return lean * select(1.0, PLACEMENT_MOST_LEAN / length_, length_ > PLACEMENT_MOST_LEAN);
}

fn placement_plant(p: PlacementParameters, patch_: vec2<i32>, cell: vec2<u32>) -> PlacedPlant {
    let index = cell.y * p.cells + cell.x;
    let clump = placement_clump(p, patch_, cell);
    let cover = p.cover * (1.0 - p.clumping * (1.0 - clump));
    var plant: PlacedPlant;
    plant.present = placement_random(p, patch_, index, PLACEMENT_PRESENT) < cover;
    let share = placement_random(p, patch_, index, PLACEMENT_HEIGHT) * (1.0 - p.clumping) + clump * p.clumping;
    let place = vec2<f32>(placement_random(p, patch_, index, PLACEMENT_PLACE_X), placement_random(p, patch_, index, PLACEMENT_PLACE_Z));
    plant.root = (vec2<f32>(cell) + place) * p.spacing;
    plant.height = p.height.x + (p.height.y - p.height.x) * share;
    plant.yaw = placement_random(p, patch_, index, PLACEMENT_YAW) * 6.2831855;
    plant.tint = placement_random(p, patch_, index, PLACEMENT_TINT);
    plant.lean = p.lean;
    if p.messiness > 0.0 {
        plant.lean = placement_scattered(p, patch_, index);
    }
    return plant;
}

// Where a blade leans, rad from +x towards +z, and by how much, whose plant leans besides.
fn placement_combed(yaw: f32, lean: f32, plant: vec2<f32>) -> vec2<f32> {
    if all(plant == vec2<f32>(0.0)) {
        return vec2<f32>(yaw, lean);
    }
    let turn = math_sin_cos(yaw);
    let way = lean * turn.yx + plant;
    return vec2<f32>(math_atan2(way.y, way.x), min(length(way), PLACEMENT_MOST_LEAN));
}

// 32 chance bits of the plant in a cell.
fn placement_variety(p: PlacementParameters, patch_: vec2<i32>, cell: u32) -> u32 {
    return math_hash(p.seed, patch_.x, patch_.y, cell, PLACEMENT_VARIETY);
}

// A chance number about a blade of the plant in a cell.
fn placement_of_blade(p: PlacementParameters, patch_: vec2<i32>, cell: vec2<u32>, blade: u32, question: u32) -> f32 {
    return placement_random(p, patch_, cell.y * p.cells + cell.x, PLACEMENT_BLADE * (blade + 1u) + question);
}

// The plant as the growth map has it: how much of it, 0 to 255, and how it leans where the next is not 0.
fn placement_grown(plant: PlacedPlant, growing: vec4<u32>) -> PlacedPlant {
    var grown = plant;
    grown.present = plant.present && growing.x > 0u;
    grown.height = plant.height * (f32(growing.x) / 255.0);
    if growing.y > 0u {
        grown.lean = vec2<f32>(bitcast<vec2<i32>>(growing.zw << vec2<u32>(24u)) >> vec2<u32>(24u)) * 0.01;
    }
    return grown;
}
