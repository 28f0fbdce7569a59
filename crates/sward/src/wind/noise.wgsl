// Gusts: octaves of noise that travel with the wind; twin of wind/noise.rs and wind/tile.rs.
// The host declares where the tile is: fn wind_tile_load(index: u32) -> vec2<f32>, index = row * 64 + column.
// The sum of all sources is sum.wgsl.

struct WindOctave {
    step_x: vec2<u32>,      // tile phase per node along +x; 2^32 is one tile
    step_z: vec2<u32>,      // along +z
    phase: vec2<u32>,       // at node (0, 0) of patch (0, 0)
    per_metre_x: vec2<f32>, // tiles per metre along +x
    per_metre_z: vec2<f32>, // along +z
    amplitude: f32,         // m/s
    reserved: u32,
}

struct WindBlock {
    mean: vec2<f32>, // m/s
    count: u32,      // octaves that count
    intervals: u32,  // node intervals along a side of a patch
    octaves: array<WindOctave, 8>,
    footprint_count: u32,
    fluid_count: u32,
    unused_a: u32,
    unused_b: u32,
    footprints: array<WindFootprint, 8>,
    fluids: array<WindFluid, 2>,
}

// The phase at a node, counted from where the phase `base` belongs.
fn wind_node_phase(octave: WindOctave, base: vec2<u32>, node: vec2<i32>) -> vec2<u32> {
    let count = bitcast<vec2<u32>>(node);
    return base + count.x * octave.step_x + count.y * octave.step_z;
}

// The phase at node (0, 0) of a patch.
fn wind_patch_phase(octave: WindOctave, patch_index: vec2<i32>, intervals: u32) -> vec2<u32> {
    return wind_node_phase(octave, octave.phase, patch_index * i32(intervals));
}

// The phase at `local` metres (x, z) from where the phase `base` belongs.
fn wind_local_phase(octave: WindOctave, base: vec2<u32>, local: vec2<f32>) -> vec2<u32> {
    let tiles = local.x * octave.per_metre_x + local.y * octave.per_metre_z;
    let part = tiles - floor(tiles);
    return base + (vec2<u32>(part * 16777216.0) << vec2<u32>(8u));
}

// Bilinear noise at a phase: the top 6 bits are the texel, the next 24 the way to the next one.
fn wind_sample(phase: vec2<u32>) -> vec2<f32> {
    let texel = phase >> vec2<u32>(26u);
    let next = (texel + 1u) & vec2<u32>(63u);
    let way = vec2<f32>((phase >> vec2<u32>(2u)) & vec2<u32>(0xffffffu)) * (1.0 / 16777216.0);
    let a = wind_tile_load(texel.y * 64u + texel.x);
    let b = wind_tile_load(texel.y * 64u + next.x);
    let c = wind_tile_load(next.y * 64u + texel.x);
    let d = wind_tile_load(next.y * 64u + next.x);
    let near = a + (b - a) * way.x;
    let far = c + (d - c) * way.x;
    return near + (far - near) * way.y;
}
