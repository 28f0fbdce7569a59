// One step of one billboard. Twin: step.rs, where everything is explained. Needs all others but surface.

const SPRINGS_ROUNDS: u32 = 8u;
const SPRINGS_DEEP: f32 = 2e-3;
const SPRINGS_PATIENCE: u32 = 4u;

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
    var least = 3.4e38;
    var kept = *faces;
    for (var attempt = 0u; attempt < 2u; attempt++) {
        var moved = before;
        var left = kept;
        var rounds = SPRINGS_ROUNDS;
        if attempt > 0u {
            left = SheetFaces();
            rounds = SPRINGS_PATIENCE * SPRINGS_ROUNDS;
        }
        for (var k = 0u; k < co.iterations && attempt == 0u; k++) {
            springs_sweep(co, root, &moved, &fixed_);
        }
        for (var k = 0u; k < rounds; k++) {
            let pushed = springs_push(co, maps, root, moment, &moved, &left);
            springs_pass(co, root, &moved);
            if !pushed {
                break;
            }
        }
        if attempt == 0u {
            springs_lay(co, maps, root, moment, &moved, &left, heading);
        }
        springs_spread(co, root, maps.last + 1u, &before, &moved);
        let deepest = springs_deepest(co, maps, root, moment, &moved);
        if deepest < least {
            least = deepest;
            *sheet = moved;
            *faces = left;
        }
        if least <= SPRINGS_DEEP {
            break;
        }
    }
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
