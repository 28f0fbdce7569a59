// Air carries its own velocity along; twin of advect.rs, where everything is explained.
// The host declares fn fluid_flow(index: u32) -> vec2<f32>: the velocity of a cell, row by row.

const FLUID_FARTHEST: f32 = 64.0;

fn fluid_flow_at(cell: vec2<i32>, side: u32) -> vec2<f32> {
    let wrapped = vec2<u32>(cell) & vec2<u32>(side - 1u);
    return fluid_flow(wrapped.y * side + wrapped.x);
}

// The velocity of a cell after a step in which its air moves `reach` cells for every m/s.
fn fluid_carried(cell: vec2<u32>, side: u32, reach: f32) -> vec2<f32> {
    let way = fluid_flow(cell.y * side + cell.x) * reach;
    let back = -vec2<f32>(math_clamped(way.x, -FLUID_FARTHEST, FLUID_FARTHEST), math_clamped(way.y, -FLUID_FARTHEST, FLUID_FARTHEST));
    let corner = floor(back);
    let part = back - corner;
    let from_cell = vec2<i32>(cell) + vec2<i32>(corner);
    let a = fluid_flow_at(from_cell, side);
    let b = fluid_flow_at(from_cell + vec2<i32>(1, 0), side);
    let c = fluid_flow_at(from_cell + vec2<i32>(0, 1), side);
    let d = fluid_flow_at(from_cell + vec2<i32>(1, 1), side);
    let below = a + (b - a) * part.x;
    let above = c + (d - c) * part.x;
    return below + (above - below) * part.y;
}
