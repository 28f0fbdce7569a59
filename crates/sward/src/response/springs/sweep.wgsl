// Structural and shear springs. Twin: sweep.rs, where everything is explained. Needs math, vector, sheet.

// Vertices that springs do not move, as bits.
struct SheetFixed {
    bits: array<u32, 3>,
}

fn springs_is_fixed(fixed_: ptr<function, SheetFixed>, vertex: u32) -> bool {
    return (((*fixed_).bits[vertex / 32u] >> (vertex % 32u)) & 1u) == 1u;
}

fn springs_sweep(co: SpringsCoefficients, root: SheetRoot, sheet: ptr<function, Sheet>, fixed_: ptr<function, SheetFixed>) {
    let columns = i32(springs_columns(co));
    let rows = i32(springs_rows(co));
    let along = springs_foot(co, root, 1u) - springs_foot(co, root, 0u);
    let up = springs_direction(root.lean) * springs_segment(co, root);
    let right_up = springs_size(up + along);
    let left_up = springs_size(up - along);
    var before = *sheet;
    for (var vertex = columns; vertex < columns * rows; vertex++) {
        if springs_is_fixed(fixed_, u32(vertex)) {
            continue;
        }
        var sum = vec3<f32>(0.0);
        var count = 0.0;
        for (var k = 0; k < 9; k++) {
            let off = vec2<i32>(k % 3 - 1, k / 3 - 1);
            let there = vec2<i32>(vertex % columns, vertex / columns) + off;
            if k == 4 || any(there < vec2<i32>(0)) || there.x >= columns || there.y >= rows {
                continue;
            }
            let other = there.y * columns + there.x;
            var rest = select(left_up, right_up, off.x == off.y);
            if off.y == 0 {
                rest = springs_size(along);
            } else if off.x == 0 {
                rest = springs_segment(co, root);
            }
            let way = before.at[vertex] - before.at[other];
            let long = math_upper(springs_size(way), 1e-9);
            let share = select(0.5, 1.0, there.y == 0 || springs_is_fixed(fixed_, u32(other)));
            sum -= way * (share * co.stiffness * (long - rest) / long);
            count += 1.0;
        }
        (*sheet).at[vertex] = before.at[vertex] + sum / count;
    }
}
