// One step of a continuum stand: rest -> wake -> contact -> wave -> lags. Twin: response/continuum/{step,patch}.rs in the core.
// One invocation is one cell (or wind node) of one awake patch; workgroup id z counts the patches of the pass.

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
    unused: vec2<f32>,
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
    reserved_a: u32,
    reserved_b: u32,
    reserved_c: u32,
}

const NONE: u32 = 0xffffffffu;

@group(0) @binding(0) var<uniform> stand: Stand;
@group(0) @binding(1) var<uniform> wind: WindBlock;
@group(0) @binding(2) var<storage, read> patches: array<AwakePatch>;
@group(0) @binding(3) var<storage, read_write> now: array<f32>;
@group(0) @binding(4) var<storage, read_write> old: array<f32>;
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
    return slot * 4u * stand.cells * stand.cells + cell.y * stand.cells + cell.x;
}

fn now_cell(index: u32) -> ContinuumCell {
    let area = stand.cells * stand.cells;
    return ContinuumCell(vec2<f32>(now[index], now[index + area]), vec2<f32>(now[index + 2u * area], now[index + 3u * area]));
}

fn old_cell(index: u32) -> ContinuumCell {
    let area = stand.cells * stand.cells;
    return ContinuumCell(vec2<f32>(old[index], old[index + area]), vec2<f32>(old[index + 2u * area], old[index + 3u * area]));
}

fn store_now(index: u32, cell: ContinuumCell) {
    let area = stand.cells * stand.cells;
    now[index] = cell.bend.x;
    now[index + area] = cell.bend.y;
    now[index + 2u * area] = cell.rate.x;
    now[index + 3u * area] = cell.rate.y;
}

fn store_old(index: u32, cell: ContinuumCell) {
    let area = stand.cells * stand.cells;
    old[index] = cell.bend.x;
    old[index + area] = cell.bend.y;
    old[index + 2u * area] = cell.rate.x;
    old[index + 3u * area] = cell.rate.y;
}

fn slope_of(slot: u32, cell: vec2<u32>) -> vec2<f32> {
    if stand.level != 0u {
        return vec2<f32>(0.0);
    }
    let area = stand.cells * stand.cells;
    let at = slot * 3u * area + cell.y * stand.cells + cell.x;
    return vec2<f32>(ground[at], ground[at + area]);
}

/// β_eq of each wind node of each patch.
@compute @workgroup_size(8, 8)
fn rest_pass(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= stand.nodes || id.y >= stand.nodes {
        return;
    }
    let entry = patches[id.z];
    var velocity = wind.mean;
    for (var k = 0u; k < wind.count; k++) {
        var octave = wind.octaves[k];
        if (entry.flags & 2u) != 0u {
            octave = tile_wind.octaves[k];
        }
        let base = wind_patch_phase(octave, entry.patch_index, wind.intervals);
        velocity += octave.amplitude * wind_sample(wind_node_phase(octave, base, vec2<i32>(id.xy) - vec2<i32>(1)));
    }
    for (var k = 0u; k < wind.footprint_count; k++) {
        let print = wind.footprints[k];
        let base = wind_footprint_base(print, entry.patch_index, wind.intervals);
        velocity += wind_footprint_velocity(print, wind_footprint_to_node(print, base, vec2<i32>(id.xy) - vec2<i32>(1)));
    }
    nodes[entry.slot * stand.nodes * stand.nodes + id.y * stand.nodes + id.x] = wind_equilibrium(velocity, stand.wind_response);
}

/// Both time levels of a waking patch at rest.
@compute @workgroup_size(8, 8)
fn wake_pass(@builtin(global_invocation_id) id: vec3<u32>) {
    let entry = patches[id.z];
    let cell = ContinuumCell(rest_of(entry.slot, vec2<i32>(id.xy)), vec2<f32>(0.0));
    let index = cell_index(entry.slot, id.xy);
    store_now(index, cell);
    store_old(index, cell);
}

