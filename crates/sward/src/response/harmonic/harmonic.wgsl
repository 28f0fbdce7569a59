// Waves on a plane, and on the small planes of touched plants. Twins: plane.rs, touch.rs.

struct HarmonicCoefficients {
    spread: f32,    // c²Δt²/Δx²
    restoring: f32, // κΔt²
    damping: f32,   // share of its change that V loses in a step
    gain: f32,      // velocity of the vegetation over that of the wind
}

// A body on a plant's plane.
struct HarmonicBrush {
    at: vec2<f32>,       // middle, cells right of the root and above it
    half_size: vec2<f32>,
    velocity: vec2<f32>, // along the plane, m/s
    through: f32,        // through it, m/s, either way
    hold: f32,           // how far it holds a cell in this step: share of its change that the cell loses
}

// Cells along a side of a touched plant's plane.
const HARMONIC_TOUCH_SIDE: u32 = 16u;
// How fast leaves give way to the sides, over how fast a body comes through.
const HARMONIC_PARTING: f32 = 0.5;

// What a body feels of the leaves of a cell of `mass` kg over a step of `dt` s, to whose velocity it adds `change`: N along right and up, and against its
// way through the plane.
fn harmonic_felt(brush: HarmonicBrush, cell: vec2<f32>, change: vec2<f32>, mass: f32, dt: f32) -> vec3<f32> {
    let push = mass / dt * change;
    return vec3<f32>(-push, push.x * HARMONIC_PARTING * (cell.x - brush.at.x) / brush.half_size.x);
}

// V after a step that nothing holds; `around` is the sum of the four neighbours' V.
fn harmonic_free(co: HarmonicCoefficients, here: vec2<f32>, old: vec2<f32>, around: vec2<f32>, air: vec2<f32>) -> vec2<f32> {
    let pulled = co.spread * (around - 4.0 * here) - co.restoring * (here - co.gain * air);
    return here + (1.0 - co.damping) * (here - old) + pulled;
}

// What a body that holds a cell adds to V in a step; `held`: the velocity that the body has there, and how far it holds.
fn harmonic_taken_along(co: HarmonicCoefficients, here: vec2<f32>, old: vec2<f32>, held: vec3<f32>) -> vec2<f32> {
    return 0.25 * held.z * held.z * (held.xy - here) - held.z * ((1.0 - co.damping) * (here - old));
}

// What a body does to a cell whose middle is `cell` from the root: the velocity it has there, and how far it holds the cell.
fn harmonic_brushed(brush: HarmonicBrush, cell: vec2<f32>) -> vec3<f32> {
    let off = (cell - brush.at) / brush.half_size;
    let rim = max(1.0 - off.x * off.x, 0.0) * max(1.0 - off.y * off.y, 0.0);
    return vec3<f32>(brush.velocity.x + HARMONIC_PARTING * brush.through * off.x, brush.velocity.y, brush.hold * min(3.0 * rim, 1.0));
}
