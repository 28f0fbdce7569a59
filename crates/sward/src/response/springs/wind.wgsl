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

fn springs_pose(co: SpringsCoefficients, root: SheetRoot, first: vec2<f32>, last: vec2<f32>) -> Sheet {
    let columns = springs_columns(co);
    let rows = springs_rows(co);
    var sheet = Sheet();
    for (var column = 0u; column < columns; column++) {
        sheet.at[column] = springs_foot(co, root, column);
        let across = f32(column) / f32(columns - 1u);
        for (var row = 1u; row < rows; row++) {
            let tilt = root.lean + (first + across * (last - first)) * (f32(row) / f32(rows - 1u));
            let vertex = row * columns + column;
            sheet.at[vertex] = sheet.at[vertex - columns] + springs_direction(tilt) * springs_segment(co, root);
        }
    }
    springs_pass(co, root, &sheet);
    return sheet;
}
