// Blades of a picture: each that is seen is solved once, into the points of its strip. One invocation is one place in the drawing order
// of one patch; how many are found, and where they go, is counted on the way. Twin: picture/blades.rs.

struct Blades {
    seen: mat4x4<f32>,
    eye: vec4<f32>,       // by which blades thin out, m; w unused
    stance: vec4<f32>,    // most lean and curl, shortest, tuft
    thinning: vec4<f32>,  // a, b, c; how many times distances count in it
    distances: vec4<f32>, // of the second and third number of pieces; where plants begin to shrink and are gone, m
    pieces: vec4<u32>,    // numbers of pieces; blades of a plant
    rooms: vec4<u32>,     // blades there is room for, per number of pieces; patches
    firsts: vec4<u32>,    // first vec4 of the records of each; whether they hold a second set of points
    shape: vec4<f32>,     // widest, most twist, share of the blades drawn that are on their way in or out; w unused
}

struct Blade {
    root: vec3<f32>,
    height: f32,
    yaw: f32,
    width: f32,
    tint: f32,
    twist: f32,
    slope: vec2<f32>,
    draw: u32,
    rank: u32,
}

// A blade before it is bent.
struct Grown {
    seen: bool,
    blade: Blade,
    local: vec2<f32>, // root, m from the corner of its patch
    tall: f32,        // height of its plant, m
    cell: vec2<u32>,
    stance: BladeStance,
    plant: vec2<f32>, // how its plant leans by itself
    away: f32,
    level: u32,
}

@group(0) @binding(7) var<storage, read_write> records: array<vec4<u32>>;
@group(0) @binding(8) var<storage, read_write> found: array<atomic<u32>, 4>;
@group(0) @binding(11) var<uniform> blades: Blades;

// Whether a ball lies outside the picture's sides or behind the eye.
fn blades_unseen(centre: vec3<f32>, radius: f32) -> bool {
    let clip = blades.seen * vec4<f32>(centre, 1.0);
    let x = length(vec3<f32>(blades.seen[0].x, blades.seen[1].x, blades.seen[2].x));
    let y = length(vec3<f32>(blades.seen[0].y, blades.seen[1].y, blades.seen[2].y));
    return clip.w < -radius || abs(clip.x) > clip.w + radius * (x + 1.0) || abs(clip.y) > clip.w + radius * (y + 1.0);
}

fn blades_level(away: f32) -> u32 {
    return select(0u, 1u, away >= blades.distances.x) + select(0u, 1u, away >= blades.distances.y);
}

