// How a cell lies in the buffers of its stand. Full precision: planes of βx, βz, ωx, ωz as bits. Half: planes of words, x and z, each β and
// ω of one axis (half.wgsl). Shared by all hosts that read cells.

override half_precision: bool = false;

/// First word of a slot.
fn cells_first(slot: u32, area: u32) -> u32 {
    return slot * select(4u, 2u, half_precision) * area;
}

/// β of the words in the first two planes.
fn cells_bend(words: vec2<u32>) -> vec2<f32> {
    if half_precision {
        return vec2<f32>(half_bend(words.x), half_bend(words.y));
    }
    return bitcast<vec2<f32>>(words);
}

/// ω of the words in the last two planes.
fn cells_rate(words: vec2<u32>) -> vec2<f32> {
    if half_precision {
        return vec2<f32>(half_rate(words.x), half_rate(words.y));
    }
    return bitcast<vec2<f32>>(words);
}

/// The words of a cell, plane by plane; the last two are none at half precision.
fn cells_words(bend: vec2<f32>, rate: vec2<f32>, dither: u32) -> vec4<u32> {
    if half_precision {
        return vec4<u32>(half_pack(bend.x, rate.x, dither), half_pack(bend.y, rate.y, dither >> 16u), 0u, 0u);
    }
    return vec4<u32>(bitcast<vec2<u32>>(bend), bitcast<vec2<u32>>(rate));
}
