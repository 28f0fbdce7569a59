// What all passes that solve plants share. Twins of the formulas: placement.rs, wind, terrain, picture/prepare.rs. How plants are bent is in
// continuum_bends.wgsl, chain_bends.wgsl or swing_bends.wgsl.

struct Prepare {
    placement: PlacementParameters,
    grid: TerrainGrid,
    camera: vec4<f32>,   // eye, m from the frame origin; w unused
    segments: u32,       // of the simulation
    drawn: u32,          // of the cards: `segments`, or 1 for plain plants; of sheets, pieces along each side
    bits: u32,           // the drawing order covers 2^bits cells a side
    layer: u32,          // first clump picture
    plain: f32,          // distance beyond which plants are straight, m
    full: f32,           // distance up to which every plant is drawn, m
    gone: f32,           // distance beyond which none is, m
    width: f32,          // of a card or sheet, m
    wind_response: f32,
    fullness: f32,       // share of plants drawn up to `full`: 1 unless the budget is short
    behind: f32,         // steps, 0 to 1, that the picture lies before the state
    substeps: f32,       // the time level before is one of them ago
    lag: vec4<f32>,      // gains of billboard_earlier
    step: vec4<u32>,     // steps done when the state was so; the rest unused
    identity: vec4<u32>, // of the picture before, for the plants of this one: bits of cell and patch, stand from 1; else 0
    sheet: vec4<u32>,    // columns and rows of the sheets, the rest unused; all 0 for cards
}

struct PatchDraw {
    offset: vec2<f32>,   // patch corner, m from the frame origin
    patch_index: vec2<i32>,
    anchor: TerrainAnchor,
    weights: vec4<f32>,  // how far cells rule over β_eq at the corners (−−, +−, −+, ++)
    slots: array<u32, 9>,
    lags: array<u32, 9>,
    first: u32,          // first plant of this patch in the output
    count: u32,
    growth: u32,         // place of its growth map, or NONE
    unused_a: u32,
    unused_b: u32,
    unused_c: u32,
}

const NONE: u32 = 0xffffffffu;

@group(0) @binding(0) var<uniform> prepare: Prepare;
@group(0) @binding(1) var<uniform> wind: WindBlock;
@group(0) @binding(2) var<storage, read> draws: array<PatchDraw>;
@group(0) @binding(3) var<storage, read> now: array<u32>;
@group(0) @binding(5) var<storage, read> heights: array<f32>;
@group(0) @binding(6) var<storage, read> tile: array<vec2<f32>>;
@group(0) @binding(9) var<storage, read> before: array<u32>;
@group(0) @binding(10) var growth_maps: texture_2d<u32>;

fn wind_tile_load(index: u32) -> vec2<f32> {
    return tile[index];
}

fn terrain_load(index: i32) -> f32 {
    return heights[index];
}

/// Cell at a place of the drawing order: bit-reversed Morton, so that any first part of the order is spread evenly.
fn ordered_cell(rank: u32) -> vec2<u32> {
    var cell = vec2<u32>(0u);
    for (var b = 0u; b < prepare.bits; b++) {
        let high = prepare.bits - 1u - b;
        cell.x |= ((rank >> (2u * b)) & 1u) << high;
        cell.y |= (((rank >> (2u * b + 1u)) ^ (rank >> (2u * b))) & 1u) << high;
    }
    return cell;
}

/// What the growth map at a place of the texture says of a cell.
fn growth_at(place: u32, cell: vec2<u32>) -> vec4<u32> {
    let columns = textureDimensions(growth_maps).x / prepare.placement.cells;
    let corner = vec2<u32>(place % columns, place / columns) * prepare.placement.cells;
    return textureLoad(growth_maps, corner + cell, 0);
}

/// The number of a plant. Twin: identity.rs.
fn prepare_number(patch_: vec2<i32>, cell: vec2<u32>) -> u32 {
    let bits = prepare.identity;
    let place = vec2<u32>(patch_) & vec2<u32>((1u << bits.y) - 1u);
    let index = cell.y * prepare.placement.cells + cell.x;
    return index | (place.x << bits.x) | (place.y << (bits.x + bits.y)) | (bits.z << (bits.x + 2u * bits.y));
}

/// A plant or a blade, as far as its bends ask.
struct Who {
    local: vec2<f32>,   // root, m from the corner of its patch
    tall: f32,          // height of its plant as it stands there, whole, m
    index: u32,         // its place among the blades of the patch
    heading: vec2<f32>, // unit ground vector along which it leans by itself
    yaw: f32,
    lean: f32,          // by how much at the root, rad
    curl: f32,          // how much more at the tip, rad
    plant: vec2<f32>,   // how its plant leans by itself, rad along x and z
}
