// One step of a stand whose billboards bodies deform: each sheet by itself. Twin: response/springs/stand.rs in the core.

struct SheetStep {
    coefficients: SpringsCoefficients,
    wind: f32,
    stiffness: f32, // of a plant over its height³, N·m/rad/m³
    reactions: u32, // first word of what bodies feel
    unused: u32,
}

struct SheetEntry {
    root: SheetRoot,
    patch_index: vec2<i32>,
    place: u32,
    fresh: u32,
    first: u32,  // of its bodies
    count: u32,
    last: u32,   // moment
    hurry: u32,
    heading: vec2<f32>,
    unused_a: u32,
    unused_b: u32,
}

// No uniforms: Mesa compiles a shader anew for each value of a uniform that decides a branch.
@group(0) @binding(0) var<storage, read> stand: SheetStep;
@group(0) @binding(1) var<storage, read> wind: WindBlock;
@group(0) @binding(2) var<storage, read> entries: array<SheetEntry>;
@group(0) @binding(3) var<storage, read_write> words: array<u32>;
@group(0) @binding(4) var<storage, read> heads: array<DistanceMapHead>;
@group(0) @binding(5) var<storage, read> texels: array<vec4<f32>>;
// Word by word, the same of all entries side by side: those of each vertex, then what the step comes to.
@group(0) @binding(6) var<storage, read_write> room: array<u32>;
// Room for summaries, then sums of what each body feels.
@group(0) @binding(7) var<storage, read_write> report: array<atomic<u32>>;
@group(0) @binding(8) var<storage, read> tile: array<vec2<f32>>;

var<private> entry_at: u32;

fn wind_tile_load(index: u32) -> vec2<f32> {
    return tile[index];
}

fn reaction_add(word: u32, parts: i32) {
    atomicAdd(&report[word], bitcast<u32>(parts));
}

fn distance_map_load(index: u32) -> vec4<f32> {
    if index >= arrayLength(&texels) {
        return vec4<f32>(DISTANCE_MAP_EMPTY, 0.0, 1.0, 0.0);
    }
    return texels[index];
}

fn springs_map(index: u32) -> DistanceMapHead {
    return heads[index];
}

fn sheet_word(index: u32) -> u32 {
    return words[index];
}

fn springs_word(k: u32) -> u32 {
    return room[k * arrayLength(&entries) + entry_at];
}

fn springs_put_word(k: u32, word: u32) {
    room[k * arrayLength(&entries) + entry_at] = word;
}

fn outcome_word() -> u32 {
    return SPRINGS_ROOM * springs_vertices(stand.coefficients);
}

// Tilt in the wind at a place of a patch.
fn tilt_at(patch_: vec2<i32>, local: vec2<f32>) -> vec2<f32> {
    return wind_equilibrium(wind_at(patch_, local, false), stand.wind);
}

// Makes the stored sheet of an entry, as it is kept from step to step, that of its room; returns the steps since its last contact.
fn load_sheet(entry: SheetEntry) -> u32 {
    let co = stand.coefficients;
    let columns = springs_columns(co);
    let vertices = springs_vertices(co);
    let first = entry.place * sheet_words(co);
    springs_feet(co, entry.root, SPRINGS_STORED);
    for (var vertex = 0u; vertex < vertices; vertex++) {
        springs_put_left(vertex, 0u);
        if entry.fresh == 1u {
            springs_put(SPRINGS_STORED, vertex, springs_at(SPRINGS_STANDING, vertex));
        } else if vertex >= columns {
            let k = vertex - columns;
            let at = first + 3u * k;
            springs_put(SPRINGS_STORED, vertex, bitcast<vec3<f32>>(vec3<u32>(words[at], words[at + 1u], words[at + 2u])));
            springs_put_left(vertex, (words[first + 3u * (vertices - columns) + k / 4u] >> (8u * (k % 4u))) & 0xffu);
        }
    }
    return select(sheet_steps(co, first), 0u, entry.fresh == 1u);
}

