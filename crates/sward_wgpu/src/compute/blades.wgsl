// One step of a stand that moves blade by blade: virtual blades, then blades with a state. Twin: response/chain/step.rs in the core.

struct ChainPatch {
    slot: u32,
    lag: u32,
    flags: u32,        // 1: it wakes; 2: it is the tiled wind patch; 4: its blades are new; 8: they are handed back; 16: all are held
    entry: u32,        // its place in the summaries
    patch_index: vec2<i32>,
    solid_first: u32,
    solid_count: u32,
    weights: vec4<f32>,
    keep: f32,
    pixels: f32,
    around: array<u32, 9>,
    segments: u32,
}

@group(0) @binding(0) var<uniform> chain: ChainStand;
@group(0) @binding(1) var<uniform> wind: WindBlock;
@group(0) @binding(2) var<storage, read> patches: array<ChainPatch>;
@group(0) @binding(3) var<storage, read_write> now: array<f32>;
@group(0) @binding(4) var<storage, read_write> old: array<f32>;
@group(0) @binding(5) var<storage, read_write> states: array<f32>;
@group(0) @binding(6) var<storage, read_write> blades: array<f32>;
@group(0) @binding(7) var<storage, read> roots: array<Root>;
@group(0) @binding(8) var<storage, read> tile: array<vec2<f32>>;
// Solids (six vec4 each), then planes from `chain.planes` on.
@group(0) @binding(10) var<storage, read> words: array<vec4<u32>>;
// Summaries, sums of what solids feel, then from `chain.busy` on what the dispatch of the busy blades asks for (three words), how many they are, and of each the number of its
// patch in `patches` and its own, in no order.
@group(0) @binding(11) var<storage, read_write> summary: array<atomic<u32>>;
@group(0) @binding(14) var<uniform> tile_wind: WindBlock;

var<private> entry: ChainPatch;

fn wind_tile_load(index: u32) -> vec2<f32> {
    return tile[index];
}

fn reaction_add(word: u32, parts: i32) {
    atomicAdd(&summary[word], bitcast<u32>(parts));
}

fn steady_load(index: u32) -> vec2<f32> {
    let pair = chain.steady[index / 2u];
    return select(pair.xy, pair.zw, (index & 1u) == 1u);
}

fn standing_load(before: bool, index: u32) -> f32 {
    if before {
        return old[index];
    }
    return now[index];
}

fn solid_plane(index: u32) -> vec4<f32> {
    return bitcast<vec4<f32>>(words[chain.planes + index]);
}

fn push_solid(index: u32) -> SolidHead {
    let first = 6u * index;
    let head = words[first];
    return SolidHead(
        head.x, head.y, head.z, head.w,
        bitcast<vec4<f32>>(words[first + 1u]),
        bitcast<vec4<f32>>(words[first + 2u]),
        bitcast<vec4<f32>>(words[first + 3u]),
        bitcast<vec4<f32>>(words[first + 4u]),
        bitcast<vec4<f32>>(words[first + 5u]),
    );
}

// The coefficients, with the number of segments out of the patch at hand: were it a uniform's, Mesa's drivers in software would unroll all loops over
// segments for it, and translate the kernel again at every dispatch, which takes 0.4 s.
fn coefficients() -> ChainCoefficients {
    var co = chain.coefficients;
    co.segments = entry.segments;
    return co;
}

/// The air at a place of the patch at hand.
fn air_at(local: vec2<f32>) -> vec2<f32> {
    return wind_at(entry.patch_index, local, (entry.flags & 2u) != 0u);
}

// The air at the root of the blade at hand: asked once, since whatever is called is inlined.
var<private> held_air: vec2<f32>;

fn held_wind(root: Root) -> vec2<f32> {
    return held_air;
}

fn pressed_joint(joint: u32) -> ChainJoint {
    return chain.coefficients.joints[joint];
}

