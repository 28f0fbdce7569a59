// Ground height in frame space, read from the terrain's samples.

@group(0) @binding(1) var<storage, read> heights: array<f32>;

// Reflection about the outermost samples; about the first it is even, and OpenGL leaves the remainder of negative numbers open.
fn heights_mirror(index: i32, count: i32) -> i32 {
    let period = max(2 * (count - 1), 1);
    let wrapped = abs(index) % period;
    return min(wrapped, period - wrapped);
}

fn heights_load(column: i32, row: i32) -> f32 {
    let size = vec2<i32>(frame.relief_size.xy);
    return heights[heights_mirror(row, size.y) * size.x + heights_mirror(column, size.x)];
}

fn heights_weights(f: f32) -> vec4<f32> {
    let g = f * f;
    let h = g * f;
    return 0.5 * vec4<f32>(-f + 2.0 * g - h, 2.0 - 5.0 * g + 3.0 * h, f + 4.0 * g - 3.0 * h, h - g);
}

// Height of the ground at `p`, metres in frame space.
fn ground_height(p: vec2<f32>) -> f32 {
    if frame.relief_size.x * frame.relief_size.y <= 1u {
        return heights[0];
    }
    let at = p * frame.relief.xy + frame.relief.zw;
    let corner = floor(at);
    let wx = heights_weights(at.x - corner.x);
    let wz = heights_weights(at.y - corner.y);
    let index = vec2<i32>(corner);
    var sum = 0.0;
    for (var j = 0; j < 4; j++) {
        var row = 0.0;
        for (var i = 0; i < 4; i++) {
            row += wx[i] * heights_load(index.x + i - 1, index.y + j - 1);
        }
        sum += wz[j] * row;
    }
    return sum;
}
