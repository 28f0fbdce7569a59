// Ground height in frame space: the host's side of relief.wgsl.

@group(0) @binding(1) var<storage, read> heights: array<f32>;

fn relief_load(index: i32) -> f32 {
    return heights[index];
}

fn ground_height(p: vec2<f32>) -> f32 {
    return relief_height(frame.relief, frame.relief_size.xy, p);
}
