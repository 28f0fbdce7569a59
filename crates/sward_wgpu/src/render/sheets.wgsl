// Sheets: a plant becomes the points of a grid on the smooth surface through its sheet. Twin: picture/sheets.rs, where everything is explained.
// `sheet_at` is in bent_at.wgsl or deformed_at.wgsl.

fn solve_joints(which: u32, plant: Rooted) {
    let draw = draws[which];
    let co = SpringsCoefficients(prepare.sheet.x, prepare.sheet.y, 0u, 0u, 0.0, 1.0, 1.0, 0u);
    let heading = math_sin_cos(plant.yaw);
    let local = plant.who.local;
    let half_width = 0.5 * plant.width * heading.yx;
    let slope = terrain_height_and_gradient(prepare.grid, draw.anchor, local).yz;
    let root = SheetRoot(local.x, plant.ground, local.y, plant.height, half_width, slope, vec2<f32>(0.0), vec2<f32>(0.0));
    var sheet = sheet_at(co, which, plant, root);
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
