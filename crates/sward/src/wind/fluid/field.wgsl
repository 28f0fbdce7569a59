// The flow of a plane as responses and pictures read it; twin of field.rs, where everything is explained.

struct WindFluid {
    phase: vec2<u32>, // at node (0, 0) of patch (0, 0); 2^32 is one plane
    step: u32,        // phase per node
    per_metre: f32,   // planes per metre
    now: u32,         // texel of the flow
    before: u32,      // of that one step before
    bits: u32,        // a side has 2^bits cells
    behind: f32,      // steps that the moment lies before the flow
}

// The phase at node (0, 0) of a patch.
fn wind_fluid_base(fluid: WindFluid, patch_index: vec2<i32>, intervals: u32) -> vec2<u32> {
    return fluid.phase + bitcast<vec2<u32>>(patch_index * i32(intervals)) * fluid.step;
}

// The phase at a node, counted from where the phase `base` belongs.
fn wind_fluid_to_node(fluid: WindFluid, base: vec2<u32>, node: vec2<i32>) -> vec2<u32> {
    return base + bitcast<vec2<u32>>(node) * fluid.step;
}

// The phase at `local` metres (x, z) from where the phase `base` belongs.
fn wind_fluid_to_local(fluid: WindFluid, base: vec2<u32>, local: vec2<f32>) -> vec2<u32> {
    let planes = local * fluid.per_metre;
    let part = planes - floor(planes);
    return base + (vec2<u32>(part * 16777216.0) << vec2<u32>(8u));
}

fn wind_fluid_sample(fluid: WindFluid, first: u32, phase: vec2<u32>) -> vec2<f32> {
    let cell = phase >> vec2<u32>(32u - fluid.bits);
    let next = (cell + 1u) & vec2<u32>((1u << fluid.bits) - 1u);
    let way = vec2<f32>((phase << vec2<u32>(fluid.bits)) >> vec2<u32>(8u)) * (1.0 / 16777216.0);
    let low = first + (cell.y << fluid.bits);
    let high = first + (next.y << fluid.bits);
    let a = wind_tile_load(low + cell.x);
    let b = wind_tile_load(low + next.x);
    let c = wind_tile_load(high + cell.x);
    let d = wind_tile_load(high + next.x);
    let near = a + (b - a) * way.x;
    let far = c + (d - c) * way.x;
    return near + (far - near) * way.y;
}

// Velocity of the air at a phase, beside the mean wind.
fn wind_fluid_velocity(fluid: WindFluid, phase: vec2<u32>) -> vec2<f32> {
    let now = wind_fluid_sample(fluid, fluid.now, phase);
    if fluid.behind > 0.0 {
        return now + (wind_fluid_sample(fluid, fluid.before, phase) - now) * fluid.behind;
    }
    return now;
}
