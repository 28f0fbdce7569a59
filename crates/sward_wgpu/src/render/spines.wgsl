// Spines: a plant becomes the joints of its cards. Twin: picture/prepare.rs.

fn solve_joints(which: u32, plant: Rooted) {
    let draw = draws[which];
    var local = vec3<f32>(plant.who.local.x, plant.ground, plant.who.local.y);
    let start = local;
    let length_ = plant.height / f32(prepare.segments);
    var spine: array<vec3<f32>, 9>;
    spine[0] = start;
    var bends: array<vec2<f32>, 8>;
    plant_bends(which, plant.who, &bends);
    for (var segment = 0u; segment < prepare.segments; segment++) {
        local += billboard_segment(billboard_leaning(bends[segment], plant.who.plant), length_);
        let floor_ = terrain_height(prepare.grid, draw.anchor, local.xz) + BILLBOARD_CLEARANCE;
        local.y = max(local.y, floor_);
        spine[segment + 1u] = local;
    }
    let first = plant.out * (prepare.drawn + 1u);
    let shift = vec3<f32>(draw.offset.x, 0.0, draw.offset.y);
    for (var k = 0u; k <= prepare.drawn; k++) {
        let share = f32(k) / f32(prepare.drawn);
        var joint = mix(start, local, share);
        if prepare.drawn == prepare.segments {
            joint = mix(spine[k], joint, plant.straight);
        }
        if k > 0u {
            joint.y = max(joint.y, terrain_height(prepare.grid, draw.anchor, joint.xz) + BILLBOARD_CLEARANCE);
        }
        joints[first + k] = vec4<f32>(joint + shift, 0.0);
    }
}
