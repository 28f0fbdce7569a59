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

/// Its sheet at the moment of the picture.
fn sheet_of(draw: PatchDraw, who: Who, root: SheetRoot) -> Sheet {
    let co = deformed.coefficients;
    let ends = array<vec2<f32>, 2>(
        wind_equilibrium(air_at_plant(draw, who.local - root.half_width), deformed.wind),
        wind_equilibrium(air_at_plant(draw, who.local + root.half_width), deformed.wind),
    );
    var standing = springs_pose(co, root, ends[0], ends[1]);
    let slot = draw.slots[4];
    if slot == NONE {
        return standing;
    }
    let area = prepare.placement.cells * prepare.placement.cells;
    let place = now[slot * area + who.index % area];
    if place == NONE {
        return standing;
    }
    let first = place * sheet_words(co);
    var stored = sheet_points(co, root, first);
    return springs_recovered(co, root, &stored, &standing, sheet_steps(co, first));
}

/// Bends of all segments of a plant or blade, at the moment of the picture, beyond what it bends by itself, lowest first.
fn plant_bends(which: u32, who: Who, bends: ptr<function, array<vec2<f32>, 8>>) {
    let draw = draws[which];
    let root = sheet_root(draw, who);
    var sheet = sheet_of(draw, who, root);
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