fn held_stands(root: Root, base: mat3x3<f32>, before: bool) -> array<vec2<f32>, 8> {
    let standing = Standing(entry.around, entry.weights, chain.patch_side, chain.virtual_side);
    var steady = array<vec2<f32>, 8>();
    if standing_needs_wind(standing) {
        steady = steady_at(held_air).moments;
    }
    let moments = standing_moments(standing, entry.segments, before, root.at.xz, steady);
    return standing_pose(coefficients(), base, root.curl, moments);
}

var<workgroup> peak: atomic<u32>;

/// Virtual blades: their states, and the moments that the blades around them bend by; those go into `old`, the next `now`.
@compute @workgroup_size(8, 8)
fn virtual_pass(@builtin(global_invocation_id) id: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    entry = patches[id.z];
    let n = entry.segments;
    let area = chain.virtual_side * chain.virtual_side;
    let index = id.y * chain.virtual_side + id.x;
    let place = (vec2<f32>(id.xy) + 0.5) * (chain.patch_side / f32(chain.virtual_side));
    let air = air_at(place);
    var steady = steady_at(air);
    let upright = mat3x3<f32>(vec3<f32>(1.0, 0.0, 0.0), vec3<f32>(0.0, 0.0, -1.0), vec3<f32>(0.0, 1.0, 0.0));
    let first = entry.slot * 4u * n * area + index;
    let moments_first = entry.slot * 2u * n * area + index;
    var state = ChainState();
    let wakes = (entry.flags & 1u) != 0u;
    for (var i = 0u; i < n; i++) {
        if wakes {
            state.joints[i] = vec4<f32>(steady.bends[i], 0.0, 0.0);
        } else {
            let at = first + 4u * i * area;
            state.joints[i] = vec4<f32>(states[at], states[at + area], states[at + 2u * area], states[at + 3u * area]);
        }
    }
    if wakes {
        var moments = virtual_inertia_moments(coefficients(), upright, state);
        for (var i = 0u; i < n; i++) {
            now[moments_first + 2u * i * area] = moments[i].x;
            now[moments_first + (2u * i + 1u) * area] = moments[i].y;
        }
    }
    state = chain_step(coefficients(), upright, 0.0, vec3<f32>(air.x, 0.0, air.y), chain.dt, state);
    var largest = 0.0;
    for (var i = 0u; i < n; i++) {
        let bend = entry.keep * (state.joints[i].xy - steady.bends[i]);
        let rate = entry.keep * state.joints[i].zw;
        if entry.keep < 1.0 {
            state.joints[i] = vec4<f32>(steady.bends[i] + bend, rate);
        }
        largest = max(largest, max(bend.x * bend.x + bend.y * bend.y, rate.x * rate.x + rate.y * rate.y));
    }
    var moments = virtual_inertia_moments(coefficients(), upright, state);
    for (var i = 0u; i < n; i++) {
        let at = first + 4u * i * area;
        let joint = state.joints[i];
        states[at] = joint.x;
        states[at + area] = joint.y;
        states[at + 2u * area] = joint.z;
        states[at + 3u * area] = joint.w;
        old[moments_first + 2u * i * area] = moments[i].x;
        old[moments_first + (2u * i + 1u) * area] = moments[i].y;
    }
    atomicMax(&peak, bitcast<u32>(largest));
    workgroupBarrier();
    if local == 0u {
        atomicMax(&summary[entry.entry * SUMMARY_WORDS], atomicLoad(&peak));
    }
}

