// Vertices go out of bodies. Twin: push.rs, where everything is explained. Needs math, distance_map, vector, sheet.
// The host declares `fn springs_map(index: u32) -> DistanceMapHead`.

struct SpringsMaps {
    first: u32,
    count: u32,
    last: u32,
}

struct SheetFaces {
    way: array<u32, 81>,
}

struct SpringsExit {
    found: bool,
    at: vec3<f32>,
    way: u32,
}

const SPRINGS_TOLERANCE: f32 = 5e-4;
const SPRINGS_SLACK: f32 = 2e-4;
const SPRINGS_TRODDEN: f32 = 2e-3;
const SPRINGS_DOWN: u32 = 7u;

fn springs_reach(maps: SpringsMaps, root: SheetRoot) -> bool {
    for (var k = 0u; k < maps.count; k++) {
        let centre = springs_map(maps.first + k).centre;
        let off = centre.xyz - springs_root_at(root);
        let far = 1.733 * centre.w + root.length + sqrt(dot(root.half_width, root.half_width));
        if dot(off, off) < far * far {
            return true;
        }
    }
    return false;
}

fn springs_depth(maps: SpringsMaps, root: SheetRoot, moment: u32, at: vec3<f32>) -> f32 {
    let height = springs_height(root, at);
    var most = 0.0;
    if height <= SPRINGS_TRODDEN {
        return most;
    }
    for (var k = 0u; k < maps.count; k++) {
        let head = springs_map(maps.first + k);
        if head.moment != moment {
            continue;
        }
        var sides = distance_map_sides(head, at);
        if sides.inside {
            var least = height - SPRINGS_TRODDEN;
            for (var face = 0u; face < 6u; face++) {
                least = math_lower(-sides.seen[face].depth, least);
            }
            most = math_upper(least, most);
        }
    }
    return most;
}

fn springs_is_under(maps: SpringsMaps, root: SheetRoot, moment: u32, at: vec3<f32>) -> bool {
    if springs_height(root, at) > SPRINGS_TRODDEN + 2.0 * SPRINGS_TOLERANCE {
        return false;
    }
    for (var k = 0u; k < maps.count; k++) {
        let head = springs_map(maps.first + k);
        if head.moment == moment && distance_map_sides(head, at).inside {
            return true;
        }
    }
    return false;
}

fn springs_deepest(co: SpringsCoefficients, maps: SpringsMaps, root: SheetRoot, moment: u32, sheet: ptr<function, Sheet>) -> f32 {
    var most = 0.0;
    for (var vertex = springs_columns(co); vertex < springs_columns(co) * springs_rows(co); vertex++) {
        most = math_upper(springs_depth(maps, root, moment, (*sheet).at[vertex]), most);
    }
    return most;
}

fn springs_exit(head: DistanceMapHead, root: SheetRoot, at: vec3<f32>, kept: u32) -> SpringsExit {
    let height = springs_height(root, at);
    var exit = SpringsExit(false, at, 0u);
    if height <= SPRINGS_TRODDEN {
        return exit;
    }
    var sides = distance_map_sides(head, at);
    if !sides.inside {
        return exit;
    }
    let down = at - vec3<f32>(0.0, height - SPRINGS_CLEAR, 0.0);
    exit.at = down;
    exit.way = SPRINGS_DOWN;
    var least = height - SPRINGS_TRODDEN;
    var deep = least;
    for (var face = 0u; face < 6u; face++) {
        let side = sides.seen[face];
        let there = at + distance_map_to_world(head, side.normal) * (SPRINGS_SLACK - side.depth);
        deep = math_lower(-side.depth, deep);
        if springs_height(root, there) < SPRINGS_CLEAR {
            continue;
        }
        if face + 1u == kept {
            exit.at = there;
            exit.way = kept;
            least = -1.0;
        } else if -side.depth < least {
            exit.at = there;
            exit.way = face + 1u;
            least = -side.depth;
        }
    }
    exit.found = deep > SPRINGS_TOLERANCE;
    if kept == SPRINGS_DOWN {
        exit.at = down;
        exit.way = SPRINGS_DOWN;
    }
    return exit;
}

// The level direction of the way out; 0 where there is none.
fn springs_way_out(maps: SpringsMaps, root: SheetRoot, moment: u32, at: vec3<f32>, kept: u32) -> vec2<f32> {
    for (var k = 0u; k < maps.count; k++) {
        let head = springs_map(maps.first + k);
        if head.moment == moment {
            let exit = springs_exit(head, root, at, kept);
            if exit.found {
                let way = exit.at.xz - at.xz;
                let long = sqrt(dot(way, way));
                return select(vec2<f32>(0.0), way / math_upper(long, 1e-9), long > 1e-6);
            }
        }
    }
    return vec2<f32>(0.0);
}

fn springs_push(
    co: SpringsCoefficients,
    maps: SpringsMaps,
    root: SheetRoot,
    moment: u32,
    sheet: ptr<function, Sheet>,
    faces: ptr<function, SheetFaces>,
) -> bool {
    var moved = false;
    for (var k = 0u; k < maps.count; k++) {
        let head = springs_map(maps.first + k);
        if head.moment != moment {
            continue;
        }
        for (var vertex = springs_columns(co); vertex < springs_columns(co) * springs_rows(co); vertex++) {
            let exit = springs_exit(head, root, (*sheet).at[vertex], (*faces).way[vertex]);
            if exit.found {
                (*sheet).at[vertex] = exit.at;
                (*faces).way[vertex] = exit.way;
                moved = true;
            }
        }
    }
    return moved;
}
