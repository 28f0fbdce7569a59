// Columns keep their lengths, above the ground. Twin: lengths.rs, where everything is explained. Needs math, vector, sheet.

fn springs_on_ground(root: SheetRoot, below: vec3<f32>, way: vec3<f32>, segment: f32) -> vec3<f32> {
    let level = sqrt(dot(way.xz, way.xz));
    let steep = sqrt(dot(root.slope, root.slope));
    var heading = vec2<f32>(1.0, 0.0);
    if level > 1e-6 {
        heading = way.xz / level;
    } else if steep > 1e-6 {
        heading = -root.slope / steep;
    }
    let rise = dot(root.slope, heading);
    let drop = springs_height(root, below) - SPRINGS_CLEAR;
    let run = 1.0 + rise * rise;
    let inner = math_upper(rise * rise * drop * drop - run * (drop * drop - segment * segment), 0.0);
    let r = (rise * drop + sqrt(inner)) / run;
    let to = vec3<f32>(heading.x * r, rise * r - drop, heading.y * r);
    return below + to * (segment / math_upper(springs_size(to), 1e-9));
}

fn springs_placed(root: SheetRoot, below: vec3<f32>, at: vec3<f32>, segment: f32) -> vec3<f32> {
    let way = springs_unit(at - below);
    let there = below + segment * way;
    if springs_height(root, there) >= SPRINGS_CLEAR {
        return there;
    }
    return springs_on_ground(root, below, way, segment);
}

// A column on its way up: where it would be, where it is, and how far it was carried.
struct SpringsColumn {
    would: vec3<f32>,
    at: vec3<f32>,
    carried: vec3<f32>,
}

fn springs_from(foot: vec3<f32>) -> SpringsColumn {
    return SpringsColumn(foot, foot, vec3<f32>(0.0));
}

// The next vertex of a column: a segment along a direction, above the ground, where what lies below has carried it.
fn springs_raised(root: SheetRoot, column: SpringsColumn, way: vec3<f32>, segment: f32) -> SpringsColumn {
    let would = column.would + way * segment;
    let at = would + column.carried;
    let there = springs_placed(root, column.at, at, segment);
    return SpringsColumn(would, there, column.carried + there - at);
}

fn springs_flat(root: SheetRoot, way: vec3<f32>, otherwise: vec2<f32>) -> vec3<f32> {
    let heading = select(otherwise, way.xz, dot(way.xz, way.xz) > 1e-4);
    let level = heading / math_upper(sqrt(dot(heading, heading)), 1e-9);
    let rise = dot(root.slope, level);
    let run = sqrt(1.0 + rise * rise);
    return vec3<f32>(level.x, rise, level.y) / run;
}
