// Upper segments, after the wave. Twin: `lags` of response/continuum/step.rs in the core.

fn store_upper(plane: u32, bend: vec2<f32>) {
    upper[plane] = bend.x;
    upper[plane + stand.cells * stand.cells] = bend.y;
}

/// Upper segments of the patches that keep them; `now` is the new present here.
@compute @workgroup_size(8, 8)
fn lag_pass(@builtin(global_invocation_id) id: vec3<u32>) {
    let entry = patches[id.z];
    let area = stand.cells * stand.cells;
    let flat_cell = id.y * stand.cells + id.x;
    let first = entry.lag * (stand.lag.segments - 1u) * 2u * area + flat_cell;
    let present = now_cell(cell_index(entry.slot, id.xy));
    let fresh = (entry.flags & 1u) != 0u;
    let ring = entry.lag * stand.lag.ring * 2u * area + flat_cell;
    if stand.lag.kind == 1u {
        for (var k = 0u; k < stand.lag.ring; k++) {
            if fresh || k == stand.frame {
                past[ring + k * 2u * area] = present.bend.x;
                past[ring + k * 2u * area + area] = present.bend.y;
            }
        }
    }
    var below = present.bend;
    for (var segment = 1u; segment < stand.lag.segments; segment++) {
        let plane = first + (segment - 1u) * 2u * area;
        if stand.lag.kind == 0u {
            var here = present.bend;
            if !fresh {
                here = vec2<f32>(upper[plane], upper[plane + area]);
            }
            below = lag_cascade(stand.lag, below, here);
            store_upper(plane, below);
        } else if stand.lag.kind == 1u {
            store_upper(plane, remembered(ring, segment));
        } else {
            store_upper(plane, looked_up(entry, vec2<i32>(id.xy), segment, present));
        }
    }
}

fn past_bend(ring: u32, back: u32) -> vec2<f32> {
    let area = stand.cells * stand.cells;
    let at = ring + ((stand.frame + stand.lag.ring - back) % stand.lag.ring) * 2u * area;
    return vec2<f32>(past[at], past[at + area]);
}

fn remembered(ring: u32, segment: u32) -> vec2<f32> {
    let present = past_bend(ring, 0u);
    let before = past_bend(ring, lag_steps(stand.lag, segment, stand.lag.gamma_top));
    if dot(present, present) < dot(before, before) {
        return past_bend(ring, lag_steps(stand.lag, segment, stand.lag.gamma_recover));
    }
    return before;
}

/// β of a cell that may lie in a neighbour; beyond awake neighbours the patch's own border stands in.
fn bend_near(entry: AwakePatch, cell: vec2<i32>) -> vec2<f32> {
    let side = i32(stand.cells);
    let over = select(select(vec2<i32>(0), vec2<i32>(1), cell >= vec2<i32>(side)), vec2<i32>(-1), cell < vec2<i32>(0));
    var slot = NONE;
    if over.y == 0 && over.x != 0 {
        slot = select(entry.neighbours.y, entry.neighbours.x, over.x < 0);
    } else if over.x == 0 && over.y != 0 {
        slot = select(entry.neighbours.w, entry.neighbours.z, over.y < 0);
    }
    var at = cell;
    if slot == NONE {
        slot = entry.slot;
    } else {
        at = cell - over * side;
    }
    return now_cell(cell_index(slot, vec2<u32>(clamp(at, vec2<i32>(0), vec2<i32>(side - 1))))).bend;
}

fn looked_up(entry: AwakePatch, cell: vec2<i32>, segment: u32, present: ContinuumCell) -> vec2<f32> {
    let speed = continuum_wave_speed(stand.coefficients, present.rate);
    let offset = lag_look_up_offset(stand.lag, segment, present.bend, present.rate, speed) / stand.spacing;
    let whole = floor(offset);
    let f = offset - whole;
    let at = cell + vec2<i32>(whole);
    let low = mix(bend_near(entry, at), bend_near(entry, at + vec2<i32>(1, 0)), f.x);
    let high = mix(bend_near(entry, at + vec2<i32>(0, 1)), bend_near(entry, at + vec2<i32>(1, 1)), f.x);
    return mix(low, high, f.y);
}
