// A billboard as a sheet of vertices. Twin: sheet.rs, where everything is explained. Needs math, vector.

struct SpringsCoefficients {
    columns: u32,
    rows: u32,
    iterations: u32,
    cubic: u32,
    stiffness: f32,
    recover: f32,
    dt: f32,
    unused: u32,
}

struct SheetRoot {
    x: f32,
    y: f32,
    z: f32,
    length: f32,
    half_width: vec2<f32>,
    slope: vec2<f32>,
    lean: vec2<f32>,
    unused: vec2<f32>,
}

struct Sheet {
    at: array<vec3<f32>, 81>,
}

const SPRINGS_MOST_SIDE: u32 = 9u;
const SPRINGS_MOST_VERTICES: u32 = 81u;
const SPRINGS_CLEAR: f32 = 1e-3;

fn springs_columns(co: SpringsCoefficients) -> u32 {
    return clamp(co.columns, 2u, SPRINGS_MOST_SIDE);
}

fn springs_rows(co: SpringsCoefficients) -> u32 {
    return clamp(co.rows, 2u, SPRINGS_MOST_SIDE);
}

fn springs_root_at(root: SheetRoot) -> vec3<f32> {
    return vec3<f32>(root.x, root.y, root.z);
}

fn springs_height(root: SheetRoot, at: vec3<f32>) -> f32 {
    return at.y - root.y - root.slope.x * (at.x - root.x) - root.slope.y * (at.z - root.z);
}

fn springs_foot(co: SpringsCoefficients, root: SheetRoot, column: u32) -> vec3<f32> {
    let off = root.half_width * (2.0 * f32(column) / f32(springs_columns(co) - 1u) - 1.0);
    return springs_root_at(root) + vec3<f32>(off.x, dot(root.slope, off), off.y);
}

fn springs_segment(co: SpringsCoefficients, root: SheetRoot) -> f32 {
    return root.length / f32(springs_rows(co) - 1u);
}

fn springs_direction(tilt: vec2<f32>) -> vec3<f32> {
    let size = sqrt(dot(tilt, tilt));
    let sc = math_sin_cos(math_lower(size, 3.0));
    var share = 1.0;
    if size > 1e-6 {
        share = sc.x / size;
    }
    return vec3<f32>(tilt.x * share, sc.y, tilt.y * share);
}
