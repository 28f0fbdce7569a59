// Limits of growth near a place: lines, polygons, pictures. Twin: growth/near.rs, where everything is explained.
// The host declares where edges and shades are: fn growth_edge(index: u32) -> vec4<f32>, fn growth_texel(index: u32) -> f32.

struct GrowthRecord {
    kind: u32,       // 0 line, 1 polygon, 2 picture
    first: u32,
    count: u32,      // edges, or columns
    rows: u32,
    low: vec2<f32>,
    high: vec2<f32>,
    colour: vec3<f32>,
    share: f32,
    half_width: f32,
    soft: f32,
    outside: f32,
    unused: f32,
}

struct GrowthBlock {
    count: u32,
    first_edge: u32,
    unused_a: u32,
    unused_b: u32,
    records: array<GrowthRecord, 64>,
}

fn growth_ramp(low: f32, high: f32, at: f32) -> f32 {
    if high <= low {
        return select(0.0, 1.0, at > low);
    }
    let t = clamp((at - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

fn growth_to_edge(edge: vec4<f32>, at: vec2<f32>) -> f32 {
    let along = edge.zw - edge.xy;
    let way = at - edge.xy;
    let t = clamp(dot(way, along) / max(dot(along, along), 1e-12), 0.0, 1.0);
    return length(way - t * along);
}

fn growth_between_texels(record: GrowthRecord, at: vec2<f32>) -> f32 {
    let size = vec2<f32>(f32(record.count), f32(record.rows));
    let place = clamp((at - record.low) / (record.high - record.low) * size - 0.5, vec2<f32>(0.0), size - 1.0);
    let first = vec2<u32>(place);
    let next = min(first + 1u, vec2<u32>(record.count, record.rows) - 1u);
    let f = place - vec2<f32>(first);
    let before = record.first + first.y * record.count;
    let after = record.first + next.y * record.count;
    let low = mix(growth_texel(before + first.x), growth_texel(before + next.x), f.x);
    let high = mix(growth_texel(after + first.x), growth_texel(after + next.x), f.x);
    return mix(low, high, f.y);
}

fn growth_cover(record: GrowthRecord, at: vec2<f32>, blur: f32) -> f32 {
    if any(at < record.low - blur) || any(at > record.high + blur) {
        return record.outside;
    }
    if record.kind == 2u {
        return growth_between_texels(record, at);
    }
    var distance = 1e9;
    var inside = false;
    for (var k = record.first; k < record.first + record.count; k++) {
        let edge = growth_edge(k);
        distance = min(distance, growth_to_edge(edge, at));
        if record.kind == 1u && (edge.y > at.y) != (edge.w > at.y) {
            let crossing = edge.x + (at.y - edge.y) / (edge.w - edge.y) * (edge.z - edge.x);
            inside = inside != (at.x < crossing);
        }
    }
    var away = distance - record.half_width;
    if inside {
        away = -distance;
    }
    return growth_ramp(-blur, record.soft + blur, away);
}

// Colour of bare ground times its share, and that share; a pixel is `blur` metres wide. The last limit lies on top.
fn growth_taken(record: GrowthRecord, at: vec2<f32>, blur: f32, bare: vec4<f32>) -> vec4<f32> {
    return mix(bare, vec4<f32>(record.colour, 1.0), record.share * (1.0 - growth_cover(record, at, blur)));
}
