// What is still in a body lies down; nothing jumps. Twin: lay.rs, where everything is explained.
// Needs math, distance_map, vector, sheet, lengths, push.

const SPRINGS_HALVINGS: u32 = 6u;
const SPRINGS_SPREAD: f32 = 0.34;
const SPRINGS_AHEAD: f32 = 1.5;
const SPRINGS_STRIDE: f32 = 0.05;
const SPRINGS_STRIDE_SHARE: f32 = 0.25;

fn springs_column_depth(
    co: SpringsCoefficients,
    maps: SpringsMaps,
    root: SheetRoot,
    moment: u32,
    sheet: ptr<function, Sheet>,
    column: u32,
) -> f32 {
    var most = 0.0;
    for (var row = 1u; row < springs_rows(co); row++) {
        most = math_upper(springs_depth(maps, root, moment, (*sheet).at[row * springs_columns(co) + column]), most);
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
    for (var k = 0u; k < SPRINGS_HALVINGS; k++) {
        let middle = 0.5 * (stuck + free);
        if springs_depth(maps, root, moment, springs_turned(root, below, from_, to, middle, segment)) > SPRINGS_TOLERANCE {
            stuck = middle;
        } else {
            free = middle;
        }
    }
    return springs_turned(root, below, from_, to, free, segment);
}

fn springs_lower(
    co: SpringsCoefficients,
    maps: SpringsMaps,
    root: SheetRoot,
    moment: u32,
    sheet: ptr<function, Sheet>,
    faces: ptr<function, SheetFaces>,
    column: u32,
    fallen: vec3<f32>,
) {
    let columns = springs_columns(co);
    let segment = springs_segment(co, root);
    var carried = vec3<f32>(0.0);
    for (var row = 1u; row < springs_rows(co); row++) {
        let vertex = row * columns + column;
        let below = (*sheet).at[vertex - columns];
        let at = springs_placed(root, below, (*sheet).at[vertex] + carried, segment);
        var there = at;
        if springs_depth(maps, root, moment, at) > SPRINGS_TOLERANCE {
            let from_ = springs_unit(at - below);
            there = springs_lowered(maps, root, moment, below, from_, select(fallen, from_, dot(from_.xz, from_.xz) > 1e-2), segment);
            for (var again = 0u; again < 2u; again++) {
                let way = springs_way_out(maps, root, moment, at, select((*faces).way[vertex], 0u, again == 1u));
                if dot(way, way) > 0.0 {
                    let other = springs_lowered(maps, root, moment, below, from_, vec3<f32>(way.x, 0.0, way.y), segment);
                    there = select(there, other, springs_size(other - at) < springs_size(there - at));
                }
            }
        }
        carried = there - (*sheet).at[vertex];
        (*sheet).at[vertex] = there;
    }
}

fn springs_lay(
    co: SpringsCoefficients,
    maps: SpringsMaps,
    root: SheetRoot,
    moment: u32,
    sheet: ptr<function, Sheet>,
    faces: ptr<function, SheetFaces>,
    otherwise: vec2<f32>,
) {
    let columns = springs_columns(co);
    let rows = springs_rows(co);
    for (var column = 0u; column < columns; column++) {
        if springs_column_depth(co, maps, root, moment, sheet, column) <= SPRINGS_TOLERANCE {
            continue;
        }
        let tip = (*sheet).at[(rows - 1u) * columns + column] - (*sheet).at[column];
        let fallen = springs_flat(root, tip / root.length, otherwise);
        springs_lower(co, maps, root, moment, sheet, faces, column, fallen);
        if springs_column_depth(co, maps, root, moment, sheet, column) > SPRINGS_TOLERANCE {
            for (var row = 1u; row < rows; row++) {
                let vertex = row * columns + column;
                let below = (*sheet).at[vertex - columns];
                (*sheet).at[vertex] = springs_placed(root, below, below + fallen, springs_segment(co, root));
            }
        }
    }
}

fn springs_spread(co: SpringsCoefficients, root: SheetRoot, count: u32, before: ptr<function, Sheet>, sheet: ptr<function, Sheet>) {
    let columns = springs_columns(co);
    let segment = springs_segment(co, root);
    let stride = max(min(SPRINGS_STRIDE, SPRINGS_STRIDE_SHARE * root.length), 1e-4);
    let most = max(SPRINGS_SPREAD * root.length / f32(count), SPRINGS_AHEAD * stride);
    var wanted = *sheet;
    for (var vertex = columns; vertex < columns * springs_rows(co); vertex++) {
        let below = (*sheet).at[vertex - columns];
        let was = (*before).at[vertex];
        let from_ = springs_way(before, columns, vertex - columns);
        let to = springs_way(&wanted, columns, vertex - columns);
        var there = springs_turned(root, below, from_, to, 1.0, segment);
        if springs_size(there - was) > most {
            var near = 0.0;
            var beyond = 1.0;
            for (var k = 0u; k < SPRINGS_HALVINGS; k++) {
                let middle = 0.5 * (near + beyond);
                if springs_size(springs_turned(root, below, from_, to, middle, segment) - was) > most {
                    beyond = middle;
                } else {
                    near = middle;
                }
            }
            there = springs_turned(root, below, from_, to, near, segment);
        }
        (*sheet).at[vertex] = there;
    }
}
