// The wind at a place, the sum of all sources; twin of wind/mod.rs. Its host has a variable `wind: WindBlock`, and a file says what is read of a patch
// that is tiled: tiled.wgsl, or untiled.wgsl where there is none.

// 0, which no driver can know. Mesa's drivers in software unroll loops for the numbers that a uniform gives them, and translate the kernel again at every
// dispatch: 4 ms each, for a step of 0.1 ms.
fn wind_none() -> u32 {
    return select(0u, 1u, wind_tile_load(0u).x > 1e30);
}

// Velocity of the air at a node of a patch, m/s.
fn wind_at_node(patch_index: vec2<i32>, node: vec2<i32>, tiled: bool) -> vec2<f32> {
    let none = wind_none();
    var velocity = wind.mean;
    for (var k = 0u; k < wind.count + none; k++) {
        let octave = wind_octave(k, tiled);
        let base = wind_patch_phase(octave, patch_index, wind.intervals);
        velocity += octave.amplitude * wind_sample(wind_node_phase(octave, base, node));
    }
    for (var k = 0u; k < wind.footprint_count + none; k++) {
        let print = wind.footprints[k];
        let base = wind_footprint_base(print, patch_index, wind.intervals);
        velocity += wind_footprint_velocity(print, wind_footprint_to_node(print, base, node));
    }
    for (var k = 0u; k < wind.fluid_count + none; k++) {
        let fluid = wind_fluid(k, tiled);
        let base = wind_fluid_base(fluid, patch_index, wind.intervals);
        velocity += wind_fluid_velocity(fluid, wind_fluid_to_node(fluid, base, node));
    }
    return velocity;
}

// The same at `local` metres from the corner of a patch.
fn wind_at(patch_index: vec2<i32>, local: vec2<f32>, tiled: bool) -> vec2<f32> {
    let none = wind_none();
    var velocity = wind.mean;
    for (var k = 0u; k < wind.count + none; k++) {
        let octave = wind_octave(k, tiled);
        let base = wind_patch_phase(octave, patch_index, wind.intervals);
        velocity += octave.amplitude * wind_sample(wind_local_phase(octave, base, local));
    }
    for (var k = 0u; k < wind.footprint_count + none; k++) {
        let print = wind.footprints[k];
        let base = wind_footprint_base(print, patch_index, wind.intervals);
        velocity += wind_footprint_velocity(print, wind_footprint_to_local(print, base, local));
    }
    for (var k = 0u; k < wind.fluid_count + none; k++) {
        let fluid = wind_fluid(k, tiled);
        let base = wind_fluid_base(fluid, patch_index, wind.intervals);
        velocity += wind_fluid_velocity(fluid, wind_fluid_to_local(fluid, base, local));
    }
    return velocity;
}
