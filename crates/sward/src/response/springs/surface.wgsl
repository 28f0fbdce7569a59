// The smooth surface through a sheet's vertices. Twin: surface.rs, where everything is explained. Needs math, vector, sheet.

fn springs_weights(t: f32) -> vec4<f32> {
    let tt = t * t;
    let ttt = tt * t;
    return vec4<f32>(0.5 * (2.0 * tt - ttt - t), 0.5 * (3.0 * ttt - 5.0 * tt) + 1.0, 0.5 * (t + 4.0 * tt - 3.0 * ttt), 0.5 * (ttt - tt));
}

// Weights of the points k − 1 to k + 2, where those beyond an end continue it straight.
fn springs_span(at: f32, k: u32, count: u32) -> vec4<f32> {
    var w = springs_weights(at - f32(k));
    if k == 0u {
        w = vec4<f32>(0.0, w.y + 2.0 * w.x, w.z - w.x, w.w);
    }
    if k + 2u == count {
        w = vec4<f32>(w.x, w.y - w.w, w.z + 2.0 * w.w, 0.0);
    }
    return w;
}

fn springs_point(co: SpringsCoefficients, root: SheetRoot, sheet: ptr<function, Sheet>, across: f32, up: f32) -> vec3<f32> {
    let columns = springs_columns(co);
    let rows = springs_rows(co);
    let right = math_clamped(across, 0.0, f32(columns - 1u));
    let above = math_clamped(up, 0.0, f32(rows - 1u));
    let i = min(u32(right), columns - 2u);
    let j = min(u32(above), rows - 2u);
    let u = springs_span(right, i, columns);
    let v = springs_span(above, j, rows);
    var at = vec3<f32>(0.0);
    for (var row = 0u; row < 4u; row++) {
        for (var column = 0u; column < 4u; column++) {
            let there = (clamp(j + row, 1u, rows) - 1u) * columns + clamp(i + column, 1u, columns) - 1u;
            at += (*sheet).at[there] * (u[column] * v[row]);
        }
    }
    let low = SPRINGS_CLEAR * math_clamped(up, 0.0, 1.0) - springs_height(root, at);
    return at + vec3<f32>(0.0, math_upper(low, 0.0), 0.0);
}
