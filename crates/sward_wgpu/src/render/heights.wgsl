// Ground height in frame space: the host's side of relief.wgsl.

@group(0) @binding(1) var<storage, read> heights: array<f32>;

fn relief_load(index: i32) -> f32 {
    return heights[index];
}

// Noise on top of the samples at `p`, m. Twin: relief.rs, `detail`.
fn ground_detail(p: vec2<f32>) -> f32 {
    let cell = frame.detail_cell;
    let detail = TerrainDetail(frame.detail.x, frame.detail.y, frame.detail.z, u32(cell.z), bitcast<u32>(cell.w), 0u, 0u, 0u);
    let resolved = max(distance(p, frame.camera.xz) / 24.0 - 1.0, 0.0);
    return terrain_detail(detail, cell.xy, frame.detail_place.xy, p, resolved).x;
}

fn ground_height(p: vec2<f32>) -> f32 {
    return relief_height(frame.relief, frame.relief_size.xy, p) + relief_edit(frame.edit, frame.edit_size.xyz, p) + ground_detail(p);
}
