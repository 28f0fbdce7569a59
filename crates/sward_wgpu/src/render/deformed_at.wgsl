// The sheet of a billboard that bodies deform, at the size of the picture. Twin: picture/sheet_at.rs, where everything is explained.

fn sheet_at(co: SpringsCoefficients, which: u32, plant: Rooted, root: SheetRoot, sheet: ptr<function, Sheet>) {
    let wide = plant.width / deformed.width;
    let tall = plant.height / max(plant.who.tall, 1e-9);
    var own = root;
    own.length = plant.who.tall;
    own.half_width = root.half_width / wide;
    own.lean = plant.who.plant;
    sheet_of(draws[which], plant.who, own, sheet);
    let foot = springs_root_at(root);
    for (var row = 0u; row < co.rows; row++) {
        let first = row * co.columns;
        let middle = 0.5 * ((*sheet).at[first + (co.columns - 1u) / 2u] + (*sheet).at[first + co.columns / 2u]);
        let there = foot + tall * (middle - foot);
        for (var vertex = first; vertex < first + co.columns; vertex++) {
            (*sheet).at[vertex] = there + wide * ((*sheet).at[vertex] - middle);
        }
    }
}
