// One step of a stand of plants that swing by themselves: (rebase ->) air -> fade -> touch. Twin: response/oscillator/step.rs in the core.

struct SwingStep {
    placement: PlacementParameters,
    coefficients: OscillatorCoefficients,
    patch_side: f32,
    height: f32,      // of level ground, m
    level: u32,       // all ground is level
    growing: u32,     // how far plants have grown is stored
    now: u32,         // steps done after this one
    pairs: u32,       // place of the pairs behind the edges
    blocks: u32,      // place of the blocks behind those
    count: u32,       // blocks
    contacts: u32,    // place of the contacts behind those
    reactions: u32,   // first word of what contacts feel behind the summaries
    inertia: f32,     // of a plant over its height³, kg/m
    unused: u32,
}

struct SwingPatch {
    slot: u32,
    flags: u32,       // 1: it wakes; 2: it is the tiled wind patch; 4: its tilt in the wind begins
    entry: u32,       // its place in the summaries
    keep: f32,
    patch_index: vec2<i32>,
    unused_a: u32,
    unused_b: u32,
    weights: vec4<f32>,
    around: array<u32, 9>,
    unused_c: u32,
    unused_d: u32,
    unused_e: u32,
}

@group(0) @binding(0) var<uniform> stand: SwingStep;
@group(0) @binding(1) var<uniform> wind: WindBlock;
@group(0) @binding(2) var<storage, read> patches: array<SwingPatch>;
@group(0) @binding(3) var<storage, read_write> records: array<u32>;
@group(0) @binding(4) var<storage, read_write> texels: array<f32>;
@group(0) @binding(5) var<storage, read> ground: array<f32>;
@group(0) @binding(6) var<storage, read> grown: array<u32>;
@group(0) @binding(8) var<storage, read> tile: array<vec2<f32>>;
// Edges (two words each), pairs (contact, corner x, corner z, unused), blocks (patch, corner, first pair, pairs), contacts (seven words each).
@group(0) @binding(10) var<storage, read> words: array<vec4<i32>>;
@group(0) @binding(11) var<storage, read_write> summary: array<atomic<u32>>;
@group(0) @binding(14) var<uniform> tile_wind: WindBlock;

fn wind_tile_load(index: u32) -> vec2<f32> {
    return tile[index];
}

fn air_load(index: u32) -> f32 {
    return texels[index];
}

fn contact_edge(index: u32) -> ContactEdge {
    let a = words[2u * index];
    let b = words[2u * index + 1u];
    return ContactEdge(a.xy, a.zw, bitcast<vec2<f32>>(b.xy), bitcast<f32>(b.z), 0.0);
}

fn contact_load(number: u32) -> Contact {
    let first = stand.contacts + 7u * number;
    let a = words[first];
    let b = words[first + 1u];
    let c = bitcast<vec4<f32>>(words[first + 2u]);
    let d = words[first + 6u];
    return Contact(
        a.xy, u32(a.z), u32(a.w), u32(b.x), u32(b.y), bitcast<vec2<f32>>(b.zw), c.xy, c.z, c.w,
        bitcast<vec4<f32>>(words[first + 3u]), bitcast<vec4<f32>>(words[first + 4u]), bitcast<vec4<f32>>(words[first + 5u]),
        bitcast<f32>(d.x), u32(d.y), bitcast<f32>(d.z), bitcast<f32>(d.w),
    );
}

fn reaction_add(word: u32, parts: i32) {
    atomicAdd(&summary[word], bitcast<u32>(parts));
}

/// Tilt in the moment's wind at a place of a patch.
fn tilt_at(entry: SwingPatch, local: vec2<f32>) -> vec2<f32> {
    return wind_equilibrium(wind_at(entry.patch_index, local, (entry.flags & 2u) != 0u), stand.coefficients.wind);
}

var<workgroup> peak: atomic<u32>;

/// The tilt in the wind at each texel of each awake patch.
@compute @workgroup_size(8, 8)
fn air_pass(@builtin(global_invocation_id) id: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let entry = patches[id.z];
    let co = stand.coefficients;
    let area = co.texels * co.texels;
    let first = entry.slot * 4u * area + id.y * co.texels + id.x;
    let place = (vec2<f32>(id.xy) + 0.5) * (stand.patch_side / f32(co.texels));
    let goal = tilt_at(entry, place);
    var before = vec2<f32>(texels[first], texels[first + area]);
    if (entry.flags & 5u) != 0u {
        before = goal;
    }
    let off = entry.keep * (before + co.follow * (goal - before) - goal);
    let next = goal + off;
    texels[first] = next.x;
    texels[first + area] = next.y;
    texels[first + 2u * area] = before.x;
    texels[first + 3u * area] = before.y;
    atomicMax(&peak, bitcast<u32>(off.x * off.x + off.y * off.y));
    workgroupBarrier();
    if lane == 0u {
        atomicMax(&summary[entry.entry * SUMMARY_WORDS], atomicLoad(&peak));
    }
}

fn load_record(first: u32) -> SwingRecord {
    let area = stand.placement.cells * stand.placement.cells;
    let deviation = bitcast<vec2<f32>>(vec2<u32>(records[first], records[first + area]));
    return SwingRecord(deviation, bitcast<f32>(records[first + 2u * area]), records[first + 3u * area]);
}

