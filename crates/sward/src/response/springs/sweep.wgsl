// Structural and shear springs. Twin: sweep.rs, where everything is explained. Needs math, vector, sheet, held.

fn springs_is_fixed(vertex: u32) -> bool {
    return (springs_lying(vertex) & 1u) == 1u;
}

fn springs_sweep(co: SpringsCoefficients, root: SheetRoot, sheet: u32) {
    let columns = i32(springs_columns(co));
    let rows = i32(springs_rows(co));
    let along = springs_foot(co, root, 1u) - springs_foot(co, root, 0u);
    let up = springs_direction(root.lean) * springs_segment(co, root);
    let right_up = springs_size(up + along);
    let left_up = springs_size(up - along);
    springs_copy(co, sheet, SPRINGS_SPARE);
    for (var vertex = columns; vertex < columns * rows; vertex++) {
        if springs_is_fixed(u32(vertex)) {
            continue;
        }
        let at = springs_at(SPRINGS_SPARE, u32(vertex));
        var sum = vec3<f32>(0.0);
        var count = 0.0;
        for (var k = 0; k < 9; k++) {
            let off = vec2<i32>(k % 3 - 1, k / 3 - 1);
            let there = vec2<i32>(vertex % columns, vertex / columns) + off;
            if k == 4 || any(there < vec2<i32>(0)) || there.x >= columns || there.y >= rows {
                continue;
            }
            let other = u32(there.y * columns + there.x);
            var rest = select(left_up, right_up, off.x == off.y);
            if off.y == 0 {
                rest = springs_size(along);
            } else if off.x == 0 {
                rest = springs_segment(co, root);
            }
            let way = at - springs_at(SPRINGS_SPARE, other);
            let long = math_upper(springs_size(way), 1e-9);
            let share = select(0.5, 1.0, there.y == 0 || springs_is_fixed(other));
            sum -= way * (share * co.stiffness * (long - rest) / long);
            count += 1.0;
        }
        springs_put(sheet, u32(vertex), at + sum / count);
    }
}
