// The small maths of state updates; twin of math.rs, where each function is documented.
// Coefficients are the same literals as there (tested). `round` gives what adding 1.5 * 2^23 gives there.

fn math_lower(a: f32, b: f32) -> f32 {
    return select(b, a, a < b);
}

fn math_upper(a: f32, b: f32) -> f32 {
    return select(b, a, a > b);
}

fn math_clamped(x: f32, low: f32, high: f32) -> f32 {
    return math_lower(math_upper(x, low), high);
}

fn math_exp(x_in: f32) -> f32 {
    let x = math_clamped(x_in, -87.3, 88.0);
    let n = round(x * 1.442695);
    let r = (x - n * 0.69314575) - n * 1.4286068e-6;
    let p = 0.49999994 + r * (0.1666652 + r * (0.041668393 + r * (0.00836878 + r * 0.0013814496)));
    let power_of_two = bitcast<f32>(u32(i32(n) + 127) << 23u);
    return (1.0 + (r + r * r * p)) * power_of_two;
}

// (sin x, cos x)
fn math_sin_cos(x: f32) -> vec2<f32> {
    let n = round(x * 0.63661975);
    let rest = ((x - n * 1.5703125) - n * 0.0004837513) - n * 7.54979e-8;
    let r = math_clamped(rest, -0.787, 0.787);
    let rr = r * r;
    let s = r + r * rr * (-0.16666655 + rr * (0.008332173 + rr * -0.00019516656));
    let c = (1.0 - 0.5 * rr) + rr * rr * (0.041666646 + rr * (-0.0013887362 + rr * 2.443773e-5));
    let quarter = bitcast<u32>(i32(n));
    let odd = (quarter & 1u) == 1u;
    let sine = bitcast<u32>(select(s, c, odd)) ^ ((quarter & 2u) << 30u);
    let cosine = bitcast<u32>(select(c, s, odd)) ^ (((quarter + 1u) & 2u) << 30u);
    return vec2<f32>(bitcast<f32>(sine), bitcast<f32>(cosine));
}

fn math_tan(x: f32) -> f32 {
    let sc = math_sin_cos(x);
    return sc.x / sc.y;
}

fn math_atan(x: f32) -> f32 {
    let a = abs(x);
    let middle = a > 0.41421357;
    let large = a > 2.4142137;
    let above = select(select(a, a - 1.0, middle), -1.0, large);
    let below = select(select(1.0, a + 1.0, middle), a, large);
    let start = select(select(0.0, 0.7853982, middle), 1.5707964, large);
    let y = above / below;
    let yy = y * y;
    let p = -0.33333316 + yy * (0.19998488 + yy * (-0.14243802 + yy * (0.105956435 + yy * -0.060824987)));
    let angle = start + (y + y * yy * p);
    return bitcast<f32>(bitcast<u32>(angle) | (bitcast<u32>(x) & 0x80000000u));
}

fn math_atan2(y: f32, x: f32) -> f32 {
    let a = abs(x);
    let b = abs(y);
    let steep = b > a;
    let above = select(b, a, steep);
    let below = select(a, b, steep);
    let flat = math_atan(above / select(1.0, below, below > 0.0));
    let quarter = select(flat, 1.5707964 - flat, steep);
    let half = select(quarter, 3.1415927 - quarter, x < 0.0);
    return select(half, -half, y < 0.0);
}

fn math_cbrt(x: f32) -> f32 {
    let bits = bitcast<u32>(x) & 0x7fffffffu;
    let a = bitcast<f32>(bits);
    let guess = bitcast<f32>(bits / 3u + 0x2a5117f6u);
    let cube = guess * guess * guess;
    let better = guess + guess * ((a - cube) / (cube + cube + a));
    let cube2 = better * better * better;
    let last = better + better * ((a - cube2) / (cube2 + cube2 + a));
    let root = select(last, 0.0, a < 1.1754944e-38);
    return bitcast<f32>(bitcast<u32>(root) | (bitcast<u32>(x) & 0x80000000u));
}

fn math_mixed(value: u32) -> u32 {
    let state = value * 747796405u + 2891336453u;
    let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

fn math_hash(seed: u32, patch_x: i32, patch_z: i32, cell: u32, purpose: u32) -> u32 {
    var h = math_mixed(seed);
    h = math_mixed(h ^ bitcast<u32>(patch_x));
    h = math_mixed(h + bitcast<u32>(patch_z));
    h = math_mixed(h ^ cell);
    return math_mixed(h + purpose);
}

fn math_unit(h: u32) -> f32 {
    return f32(h >> 8u) * (1.0 / 16777216.0);
}
