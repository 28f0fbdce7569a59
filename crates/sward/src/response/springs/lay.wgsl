// What is still in a body lies down; nothing jumps. Twin: lay.rs, where everything is explained.
// Needs math, distance_map, vector, sheet, lengths, held, push.

const SPRINGS_HALVINGS: u32 = 6u;
const SPRINGS_SPREAD: f32 = 0.34;
const SPRINGS_AHEAD: f32 = 1.5;
const SPRINGS_STRIDE: f32 = 0.05;
const SPRINGS_STRIDE_SHARE: f32 = 0.25;

fn springs_column_depth(co: SpringsCoefficients, maps: SpringsMaps, root: SheetRoot, moment: u32, sheet: u32, column: u32) -> f32 {
    var most = 0.0;
    for (var row = 1u; row < springs_rows(co); row++) {
        most = math_upper(springs_depth(maps, root, moment, springs_at(sheet, row * springs_columns(co) + column)), most);
    }
    return most;
}

// Where a segment ends that turns a share of the way from one direction to another.
fn springs_turned(root: SheetRoot, below: vec3<f32>, from_: vec3<f32>, to: vec3<f32>, share: f32, segment: f32) -> vec3<f32> {
    return springs_placed(root, below, below + springs_between(from_, to, share), segment);
}

fn springs_lowered(
    maps: SpringsMaps,
    root: SheetRoot,
    moment: u32,
    below: vec3<f32>,
    from_: vec3<f32>,
    heading: vec3<f32>,
    segment: f32,
) -> vec3<f32> {
    let to = springs_unit(springs_on_ground(root, below, heading, segment) - below);
    var stuck = 0.0;
    var free = 1.0;
    // The last time round, to where it is free: each call stands in the text once, since compilers copy what they call.
    for (var k = 0u; k <= SPRINGS_HALVINGS; k++) {
        let share = select(0.5 * (stuck + free), free, k == SPRINGS_HALVINGS);
        let there = springs_turned(root, below, from_, to, share, segment);
        if k == SPRINGS_HALVINGS {
            return there;
        }
        if springs_depth(maps, root, moment, there) > SPRINGS_TOLERANCE {
            stuck = share;
        } else {
            free = share;
        }
    }
    return below;
}

// Where a vertex goes that lies in a body at `at`: down the way its segment points, or the way out, by the face kept or any, whichever moves it less.
fn springs_fallen(
    maps: SpringsMaps,
    root: SheetRoot,
    moment: u32,
    below: vec3<f32>,
    at: vec3<f32>,
    fallen: vec3<f32>,
    left: u32,
    segment: f32,
) -> vec3<f32> {
    let from_ = springs_unit(at - below);
    var there = at;
    for (var again = 0u; again < 3u; again++) {
        var heading = select(fallen, from_, dot(from_.xz, from_.xz) > 1e-2);
        if again > 0u {
            let way = springs_way_out(maps, root, moment, at, select(left, 0u, again == 2u));
            if dot(way, way) == 0.0 {
                continue;
            }
            heading = vec3<f32>(way.x, 0.0, way.y);
        }
        let other = springs_lowered(maps, root, moment, below, from_, heading, segment);
        if again == 0u || springs_size(other - at) < springs_size(there - at) {
            there = other;
        }
    }
    return there;
}

fn springs_lower(co: SpringsCoefficients, maps: SpringsMaps, root: SheetRoot, moment: u32, sheet: u32, column: u32, fallen: vec3<f32>) {
    let columns = springs_columns(co);
    let segment = springs_segment(co, root);
    var carried = vec3<f32>(0.0);
    for (var row = 1u; row < springs_rows(co); row++) {
        let vertex = row * columns + column;
        let below = springs_at(sheet, vertex - columns);
        let was = springs_at(sheet, vertex);
        var there = springs_placed(root, below, was + carried, segment);
        if springs_depth(maps, root, moment, there) > SPRINGS_TOLERANCE {
            there = springs_fallen(maps, root, moment, below, there, fallen, springs_left(vertex), segment);
        }
        carried = there - was;
        springs_put(sheet, vertex, there);
    }
}

fn springs_lay(co: SpringsCoefficients, maps: SpringsMaps, root: SheetRoot, moment: u32, sheet: u32, otherwise: vec2<f32>) {
    let columns = springs_columns(co);
    for (var column = 0u; column < columns; column++) {
        let tip = springs_at(sheet, (springs_rows(co) - 1u) * columns + column) - springs_at(sheet, column);
        let fallen = springs_flat(root, tip / root.length, otherwise);
        for (var again = 0u; again < 2u; again++) {
            if springs_column_depth(co, maps, root, moment, sheet, column) <= SPRINGS_TOLERANCE {
                break;
            }
            if again == 0u {
                springs_lower(co, maps, root, moment, sheet, column, fallen);
                continue;
            }
            for (var row = 1u; row < springs_rows(co); row++) {
                let vertex = row * columns + column;
                let below = springs_at(sheet, vertex - columns);
                springs_put(sheet, vertex, springs_placed(root, below, below + fallen, springs_segment(co, root)));
            }
        }
    }
}

// Nothing moves farther from where it was before the moment than its share.
fn springs_spread(co: SpringsCoefficients, root: SheetRoot, count: u32, sheet: u32) {
    let columns = springs_columns(co);
    let segment = springs_segment(co, root);
    let stride = math_upper(math_lower(SPRINGS_STRIDE, SPRINGS_STRIDE_SHARE * root.length), 1e-4);
    let most = math_upper(SPRINGS_SPREAD * root.length / f32(count), SPRINGS_AHEAD * stride);
    springs_copy(co, sheet, SPRINGS_SPARE);
    for (var vertex = columns; vertex < springs_vertices(co); vertex++) {
        let below = springs_at(sheet, vertex - columns);
        let was = springs_at(SPRINGS_BEFORE, vertex);
        let from_ = springs_way_at(SPRINGS_BEFORE, columns, vertex - columns);
        let to = springs_way_at(SPRINGS_SPARE, columns, vertex - columns);
        var near = 0.0;
        var beyond = 1.0;
        var there = below;
        // All of the way first; where that is too far, halvings, and the last time round the farthest that is not.
        for (var k = 0u; k <= SPRINGS_HALVINGS + 1u; k++) {
            let last = k == SPRINGS_HALVINGS + 1u;
            let share = select(select(0.5 * (near + beyond), 1.0, k == 0u), near, last);
            there = springs_turned(root, below, from_, to, share, segment);
            let far = springs_size(there - was) > most;
            if last || (k == 0u && !far) {
                break;
            }
            if far {
                beyond = share;
            } else {
                near = share;
            }
        }
        springs_put(sheet, vertex, there);
    }
}
