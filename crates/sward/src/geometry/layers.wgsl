// Layers of plants: where the corners of their grids are, and how far the waves move them. Twin: layers.rs.

struct LayerDraw {
    eye: vec4<f32>,      // frame space, of the cut; w = depth of the layer
    right: vec4<f32>,    // axes of the cut, unit; w = left side of its window
    up: vec4<f32>,       // w = bottom
    forward: vec4<f32>,  // w = share that is there while cuts change
    window: vec4<f32>,   // right, top; pieces along x and y
    cell: vec4<f32>,     // corner and size of the layer's part of the texture
    root: vec4<f32>,     // frame space; w = height
    plane: vec4<f32>,    // the waves' right, unit; w = cells from their corner to the root
    scale: vec4<f32>,    // way for each m/s: right, up, shrinking; w = stiffness
    cells: vec4<f32>,    // cells of a metre; of a touched plant's; share of the older note; cells by which a look-up goes back along V
    notes: vec4<u32>,    // first cells of the two notes; first cell of the touched plant's plane or none; cells along a side
    which: vec4<u32>,    // number of the plant; 1 if outputs tell of it; layer; 1 leaves
}

const LAYERS_NONE: u32 = 0xffffffffu;
const LAYERS_TOUCH_SIDE: u32 = 16u;

// A corner of a layer's grid: where it is, and where in the texture.
struct LayerCorner { place: vec3<f32>, uv: vec2<f32> }

fn layers_wave(first: u32, side: u32, at: vec2<f32>) -> vec2<f32> {
    let start = at - 0.5;
    let corner = floor(start);
    let f = start - corner;
    let mask = vec2<i32>(i32(side) - 1);
    let a = vec2<u32>(vec2<i32>(corner) & mask);
    let b = vec2<u32>((vec2<i32>(corner) + 1) & mask);
    let low = mix(layers_note(first + a.y * side + a.x), layers_note(first + a.y * side + b.x), f.x);
    let high = mix(layers_note(first + b.y * side + a.x), layers_note(first + b.y * side + b.x), f.x);
    return mix(low, high, f.y);
}

// V of a touched plant's own plane; it ends at its rim.
fn layers_touched(first: u32, at: vec2<f32>) -> vec2<f32> {
    let most = f32(LAYERS_TOUCH_SIDE) - 1.0;
    let start = clamp(at - 0.5, vec2<f32>(0.0), vec2<f32>(most));
    let corner = min(floor(start), vec2<f32>(most - 1.0));
    let f = start - corner;
    let k = first + u32(corner.y) * LAYERS_TOUCH_SIDE + u32(corner.x);
    let low = mix(layers_touch(k), layers_touch(k + 1u), f.x);
    let high = mix(layers_touch(k + LAYERS_TOUCH_SIDE), layers_touch(k + LAYERS_TOUCH_SIDE + 1u), f.x);
    return mix(low, high, f.y);
}

// V at a place of a plant, m right of its root along the waves' plane and above it, m/s along the plane.
fn layers_velocity(draw: LayerDraw, along: f32, up: f32) -> vec2<f32> {
    let side = draw.notes.w;
    let at = vec2<f32>(draw.plane.w + along * draw.cells.x, up * draw.cells.x);
    var velocity = mix(layers_wave(draw.notes.x, side, at), layers_wave(draw.notes.y, side, at), draw.cells.z);
    if draw.cells.w > 0.0 {
        let speed = length(velocity);
        if speed > 1e-6 {
            velocity = layers_wave(draw.notes.x, side, at + velocity * (draw.cells.w / speed));
        }
    }
    if draw.notes.z != LAYERS_NONE {
        velocity += layers_touched(draw.notes.z, vec2<f32>(along, up) * draw.cells.y + vec2<f32>(0.5 * f32(LAYERS_TOUCH_SIDE), 0.0));
    }
    return velocity;
}

// `share`: 0..1 across the window, from its left and its bottom.
fn layers_corner(draw: LayerDraw, share: vec2<f32>) -> LayerCorner {
    let low = vec2<f32>(draw.right.w, draw.up.w);
    let at = low + (draw.window.xy - low) * share;
    let depth = draw.eye.w;
    var place = draw.eye.xyz + (draw.right.xyz * at.x + draw.up.xyz * at.y + draw.forward.xyz) * depth;
    let uv = draw.cell.xy + draw.cell.zw * vec2<f32>(share.x, 1.0 - share.y);
    if draw.scale.x != 0.0 || draw.scale.y != 0.0 || draw.scale.z != 0.0 {
        let local = place - draw.root.xyz;
        let velocity = layers_velocity(draw, dot(local, draw.plane.xyz), local.y);
        let world = draw.plane.xyz * velocity.x + vec3<f32>(0.0, velocity.y, 0.0);
        let risen = clamp(local.y / draw.root.w, 0.0, 1.0);
        var held = 1.0;
        if draw.scale.w > 0.0 {
            held = pow(risen, draw.scale.w);
        }
        let seen = vec3<f32>(dot(world, draw.right.xyz), dot(world, draw.up.xyz), dot(world, draw.forward.xyz));
        let way = held * vec2<f32>(draw.scale.x * seen.x, draw.scale.y * seen.y - draw.scale.z * abs(seen.z));
        place += draw.right.xyz * way.x + draw.up.xyz * way.y;
    }
    return LayerCorner(place, uv);
}
