// The sheet of a plant whose response knows only bends. Twin: picture/sheet_at.rs, where everything is explained.

fn sheet_at(co: SpringsCoefficients, which: u32, plant: Rooted, root: SheetRoot, sheet: ptr<function, Sheet>) {
    let patch_side = prepare.placement.spacing * f32(prepare.placement.cells);
    var low: array<vec2<f32>, 2>;
    var high: array<vec2<f32>, 2>;
    for (var end = 0u; end < 2u; end++) {
        // Cells and texels are asked within the patch only, as by plants.
        let away = root.half_width * (2.0 * f32(end) - 1.0);
        var there = plant.who;
        there.local = vec2<f32>(
            math_clamped(plant.who.local.x + away.x, 0.0, patch_side),
            math_clamped(plant.who.local.y + away.y, 0.0, patch_side),
        );
        var bends: array<vec2<f32>, 8>;
        plant_bends(which, there, &bends);
        low[end] = billboard_leaning(bends[0], plant.who.plant);
        high[end] = billboard_leaning(bends[prepare.segments - 1u], plant.who.plant);
    }
    let tilts = f32(co.rows - 1u);
    let mean_low = 0.5 * (low[0] + low[1]);
    let mean_high = 0.5 * (high[0] + high[1]);
    var leaning = root;
    var shift = 0.5 * (mean_low - mean_high);
    if co.rows > 2u {
        leaning.lean = (tilts * mean_low - mean_high) / (tilts - 1.0);
        shift = -leaning.lean;
    }
    springs_pose(co, leaning, vec4<f32>(high[0] + shift, high[1] + shift), sheet);
}
