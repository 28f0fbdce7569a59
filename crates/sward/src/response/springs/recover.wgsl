// Recovery by directions. Twin: recover.rs, where everything is explained. Needs math, vector, sheet, lengths.

fn springs_time_left(co: SpringsCoefficients, steps: u32) -> f32 {
    return math_clamped(1.0 - f32(steps) * co.dt / co.recover, 0.0, 1.0);
}

fn springs_share_left(co: SpringsCoefficients, steps: u32) -> f32 {
    let t = springs_time_left(co, steps);
    return select(t * t * (3.0 - 2.0 * t), t * t * t, co.cubic == 1u);
}

fn springs_recovered(
    co: SpringsCoefficients,
    root: SheetRoot,
    stored: ptr<function, Sheet>,
    wind: ptr<function, Sheet>,
    steps: u32,
) -> Sheet {
    if steps == 0u {
        return *stored;
    }
    let share = 1.0 - springs_share_left(co, steps);
    let columns = springs_columns(co);
    var sheet = Sheet();
    for (var column = 0u; column < columns; column++) {
        sheet.at[column] = springs_foot(co, root, column);
    }
    for (var vertex = 0u; vertex < columns * (springs_rows(co) - 1u); vertex++) {
        let way = springs_between(springs_way(stored, columns, vertex), springs_way(wind, columns, vertex), share);
        sheet.at[vertex + columns] = sheet.at[vertex] + way * springs_segment(co, root);
    }
    springs_pass(co, root, &sheet);
    return sheet;
}
