// Sheets: a plant becomes the points of a grid on the smooth surface through its sheet. Twin: picture/sheets.rs, where everything is explained.
// `sheet_at` is in bent_at.wgsl or deformed_at.wgsl.

// A place across the sheet in each of its rows: springs_point in two parts, so that all points above each other share the first.
fn sheet_rung(co: SpringsCoefficients, sheet: ptr<function, Sheet>, across: f32, rung: ptr<function, array<vec3<f32>, SPRINGS_MOST_SIDE>>) {
    let i = min(u32(across), co.columns - 2u);
    let u = springs_span(across, i, co.columns);
    for (var row = 0u; row < co.rows; row++) {
        var at = vec3<f32>(0.0);
        for (var column = 0u; column < 4u; column++) {
            at += (*sheet).at[row * co.columns + clamp(i + column, 1u, co.columns) - 1u] * u[column];
        }
        (*rung)[row] = at;
    }
}

// The other part: a place up a rung, above the ground.
fn sheet_point(co: SpringsCoefficients, root: SheetRoot, rung: ptr<function, array<vec3<f32>, SPRINGS_MOST_SIDE>>, up: f32) -> vec3<f32> {
    let j = min(u32(up), co.rows - 2u);
    let v = springs_span(up, j, co.rows);
    var at = vec3<f32>(0.0);
    for (var row = 0u; row < 4u; row++) {
        at += (*rung)[clamp(j + row, 1u, co.rows) - 1u] * v[row];
    }
    let low = SPRINGS_CLEAR * math_clamped(up, 0.0, 1.0) - springs_height(root, at);
    return at + vec3<f32>(0.0, math_upper(low, 0.0), 0.0);
}

fn solve_joints(which: u32, plant: Rooted) {
    let draw = draws[which];
    let co = SpringsCoefficients(prepare.sheet.x, prepare.sheet.y, 0u, 0u, 0.0, 1.0, 1.0, 0u);
    let heading = math_sin_cos(plant.yaw);
    let local = plant.who.local;
    let half_width = 0.5 * plant.width * heading.yx;
    let slope = terrain_height_and_gradient(prepare.grid, draw.anchor, local).yz;
    let root = SheetRoot(local.x, plant.ground, local.y, plant.height, half_width, slope, vec2<f32>(0.0), vec2<f32>(0.0));
    var sheet: Sheet;
    sheet_at(co, which, plant, root, &sheet);
    let last = f32(co.columns - 1u);
    let top = f32(co.rows - 1u);
    // Straight ones lie between their corners, which are the sheet's own.
    let foot = array<vec3<f32>, 2>(sheet.at[0], sheet.at[co.columns - 1u]);
    let tip = array<vec3<f32>, 2>(sheet.at[(co.rows - 1u) * co.columns], sheet.at[co.rows * co.columns - 1u]);
    var rung: array<vec3<f32>, SPRINGS_MOST_SIDE>;
    let side = prepare.drawn + 1u;
    let shift = vec3<f32>(draw.offset.x, 0.0, draw.offset.y);
    for (var column = 0u; column < side; column++) {
        let across = f32(column) / f32(prepare.drawn);
        sheet_rung(co, &sheet, across * last, &rung);
        for (var row = 0u; row < side; row++) {
            let up = f32(row) / f32(prepare.drawn);
            var at = sheet_point(co, root, &rung, up * top);
            if plant.straight > 0.0 {
                at = mix(at, mix(mix(foot[0], foot[1], across), mix(tip[0], tip[1], across), up), plant.straight);
            }
            let clear = select(0.0, BILLBOARD_CLEARANCE, up > 0.0);
            at.y = math_upper(at.y, terrain_height(prepare.grid, draw.anchor, at.xz) + clear);
            joints[(plant.out * side + row) * side + column] = vec4<f32>(at + shift, 0.0);
        }
    }
}
