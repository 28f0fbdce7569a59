// Vertices go out of bodies. Twin: push.rs, where everything is explained. Needs math, distance_map, vector, sheet, held.
// The host declares `fn springs_map(index: u32) -> DistanceMapHead`.

struct SpringsMaps {
    first: u32,
    count: u32,
    last: u32,
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

// The shortest way out of a body that a point lies in, m, `least` if that is shorter; below 0 outside.
fn springs_depth_in(head: DistanceMapHead, at: vec3<f32>, least: f32) -> f32 {
    let own = distance_map_to_body(head, at);
    if !all(abs(own) < vec3<f32>(head.centre.w)) {
        return -1.0;
    }
    var depth = least;
    for (var face = 0u; face < 6u; face++) {
        let seen = distance_map_side(head, face, own);
        if seen.distance >= 0.0 {
            return -1.0;
        }
        depth = math_lower(-seen.depth, depth);
    }
    return depth;
}

// How deep a point lies in any body, m; 0 on the ground under one, below 0 in none.
fn springs_lies(maps: SpringsMaps, root: SheetRoot, moment: u32, at: vec3<f32>) -> f32 {
    let least = math_upper(springs_height(root, at) - SPRINGS_TRODDEN, 0.0);
    var most = -1.0;
    for (var k = 0u; k < maps.count; k++) {
        let head = springs_map(maps.first + k);
        if head.moment == moment {
            most = math_upper(springs_depth_in(head, at, least), most);
        }
    }
    return most;
}

fn springs_depth(maps: SpringsMaps, root: SheetRoot, moment: u32, at: vec3<f32>) -> f32 {
    if springs_height(root, at) <= SPRINGS_TRODDEN {
        return 0.0;
    }
    return math_upper(springs_lies(maps, root, moment, at), 0.0);
}

fn springs_deepest(co: SpringsCoefficients, maps: SpringsMaps, root: SheetRoot, moment: u32, sheet: u32) -> f32 {
    var most = 0.0;
    for (var vertex = springs_columns(co); vertex < springs_vertices(co); vertex++) {
        most = math_upper(springs_depth(maps, root, moment, springs_at(sheet, vertex)), most);
    }
    return most;
}

fn springs_exit(head: DistanceMapHead, root: SheetRoot, at: vec3<f32>, kept: u32) -> SpringsExit {
    let height = springs_height(root, at);
    let own = distance_map_to_body(head, at);
    let none = SpringsExit(false, at, 0u);
    if height <= SPRINGS_TRODDEN || !all(abs(own) < vec3<f32>(head.centre.w)) {
        return none;
    }
    let down = at - vec3<f32>(0.0, height - SPRINGS_CLEAR, 0.0);
    var exit = SpringsExit(true, down, SPRINGS_DOWN);
    var least = height - SPRINGS_TRODDEN;
    var deep = least;
    for (var face = 0u; face < 6u; face++) {
        let side = distance_map_side(head, face, own);
        if side.distance >= 0.0 {
            return none;
        }
        let there = at + distance_map_to_world(head, side.normal) * (SPRINGS_SLACK - side.depth);
        deep = math_lower(-side.depth, deep);
        let allowed = springs_height(root, there) >= SPRINGS_CLEAR;
        if allowed && (face + 1u == kept || -side.depth < least) {
            exit.at = there;
            exit.way = face + 1u;
            least = select(-side.depth, -1.0, face + 1u == kept);
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

fn springs_push(co: SpringsCoefficients, maps: SpringsMaps, root: SheetRoot, moment: u32, sheet: u32) -> bool {
    var moved = false;
    for (var k = 0u; k < maps.count; k++) {
        let head = springs_map(maps.first + k);
        if head.moment != moment {
            continue;
        }
        for (var vertex = springs_columns(co); vertex < springs_vertices(co); vertex++) {
            let exit = springs_exit(head, root, springs_at(sheet, vertex), springs_left(vertex));
            if exit.found {
                springs_put(sheet, vertex, exit.at);
                springs_put_left(vertex, exit.way);
                moved = true;
            }
        }
    }
    return moved;
}
