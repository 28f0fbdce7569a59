// What moves the air of a plane: gusts and bodies; twin of force.rs, where everything is explained.

struct FluidGust {
    at: vec2<f32>,
    change: vec2<f32>,
    radius: f32,
    unused_a: f32,
    unused_b: f32,
    unused_c: f32,
}

struct FluidDrag {
    at: vec2<f32>,
    half: vec2<f32>,
    velocity: vec2<f32>,
    turn: vec2<f32>,
    leaves: f32,
    unused_a: f32,
    unused_b: f32,
    unused_c: f32,
}

const FLUID_HOLDS: f32 = 3.2;

// From `at` to the middle of a cell, m, the nearest way round a plane `width` wide.
fn fluid_off(cell: vec2<u32>, size: f32, width: f32, at: vec2<f32>) -> vec2<f32> {
    let straight = (vec2<f32>(cell) + 0.5) * size - at;
    return straight - width * floor(straight / width + 0.5);
}

// 1 in the middle, 0 at the rim and beyond; of the square of the distance in radii.
fn fluid_bump(away: f32) -> f32 {
    if away < 1.0 {
        return (1.0 - away) * (1.0 - away);
    }
    return 0.0;
}

// The velocity after a gust, `off` m from its middle.
fn fluid_pushed(velocity: vec2<f32>, gust: FluidGust, off: vec2<f32>) -> vec2<f32> {
    let away = off / gust.radius;
    return velocity + fluid_bump(away.x * away.x + away.y * away.y) * gust.change;
}

// The velocity after a body, `off` m from its middle.
fn fluid_dragged(velocity: vec2<f32>, body: FluidDrag, off: vec2<f32>) -> vec2<f32> {
    let own = vec2<f32>(body.turn.x * off.x - body.turn.y * off.y, body.turn.y * off.x + body.turn.x * off.y) / body.half;
    let inside = math_lower(fluid_bump(own.x * own.x + own.y * own.y) * FLUID_HOLDS, 1.0);
    return velocity + (body.velocity - velocity) * ((1.0 - body.leaves) * inside);
}
