// How plants are bent where they stand: what all passes that solve plants share. Twins of the formulas: placement.rs, billboard.rs,
// wind, terrain, picture/prepare.rs.

struct Prepare {
    placement: PlacementParameters,
    grid: TerrainGrid,
    camera: vec4<f32>,   // eye, m from the frame origin; w unused
    segments: u32,       // of the simulation
    drawn: u32,          // of the cards: `segments`, or 1 for plain plants
    bits: u32,           // the drawing order covers 2^bits cells a side
    layer: u32,          // first clump picture
    plain: f32,          // distance beyond which plants are straight, m
    full: f32,           // distance up to which every plant is drawn, m
    gone: f32,           // distance beyond which none is, m
    width: f32,          // of a card, m
    wind_response: f32,
    fullness: f32,       // share of plants drawn up to `full`: 1 unless the budget is short
    behind: f32,         // steps, 0 to 1, that the picture lies before the state
    substeps: f32,       // the time level before is one of them ago
    lag: vec4<f32>,      // gains of billboard_earlier
    identity: vec4<u32>, // of the picture before, for the plants of this one: bits of cell and patch, stand from 1; else 0
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
@group(0) @binding(4) var<storage, read> upper: array<f32>;
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
fn growth_at(place: u32, cell: vec2<u32>) -> u32 {
    let columns = textureDimensions(growth_maps).x / prepare.placement.cells;
    let corner = vec2<u32>(place % columns, place / columns) * prepare.placement.cells;
    return textureLoad(growth_maps, corner + cell, 0).r;
}

fn rest_at_plant(draw: PatchDraw, local: vec2<f32>) -> vec2<f32> {
    var velocity = wind.mean;
    for (var k = 0u; k < wind.count; k++) {
        let octave = wind.octaves[k];
        let base = wind_patch_phase(octave, draw.patch_index, wind.intervals);
        velocity += octave.amplitude * wind_sample(wind_local_phase(octave, base, local));
    }
    for (var k = 0u; k < wind.footprint_count; k++) {
        let print = wind.footprints[k];
        let base = wind_footprint_base(print, draw.patch_index, wind.intervals);
        velocity += wind_footprint_velocity(print, wind_footprint_to_local(print, base, local));
    }
    return wind_equilibrium(velocity, prepare.wind_response);
}

/// Which of the nine patches around (and including) this one holds a cell, and the cell in it.
fn owner_of(cell: vec2<i32>) -> vec3<u32> {
    let side = i32(prepare.placement.cells);
    let over = select(select(vec2<i32>(0), vec2<i32>(1), cell >= vec2<i32>(side)), vec2<i32>(-1), cell < vec2<i32>(0));
    let at = vec2<u32>(cell - over * side);
    return vec3<u32>(u32((over.y + 1) * 3 + over.x + 1), at);
}

/// Bend of segment `segment` in one cell; β_eq where the patch sleeps, β where it keeps no upper segments.
/// Segment NONE asks for the lowest one at the moment of the picture.
fn cell_bend(which: u32, cell: vec2<i32>, segment: u32, rest: vec2<f32>) -> vec2<f32> {
    let owner = owner_of(cell);
    let slot = draws[which].slots[owner.x];
    if slot == NONE {
        return rest;
    }
    let area = prepare.placement.cells * prepare.placement.cells;
    let index = owner.z * prepare.placement.cells + owner.y;
    let lag = draws[which].lags[owner.x];
    if segment > 0u && segment != NONE && lag != NONE {
        let plane = (lag * (prepare.segments - 1u) + segment - 1u) * 2u * area + index;
        return vec2<f32>(upper[plane], upper[plane + area]);
    }
    let plane = cells_first(slot, area) + index;
    let bend = cells_bend(vec2<u32>(now[plane], now[plane + area]));
    if segment != NONE || prepare.behind == 0.0 {
        return bend;
    }
    return mix(bend, cells_bend(vec2<u32>(before[plane], before[plane + area])), prepare.behind * prepare.substeps);
}

/// Bend between the four cells around a plant.
fn plant_bend(which: u32, local: vec2<f32>, segment: u32, rest: vec2<f32>) -> vec2<f32> {
    let at = local / prepare.placement.spacing - 0.5;
    let corner = floor(at);
    let f = at - corner;
    let cell = vec2<i32>(corner);
    let low = mix(cell_bend(which, cell, segment, rest), cell_bend(which, cell + vec2<i32>(1, 0), segment, rest), f.x);
    let high = mix(cell_bend(which, cell + vec2<i32>(0, 1), segment, rest), cell_bend(which, cell + vec2<i32>(1, 1), segment, rest), f.x);
    let bend = mix(low, high, f.y);
    let side = prepare.placement.spacing * f32(prepare.placement.cells);
    let w = draws[which].weights;
    let weight = mix(mix(w.x, w.y, local.x / side), mix(w.z, w.w, local.x / side), local.y / side);
    return mix(rest, bend, weight);
}

/// The number of a plant. Twin: identity.rs.
fn prepare_number(patch_: vec2<i32>, cell: vec2<u32>) -> u32 {
    let bits = prepare.identity;
    let place = vec2<u32>(patch_) & vec2<u32>((1u << bits.y) - 1u);
    let index = cell.y * prepare.placement.cells + cell.x;
    return index | (place.x << bits.x) | (place.y << (bits.x + bits.y)) | (bits.z << (bits.x + 2u * bits.y));
}

// Bends of all segments at a place of a patch, at the moment of the picture, lowest first.
fn plant_bends(which: u32, root: vec2<f32>, bends: ptr<function, array<vec2<f32>, 8>>) {
    let draw = draws[which];
    let rest = rest_at_plant(draw, root);
    // Where no upper segments are kept, all show what the lowest does.
    let gains = select(vec4<f32>(0.0, 0.0, 1.0, 1.0), prepare.lag, draw.lags[4] != NONE);
    var below_now = plant_bend(which, root, 0u, rest);
    var shown = plant_bend(which, root, NONE, rest);
    for (var segment = 0u; segment < prepare.segments; segment++) {
        if segment > 0u {
            let here = plant_bend(which, root, segment, rest);
            if prepare.behind > 0.0 {
                shown = billboard_earlier(here, below_now, shown, gains, prepare.behind);
            } else {
                shown = here;
            }
            below_now = here;
        }
        (*bends)[segment] = shown;
    }
}
