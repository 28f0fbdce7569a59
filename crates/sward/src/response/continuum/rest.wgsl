// β_eq over a patch from nodes two cells apart. Twin: rest.rs.
// The host declares `fn rest_node(index: u32) -> vec2<f32>`.

/// Node below a cell centre (counted from node −1) and the weight of the node above it.
fn rest_between(cell: i32) -> vec2<f32> {
    let odd = cell & 1;
    return vec2<f32>(f32((cell - odd) / 2 + 1), select(0.25, 0.75, odd == 1));
}

fn rest_mixed(a: vec2<f32>, b: vec2<f32>, weight: f32) -> vec2<f32> {
    return a * (1.0 - weight) + b * weight;
}

/// β_eq at cell (i, j), −1 ≤ i, j ≤ cells; `first` = index of the patch's first node, `width` = nodes a row.
fn rest_at(first: u32, width: u32, cell: vec2<i32>) -> vec2<f32> {
    let x = rest_between(cell.x);
    let z = rest_between(cell.y);
    let row = first + u32(z.x) * width + u32(x.x);
    let low = rest_mixed(rest_node(row), rest_node(row + 1u), x.y);
    let high = rest_mixed(rest_node(row + width), rest_node(row + width + 1u), x.y);
    return rest_mixed(low, high, z.y);
}
