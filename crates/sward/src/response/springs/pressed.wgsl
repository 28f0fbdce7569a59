// What a body feels of a billboard that it deforms. Twin: pressed.rs, where everything is explained. Needs push, interaction/reaction.

const SPRINGS_LEAST: f32 = 1e-5;

// What a body feels, and the number of its map among those of the step; none if that is SPRINGS_NOBODY.
struct SpringsFelt {
    head: u32,
    felt: Felt,
}

const SPRINGS_NOBODY: u32 = 0xffffffffu;

// Tilt from upright of the line from foot to tip of the middle column.
fn springs_slant(co: SpringsCoefficients, sheet: u32) -> vec2<f32> {
    let columns = springs_columns(co);
    let middle = columns / 2u;
    let way = springs_at(sheet, (springs_rows(co) - 1u) * columns + middle) - springs_at(sheet, middle);
    let level = sqrt(way.x * way.x + way.z * way.z);
    return way.xz * (math_atan2(level, way.y) / math_upper(level, 1e-9));
}

fn springs_felt(co: SpringsCoefficients, maps: SpringsMaps, root: SheetRoot, before: u32, after: u32, standing: u32, stiffness: f32) -> SpringsFelt {
    let columns = springs_columns(co);
    let now = springs_slant(co, after);
    let tilt = sqrt(now.x * now.x + now.y * now.y);
    let towards = now / math_upper(tilt, 1e-9);
    let rest = springs_slant(co, standing);
    let away = math_upper((now.x - rest.x) * towards.x + (now.y - rest.y) * towards.y, 0.0);
    var far = 0.0;
    var way = 0.0;
    var count = 0.0;
    for (var vertex = columns; vertex < springs_vertices(co); vertex++) {
        if springs_left(vertex) != 0u {
            let at = springs_at(after, vertex);
            let gone = at - springs_at(before, vertex);
            let up = at - springs_at(after, vertex % columns);
            far += sqrt(dot(up, up));
            way += gone.x * towards.x + gone.z * towards.y;
            count += 1.0;
        }
    }
    let length_ = select(0.5 * root.length, far / count, count > 0.0);
    let was = springs_slant(co, before);
    let turn = tilt - was.x * towards.x - was.y * towards.y;
    let angle = math_sin_cos(tilt);
    let aside = turn > SPRINGS_LEAST && way > SPRINGS_LEAST * root.length;
    let lever = select(length_, angle.y * way / (count * turn), aside);
    let foot = springs_root_at(root);
    let at = foot + length_ * vec3<f32>(angle.x * towards.x, angle.y, angle.x * towards.y);
    var by = SPRINGS_NOBODY;
    var least = 3e38;
    var centre = vec3<f32>(0.0);
    for (var k = 0u; k < maps.count; k++) {
        let head = springs_map(maps.first + k);
        let off = at - head.centre.xyz;
        let distance_ = sqrt(dot(off, off)) / head.centre.w;
        if head.moment == maps.last && distance_ < least {
            by = maps.first + k;
            least = distance_;
            centre = head.centre.xyz;
        }
    }
    let fell = tilt > REACTION_CRUSHED && was.x * was.x + was.y * was.y <= REACTION_CRUSHED * REACTION_CRUSHED;
    let crushed = select(0.0, 0.5 * stiffness * away * away, fell);
    let leaning = Leaning(tilt, towards, stiffness * away, lever, length_, select(0.0, 1.0, aside), crushed);
    return SpringsFelt(by, reaction_felt(leaning, foot - centre));
}
