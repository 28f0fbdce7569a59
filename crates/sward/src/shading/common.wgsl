// Noise, air and tone curve shared by all shading.

// The pattern of the ground repeats after this many metres; hosts hand in positions modulo this.
const SHADING_PERIOD: f32 = 1024.0;

fn shading_hash(x: i32, z: i32, salt: u32) -> f32 {
    var h = bitcast<u32>(x) * 0x8da6b343u + bitcast<u32>(z) * 0xd8163841u + salt * 0xcb1ab31fu;
    h = (h ^ (h >> 15u)) * 0x2c1b3c6du;
    h = (h ^ (h >> 12u)) * 0x297a2d39u;
    h = h ^ (h >> 15u);
    return f32(h >> 8u) * (1.0 / 16777216.0);
}

// Value noise, 0..1, one lattice cell per unit of p. Cells wrap after `cells` (a power of two).
fn shading_noise(p: vec2<f32>, cells: i32, salt: u32) -> f32 {
    let corner = floor(p);
    let f = p - corner;
    let w = f * f * (3.0 - 2.0 * f);
    let a = vec2<i32>(corner) & vec2<i32>(cells - 1);
    let b = (a + 1) & vec2<i32>(cells - 1);
    let low = mix(shading_hash(a.x, a.y, salt), shading_hash(b.x, a.y, salt), w.x);
    let high = mix(shading_hash(a.x, b.y, salt), shading_hash(b.x, b.y, salt), w.x);
    return mix(low, high, w.y);
}

// How a meadow varies over space at `p` (metres modulo SHADING_PERIOD):
// x = hue, -1 (bluish) .. 1 (yellowish); y = extra dryness 0..1; z = vigour (brightness) 0.8..1.2.
fn shading_patchwork(p: vec2<f32>) -> vec3<f32> {
    let broad = shading_noise(p / 32.0, 32, 11u);
    let middle = shading_noise(p / 8.0, 128, 12u);
    let small = shading_noise(p / 2.0, 512, 13u);
    let dry = shading_noise(p / 16.0, 64, 14u) * 0.6 + middle * 0.25 + small * 0.15;
    return vec3<f32>(
        1.1 * (broad - 0.5) + 0.7 * (middle - 0.5) + 0.3 * (small - 0.5),
        smoothstep(0.44, 0.78, dry),
        0.72 + 0.36 * middle + 0.20 * small,
    );
}

// What is left of light after `distance` metres of air, and how much the air itself adds.
// Fog is thinner above the ground: `height` is the eye's height over the point, in metres.
fn shading_fog(distance: f32, density: f32) -> f32 {
    return exp(-density * distance);
}

// Film-like curve: linear radiance times exposure -> display value 0..1, still linear.
fn shading_tone(radiance: vec3<f32>) -> vec3<f32> {
    let luminance = dot(radiance, vec3<f32>(0.2126, 0.7152, 0.0722));
    // Very bright colours wash out, as they do on film.
    let vivid = max(mix(vec3<f32>(luminance), radiance, 1.15), vec3<f32>(0.0));
    let washed = mix(vivid, vec3<f32>(luminance), luminance / (luminance + 14.0));
    let shoulder = 1.0 - exp(-washed);
    let toe = washed / (washed + 0.055);
    return clamp(shoulder * mix(toe, vec3<f32>(1.0), 0.5), vec3<f32>(0.0), vec3<f32>(1.0));
}

// Linear display value -> sRGB code value.
fn shading_encode(linear: vec3<f32>) -> vec3<f32> {
    let curve = 1.055 * pow(max(linear, vec3<f32>(0.0031308)), vec3<f32>(1.0 / 2.4)) - 0.055;
    return select(curve, linear * 12.92, linear <= vec3<f32>(0.0031308));
}
