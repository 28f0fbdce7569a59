// The ground in frame space, read from the terrain's samples. Twin: relief.rs.
// The host declares `fn relief_load(index: i32) -> f32`.

// Reflection about the outermost samples; about the first it is even, and OpenGL leaves the remainder of negative numbers open.
fn relief_mirror(index: i32, count: i32) -> i32 {
    let period = max(2 * (count - 1), 1);
    let wrapped = abs(index) % period;
    return min(wrapped, period - wrapped);
}

fn relief_weights(f: f32) -> vec4<f32> {
    let g = f * f;
    let h = g * f;
    return 0.5 * vec4<f32>(-f + 2.0 * g - h, 2.0 - 5.0 * g + 3.0 * h, f + 4.0 * g - 3.0 * h, h - g);
}

// Height of the ground at `p`, metres in frame space. `mapping`: samples per metre (xy), sample position of the frame origin (zw).
fn relief_height(mapping: vec4<f32>, size: vec2<u32>, p: vec2<f32>) -> f32 {
    if size.x * size.y <= 1u {
        return relief_load(0);
    }
    let at = p * mapping.xy + mapping.zw;
    let corner = floor(at);
    let wx = relief_weights(at.x - corner.x);
    let wz = relief_weights(at.y - corner.y);
    let index = vec2<i32>(corner);
    let counts = vec2<i32>(size);
    var sum = 0.0;
    for (var j = 0; j < 4; j++) {
        let start = relief_mirror(index.y + j - 1, counts.y) * counts.x;
        var row = 0.0;
        for (var i = 0; i < 4; i++) {
            row += wx[i] * relief_load(start + relief_mirror(index.x + i - 1, counts.x));
        }
        sum += wz[j] * row;
    }
    return sum;
}

// Height that edits add at `p`, m. `mapping`: samples per metre (x), sample position of the frame origin (zw); `size`: columns, rows,
// place of the first sample.
fn relief_edit(mapping: vec4<f32>, size: vec3<u32>, p: vec2<f32>) -> f32 {
    let counts = vec2<i32>(size.xy);
    let at = p * mapping.x + mapping.zw;
    let corner = vec2<i32>(floor(at));
    if size.x == 0u || any(corner < vec2<i32>(-2)) || any(corner > counts) {
        return 0.0;
    }
    let wx = relief_weights(at.x - floor(at.x));
    let wz = relief_weights(at.y - floor(at.y));
    var sum = 0.0;
    for (var j = 0; j < 4; j++) {
        for (var i = 0; i < 4; i++) {
            let place = corner + vec2<i32>(i, j) - 1;
            if all(place >= vec2<i32>(0)) && all(place < counts) {
                sum += wx[i] * wz[j] * relief_load(i32(size.z) + place.y * counts.x + place.x);
            }
        }
    }
    return sum;
}
