// Sheets: a plant becomes the points of a grid on the smooth surface through its sheet. Twin: picture/sheets.rs, where everything is explained.

// The bends of springs_pose at both ends of the foot; what all of it leans goes into the root.
fn sheet_bends(co: SpringsCoefficients, which: u32, who: Who, root: ptr<function, SheetRoot>) -> array<vec2<f32>, 2> {
    let patch_side = prepare.placement.spacing * f32(prepare.placement.cells);
    var low: array<vec2<f32>, 2>;
    var high: array<vec2<f32>, 2>;
    for (var end = 0u; end < 2u; end++) {
        // Cells and texels are asked within the patch only, as by plants.
        let away = (*root).half_width * (2.0 * f32(end) - 1.0);
        var there = who;
        there.local = vec2<f32>(math_clamped(who.local.x + away.x, 0.0, patch_side), math_clamped(who.local.y + away.y, 0.0, patch_side));
        var bends: array<vec2<f32>, 8>;
        plant_bends(which, there, &bends);
        low[end] = bends[0];
        high[end] = bends[prepare.segments - 1u];
    }
    let tilts = f32(co.rows - 1u);
    let mean_low = 0.5 * (low[0] + low[1]);
    let mean_high = 0.5 * (high[0] + high[1]);
    if co.rows == 2u {
        let shift = 0.5 * (mean_low - mean_high);
        return array<vec2<f32>, 2>(high[0] + shift, high[1] + shift);
    }
    let lean = (tilts * mean_low - mean_high) / (tilts - 1.0);
    (*root).lean = lean;
    return array<vec2<f32>, 2>(high[0] - lean, high[1] - lean);
}

fn solve_joints(which: u32, plant: Rooted) {
    let draw = draws[which];
    let co = SpringsCoefficients(prepare.sheet.x, prepare.sheet.y, 0u, 0u, 0.0, 1.0, 1.0, 0u);
    let heading = math_sin_cos(plant.yaw);
    let local = plant.who.local;
    let half_width = 0.5 * plant.width * heading.yx;
    let slope = terrain_height_and_gradient(prepare.grid, draw.anchor, local).yz;
    var root = SheetRoot(local.x, plant.ground, local.y, plant.height, half_width, slope, vec2<f32>(0.0), vec2<f32>(0.0));
    let bends = sheet_bends(co, which, plant.who, &root);
    var sheet = springs_pose(co, root, bends[0], bends[1]);
    sheet_at(co, which, plant.who, root, &sheet);
    let last = f32(co.columns - 1u);
    let top = f32(co.rows - 1u);
    var corners: array<vec3<f32>, 4>;
    if plant.straight > 0.0 {
        corners[0] = springs_point(co, root, &sheet, 0.0, 0.0);
        corners[1] = springs_point(co, root, &sheet, last, 0.0);
        corners[2] = springs_point(co, root, &sheet, 0.0, top);
        corners[3] = springs_point(co, root, &sheet, last, top);
    }
    let side = prepare.drawn + 1u;
    let shift = vec3<f32>(draw.offset.x, 0.0, draw.offset.y);
    for (var k = 0u; k < side * side; k++) {
        let across = f32(k % side) / f32(prepare.drawn);
        let up = f32(k / side) / f32(prepare.drawn);
        var at = springs_point(co, root, &sheet, across * last, up * top);
        if plant.straight > 0.0 {
            at = mix(at, mix(mix(corners[0], corners[1], across), mix(corners[2], corners[3], across), up), plant.straight);
        }
        let clear = select(0.0, BILLBOARD_CLEARANCE, up > 0.0);
        at.y = math_upper(at.y, terrain_height(prepare.grid, draw.anchor, at.xz) + clear);
        joints[plant.out * side * side + k] = vec4<f32>(at + shift, 0.0);
    }
}