// Keeps a sheet of its room until the next step.
fn store_sheet(entry: SheetEntry, sheet: u32, steps: u32) {
    let co = stand.coefficients;
    let columns = springs_columns(co);
    let count = springs_vertices(co) - columns;
    let first = entry.place * sheet_words(co);
    var quad = 0u;
    for (var k = 0u; k < count; k++) {
        let bits = bitcast<vec3<u32>>(springs_at(sheet, columns + k));
        words[first + 3u * k] = bits.x;
        words[first + 3u * k + 1u] = bits.y;
        words[first + 3u * k + 2u] = bits.z;
        quad |= (springs_left(columns + k) & 0xffu) << (8u * (k % 4u));
        if k % 4u == 3u || k + 1u == count {
            words[first + 3u * count + k / 4u] = quad;
            quad = 0u;
        }
    }
    words[first + sheet_words(co) - 1u] = steps + min(entry.hurry, 0xffffffffu - steps);
}

@compute @workgroup_size(64)
fn sheet_touch_pass(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&entries) {
        return;
    }
    entry_at = id.x;
    let entry = entries[id.x];
    let co = stand.coefficients;
    let foot = vec2<f32>(entry.root.x, entry.root.z);
    var ends = vec4<f32>(0.0);
    for (var k = 0u; k < 2u; k++) {
        let tilt = tilt_at(entry.patch_index, foot + select(-entry.root.half_width, entry.root.half_width, k == 1u));
        ends = select(vec4<f32>(tilt, ends.zw), vec4<f32>(ends.xy, tilt), k == 1u);
    }
    springs_stand(co, entry.root, SPRINGS_STANDING, ends.xy, ends.zw);
    let steps = load_sheet(entry);
    var outcome = SPRINGS_LEANING;
    var now = SPRINGS_STORED;
    var later = steps;
    if entry.root.length > 0.0 {
        outcome = springs_begin(co, SpringsMaps(entry.first, entry.count, entry.last), entry.root, steps);
        now = select(SPRINGS_NOW, SPRINGS_STORED, outcome == SPRINGS_FREE);
        later = select(0u, steps + select(1u, 0u, steps == 0xffffffffu), outcome == SPRINGS_FREE);
    }
    springs_put_word(outcome_word(), outcome);
    if outcome == SPRINGS_TOUCHED {
        return;
    }
    for (var vertex = 0u; vertex < springs_vertices(co) && outcome == SPRINGS_FREE; vertex++) {
        springs_put_left(vertex, 0u);
    }
    store_sheet(entry, now, later);
}

@compute @workgroup_size(64)
fn sheet_resolve_pass(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&entries) {
        return;
    }
    entry_at = id.x;
    let outcome = springs_word(outcome_word());
    let entry = entries[id.x];
    if outcome == SPRINGS_FREE || entry.root.length <= 0.0 {
        return;
    }
    let co = stand.coefficients;
    let maps = SpringsMaps(entry.first, entry.count, entry.last);
    for (var vertex = 0u; vertex < springs_vertices(co); vertex++) {
        springs_put(SPRINGS_BEGUN, vertex, springs_at(SPRINGS_NOW, vertex));
    }
    if outcome == SPRINGS_TOUCHED {
        for (var moment = 0u; moment <= maps.last; moment++) {
            springs_resolve(co, maps, entry.root, moment, entry.heading);
        }
        store_sheet(entry, SPRINGS_NOW, 0u);
    }
    let length_ = entry.root.length;
    let by = springs_felt(co, maps, entry.root, SPRINGS_BEGUN, SPRINGS_NOW, SPRINGS_STANDING, stand.stiffness * length_ * length_ * length_);
    if by.head != SPRINGS_NOBODY {
        reaction_sum(stand.reactions + REACTION_WORDS * by.head, by.felt);
    }
}
