// A cell at half its size: one axis of β and ω in a word. Twin: half.rs (where the layout is explained), the same bits.

const HALF_LARGEST_BEND: f32 = 1.75;
const HALF_LARGEST_RATE: u32 = 0x42700000u;
const HALF_SMALLEST_RATE: u32 = 0x33000000u;
const HALF_RATE_OFFSET: u32 = 0x32800000u;

/// Dither of a cell, 16 bits for each axis; `patch_number` comes from the CPU.
fn half_dither(patch_number: u32, cell: u32) -> u32 {
    return math_mixed(patch_number ^ cell);
}

fn half_pack(bend: f32, rate: f32, dither: u32) -> u32 {
    let fine = i32(clamp(bend, -HALF_LARGEST_BEND, HALF_LARGEST_BEND) * 8388608.0);
    let steps = (fine + i32((dither >> 9u) & 127u)) >> 7u;
    let bits = bitcast<u32>(rate);
    let size = min(bits & 0x7fffffffu, HALF_LARGEST_RATE);
    let code = ((size - HALF_RATE_OFFSET + ((dither & 511u) << 6u)) >> 15u) | ((bits >> 18u) & 0x2000u);
    return (bitcast<u32>(steps) << 14u) | select(code, 0u, size < HALF_SMALLEST_RATE);
}

fn half_bend(word: u32) -> f32 {
    return f32(bitcast<i32>(word) >> 14u) * (1.0 / 65536.0);
}

fn half_rate(word: u32) -> f32 {
    let size = word & 0x1fffu;
    let bits = ((size << 15u) + HALF_RATE_OFFSET) | ((word & 0x2000u) << 18u);
    return select(bitcast<f32>(bits), 0.0, size == 0u);
}
