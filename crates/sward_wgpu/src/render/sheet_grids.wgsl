// Sheets: grids of points that were solved, row by row from the root up.

// Corner `corner` of a grid: its point, those around it, and its place from root to tip and from side to side.
struct Corner { here: u32, left: u32, right: u32, low: u32, high: u32, side: f32, along: f32 }

fn plants_corner(index: u32, corner: u32) -> Corner {
    let pieces = style.shape.x;
    let side = pieces + 1u;
    let first = index * side * side;
    let column = corner % side;
    let row = corner / side;
    let here = first + corner;
    let left = here - select(1u, 0u, column == 0u);
    let right = here + select(1u, 0u, column == pieces);
    let low = here - select(side, 0u, row == 0u);
    let high = here + select(side, 0u, row == pieces);
    return Corner(here, left, right, low, high, 2.0 * f32(column) / f32(pieces) - 1.0, f32(row) / f32(pieces));
}

// A corner between the points around it.
fn plants_bend_between(plant: Plant, corner: Corner, around: SheetAround, keep: f32) -> Bent {
    let bent = sheet_corner(SheetOf(plant.root, plant.width, plant.height, plant.tint), around, corner.side, corner.along, keep);
    return Bent(bent.place, bent.across, bent.facing, corner.along, corner.side, bent.lying);
}

fn plants_bend(plant: Plant, index: u32, corner: u32, keep: f32) -> Bent {
    let at = plants_corner(index, corner);
    let around = SheetAround(joints[at.here].xyz, joints[at.left].xyz, joints[at.right].xyz, joints[at.low].xyz, joints[at.high].xyz);
    return plants_bend_between(plant, at, around, keep);
}
