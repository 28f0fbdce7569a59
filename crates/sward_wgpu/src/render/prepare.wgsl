// Prepare: each visible plant is solved once, into joints that the shadow and the main pass share.
// One invocation is one place in the drawing order of one patch. Twins of the formulas: placement.rs, billboard.rs, wind, terrain.

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

struct Plant {
    root: vec3<f32>,
    height: f32,
    yaw: f32,
    width: f32,
    tint: f32,
    layer: u32,
}

const NONE: u32 = 0xffffffffu;

@group(0) @binding(0) var<uniform> prepare: Prepare;
@group(0) @binding(1) var<uniform> wind: WindBlock;
@group(0) @binding(2) var<storage, read> draws: array<PatchDraw>;
@group(0) @binding(3) var<storage, read> now: array<u32>;
@group(0) @binding(4) var<storage, read> upper: array<f32>;
@group(0) @binding(5) var<storage, read> heights: array<f32>;
@group(0) @binding(6) var<storage, read> tile: array<vec2<f32>>;
@group(0) @binding(7) var<storage, read_write> plants: array<Plant>;
@group(0) @binding(8) var<storage, read_write> joints: array<vec4<f32>>;
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

fn nothing(plant: u32) {
    plants[plant] = Plant(vec3<f32>(0.0), 0.0, 0.0, 0.0, 0.0, 0u);
}

@compute @workgroup_size(64)
fn prepare_pass(@builtin(global_invocation_id) id: vec3<u32>) {
    let which = id.y;
    let draw = draws[which];
    if id.x >= draw.count {
        return;
    }
    let out = draw.first + id.x;
    let cell = ordered_cell(id.x);
    if any(cell >= vec2<u32>(prepare.placement.cells)) {
        nothing(out);
        return;
    }
    var placed = placement_plant(prepare.placement, draw.patch_index, cell);
    if draw.growth != NONE {
        placed = placement_grown(placed, growth_at(draw.growth, cell));
    }
    if !placed.present {
        nothing(out);
        return;
    }
    let ground = terrain_height(prepare.grid, draw.anchor, placed.root);
    let root = vec3<f32>(draw.offset.x + placed.root.x, ground, draw.offset.y + placed.root.y);
    let away = distance(root, prepare.camera.xyz);
    // Farther off fewer plants stand for more: each grows wider, and the last ones shrink before they go.
    let thin = min(1.0, pow(prepare.full / max(away, 1e-3), PREPARE_THINNING)) * prepare.fullness;
    let rank = (f32(id.x) + 0.5) / f32(1u << (2u * prepare.bits));
    let stay = clamp((thin - rank) / (0.12 * thin), 0.0, 1.0);
    // The picture before may have left out what this one shows: its smallest form then.
    let then = prepare.identity.z > 0u;
    if !then && (stay <= 0.0 || away >= prepare.gone) {
        nothing(out);
        return;
    }
    let height = placed.height * mix(0.35, 1.0, stay);
    let rest = rest_at_plant(draw, placed.root);
    var local = vec3<f32>(placed.root.x, ground, placed.root.y);
    let start = local;
    let length_ = height / f32(prepare.segments);
    var straight = 0.0;
    if prepare.plain > 0.0 {
        straight = smoothstep(0.75 * prepare.plain, 0.97 * prepare.plain, away);
    }
    var spine: array<vec3<f32>, 9>;
    spine[0] = start;
    // Where no upper segments are kept, all show what the lowest does.
    let gains = select(vec4<f32>(0.0, 0.0, 1.0, 1.0), prepare.lag, draw.lags[4] != NONE);
    var below_now = plant_bend(which, placed.root, 0u, rest);
    var shown = plant_bend(which, placed.root, NONE, rest);
    for (var segment = 0u; segment < prepare.segments; segment++) {
        if segment > 0u {
            let here = plant_bend(which, placed.root, segment, rest);
            if prepare.behind > 0.0 {
                shown = billboard_earlier(here, below_now, shown, gains, prepare.behind);
            } else {
                shown = here;
            }
            below_now = here;
        }
        local += billboard_segment(shown, length_);
        let floor_ = terrain_height(prepare.grid, draw.anchor, local.xz) + BILLBOARD_CLEARANCE;
        local.y = max(local.y, floor_);
        spine[segment + 1u] = local;
    }
    let first = out * (prepare.drawn + 1u);
    let shift = vec3<f32>(draw.offset.x, 0.0, draw.offset.y);
    for (var k = 0u; k <= prepare.drawn; k++) {
        let share = f32(k) / f32(prepare.drawn);
        var joint = mix(start, local, share);
        if prepare.drawn == prepare.segments {
            joint = mix(spine[k], joint, straight);
        }
        if k > 0u {
            joint.y = max(joint.y, terrain_height(prepare.grid, draw.anchor, joint.xz) + BILLBOARD_CLEARANCE);
        }
        joints[first + k] = vec4<f32>(joint + shift, 0.0);
    }
    let chance = fract(placed.tint * 61.7);
    let width = prepare.width * (0.8 + 0.4 * fract(placed.tint * 17.3)) * min(inverseSqrt(thin), 2.2) * mix(0.5, 1.0, stay);
    var layer = prepare.layer + min(u32(chance * f32(CLUMP_VARIANTS)), CLUMP_VARIANTS - 1u);
    if then {
        layer = prepare_number(draw.patch_index, cell);
    }
    plants[out] = Plant(root, height, placed.yaw, width, placed.tint, layer);
}
