// The passes that solve blades.

// The patch of a workgroup: the last one whose first workgroup is not beyond it.
fn blades_patch(group: u32) -> u32 {
    var low = 0u;
    var high = blades.rooms.w;
    while low + 1u < high {
        let middle = (low + high) / 2u;
        if draws[middle].first <= group {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

// Finds the blades of a picture and gives each a record. Few candidates of a workgroup are seen; solving those that are is left to a
// pass whose workgroups are full.
@compute @workgroup_size(64)
fn blades_find(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let workgroup = group.y * groups.x + group.x;
    let which = blades_patch(workgroup);
    let rank = (workgroup - draws[which].first) * BLADE_GROUP + lane;
    if rank >= draws[which].count {
        return;
    }
    let grown = blades_grown(which, rank, true);
    if !grown.seen {
        return;
    }
    let slot = atomicAdd(&found[grown.level], 1u);
    if slot < blades.rooms[grown.level] {
        records[blades.firsts[grown.level] + slot * blades_stride(grown.level) + 2u] = vec4<u32>(0u, 0u, which, rank);
    }
}

// A record that holds a blade.
struct BladeSource {
    exists: bool,
    level: u32,
    first: u32,
    which: u32,
    rank: u32,
}

fn blades_source(group: vec3<u32>, groups: vec3<u32>, lane: u32) -> BladeSource {
    var slot = (group.y * groups.x + group.x) * BLADE_GROUP + lane;
    var level = 0u;
    while level < 2u && slot >= blades.rooms[level] {
        slot -= blades.rooms[level];
        level += 1u;
    }
    if slot >= min(atomicLoad(&found[level]), blades.rooms[level]) {
        return BladeSource(false, 0u, 0u, 0u, 0u);
    }
    let first = blades.firsts[level] + slot * blades_stride(level);
    let source = records[first + 2u];
    return BladeSource(true, level, first, source.z, source.w);
}

// Fills the records.
@compute @workgroup_size(64)
fn blades_solve(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let source = blades_source(group, groups, lane);
    if !source.exists {
        return;
    }
    let grown = blades_grown(source.which, source.rank, true);
    let blade = grown.blade;
    records[source.first] = bitcast<vec4<u32>>(vec4<f32>(blade.root, blade.height));
    records[source.first + 1u] = bitcast<vec4<u32>>(vec4<f32>(blade.yaw, blade.width, blade.tint, blade.twist));
    records[source.first + 2u] = vec4<u32>(bitcast<vec2<u32>>(blade.slope), source.which, source.rank);
    blades_bend(grown, source.level, source.first + BLADE_HEAD);
}

// The same blades as they were in the picture before: the number of the plant, then points.
@compute @workgroup_size(64)
fn blades_then(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let source = blades_source(group, groups, lane);
    if !source.exists {
        return;
    }
    let grown = blades_grown(source.which, source.rank, false);
    let then = source.first + BLADE_HEAD + blades.pieces[source.level] + 1u;
    records[then] = vec4<u32>(prepare_number(draws[source.which].patch_index, grown.cell), 0u, 0u, 0u);
    blades_bend(grown, source.level, then + 1u);
}
