// Wind of a place: outward, round, or from an image; twin of wind/footprint.rs. Texels of images follow those of the noise tile.

struct WindFootprint {
    patch_index: vec2<i32>,
    centre: vec2<i32>, // in that patch, 1/256 node
    turn: vec2<f32>,   // cos and sin of the yaw
    radius: f32,       // m
    speed: f32,        // m/s
    part: f32,         // m in 1/256 node
    kind: u32,         // 0 outward, 1 swirl, 2 image
    first: u32,        // texel of the image
    side: u32,         // texels along a side
}

const WIND_TILE_TEXELS: u32 = 4096u;

// Node (0, 0) of a patch seen from the centre, 1/256 node.
fn wind_footprint_base(print: WindFootprint, patch_index: vec2<i32>, intervals: u32) -> vec2<i32> {
    let apart = patch_index - print.patch_index;
    if any(apart <= vec2<i32>(-1024)) || any(apart >= vec2<i32>(1024)) {
        return vec2<i32>(1073741823);
    }
    return apart * i32(intervals) * 256 - print.centre;
}

// From the centre to a node, m.
fn wind_footprint_to_node(print: WindFootprint, base: vec2<i32>, node: vec2<i32>) -> vec2<f32> {
    return vec2<f32>(base + node * 256) * print.part;
}

// From the centre to `local` metres from where `base` belongs, m.
fn wind_footprint_to_local(print: WindFootprint, base: vec2<i32>, local: vec2<f32>) -> vec2<f32> {
    return vec2<f32>(base) * print.part + local;
}

fn wind_image_texel(print: WindFootprint, at: vec2<i32>) -> vec2<f32> {
    let side = i32(print.side);
    if any(at < vec2<i32>(0)) || any(at >= vec2<i32>(side)) {
        return vec2<f32>(0.0);
    }
    return wind_tile_load(WIND_TILE_TEXELS + print.first + u32(at.y * side + at.x));
}

// Velocity of the air at a place, m from the centre.
fn wind_footprint_velocity(print: WindFootprint, at: vec2<f32>) -> vec2<f32> {
    if print.kind == 2u {
        let own = vec2<f32>(print.turn.x * at.x - print.turn.y * at.y, print.turn.y * at.x + print.turn.x * at.y);
        let texels = f32(print.side) / (2.0 * print.radius);
        let place = (own + print.radius) * texels - 0.5;
        if any(place <= vec2<f32>(-1.0)) || any(place >= vec2<f32>(f32(print.side))) {
            return vec2<f32>(0.0);
        }
        let corner = vec2<i32>(floor(place));
        let way = place - vec2<f32>(corner);
        let a = wind_image_texel(print, corner);
        let b = wind_image_texel(print, corner + vec2<i32>(1, 0));
        let c = wind_image_texel(print, corner + vec2<i32>(0, 1));
        let d = wind_image_texel(print, corner + vec2<i32>(1, 1));
        let near = a + (b - a) * way.x;
        let far = c + (d - c) * way.x;
        let found = near + (far - near) * way.y;
        return print.speed * vec2<f32>(print.turn.x * found.x + print.turn.y * found.y, print.turn.x * found.y - print.turn.y * found.x);
    }
    let distance = sqrt(at.x * at.x + at.y * at.y);
    let share = 1.0 - distance / print.radius;
    if share <= 0.0 || distance < 1e-6 {
        return vec2<f32>(0.0);
    }
    let speed = print.speed * share / distance;
    return select(vec2<f32>(-speed * at.y, speed * at.x), speed * at, print.kind == 0u);
}