fn store_record(first: u32, record: SwingRecord) {
    let area = stand.placement.cells * stand.placement.cells;
    let deviation = bitcast<vec2<u32>>(record.deviation);
    records[first] = deviation.x;
    records[first + area] = deviation.y;
    records[first + 2u * area] = bitcast<u32>(record.rate);
    records[first + 3u * area] = record.stamp;
}

/// The plant of a cell as it has grown.
fn grown_plant(entry: SwingPatch, cell: vec2<u32>) -> PlacedPlant {
    let side = stand.placement.cells;
    let index = cell.y * side + cell.x;
    let plant = placement_plant(stand.placement, entry.patch_index, cell);
    if stand.growing == 0u {
        return plant;
    }
    let word = grown[(entry.slot * side * side + index) / 4u];
    return placement_grown(plant, vec4<u32>((word >> (8u * (index & 3u))) & 0xffu, 0u, 0u, 0u));
}

/// Where the numbers have changed: `stand` has those till now.
@compute @workgroup_size(8, 8)
fn rebase_pass(@builtin(global_invocation_id) id: vec3<u32>) {
    let entry = patches[id.z];
    let side = stand.placement.cells;
    let index = id.y * side + id.x;
    let first = entry.slot * 4u * side * side + index;
    let plant = grown_plant(entry, id.xy);
    let own = swing_own(stand.coefficients, placement_variety(stand.placement, entry.patch_index, index), select(0.0, plant.height, plant.present));
    store_record(first, swing_rebased(stand.coefficients, own, load_record(first), stand.now));
}

/// Plants of patches that fade keep a share of their motion; those at rest forget it.
@compute @workgroup_size(8, 8)
fn fade_pass(@builtin(global_invocation_id) id: vec3<u32>) {
    let entry = patches[id.z];
    let side = stand.placement.cells;
    let first = entry.slot * 4u * side * side + id.y * side + id.x;
    var record = load_record(first);
    record.deviation *= entry.keep;
    record.rate *= entry.keep;
    if swing_is_aged(stand.coefficients, record, stand.now) {
        record = SwingRecord(vec2<f32>(0.0), 0.0, 0u);
    }
    store_record(first, record);
}

/// What all pieces over a block ask of one of its plants; the second ones leave within the step.
struct Asked {
    staying: Gathered,
    leaving: Gathered,
    stays: f32,
}

fn asked_of(block: vec4<i32>, cell: vec2<i32>, root: vec2<f32>, height: f32, rod: f32, facing: vec2<f32>) -> Asked {
    var asked: Asked;
    asked.stays = 1.0;
    for (var k = 0u; k < u32(block.w); k++) {
        let pair = words[stand.pairs + u32(block.z) + k];
        let contact = contact_load(u32(pair.x));
        let at = cell - pair.yz;
        if any(at < vec2<i32>(0)) || any(at >= contact.size) {
            continue;
        }
        let push = instigator_push(stand.coefficients, contact, root - vec2<f32>(pair.yz) * stand.placement.spacing, height, rod, facing);
        if push.tilt <= 0.0 {
            continue;
        }
        if contact.stays < 1.0 {
            asked.leaving = touch_add(asked.leaving, push, k);
            asked.stays = contact.stays;
        } else {
            asked.staying = touch_add(asked.staying, push, k);
        }
    }
    return asked;
}

/// Plants in reach of bodies; a workgroup is one block of cells.
@compute @workgroup_size(8, 8)
fn touch_pass(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_id) lane: vec3<u32>) {
    let number = group.y * groups.x + group.x;
    if number >= stand.count {
        return;
    }
    let block = words[stand.blocks + number];
    let entry = patches[block.x];
    let side = stand.placement.cells;
    let cell = vec2<u32>(u32(block.y) & 0xffffu, u32(block.y) >> 16u) + lane.xy;
    let index = cell.y * side + cell.x;
    let plant = grown_plant(entry, cell);
    if !plant.present {
        return;
    }
    var height = stand.height;
    if stand.level == 0u {
        let first = entry.slot * 3u * side * side + index;
        let off = plant.root - (vec2<f32>(cell) + 0.5) * stand.placement.spacing;
        height = ground[first + 2u * side * side] + ground[first] * off.x + ground[first + side * side] * off.y;
    }
    let co = stand.coefficients;
    let asked = asked_of(block, vec2<i32>(cell), plant.root, height, plant.height, math_sin_cos(plant.yaw).yx);
    let first = entry.slot * 4u * side * side + index;
    let air = Air(entry.around, entry.weights, stand.patch_side);
    var still = vec2<f32>(0.0);
    if air_asks(co, air) {
        still = tilt_at(entry, plant.root);
    }
    let own = swing_own(co, placement_variety(stand.placement, entry.patch_index, index), plant.height);
    let inertia = stand.inertia * plant.height * plant.height * plant.height;
    let touched = TouchPlant(own, load_record(first), air_at(co, air, plant.root, 0.0, still), inertia, plant.height);
    let next = touch_step(co, touched, asked.staying, asked.leaving, asked.stays, stand.now);
    if next.changed {
        store_record(first, next.record);
    }
    if next.held {
        let pair = words[stand.pairs + u32(block.z) + next.by];
        let contact = contact_load(u32(pair.x));
        let at = plant.root - vec2<f32>(pair.yz) * stand.placement.spacing - contact.centre;
        let felt = reaction_felt(next.leaning, vec3<f32>(at.x, height - contact.end.z, at.y));
        reaction_sum(stand.reactions + REACTION_WORDS * u32(pair.x), felt);
    }
}