/// Most blades are neither held nor within reach of a body: those that are not are listed, since moving one takes long.
@compute @workgroup_size(64)
fn busy_pass(@builtin(global_invocation_id) id: vec3<u32>) {
    let present = patches[id.y];
    if id.x >= chain.blades {
        return;
    }
    let n = present.segments;
    let end = (present.lag * (6u * n + 2u) + 6u * n) * chain.blades + id.x;
    let root = roots[present.lag * chain.blades + id.x];
    if (present.flags & 4u) != 0u {
        blades[end] = 0.0;
        blades[end + chain.blades] = 0.0;
    }
    let rests = blades[end] <= 0.0 && blades[end + chain.blades] <= 0.0 && (present.flags & 16u) == 0u;
    if root.length <= 0.0 || (rests && !push_reach(push_obstacles(present.solid_first, present.solid_count), root)) {
        return;
    }
    let place = atomicAdd(&summary[chain.busy + 3u], 1u);
    atomicStore(&summary[chain.busy + 4u + 2u * place], id.y);
    atomicStore(&summary[chain.busy + 5u + 2u * place], id.x);
    atomicMax(&summary[chain.busy], place / 64u + 1u);
}

/// Blades that are held or may be touched; `now` is the new present here.
@compute @workgroup_size(64)
fn blades_pass(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= atomicLoad(&summary[chain.busy + 3u]) {
        return;
    }
    let which = vec2<u32>(atomicLoad(&summary[chain.busy + 4u + 2u * id.x]), atomicLoad(&summary[chain.busy + 5u + 2u * id.x]));
    entry = patches[which.x];
    let n = entry.segments;
    let first = entry.lag * (6u * n + 2u) * chain.blades + which.y;
    let root = roots[entry.lag * chain.blades + which.y];
    let by = Holding(
        push_obstacles(entry.solid_first, entry.solid_count), chain.dt, entry.keep, entry.pixels,
        (entry.flags & 16u) != 0u, (entry.flags & 8u) != 0u,
    );
    held_air = air_at(root.at.xz);
    var blade = HeldBlade();
    blade.hold = blades[first + 6u * n * chain.blades];
    blade.hold_before = blades[first + (6u * n + 1u) * chain.blades];
    for (var i = 0u; i < n; i++) {
        let at = first + 4u * i * chain.blades;
        blade.state.joints[i] = vec4<f32>(blades[at], blades[at + chain.blades], blades[at + 2u * chain.blades], blades[at + 3u * chain.blades]);
    }
    blade = held_step(coefficients(), by, root, blade);
    if held_pressed.solid != STANDING_NONE {
        let solid = by.obstacles.first + held_pressed.solid;
        let head = push_solid(solid);
        let base = chain_planted(root.yaw, root.lean);
        let about = 0.5 * (head.low.xyz + head.high.xyz);
        let felt = pressed_felt(coefficients(), root, base, held_pressed, blade.before, held_bends(blade.state), about);
        // The sums lie between the summaries and the busy blades.
        reaction_sum(chain.busy + REACTION_WORDS * (solid - chain.planes / 6u), felt);
    }
    for (var i = 0u; i < n; i++) {
        let at = first + 4u * i * chain.blades;
        let joint = blade.state.joints[i];
        blades[at] = joint.x;
        blades[at + chain.blades] = joint.y;
        blades[at + 2u * chain.blades] = joint.z;
        blades[at + 3u * chain.blades] = joint.w;
        let back = first + (4u * n + 2u * i) * chain.blades;
        blades[back] = blade.before[i].x;
        blades[back + chain.blades] = blade.before[i].y;
    }
    blades[first + 6u * n * chain.blades] = blade.hold;
    blades[first + (6u * n + 1u) * chain.blades] = blade.hold_before;
    if blade.hold > 0.0 {
        var restless = BLADES_RESTLESS;
        if (entry.flags & 16u) != 0u {
            restless = 0.0;
            for (var i = 0u; i < n; i++) {
                let rate = blade.state.joints[i].zw;
                restless = max(restless, rate.x * rate.x + rate.y * rate.y);
            }
        }
        atomicAdd(&summary[entry.entry * SUMMARY_WORDS + 6u], 1u);
        atomicMax(&summary[entry.entry * SUMMARY_WORDS], bitcast<u32>(restless));
    }
}
