// One step of a continuum stand: rest -> wake -> contact -> wave. Twin: response/continuum/{step,patch}.rs in the core.
// One invocation is one cell (or wind node) of one awake patch; workgroup id z counts the patches of the pass.

/// β_eq of each wind node of each patch.
@compute @workgroup_size(8, 8)
fn rest_pass(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= stand.nodes || id.y >= stand.nodes {
        return;
    }
    let entry = patches[id.z];
    let velocity = wind_at_node(entry.patch_index, vec2<i32>(id.xy) - vec2<i32>(1), (entry.flags & 2u) != 0u);
    nodes[entry.slot * stand.nodes * stand.nodes + id.y * stand.nodes + id.x] = wind_equilibrium(velocity, stand.wind_response);
}

/// Both time levels of a waking patch at rest.
@compute @workgroup_size(8, 8)
fn wake_pass(@builtin(global_invocation_id) id: vec3<u32>) {
    let entry = patches[id.z];
    let cell = ContinuumCell(rest_of(entry.slot, vec2<i32>(id.xy)), vec2<f32>(0.0));
    let index = cell_index(entry.slot, id.xy);
    let dither = dither_of(entry, id.xy);
    store_now(index, cell, dither);
    store_old(index, cell, dither);
}

/// Bends the cells under bodies and marks them held: the wave leaves those as they are, and keeps them for the past.
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
                touch = continuum_gather(stand.coefficients, cell.bend, touch, hit, k);
            }
        }
    }
    held[entry.held * area + id.y * stand.cells + id.x] = u32(touch.hit.touches);
    if touch.hit.touches {
        let next = continuum_contact(stand.coefficients, cell.bend, touch, slope_of(entry.slot, id.xy));
        let dither = dither_of(entry, id.xy);
        store_now(index, next, dither);
        let pair = words[entry.pair_first + continuum_by(touch)];
        let contact = contacts[u32(pair.x)];
        let middle = (vec2<f32>(vec2<i32>(id.xy) - pair.yz) + 0.5) * contact.spacing - contact.centre;
        let rest = rest_of(entry.slot, vec2<i32>(id.xy));
        let leaning = continuum_leaning(stand.coefficients, stand.inertia, stand.kappa, cell, next, continuum_height(touch), rest);
        let felt = reaction_felt(leaning, vec3<f32>(middle.x, height - contact.end.z, middle.y));
        reaction_sum(stand.reactions + REACTION_WORDS * u32(pair.x), felt);
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
            if largest > 0u { atomicMax(&summary[entry * SUMMARY_WORDS + k], largest); }
        }
        let count = atomicLoad(&peak[5]);
        if count > 0u { atomicAdd(&summary[entry * SUMMARY_WORDS + 5u], count); }
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
        var slope = vec2<f32>(0.0);
        if continuum_length(free.bend) > entry.safe {
            slope = slope_of(entry.slot, id.xy);
        }
        let limited = continuum_limited(free, slope);
        next = limited.cell;
        clamped = limited.clamped;
    }
    if last_substep && entry.keep < 1.0 {
        next = continuum_faded(next, rest, entry.keep);
    }
    store_old(index, next, dither_of(entry, id.xy));
    // Activation goes by the end of the step, as on the CPU: substeps on the way there do not count.
    if last_substep {
        summarise(id.z, id.xy, continuum_deviation(next, rest), clamped, local == 0u);
    }
}
