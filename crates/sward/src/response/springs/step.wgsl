// One step of one billboard. Twin: step.rs, where everything is explained. Needs all others but surface.

const SPRINGS_ROUNDS: u32 = 8u;

fn springs_is_touched(co: SpringsCoefficients, maps: SpringsMaps, root: SheetRoot, sheet: ptr<function, Sheet>) -> bool {
    if !springs_reach(maps, root) {
        return false;
    }
    for (var moment = 0u; moment <= maps.last; moment++) {
        if springs_deepest(co, maps, root, moment, sheet) > SPRINGS_TOLERANCE {
            return true;
        }
    }
    return false;
}

fn springs_resolve(
    co: SpringsCoefficients,
    maps: SpringsMaps,
    root: SheetRoot,
    moment: u32,
    heading: vec2<f32>,
    sheet: ptr<function, Sheet>,
    faces: ptr<function, SheetFaces>,
) {
    if springs_deepest(co, maps, root, moment, sheet) <= SPRINGS_TOLERANCE {
        return;
    }
    var before = *sheet;
    var fixed_ = SheetFixed();
    for (var vertex = 0u; vertex < springs_columns(co) * springs_rows(co); vertex++) {
        if springs_is_under(maps, root, moment, before.at[vertex]) {
            fixed_.bits[vertex / 32u] |= 1u << (vertex % 32u);
        }
        if springs_depth(maps, root, moment, before.at[vertex]) <= SPRINGS_TOLERANCE {
            (*faces).way[vertex] = 0u;
        }
    }
    for (var k = 0u; k < co.iterations; k++) {
        springs_sweep(co, root, sheet, &fixed_);
    }
    for (var k = 0u; k < SPRINGS_ROUNDS; k++) {
        let moved = springs_push(co, maps, root, moment, sheet, faces);
        springs_pass(co, root, sheet);
        if !moved {
            break;
        }
    }
    springs_lay(co, maps, root, moment, sheet, faces, heading);
    springs_spread(co, root, &before, sheet);
}

// Returns the steps since the last contact; `stored` and `faces` are what the step leaves.
fn springs_step(
    co: SpringsCoefficients,
    maps: SpringsMaps,
    root: SheetRoot,
    wind: ptr<function, Sheet>,
    heading: vec2<f32>,
    stored: ptr<function, Sheet>,
    steps: u32,
    faces: ptr<function, SheetFaces>,
) -> u32 {
    if root.length <= 0.0 {
        return steps;
    }
    var shown = springs_recovered(co, root, stored, wind, steps);
    if springs_is_touched(co, maps, root, &shown) {
        for (var moment = 0u; moment <= maps.last; moment++) {
            springs_resolve(co, maps, root, moment, heading, &shown, faces);
        }
        *stored = shown;
        return 0u;
    }
    let later = select(steps + 1u, steps, steps == 0xffffffffu);
    var next = springs_recovered(co, root, stored, wind, later);
    if springs_is_touched(co, maps, root, &next) {
        *stored = shown;
        return 0u;
    }
    *faces = SheetFaces();
    return later;
}
