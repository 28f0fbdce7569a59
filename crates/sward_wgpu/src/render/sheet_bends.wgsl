// How billboards are bent that bodies deform: as the middle of their sheet. Twin: picture/prepare.rs.

struct SheetStand {
    coefficients: SpringsCoefficients,
    wind: f32,
    width: f32,
    unused: vec2<f32>,
}

@group(0) @binding(4) var<storage, read> sheets: array<u32>;
@group(0) @binding(12) var<uniform> deformed: SheetStand;

fn sheet_word(index: u32) -> u32 {
    return sheets[index];
}

/// Where the billboard of a plant stands.
fn sheet_root(draw: PatchDraw, who: Who) -> SheetRoot {
    let ground = terrain_height_and_gradient(prepare.grid, draw.anchor, who.local);
    let turn = math_sin_cos(who.yaw);
    let half_ = 0.5 * deformed.width;
    return SheetRoot(who.local.x, ground.x, who.local.y, who.tall, vec2<f32>(half_ * turn.y, half_ * turn.x), ground.yz, who.plant, vec2<f32>(0.0));
}

/// Where the stored sheet of a plant begins, or NONE.
fn sheet_place(draw: PatchDraw, who: Who) -> u32 {
    let slot = draw.slots[4];
    if slot == NONE {
        return NONE;
    }
    let area = prepare.placement.cells * prepare.placement.cells;
    return now[slot * area + who.index % area];
}

/// Its sheet at the moment of the picture: in the wind, and on the way there from how bodies left it. Column by column, so that no other sheet is kept
/// meanwhile.
fn sheet_of(draw: PatchDraw, who: Who, root: SheetRoot, sheet: ptr<function, Sheet>) {
    let co = deformed.coefficients;
    let bends = vec4<f32>(
        wind_equilibrium(wind_at(draw.patch_index, who.local - root.half_width, false), deformed.wind),
        wind_equilibrium(wind_at(draw.patch_index, who.local + root.half_width, false), deformed.wind),
    );
    let place = sheet_place(draw, who);
    let first = select(place * sheet_words(co), 0u, place == NONE);
    var steps = 0u;
    if place != NONE {
        steps = sheet_steps(co, first);
    }
    let share = 1.0 - springs_share_left(co, steps);
    let columns = springs_columns(co);
    let segment = springs_segment(co, root);
    for (var column = 0u; column < columns; column++) {
        var standing = springs_from(springs_foot(co, root, column));
        var shown = standing;
        var left = standing.at;
        (*sheet).at[column] = standing.at;
        for (var row = 1u; row < springs_rows(co); row++) {
            let vertex = row * columns + column;
            let below = standing.at;
            standing = springs_raised(root, standing, springs_direction(springs_tilt(co, root, bends, column, row)), segment);
            var there = standing.at;
            if place != NONE {
                there = sheet_vertex(first, vertex - columns);
                if steps > 0u {
                    let way = springs_between(springs_unit(there - left), springs_unit(standing.at - below), share);
                    left = there;
                    shown = springs_raised(root, shown, way, segment);
                    there = shown.at;
                }
            }
            (*sheet).at[vertex] = there;
        }
    }
}

/// Bends of all segments of a plant or blade, at the moment of the picture, beyond what it bends by itself, lowest first.
fn plant_bends(which: u32, who: Who, bends: ptr<function, array<vec2<f32>, 8>>) {
    let draw = draws[which];
    let root = sheet_root(draw, who);
    var sheet: Sheet;
    sheet_of(draw, who, root, &sheet);
    let columns = springs_columns(deformed.coefficients);
    let rows = springs_rows(deformed.coefficients);
    for (var segment = 0u; segment < prepare.segments; segment++) {
        let row = (segment * (rows - 1u) + (rows - 1u) / 2u) / max(prepare.segments, 1u);
        let low = sheet.at[min(row, rows - 1u) * columns + columns / 2u];
        let high = sheet.at[min(row + 1u, rows - 1u) * columns + columns / 2u];
        let way = high - low;
        let level = sqrt(way.x * way.x + way.z * way.z);
        (*bends)[segment] = way.xz * (math_atan2(level, way.y) / max(level, 1e-9)) - who.plant;
    }
}
