// How a sheet stands in the wind. Twin: wind.rs, where everything is explained. Needs math, vector, sheet, lengths.

struct SpringsWave {
    bend: vec2<f32>,
    turns: vec2<f32>,
    phase: u32,
    unused: u32,
}

// One wave's share of the bend at a place.
fn springs_sway(wave: SpringsWave, at: vec2<f32>) -> vec2<f32> {
    let turns = wave.turns.x * at.x + wave.turns.y * at.y;
    let part = turns - floor(turns);
    return wave.bend * math_sin_cos(f32(wave.phase) * 1.4629181e-9 + part * 6.2831855).x;
}

// Tilt of the segment below a vertex.
fn springs_tilt(co: SpringsCoefficients, root: SheetRoot, bends: vec4<f32>, column: u32, row: u32) -> vec2<f32> {
    let across = f32(column) / f32(springs_columns(co) - 1u);
    return root.lean + (bends.xy + across * (bends.zw - bends.xy)) * (f32(row) / f32(springs_rows(co) - 1u));
}

// `bends` are those of the first column's tip and the last one's.
fn springs_pose(co: SpringsCoefficients, root: SheetRoot, bends: vec4<f32>, sheet: ptr<function, Sheet>) {
    let columns = springs_columns(co);
    for (var column = 0u; column < columns; column++) {
        var up = springs_from(springs_foot(co, root, column));
        (*sheet).at[column] = up.at;
        for (var row = 1u; row < springs_rows(co); row++) {
            let way = springs_direction(springs_tilt(co, root, bends, column, row));
            up = springs_raised(root, up, way, springs_segment(co, root));
            (*sheet).at[row * columns + column] = up.at;
        }
    }
}
