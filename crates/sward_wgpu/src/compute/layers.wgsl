// A step of a stand of meshes: one invocation is one cell of the plane, or of a touched plant's own.

struct PlaneStep {
    co: HarmonicCoefficients,
    touch: HarmonicCoefficients,
    side: u32, // cells along a side of the plane
    note: u32, // first cell of the present's note
    dt: f32,
    unused: u32,
}

struct Touched {
    slot: u32,
    fresh: u32,
    wind: vec2<f32>, // along the plane
    brushes: vec2<u32>, // first, and one past the last
    cell_mass: f32, // of the leaves of a cell, kg
    unused: u32,
}

@group(0) @binding(0) var<uniform> plane: PlaneStep;
@group(0) @binding(1) var<uniform> wind: WindBlock;
@group(0) @binding(2) var<storage, read> waves_now: array<vec2<f32>>;
@group(0) @binding(3) var<storage, read_write> waves_old: array<vec2<f32>>; // becomes the next
@group(0) @binding(4) var<storage, read_write> wave_notes: array<vec2<f32>>;
@group(0) @binding(5) var<storage, read> touched: array<Touched>;
@group(0) @binding(6) var<storage, read> brushes: array<HarmonicBrush>;
@group(0) @binding(7) var<storage, read_write> touch_now: array<vec2<f32>>;
@group(0) @binding(8) var<storage, read> wind_tile: array<vec2<f32>>;
@group(0) @binding(9) var<storage, read_write> touch_old: array<vec2<f32>>; // becomes the next

// What each brush feels.
@group(0) @binding(10) var<storage, read_write> felt_sums: array<atomic<u32>>;

fn reaction_add(word: u32, parts: i32) {
    atomicAdd(&felt_sums[word], bitcast<u32>(parts));
}

fn wind_tile_load(index: u32) -> vec2<f32> {
    return wind_tile[index];
}

@compute @workgroup_size(8, 8)
fn plane_pass(@builtin(global_invocation_id) id: vec3<u32>) {
    let n = plane.side;
    if id.x >= n || id.y >= n {
        return;
    }
    let last = n - 1u;
    let here = id.y * n + id.x;
    let around = waves_now[id.y * n + ((id.x + last) & last)] + waves_now[id.y * n + ((id.x + 1u) & last)]
        + waves_now[((id.y + last) & last) * n + id.x] + waves_now[((id.y + 1u) & last) * n + id.x];
    let air = wind_at_node(vec2<i32>(0), vec2<i32>(id.xy), false);
    let next = harmonic_free(plane.co, waves_now[here], waves_old[here], around, air);
    waves_old[here] = next;
    wave_notes[plane.note + here] = next;
}

@compute @workgroup_size(8, 8)
fn plant_pass(@builtin(global_invocation_id) id: vec3<u32>) {
    let plant = touched[id.z];
    let first = plant.slot * HARMONIC_TOUCH_SIDE * HARMONIC_TOUCH_SIDE;
    let at = first + id.y * HARMONIC_TOUCH_SIDE + id.x;
    var here = vec2<f32>(0.0);
    var old = vec2<f32>(0.0);
    var around = vec2<f32>(0.0);
    if plant.fresh == 0u {
        let last = HARMONIC_TOUCH_SIDE - 1u;
        here = touch_now[at];
        old = touch_old[at];
        around = touch_now[select(at - 1u, at, id.x == 0u)] + touch_now[select(at + 1u, at, id.x == last)]
            + touch_now[select(at - HARMONIC_TOUCH_SIDE, at, id.y == 0u)] + touch_now[select(at + HARMONIC_TOUCH_SIDE, at, id.y == last)];
    } else {
        touch_now[at] = vec2<f32>(0.0);
    }
    let middle = vec2<f32>(id.xy) + vec2<f32>(0.5 - 0.5 * f32(HARMONIC_TOUCH_SIDE), 0.5);
    // The one that holds most.
    var held = vec3<f32>(0.0);
    var by = plant.brushes.x;
    for (var k = plant.brushes.x; k < plant.brushes.y; k++) {
        let one = harmonic_brushed(brushes[k], middle);
        if one.z > held.z {
            held = one;
            by = k;
        }
    }
    let change = harmonic_taken_along(plane.touch, here, old, held);
    touch_old[at] = harmonic_free(plane.touch, here, old, around, plant.wind) + change;
    if held.z > 0.0 {
        let force = harmonic_felt(brushes[by], middle, change, plant.cell_mass, plane.dt);
        reaction_sum(REACTION_WORDS * by, Felt(force, vec3<f32>(0.0), 0.0));
    }
}
