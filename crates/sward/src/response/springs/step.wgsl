// One step of one billboard. Twin: step.rs, where everything is explained. Needs all others but surface.

const SPRINGS_ROUNDS: u32 = 8u;
const SPRINGS_DEEP: f32 = 2e-3;
const SPRINGS_PATIENCE: u32 = 4u;

// What a step comes to: bodies touch the sheet, it would recover into one, or nothing hinders it.
const SPRINGS_TOUCHED: u32 = 0u;
const SPRINGS_LEANING: u32 = 1u;
const SPRINGS_FREE: u32 = 2u;

fn springs_is_touched(co: SpringsCoefficients, maps: SpringsMaps, root: SheetRoot, sheet: u32) -> bool {
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

// The sheet in this step, from the stored one and the one in the wind, `steps` after its last contact; returns what the step comes to.
fn springs_begin(co: SpringsCoefficients, maps: SpringsMaps, root: SheetRoot, steps: u32) -> u32 {
    for (var k = 0u; k < 2u; k++) {
        let sheet = select(SPRINGS_NOW, SPRINGS_BEFORE, k == 1u);
        springs_recover(co, root, sheet, steps + select(0u, k, steps != 0xffffffffu));
        if springs_is_touched(co, maps, root, sheet) {
            return k;
        }
    }
    return SPRINGS_FREE;
}

// Begins a moment anew, by no way that was taken before; remembers what has come of it, ways in the place of what vertices lie in.
fn springs_try_again(co: SpringsCoefficients) {
    for (var vertex = 0u; vertex < springs_vertices(co); vertex++) {
        springs_put(SPRINGS_TRIED, vertex, springs_at(SPRINGS_NOW, vertex));
        springs_put_lying(vertex, springs_left(vertex));
        springs_put(SPRINGS_NOW, vertex, springs_at(SPRINGS_BEFORE, vertex));
        springs_put_left(vertex, 0u);
    }
}

// Takes what had come of a moment at first.
fn springs_go_back(co: SpringsCoefficients) {
    for (var vertex = 0u; vertex < springs_vertices(co); vertex++) {
        springs_put(SPRINGS_NOW, vertex, springs_at(SPRINGS_TRIED, vertex));
        springs_put_left(vertex, springs_lying(vertex));
    }
}

// Out of the bodies of one moment.
fn springs_resolve(co: SpringsCoefficients, maps: SpringsMaps, root: SheetRoot, moment: u32, heading: vec2<f32>) {
    var deepest = 0.0;
    for (var vertex = 0u; vertex < springs_vertices(co); vertex++) {
        let at = springs_at(SPRINGS_NOW, vertex);
        let lies = springs_lies(maps, root, moment, at);
        let under = lies >= 0.0 && springs_height(root, at) <= SPRINGS_TRODDEN + 2.0 * SPRINGS_TOLERANCE;
        springs_put_lying(vertex, select(0u, 1u, under) | select(0u, 2u, lies > SPRINGS_TOLERANCE));
        springs_put(SPRINGS_BEFORE, vertex, at);
        deepest = math_upper(lies, deepest);
    }
    if deepest <= SPRINGS_TOLERANCE {
        return;
    }
    for (var vertex = 0u; vertex < springs_vertices(co); vertex++) {
        if springs_lying(vertex) < 2u {
            springs_put_left(vertex, 0u);
        }
    }
    var least = 0.0;
    for (var attempt = 0u; attempt < 2u; attempt++) {
        let first = attempt == 0u;
        for (var k = 0u; k < co.iterations && first; k++) {
            springs_sweep(co, root, SPRINGS_NOW);
        }
        let rounds = select(SPRINGS_PATIENCE * SPRINGS_ROUNDS, SPRINGS_ROUNDS, first);
        for (var k = 0u; k < rounds; k++) {
            let pushed = springs_push(co, maps, root, moment, SPRINGS_NOW);
            springs_keep_lengths(co, root, SPRINGS_NOW);
            if !pushed {
                break;
            }
        }
        if first {
            springs_lay(co, maps, root, moment, SPRINGS_NOW, heading);
        }
        springs_spread(co, root, maps.last + 1u, SPRINGS_NOW);
        let left_over = springs_deepest(co, maps, root, moment, SPRINGS_NOW);
        if first && left_over <= SPRINGS_DEEP {
            return;
        }
        if first {
            springs_try_again(co);
        } else if left_over >= least {
            springs_go_back(co);
        }
        least = left_over;
    }
}