/// Bends the cells under bodies and marks them held.
@compute @workgroup_size(8, 8)
fn contact_pass(@builtin(global_invocation_id) id: vec3<u32>) {
    let entry = patches[id.z];
    let area = stand.cells * stand.cells;
    let index = cell_index(entry.slot, id.xy);
    let cell = now_cell(index);
    var height = stand.height;
    if stand.level == 0u {
        height = ground[entry.slot * 3u * area + 2u * area + id.y * stand.cells + id.x];
    }
    var touch: ContinuumTouch;
    for (var k = 0u; k < entry.pair_count; k++) {
        let pair = words[entry.pair_first + k];
        let contact = contacts[u32(pair.x)];
        let at = vec2<i32>(id.xy) - pair.yz;
        if all(at >= vec2<i32>(0)) && all(at < contact.size) {
            let hit = contact_at(contact, at, height, stand.coefficients.plant_height);
            if hit.touches {
                touch = continuum_gather(stand.coefficients, cell.bend, touch, hit);
            }
        }
    }
    held[entry.held * area + id.y * stand.cells + id.x] = u32(touch.hit.touches);
    if touch.hit.touches {
        let next = continuum_contact(stand.coefficients, cell.bend, touch, slope_of(entry.slot, id.xy));
        store_now(index, next);
        store_old(index, next);
    }
}

/// A cell of the present that may lie in a neighbour; at rest where that one sleeps.
fn beside(entry: AwakePatch, cell: vec2<i32>) -> ContinuumCell {
    let side = i32(stand.cells);
    var slot = entry.slot;
    if cell.x < 0 {
        slot = entry.neighbours.x;
    } else if cell.x >= side {
        slot = entry.neighbours.y;
    } else if cell.y < 0 {
        slot = entry.neighbours.z;
    } else if cell.y >= side {
        slot = entry.neighbours.w;
    }
    if slot == NONE {
        return ContinuumCell(rest_of(entry.slot, cell), vec2<f32>(0.0));
    }
    return now_cell(cell_index(slot, vec2<u32>((cell + vec2<i32>(side)) % vec2<i32>(side))));
}

var<workgroup> peak: array<atomic<u32>, 6>;

fn summarise(entry: u32, cell: vec2<u32>, deviation: f32, clamped: bool, first: bool) {
    let bits = bitcast<u32>(deviation);
    let band = SUMMARY_BAND;
    atomicMax(&peak[0], bits);
    if cell.x < band { atomicMax(&peak[1], bits); }
    if cell.x + band >= stand.cells { atomicMax(&peak[2], bits); }
    if cell.y < band { atomicMax(&peak[3], bits); }
    if cell.y + band >= stand.cells { atomicMax(&peak[4], bits); }
    if clamped { atomicAdd(&peak[5], 1u); }
    workgroupBarrier();
    if first {
        for (var k = 0u; k < 5u; k++) {
            let largest = atomicLoad(&peak[k]);
            if largest > 0u { atomicMax(&summary[entry * 6u + k], largest); }
        }
        let count = atomicLoad(&peak[5]);
        if count > 0u { atomicAdd(&summary[entry * 6u + 5u], count); }
    }
}

/// One substep of the wave: `old` holds the past and receives the future.
@compute @workgroup_size(8, 8)
fn wave_pass(@builtin(global_invocation_id) id: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let entry = patches[id.z];
    let index = cell_index(entry.slot, id.xy);
    let cell = vec2<i32>(id.xy);
    let rest = rest_of(entry.slot, cell);
    let present = now_cell(index);
    var is_held = false;
    if entry.held != NONE {
        is_held = held[entry.held * stand.cells * stand.cells + id.y * stand.cells + id.x] != 0u;
    }
    var next = present;
    var clamped = false;
    if !is_held {
        let left = beside(entry, cell + vec2<i32>(-1, 0));
        let right = beside(entry, cell + vec2<i32>(1, 0));
        let before = beside(entry, cell + vec2<i32>(0, -1));
        let after = beside(entry, cell + vec2<i32>(0, 1));
        let around = ContinuumCell((left.bend + right.bend) + (before.bend + after.bend), (left.rate + right.rate) + (before.rate + after.rate));
        let free = continuum_propagate(stand.coefficients, present, old_cell(index), around, rest);
        next = continuum_limited(free, slope_of(entry.slot, id.xy));
        clamped = any(next.bend != free.bend) || any(next.rate != free.rate);
    }
    if last_substep && entry.keep < 1.0 {
        next = continuum_faded(next, rest, entry.keep);
    }
    store_old(index, next);
    // Activation goes by the end of the step, as on the CPU: substeps on the way there do not count.
    if last_substep {
        summarise(id.z, id.xy, continuum_deviation(next, rest), clamped, local == 0u);
    }
}

