// Prepare: each visible plant is solved once, into joints that the shadow and the main pass share (spines.wgsl, sheets.wgsl).
// One invocation is one place in the drawing order of one patch. Twin: picture/prepare.rs.

struct Plant {
    root: vec3<f32>,
    height: f32,
    yaw: f32,
    width: f32,
    tint: f32,
    layer: u32,
}

@group(0) @binding(7) var<storage, read_write> plants: array<Plant>;
@group(0) @binding(8) var<storage, read_write> joints: array<vec4<f32>>;

// A plant where it stands. Twin: picture/sheets.rs.
struct Rooted {
    who: Who,
    ground: f32,   // height at its root, m
    height: f32,   // as it is drawn, m
    straight: f32, // how far it is drawn plain, 0..1
    yaw: f32,
    width: f32,    // m
    out: u32,      // its place among all plants
}

fn nothing(plant: u32) {
    plants[plant] = Plant(vec3<f32>(0.0), 0.0, 0.0, 0.0, 0.0, 0u);
}

@compute @workgroup_size(64)
fn prepare_pass(@builtin(global_invocation_id) id: vec3<u32>) {
    let which = id.y;
    let draw = draws[which];
    if id.x >= draw.count {
        return;
    }
    let out = draw.first + id.x;
    let cell = ordered_cell(id.x);
    if any(cell >= vec2<u32>(prepare.placement.cells)) {
        nothing(out);
        return;
    }
    var placed = placement_plant(prepare.placement, draw.patch_index, cell);
    if draw.growth != NONE {
        placed = placement_grown(placed, growth_at(draw.growth, cell));
    }
    if !placed.present {
        nothing(out);
        return;
    }
    let ground = terrain_height(prepare.grid, draw.anchor, placed.root);
    let root = vec3<f32>(draw.offset.x + placed.root.x, ground, draw.offset.y + placed.root.y);
    let away = distance(root, prepare.camera.xyz);
    // Farther off fewer plants stand for more: each grows wider, and the last ones shrink before they go.
    let thin = min(1.0, pow(prepare.full / max(away, 1e-3), PREPARE_THINNING)) * prepare.fullness;
    let rank = (f32(id.x) + 0.5) / f32(1u << (2u * prepare.bits));
    let stay = clamp((thin - rank) / (0.12 * thin), 0.0, 1.0);
    // The picture before may have left out what this one shows: its smallest form then.
    let then = prepare.identity.z > 0u;
    if !then && (stay <= 0.0 || away >= prepare.gone) {
        nothing(out);
        return;
    }
    let height = placed.height * mix(0.35, 1.0, stay);
    var straight = 0.0;
    if prepare.plain > 0.0 {
        straight = smoothstep(0.75 * prepare.plain, 0.97 * prepare.plain, away);
    }
    let leans = placement_combed(0.0, 0.0, placed.lean);
    let turn = math_sin_cos(leans.x);
    let index = cell.y * prepare.placement.cells + cell.x;
    let who = Who(placed.root, placed.height, index, vec2<f32>(turn.y, turn.x), leans.x, leans.y, 0.0, placed.lean);
    let width = prepare.width * (0.8 + 0.4 * fract(placed.tint * 17.3)) * min(inverseSqrt(thin), 2.2) * mix(0.5, 1.0, stay);
    solve_joints(which, Rooted(who, ground, height, straight, placed.yaw, width, out));
    let chance = fract(placed.tint * 61.7);
    var layer = prepare.layer + min(u32(chance * f32(CLUMP_VARIANTS)), CLUMP_VARIANTS - 1u);
    if then {
        layer = prepare_number(draw.patch_index, cell);
    }
    plants[out] = Plant(root, height, placed.yaw, width, placed.tint, layer);
}
