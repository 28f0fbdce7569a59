// A corner of a sheet where it was in the picture before.

fn plants_bend_then(plant: Plant, index: u32, corner: u32) -> Bent {
    let at = plants_corner(index, corner);
    let keep = plants_keep(plants_gone(plant, aov.eye.xyz));
    let sides = SheetAround(joints_then[at.here].xyz, joints_then[at.left].xyz, joints_then[at.right].xyz, joints_then[at.low].xyz, joints_then[at.high].xyz);
    return plants_bend_between(plant, at, sides, keep);
}
