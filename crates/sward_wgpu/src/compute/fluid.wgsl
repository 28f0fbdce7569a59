// One step of a plane of air: force, columns, spread, rows, advect, columns, project, end. Twin: wind/fluid/plane.rs in the core.
// A workgroup transforms a row. Between rows and columns the plane is transposed: `waves` holds rows of waves along x.

struct FluidStep {
    side: u32,     // cells along a side, a power of two
    now: u32,      // texel of the flow
    next: u32,     // texel of the flow after the step
    gusts: u32,
    drags: u32,
    cell: f32,     // m
    width: f32,    // of the plane, m
    reach: f32,    // cells a step for every m/s
    lasts: f32,    // what is left after the step
    fastest: f32,  // m/s
    share: f32,    // 1 / side²
    unused: f32,
}

// No uniforms: Mesa compiles a shader anew for each value of a uniform that decides a branch.
@group(0) @binding(0) var<storage, read> numbers: FluidStep;
// Of each wave: its turn (of those below side/2), its difference, what is left of it after spreading.
@group(0) @binding(1) var<storage, read> table: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> gusts: array<FluidGust>;
@group(0) @binding(3) var<storage, read> drags: array<FluidDrag>;
@group(0) @binding(4) var<storage, read_write> texels: array<vec2<f32>>;
@group(0) @binding(5) var<storage, read_write> waves: array<vec2<f32>>;
@group(0) @binding(6) var<storage, read_write> cells: array<vec2<f32>>;

// Two rows of at most 512.
var<workgroup> room: array<vec2<f32>, 1024>;

fn fft_load(index: u32) -> vec2<f32> {
    return room[index];
}

fn fft_store(index: u32, value: vec2<f32>) {
    room[index] = value;
}

fn fft_turn(index: u32) -> vec2<f32> {
    return table[index].xy;
}

fn fluid_flow(index: u32) -> vec2<f32> {
    return cells[index];
}

// Puts the row at hand, transformed, where its column of waves is.
fn put_column(row: u32, lane: u32) {
    let n = numbers.side;
    workgroupBarrier();
    let base = fft_row(n, lane, false);
    for (var i = lane; i < n; i += FFT_LANES) {
        waves[i * n + row] = room[base + i];
    }
}

/// Gusts and bodies, then the rows' transform.
@compute @workgroup_size(64)
fn force_pass(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let n = numbers.side;
    for (var i = lane; i < n; i += FFT_LANES) {
        let cell = vec2<u32>(i, group.x);
        var velocity = texels[numbers.now + group.x * n + i];
        for (var k = 0u; k < numbers.gusts; k++) {
            velocity = fluid_pushed(velocity, gusts[k], fluid_off(cell, numbers.cell, numbers.width, gusts[k].at));
        }
        for (var k = 0u; k < numbers.drags; k++) {
            velocity = fluid_dragged(velocity, drags[k], fluid_off(cell, numbers.cell, numbers.width, drags[k].at));
        }
        room[i] = velocity;
    }
    put_column(group.x, lane);
}

/// Air carries itself along; then the rows' transform.
@compute @workgroup_size(64)
fn advect_pass(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let n = numbers.side;
    for (var i = lane; i < n; i += FFT_LANES) {
        room[i] = fluid_carried(vec2<u32>(i, group.x), n, numbers.reach);
    }
    put_column(group.x, lane);
}

/// The columns' transform, in place.
@compute @workgroup_size(64)
fn columns_pass(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let n = numbers.side;
    let first = group.x * n;
    for (var i = lane; i < n; i += FFT_LANES) {
        room[i] = waves[first + i];
    }
    workgroupBarrier();
    let base = fft_row(n, lane, false);
    for (var i = lane; i < n; i += FFT_LANES) {
        waves[first + i] = room[base + i];
    }
}

// Waves without divergence, and the columns' way back.
fn project(row: u32, lane: u32, spreads: bool) {
    let n = numbers.side;
    let other = (n - row) % n;
    for (var i = lane; i < n; i += FFT_LANES) {
        let slopes = vec2<f32>(table[row].z, table[i].z);
        var lasts = 1.0;
        if spreads {
            lasts = table[row].w * table[i].w;
        }
        room[i] = fluid_projected(waves[row * n + i], waves[other * n + (n - i) % n], slopes, lasts);
    }
    workgroupBarrier();
    let base = fft_row(n, lane, true);
    for (var i = lane; i < n; i += FFT_LANES) {
        cells[i * n + row] = room[base + i];
    }
}

@compute @workgroup_size(64)
fn spread_pass(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    project(group.x, lane, true);
}

@compute @workgroup_size(64)
fn project_pass(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    project(group.x, lane, false);
}

// The rows' way back, into the workgroup's room; returns where they begin.
fn rows_back(row: u32, lane: u32) -> u32 {
    let n = numbers.side;
    for (var i = lane; i < n; i += FFT_LANES) {
        room[i] = cells[row * n + i];
    }
    workgroupBarrier();
    return fft_row(n, lane, true);
}

/// Velocities again, in place.
@compute @workgroup_size(64)
fn rows_pass(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let n = numbers.side;
    let base = rows_back(group.x, lane);
    for (var i = lane; i < n; i += FFT_LANES) {
        cells[group.x * n + i] = room[base + i] * numbers.share;
    }
}

/// Velocities at the end of the step, slowed, where responses read them.
@compute @workgroup_size(64)
fn end_pass(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let n = numbers.side;
    let base = rows_back(group.x, lane);
    for (var i = lane; i < n; i += FFT_LANES) {
        let left = room[base + i] * numbers.share * numbers.lasts;
        let most = numbers.fastest;
        texels[numbers.next + group.x * n + i] = vec2<f32>(math_clamped(left.x, -most, most), math_clamped(left.y, -most, most));
    }
}
