// Fast Fourier transform of a row by a workgroup: radix 2, Stockham; twin of fft.rs, where everything is explained.
// The host declares where two rows and the turns are: fn fft_load(index: u32) -> vec2<f32>, fn fft_store(index: u32, value: vec2<f32>),
// fn fft_turn(index: u32) -> vec2<f32>; the first row is 0 to n - 1, the second n to 2 n - 1.

const FFT_LANES: u32 = 64u;

// One butterfly: number `index` of n/2, from the row that begins at `base` to the one that begins at `to`.
fn fft_butterfly(n: u32, groups: u32, index: u32, base: u32, to: u32, inverse: bool) {
    let half = n / 2u;
    let k = index / groups;
    let j = index % groups;
    var turn = fft_turn(k * groups);
    if inverse {
        turn.y = -turn.y;
    }
    let a = fft_load(base + 2u * k * groups + j);
    let c = fft_load(base + (2u * k + 1u) * groups + j);
    let b = vec2<f32>(c.x * turn.x - c.y * turn.y, c.x * turn.y + c.y * turn.x);
    fft_store(to + k * groups + j, a + b);
    fft_store(to + k * groups + j + half, a - b);
}

// Transforms the first row; returns where the result begins. All lanes of the workgroup must come here, after a barrier.
fn fft_row(n: u32, lane: u32, inverse: bool) -> u32 {
    var base = 0u;
    for (var groups = n / 2u; groups > 0u; groups = groups / 2u) {
        for (var index = lane; index < n / 2u; index += FFT_LANES) {
            fft_butterfly(n, groups, index, base, n - base, inverse);
        }
        base = n - base;
        workgroupBarrier();
    }
    return base;
}