// What grows at a place of the drawing order; `seen` tells whether it may be in the picture, and is true of all blades of the picture
// before.
fn blades_grown(which: u32, rank: u32, only_seen: bool) -> Grown {
    var grown: Grown;
    grown.seen = false;
    let draw = draws[which];
    let cell = ordered_cell(rank & ((1u << (2u * prepare.bits)) - 1u));
    if any(cell >= vec2<u32>(prepare.placement.cells)) {
        return grown;
    }
    let place = (f32(rank) + 0.5) / f32(blades.pieces.w << (2u * prepare.bits));
    let middle = draw.offset + (vec2<f32>(cell) + 0.5) * prepare.placement.spacing;
    let nearest = max(distance(middle, blades.eye.xz) - 0.71 * prepare.placement.spacing, 0.0);
    // Most candidates are too many wherever in their cell they stand.
    if only_seen && place > blade_density(blades.thinning.xyz, 1.0, nearest * blades.thinning.w) {
        return grown;
    }
    var placed = placement_plant(prepare.placement, draw.patch_index, cell);
    if draw.growth != NONE {
        placed = placement_grown(placed, growth_at(draw.growth, cell));
    }
    if !placed.present {
        return grown;
    }
    let number = rank >> (2u * prepare.bits);
    var chance: array<f32, 9>;
    for (var question = 0u; question < 9u; question++) {
        chance[question] = placement_of_blade(prepare.placement, draw.patch_index, cell, number, question);
    }
    let anywhere = (vec2<f32>(cell) + vec2<f32>(chance[0], chance[1])) * prepare.placement.spacing;
    let local = mix(anywhere, placed.root, blades.stance.w);
    let ground = terrain_height_and_gradient(prepare.grid, draw.anchor, local);
    let root = vec3<f32>(draw.offset.x + local.x, ground.x, draw.offset.y + local.y);
    let to_eye = blades.eye.xyz - root;
    let away = length(to_eye);
    let normal = normalize(vec3<f32>(-ground.y, 1.0, -ground.z));
    let thin = blade_density(blades.thinning.xyz, dot(normal, to_eye) / max(away, 1e-3), away * blades.thinning.w);
    // The last ones to be drawn are small: so nothing pops.
    let stay = clamp((thin - place) / max(blades.shape.z * thin, 1e-9), 0.0, 1.0);
    let tint = chance[2];
    let fade = blades.distances.z;
    let gone = blades.distances.w;
    let left = 1.0 - smoothstep(fade, gone, away + (tint - 0.5) * 0.3 * (gone - fade));
    let height = placed.height * mix(blades.stance.z, 1.0, chance[3]) * (0.15 + 0.85 * left);
    if only_seen && (stay <= 0.0 || left <= 0.0 || blades_unseen(root, height + BLADE_AROUND)) {
        return grown;
    }
    let stands = placement_combed(chance[4] * 6.2831855, blades.stance.x * chance[7], placed.lean);
    let yaw = stands.x;
    let turn = math_sin_cos(yaw);
    let widened = min(inverseSqrt(max(thin, 1e-6)), 2.5);
    let width = blades.shape.x * (0.7 + 0.6 * chance[5]) * widened * stay * left;
    let twist = blades.shape.y * (2.0 * chance[6] - 1.0);
    grown.seen = true;
    grown.blade = Blade(root, height, yaw, width, tint, twist, ground.yz, which, rank);
    grown.local = local;
    grown.tall = placed.height;
    grown.cell = cell;
    grown.stance = BladeStance(vec2<f32>(turn.y, turn.x), stands.y, blades.stance.y * chance[8]);
    grown.plant = placed.lean;
    grown.away = away;
    grown.level = blades_level(away);
    return grown;
}

// The points of a strip, root first, into records from `first` on.
fn blades_bend(grown: Grown, level: u32, first: u32) {
    let which = grown.blade.draw;
    let draw = draws[which];
    var bends: array<vec2<f32>, 8>;
    let cells = prepare.placement.cells;
    let index = ((grown.blade.rank >> (2u * prepare.bits)) * cells + grown.cell.y) * cells + grown.cell.x;
    plant_bends(which, Who(grown.local, grown.tall, index, grown.stance.heading, grown.blade.yaw, grown.stance.lean, grown.stance.curl, grown.plant), &bends);
    let pieces = blades.pieces[level];
    let coarse = blades.pieces[min(level + 1u, 2u)];
    let border = blades.distances[min(level, 1u)];
    // Where the next number of pieces begins, the strip has its shape already: so nothing pops.
    let morph = select(0.0, smoothstep(0.7 * border, border, grown.away), level < 2u);
    let length_ = grown.blade.height / f32(pieces);
    var at = vec3<f32>(grown.local.x, grown.blade.root.y, grown.local.y);
    let shift = vec3<f32>(draw.offset.x, 0.0, draw.offset.y);
    records[first] = bitcast<vec4<u32>>(vec4<f32>(at + shift, 0.0));
    for (var k = 0u; k < pieces; k++) {
        let way = billboard_segment(blade_piece_bend(&bends, prepare.segments, grown.stance, k, pieces, coarse, morph), length_);
        let there = at + way;
        let floor_ = terrain_height(prepare.grid, draw.anchor, there.xz) + BILLBOARD_CLEARANCE;
        if there.y >= floor_ {
            at = there;
        } else {
            at += blade_raised(way, floor_ - at.y);
            at.y = max(at.y, terrain_height(prepare.grid, draw.anchor, at.xz) + BILLBOARD_CLEARANCE);
        }
        records[first + k + 1u] = bitcast<vec4<u32>>(vec4<f32>(at + shift, 0.0));
    }
}

fn blades_stride(level: u32) -> u32 {
    let points = blades.pieces[level] + 1u;
    return BLADE_HEAD + points + select(0u, points + 1u, blades.firsts.w > 0u);
}
