// How plants of a continuum are bent where they stand. Twin: picture/prepare.rs.

@group(0) @binding(4) var<storage, read> upper: array<f32>;

fn rest_at_plant(draw: PatchDraw, local: vec2<f32>) -> vec2<f32> {
    return wind_equilibrium(wind_at(draw.patch_index, local, false), prepare.wind_response);
}

/// Which of the nine patches around (and including) this one holds a cell, and the cell in it.
fn owner_of(cell: vec2<i32>) -> vec3<u32> {
    let side = i32(prepare.placement.cells);
    let over = select(select(vec2<i32>(0), vec2<i32>(1), cell >= vec2<i32>(side)), vec2<i32>(-1), cell < vec2<i32>(0));
    let at = vec2<u32>(cell - over * side);
    return vec3<u32>(u32((over.y + 1) * 3 + over.x + 1), at);
}

/// Bend of segment `segment` in one cell; β_eq where the patch sleeps, β where it keeps no upper segments.
/// Segment NONE asks for the lowest one at the moment of the picture.
fn cell_bend(which: u32, cell: vec2<i32>, segment: u32, rest: vec2<f32>) -> vec2<f32> {
    let owner = owner_of(cell);
    let slot = draws[which].slots[owner.x];
    if slot == NONE {
        return rest;
    }
    let area = prepare.placement.cells * prepare.placement.cells;
    let index = owner.z * prepare.placement.cells + owner.y;
    let lag = draws[which].lags[owner.x];
    if segment > 0u && segment != NONE && lag != NONE {
        let plane = (lag * (prepare.segments - 1u) + segment - 1u) * 2u * area + index;
        return vec2<f32>(upper[plane], upper[plane + area]);
    }
    let plane = cells_first(slot, area) + index;
    let bend = cells_bend(vec2<u32>(now[plane], now[plane + area]));
    if segment != NONE || prepare.behind == 0.0 {
        return bend;
    }
    return mix(bend, cells_bend(vec2<u32>(before[plane], before[plane + area])), prepare.behind * prepare.substeps);
}

/// Bend between the four cells around a plant.
fn plant_bend(which: u32, local: vec2<f32>, segment: u32, rest: vec2<f32>) -> vec2<f32> {
    let at = local / prepare.placement.spacing - 0.5;
    let corner = floor(at);
    let f = at - corner;
    let cell = vec2<i32>(corner);
    let low = mix(cell_bend(which, cell, segment, rest), cell_bend(which, cell + vec2<i32>(1, 0), segment, rest), f.x);
    let high = mix(cell_bend(which, cell + vec2<i32>(0, 1), segment, rest), cell_bend(which, cell + vec2<i32>(1, 1), segment, rest), f.x);
    let bend = mix(low, high, f.y);
    let side = prepare.placement.spacing * f32(prepare.placement.cells);
    let w = draws[which].weights;
    let weight = mix(mix(w.x, w.y, local.x / side), mix(w.z, w.w, local.x / side), local.y / side);
    return mix(rest, bend, weight);
}

/// Bends of all segments of a plant or blade, at the moment of the picture, beyond what it bends by itself, lowest first.
fn plant_bends(which: u32, who: Who, bends: ptr<function, array<vec2<f32>, 8>>) {
    let root = who.local;
    let draw = draws[which];
    let rest = rest_at_plant(draw, root);
    // Where no upper segments are kept, all show what the lowest does.
    let gains = select(vec4<f32>(0.0, 0.0, 1.0, 1.0), prepare.lag, draw.lags[4] != NONE);
    var below_now = plant_bend(which, root, 0u, rest);
    var shown = plant_bend(which, root, NONE, rest);
    for (var segment = 0u; segment < prepare.segments; segment++) {
        if segment > 0u {
            let here = plant_bend(which, root, segment, rest);
            if prepare.behind > 0.0 {
                shown = billboard_earlier(here, below_now, shown, gains, prepare.behind);
            } else {
                shown = here;
            }
            below_now = here;
        }
        (*bends)[segment] = shown;
    }
}
