// Crossed cards bent along their joints.

// A corner of a card, and where the joints are that shape it.
struct Corner { card: u32, joint: u32, side: f32, base: u32, here: u32, low: u32, high: u32 }

// Corner `corner` of plant `index`: card, joint and side follow from its number.
fn plants_corner(index: u32, corner: u32) -> Corner {
    let segments = style.shape.x;
    let per_card = 2u * (segments + 1u);
    let joint = (corner % per_card) / 2u;
    let first = index * (segments + 1u);
    let low = first + select(joint - 1u, 0u, joint == 0u);
    return Corner(corner / per_card, joint, f32(corner & 1u) * 2.0 - 1.0, first, first + joint, low, first + min(joint + 1u, segments));
}

// A corner between the joints at its places.
fn plants_bend_between(plant: Plant, corner: Corner, base: vec3<f32>, here: vec3<f32>, low: vec3<f32>, high: vec3<f32>, keep: f32) -> Bent {
    let turn = plant.yaw + f32(corner.card) * 3.14159265 / f32(style.shape.y);
    let rung = card_rung(base, here, low, high, turn, plant.width, f32(corner.card + 1u) * f32(corner.joint), keep);
    let place = rung.middle + rung.across * (0.5 * rung.width * corner.side);
    return Bent(place, rung.across, rung.facing, f32(corner.joint) / f32(style.shape.x), corner.side, rung.lying);
}

fn plants_bend(plant: Plant, index: u32, corner: u32, keep: f32) -> Bent {
    let at = plants_corner(index, corner);
    return plants_bend_between(plant, at, joints[at.base].xyz, joints[at.here].xyz, joints[at.low].xyz, joints[at.high].xyz, keep);
}
