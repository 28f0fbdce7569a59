// Sheets in a step, and what their files do to them: in words of the billboard's own, not in arrays of functions, which compilers copy and
// clear vertex by vertex. Twins: sheet.rs, lengths.rs, wind.rs, recover.rs. Needs math, vector, sheet, lengths, recover.
// The host declares `fn springs_word(k: u32) -> u32` and `fn springs_put_word(k: u32, word: u32)`, of SPRINGS_ROOM words a vertex.

// Of a vertex: six places, by which way it left a body, and what it lies in.
const SPRINGS_ROOM: u32 = 20u;
// As it was left; in the wind; in this step; at its beginning, or a step later; while others change.
const SPRINGS_STORED: u32 = 0u;
const SPRINGS_STANDING: u32 = 1u;
const SPRINGS_NOW: u32 = 2u;
const SPRINGS_BEFORE: u32 = 3u;
const SPRINGS_SPARE: u32 = 4u;
// As the step began.
const SPRINGS_BEGUN: u32 = 5u;
// What a moment has come to at first: nobody needs the stored one any more.
const SPRINGS_TRIED: u32 = 0u;

fn springs_at(sheet: u32, vertex: u32) -> vec3<f32> {
    let first = vertex * SPRINGS_ROOM + 3u * sheet;
    return bitcast<vec3<f32>>(vec3<u32>(springs_word(first), springs_word(first + 1u), springs_word(first + 2u)));
}

fn springs_put(sheet: u32, vertex: u32, at: vec3<f32>) {
    let first = vertex * SPRINGS_ROOM + 3u * sheet;
    springs_put_word(first, bitcast<u32>(at.x));
    springs_put_word(first + 1u, bitcast<u32>(at.y));
    springs_put_word(first + 2u, bitcast<u32>(at.z));
}

// By which way a vertex left a body, 0: it touches none.
fn springs_left(vertex: u32) -> u32 {
    return springs_word(vertex * SPRINGS_ROOM + 18u);
}

fn springs_put_left(vertex: u32, way: u32) {
    springs_put_word(vertex * SPRINGS_ROOM + 18u, way);
}

// Whether a vertex is trodden down (1), and whether it lies in a body (2).
fn springs_lying(vertex: u32) -> u32 {
    return springs_word(vertex * SPRINGS_ROOM + 19u);
}

fn springs_put_lying(vertex: u32, lying: u32) {
    springs_put_word(vertex * SPRINGS_ROOM + 19u, lying);
}

fn springs_vertices(co: SpringsCoefficients) -> u32 {
    return springs_columns(co) * springs_rows(co);
}

fn springs_copy(co: SpringsCoefficients, from_: u32, to: u32) {
    for (var vertex = 0u; vertex < springs_vertices(co); vertex++) {
        springs_put(to, vertex, springs_at(from_, vertex));
    }
}

fn springs_feet(co: SpringsCoefficients, root: SheetRoot, sheet: u32) {
    for (var column = 0u; column < springs_columns(co); column++) {
        springs_put(sheet, column, springs_foot(co, root, column));
    }
}

// Direction of the segment above a vertex.
fn springs_way_at(sheet: u32, columns: u32, vertex: u32) -> vec3<f32> {
    return springs_unit(springs_at(sheet, vertex + columns) - springs_at(sheet, vertex));
}

fn springs_keep_lengths(co: SpringsCoefficients, root: SheetRoot, sheet: u32) {
    let columns = springs_columns(co);
    let segment = springs_segment(co, root);
    for (var column = 0u; column < columns; column++) {
        var carried = vec3<f32>(0.0);
        for (var row = 1u; row < springs_rows(co); row++) {
            let vertex = row * columns + column;
            let at = springs_at(sheet, vertex) + carried;
            let there = springs_placed(root, springs_at(sheet, vertex - columns), at, segment);
            carried += there - at;
            springs_put(sheet, vertex, there);
        }
    }
}

fn springs_stand(co: SpringsCoefficients, root: SheetRoot, sheet: u32, first: vec2<f32>, last: vec2<f32>) {
    let columns = springs_columns(co);
    springs_feet(co, root, sheet);
    for (var vertex = columns; vertex < springs_vertices(co); vertex++) {
        let tilt = springs_tilt(co, root, vec4<f32>(first, last), vertex % columns, vertex / columns);
        springs_put(sheet, vertex, springs_at(sheet, vertex - columns) + springs_direction(tilt) * springs_segment(co, root));
    }
    springs_keep_lengths(co, root, sheet);
}

// From as it was left to as the wind has it.
fn springs_recover(co: SpringsCoefficients, root: SheetRoot, sheet: u32, steps: u32) {
    if steps == 0u {
        springs_copy(co, SPRINGS_STORED, sheet);
        return;
    }
    let share = 1.0 - springs_share_left(co, steps);
    let columns = springs_columns(co);
    springs_feet(co, root, sheet);
    for (var vertex = columns; vertex < springs_vertices(co); vertex++) {
        let below = vertex - columns;
        let way = springs_between(springs_way_at(SPRINGS_STORED, columns, below), springs_way_at(SPRINGS_STANDING, columns, below), share);
        springs_put(sheet, vertex, springs_at(sheet, below) + way * springs_segment(co, root));
    }
    springs_keep_lengths(co, root, sheet);
}