fn store_upper(plane: u32, bend: vec2<f32>) {
    upper[plane] = bend.x;
    upper[plane + stand.cells * stand.cells] = bend.y;
}

/// Upper segments of the patches that keep them; `now` is the new present here.
@compute @workgroup_size(8, 8)
fn lag_pass(@builtin(global_invocation_id) id: vec3<u32>) {
    let entry = patches[id.z];
    let area = stand.cells * stand.cells;
    let flat_cell = id.y * stand.cells + id.x;
    let first = entry.lag * (stand.lag.segments - 1u) * 2u * area + flat_cell;
    let present = now_cell(cell_index(entry.slot, id.xy));
    let fresh = (entry.flags & 1u) != 0u;
    let ring = entry.lag * stand.lag.ring * 2u * area + flat_cell;
    if stand.lag.kind == 1u {
        for (var k = 0u; k < stand.lag.ring; k++) {
            if fresh || k == stand.frame {
                past[ring + k * 2u * area] = present.bend.x;
                past[ring + k * 2u * area + area] = present.bend.y;
            }
        }
    }
    var below = present.bend;
    for (var segment = 1u; segment < stand.lag.segments; segment++) {
        let plane = first + (segment - 1u) * 2u * area;
        if stand.lag.kind == 0u {
            var here = present.bend;
            if !fresh {
                here = vec2<f32>(upper[plane], upper[plane + area]);
            }
            below = lag_cascade(stand.lag, below, here);
            store_upper(plane, below);
        } else if stand.lag.kind == 1u {
            store_upper(plane, remembered(ring, segment));
        } else {
            store_upper(plane, looked_up(entry, vec2<i32>(id.xy), segment, present));
        }
    }
}

fn past_bend(ring: u32, back: u32) -> vec2<f32> {
    let area = stand.cells * stand.cells;
    let at = ring + ((stand.frame + stand.lag.ring - back) % stand.lag.ring) * 2u * area;
    return vec2<f32>(past[at], past[at + area]);
}

fn remembered(ring: u32, segment: u32) -> vec2<f32> {
    let present = past_bend(ring, 0u);
    let before = past_bend(ring, lag_steps(stand.lag, segment, stand.lag.gamma_top));
    if dot(present, present) < dot(before, before) {
        return past_bend(ring, lag_steps(stand.lag, segment, stand.lag.gamma_recover));
    }
    return before;
}

/// β of a cell that may lie in a neighbour; beyond awake neighbours the patch's own border stands in.
fn bend_near(entry: AwakePatch, cell: vec2<i32>) -> vec2<f32> {
    let side = i32(stand.cells);
    let over = select(select(vec2<i32>(0), vec2<i32>(1), cell >= vec2<i32>(side)), vec2<i32>(-1), cell < vec2<i32>(0));
    var slot = NONE;
    if over.y == 0 && over.x != 0 {
        slot = select(entry.neighbours.y, entry.neighbours.x, over.x < 0);
    } else if over.x == 0 && over.y != 0 {
        slot = select(entry.neighbours.w, entry.neighbours.z, over.y < 0);
    }
    var at = cell;
    if slot == NONE {
        slot = entry.slot;
    } else {
        at = cell - over * side;
    }
    return now_cell(cell_index(slot, vec2<u32>(clamp(at, vec2<i32>(0), vec2<i32>(side - 1))))).bend;
}

fn looked_up(entry: AwakePatch, cell: vec2<i32>, segment: u32, present: ContinuumCell) -> vec2<f32> {
    let speed = continuum_wave_speed(stand.coefficients, present.rate);
    let offset = lag_look_up_offset(stand.lag, segment, present.bend, present.rate, speed) / stand.spacing;
    let whole = floor(offset);
    let f = offset - whole;
    let at = cell + vec2<i32>(whole);
    let low = mix(bend_near(entry, at), bend_near(entry, at + vec2<i32>(1, 0)), f.x);
    let high = mix(bend_near(entry, at + vec2<i32>(0, 1)), bend_near(entry, at + vec2<i32>(1, 1)), f.x);
    return mix(low, high, f.y);
}
