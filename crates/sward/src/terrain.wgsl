// The ground: bicubic Catmull-Rom over height samples, mirrored outside; twin of terrain.rs.
// The host declares where the samples are: fn terrain_load(index: i32) -> f32, index = row * columns + column.

struct TerrainGrid {
    size: vec2<i32>,            // columns, rows
    inverse_spacing: vec2<f32>, // samples per metre
    detail: TerrainDetail,
    edit_size: vec2<i32>,       // columns, rows of what was added since; 0: nothing
    edit_first: i32,            // where its samples begin
    edit_inverse_spacing: f32,
}

struct TerrainAnchor {
    index: vec2<i32>,    // within one mirrored period
    fraction: vec2<f32>, // 0..=1
    detail_cell: vec2<i32>,
    detail_way: vec2<f32>,
    edit_index: vec2<i32>,
    edit_fraction: vec2<f32>,
}

fn terrain_mirrored(index: i32, samples: i32) -> i32 {
    let period = select(1, 2 * (samples - 1), samples > 1);
    // Mirrored about sample 0 it is even, and OpenGL leaves the remainder of negative numbers open.
    let within = abs(index) % period;
    return select(period - within, within, within < samples);
}

fn terrain_weights(t: f32) -> vec4<f32> {
    return vec4<f32>(
        ((-0.5 * t + 1.0) * t - 0.5) * t,
        (1.5 * t - 2.5) * t * t + 1.0,
        ((-1.5 * t + 2.0) * t + 0.5) * t,
        (0.5 * t - 0.5) * t * t,
    );
}

fn terrain_slopes(t: f32) -> vec4<f32> {
    return vec4<f32>(
        (-1.5 * t + 2.0) * t - 0.5,
        (4.5 * t - 5.0) * t,
        (-4.5 * t + 4.0) * t + 0.5,
        (1.5 * t - 1.0) * t,
    );
}

// Four samples of a row around a column, above `base`.
fn terrain_row(grid: TerrainGrid, row: i32, column: i32, base: f32) -> vec4<f32> {
    let start = terrain_mirrored(row, grid.size.y) * grid.size.x;
    return vec4<f32>(
        terrain_load(start + terrain_mirrored(column - 1, grid.size.x)),
        terrain_load(start + terrain_mirrored(column, grid.size.x)),
        terrain_load(start + terrain_mirrored(column + 1, grid.size.x)),
        terrain_load(start + terrain_mirrored(column + 2, grid.size.x)),
    ) - vec4<f32>(base);
}

// Four samples of a row of the edits; 0 outside.
fn terrain_edit_row(grid: TerrainGrid, row: i32, column: i32) -> vec4<f32> {
    var samples = vec4<f32>(0.0);
    for (var k = 0; k < 4; k += 1) {
        let at = vec2<i32>(column + k - 1, row);
        if all(at >= vec2<i32>(0)) && all(at < grid.edit_size) {
            samples[k] = terrain_load(grid.edit_first + at.y * grid.edit_size.x + at.x);
        }
    }
    return samples;
}

// Height and slope that edits add.
fn terrain_edit(grid: TerrainGrid, anchor: TerrainAnchor, local: vec2<f32>) -> vec3<f32> {
    let place = anchor.edit_fraction + local * grid.edit_inverse_spacing;
    let whole = floor(place);
    let first = anchor.edit_index + vec2<i32>(whole);
    if grid.edit_size.x == 0 || any(first < vec2<i32>(-2)) || any(first > grid.edit_size) {
        return vec3<f32>(0.0);
    }
    let way = vec2<f32>(math_clamped(place.x - whole.x, 0.0, 1.0), math_clamped(place.y - whole.y, 0.0, 1.0));
    let along_z = terrain_weights(way.y);
    let slope_z = terrain_slopes(way.y);
    var added = vec3<f32>(0.0);
    for (var j = 0; j < 4; j += 1) {
        let samples = terrain_edit_row(grid, first.y + j - 1, first.x);
        let row = dot(terrain_weights(way.x), samples);
        added += vec3<f32>(along_z[j] * row, along_z[j] * dot(terrain_slopes(way.x), samples), slope_z[j] * row);
    }
    return added * vec3<f32>(1.0, vec2<f32>(grid.edit_inverse_spacing));
}

// Height [m], then slope along x and z [m/m], at `local` metres (x, z) from the anchor.
fn terrain_height_and_gradient(grid: TerrainGrid, anchor: TerrainAnchor, local: vec2<f32>) -> vec3<f32> {
    let place = anchor.fraction + local * grid.inverse_spacing;
    let whole = floor(place);
    let first = anchor.index + vec2<i32>(whole);
    let way = vec2<f32>(math_clamped(place.x - whole.x, 0.0, 1.0), math_clamped(place.y - whole.y, 0.0, 1.0));
    let base = terrain_load(
        terrain_mirrored(first.y, grid.size.y) * grid.size.x + terrain_mirrored(first.x, grid.size.x));
    let along_x = terrain_weights(way.x);
    let slope_x = terrain_slopes(way.x);
    let along_z = terrain_weights(way.y);
    let slope_z = terrain_slopes(way.y);
    var height = 0.0;
    var gradient = vec2<f32>(0.0);
    for (var j = 0; j < 4; j += 1) {
        let above = terrain_row(grid, first.y + j - 1, first.x, base);
        let row = dot(along_x, above);
        height += along_z[j] * row;
        gradient += vec2<f32>(along_z[j] * dot(slope_x, above), slope_z[j] * row);
    }
    let detail = terrain_detail(grid.detail, anchor.detail_cell, anchor.detail_way, local, 0.0);
    return vec3<f32>(base + height, gradient * grid.inverse_spacing) + detail + terrain_edit(grid, anchor, local);
}

fn terrain_height(grid: TerrainGrid, anchor: TerrainAnchor, local: vec2<f32>) -> f32 {
    return terrain_height_and_gradient(grid, anchor, local).x;
}
