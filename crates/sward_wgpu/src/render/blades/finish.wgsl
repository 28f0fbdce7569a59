// Turns the numbers of blades found into arguments of draw calls, one for each number of pieces. Those beyond the room are no more counted
// there, but in the fourth number.

struct BladeCounts {
    rooms: vec4<u32>,   // blades there is room for
    indices: vec4<u32>, // of an instance
}

@group(0) @binding(0) var<storage, read_write> found: array<u32, 4>;
@group(0) @binding(1) var<storage, read_write> arguments: array<u32, 15>;
@group(0) @binding(2) var<uniform> counts: BladeCounts;

@compute @workgroup_size(1)
fn blades_finish() {
    for (var level = 0u; level < 3u; level++) {
        let blades = min(found[level], counts.rooms[level]);
        found[3] += found[level] - blades;
        found[level] = blades;
        arguments[5u * level] = counts.indices[level];
        arguments[5u * level + 1u] = (blades + BLADES_PER_INSTANCE - 1u) / BLADES_PER_INSTANCE;
        arguments[5u * level + 2u] = 0u;
        arguments[5u * level + 3u] = 0u;
        arguments[5u * level + 4u] = 0u;
    }
}
