// What the passes of a step share: a stand, its awake patches, its cells. Passes: step.wgsl, lags.wgsl.

struct Stand {
    coefficients: ContinuumCoefficients,
    lag: LagCoefficients,
    cells: u32,
    nodes: u32,     // wind nodes a row, cells/2 + 3
    gusty: u32,     // β_eq comes from nodes, else from `rest`
    level: u32,     // all ground is level at `height`
    rest: vec2<f32>,
    wind_response: f32,
    height: f32,
    frame: u32,     // place of this step in the ring of `history`
    spacing: f32,
    inertia: f32,   // of what stands in a cell, kg·m²
    kappa: f32,     // 1/s²
    reactions: u32, // first word of what contacts feel behind the summaries
    unused_a: u32,
    unused_b: u32,
    unused_c: u32,
}

struct AwakePatch {
    slot: u32,
    lag: u32,
    held: u32,      // index of its held mask, or NONE
    flags: u32,     // 1: its upper segments are new; 2: it is the tiled wind patch
    neighbours: vec4<u32>,
    patch_index: vec2<i32>,
    pair_first: u32,
    pair_count: u32,
    keep: f32,
    dither: u32,    // number of the patch and step from which cells at half precision are dithered
    safe: f32,      // |β| below which the ground limits nothing
    reserved: u32,
}

const NONE: u32 = 0xffffffffu;

@group(0) @binding(0) var<uniform> stand: Stand;
@group(0) @binding(1) var<uniform> wind: WindBlock;
@group(0) @binding(2) var<storage, read> patches: array<AwakePatch>;
@group(0) @binding(3) var<storage, read_write> now: array<u32>;
@group(0) @binding(4) var<storage, read_write> old: array<u32>;
@group(0) @binding(5) var<storage, read> ground: array<f32>;
@group(0) @binding(6) var<storage, read_write> held: array<u32>;
@group(0) @binding(7) var<storage, read_write> nodes: array<vec2<f32>>;
@group(0) @binding(8) var<storage, read> tile: array<vec2<f32>>;
@group(0) @binding(9) var<storage, read> contacts: array<Contact>;
// Edges (two words each), then pairs (contact, corner x, corner z, unused) from `words_pairs` on.
@group(0) @binding(10) var<storage, read> words: array<vec4<i32>>;
@group(0) @binding(11) var<storage, read_write> summary: array<atomic<u32>>;
@group(0) @binding(12) var<storage, read_write> upper: array<f32>;
@group(0) @binding(13) var<storage, read_write> past: array<f32>;
@group(0) @binding(14) var<uniform> tile_wind: WindBlock;

override last_substep: bool = true;

fn wind_tile_load(index: u32) -> vec2<f32> {
    return tile[index];
}

fn reaction_add(word: u32, parts: i32) {
    atomicAdd(&summary[word], bitcast<u32>(parts));
}

fn rest_node(index: u32) -> vec2<f32> {
    return nodes[index];
}

fn contact_edge(index: u32) -> ContactEdge {
    let a = words[2u * index];
    let b = words[2u * index + 1u];
    return ContactEdge(a.xy, a.zw, bitcast<vec2<f32>>(b.xy), bitcast<f32>(b.z), 0.0);
}

fn rest_of(slot: u32, cell: vec2<i32>) -> vec2<f32> {
    if stand.gusty == 0u {
        return stand.rest;
    }
    return rest_at(slot * stand.nodes * stand.nodes, stand.nodes, cell);
}

fn cell_index(slot: u32, cell: vec2<u32>) -> u32 {
    return cells_first(slot, stand.cells * stand.cells) + cell.y * stand.cells + cell.x;
}

fn dither_of(entry: AwakePatch, cell: vec2<u32>) -> u32 {
    return half_dither(entry.dither, cell.y * stand.cells + cell.x);
}

fn now_cell(index: u32) -> ContinuumCell {
    let area = stand.cells * stand.cells;
    let bends = vec2<u32>(now[index], now[index + area]);
    var rates = bends;
    if !half_precision {
        rates = vec2<u32>(now[index + 2u * area], now[index + 3u * area]);
    }
    return ContinuumCell(cells_bend(bends), cells_rate(rates));
}

fn old_cell(index: u32) -> ContinuumCell {
    let area = stand.cells * stand.cells;
    let bends = vec2<u32>(old[index], old[index + area]);
    var rates = bends;
    if !half_precision {
        rates = vec2<u32>(old[index + 2u * area], old[index + 3u * area]);
    }
    return ContinuumCell(cells_bend(bends), cells_rate(rates));
}

fn store_now(index: u32, cell: ContinuumCell, dither: u32) {
    let area = stand.cells * stand.cells;
    let packed = cells_words(cell.bend, cell.rate, dither);
    now[index] = packed.x;
    now[index + area] = packed.y;
    if !half_precision {
        now[index + 2u * area] = packed.z;
        now[index + 3u * area] = packed.w;
    }
}

fn store_old(index: u32, cell: ContinuumCell, dither: u32) {
    let area = stand.cells * stand.cells;
    let packed = cells_words(cell.bend, cell.rate, dither);
    old[index] = packed.x;
    old[index + area] = packed.y;
    if !half_precision {
        old[index + 2u * area] = packed.z;
        old[index + 3u * area] = packed.w;
    }
}

fn slope_of(slot: u32, cell: vec2<u32>) -> vec2<f32> {
    if stand.level != 0u {
        return vec2<f32>(0.0);
    }
    let area = stand.cells * stand.cells;
    let at = slot * 3u * area + cell.y * stand.cells + cell.x;
    return vec2<f32>(ground[at], ground[at + area]);
}
