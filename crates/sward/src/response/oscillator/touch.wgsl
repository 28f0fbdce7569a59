// What a step does to a plant within reach of bodies. Twin: touch.rs, where everything is explained. Needs instigator.wgsl, interaction/reaction.wgsl.

const TOUCH_UPRIGHT: f32 = 0.05;
const TOUCH_OPPOSED: f32 = 0.2;

struct Gathered {
    strongest: f32,
    strongest_outward: vec2<f32>,
    number: u32, // of that push
    lever: f32,
    aside: f32,
    pace: f32,
    sum: vec2<f32>,
    total: f32,
}

struct Touched {
    changed: bool,
    record: SwingRecord,
    held: bool,
    by: u32, // number of the push
    leaning: Leaning,
}

struct TouchPlant {
    own: SwingOwn,
    record: SwingRecord,
    wind: vec2<f32>,
    inertia: f32,
    length: f32,
}

fn touch_add(gathered: Gathered, push: Push, number: u32) -> Gathered {
    var g = gathered;
    if push.tilt > g.strongest {
        g.strongest = push.tilt;
        g.strongest_outward = push.outward;
        g.number = number;
        g.lever = push.lever;
        g.aside = push.aside;
    }
    g.pace = max(g.pace, push.pace);
    g.sum += push.tilt * push.outward;
    g.total += push.tilt;
    return g;
}

fn touch_outward(g: Gathered) -> vec2<f32> {
    let size = swing_length(g.sum);
    if size < TOUCH_OPPOSED * g.total {
        return g.strongest_outward;
    }
    return g.sum / size;
}

fn touch_turned(origin: vec2<f32>, to: vec2<f32>, most: f32) -> vec2<f32> {
    let turn = math_sin_cos(most);
    if dot(origin, to) >= turn.y {
        return to;
    }
    let sine = select(turn.x, -turn.x, origin.x * to.y - origin.y * to.x < 0.0);
    return vec2<f32>(origin.x * turn.y - origin.y * sine, origin.x * sine + origin.y * turn.y);
}

fn touch_shown(co: OscillatorCoefficients, plant: TouchPlant, now: u32) -> vec2<f32> {
    return swing_limited(swing_at(co, plant.own, plant.record, now, 0.0) + plant.wind);
}

fn touch_is_empty(record: SwingRecord) -> bool {
    return all(record.deviation == vec2<f32>(0.0)) && record.rate == 0.0 && record.stamp == 0u;
}

fn touch_held(co: OscillatorCoefficients, plant: TouchPlant, by: Gathered, before: vec2<f32>, free: vec2<f32>, now: u32) -> Touched {
    let not = Touched(false, plant.record, false, 0u, Leaning());
    if by.strongest <= 0.0 {
        return not;
    }
    let lean = swing_length(free);
    var towards = touch_outward(by);
    if lean > TOUCH_UPRIGHT {
        towards = touch_turned(free / lean, towards, co.pace);
    }
    let reached = max(dot(before, towards), 0.0) + co.pace + by.pace * co.dt;
    let hold = min(min(by.strongest, reached), SWING_HALF_PI);
    if hold < dot(free, towards) {
        return not;
    }
    var deviation = hold * towards - plant.wind;
    var size = swing_length(deviation);
    if size < SWING_SHORTEST {
        deviation = towards * SWING_SHORTEST;
        size = SWING_SHORTEST;
    }
    let leant = swing_length(before);
    var turn = 0.0;
    if leant > TOUCH_UPRIGHT {
        turn = math_atan2(before.x * towards.y - before.y * towards.x, dot(before, towards));
    }
    let rate = (hold - leant) / co.dt * (dot(towards, deviation) / size);
    let was = dot(swing_rate_at(co, plant.own, plant.record, now - 1u), towards);
    let going = (hold - dot(before, towards)) / co.dt;
    let pull = (going - was) / co.dt + 2.0 * plant.own.gamma * going + plant.own.omega_squared * dot(deviation, towards);
    let fell = hold > REACTION_CRUSHED && leant <= REACTION_CRUSHED;
    let energy = 0.5 * plant.inertia * plant.own.omega_squared * size * size;
    let leaning = Leaning(hold, towards, max(plant.inertia * pull, 0.0), by.lever, plant.length, by.aside, select(0.0, energy, fell));
    return Touched(true, SwingRecord(deviation, rate, swing_stamp_held(now, turn / co.pace)), true, by.number, leaning);
}

// The record after the step that makes `now` steps; `stays` is the share of the step for which `leaving` are there
fn touch_step(co: OscillatorCoefficients, given: TouchPlant, staying: Gathered, leaving: Gathered, stays: f32, now: u32) -> Touched {
    var plant = given;
    let before = touch_shown(co, plant, now - 1u);
    let let_go = touch_held(co, plant, leaving, before, touch_shown(co, plant, now), now);
    if let_go.changed {
        plant.record = swing_later(plant.own, let_go.record, (1.0 - stays) * co.dt, now);
    }
    let held = touch_held(co, plant, staying, before, touch_shown(co, plant, now), now);
    if held.changed {
        return held;
    }
    if let_go.changed {
        return Touched(true, plant.record, true, let_go.by, let_go.leaning);
    }
    let aged = swing_is_aged(co, plant.record, now) && !touch_is_empty(plant.record);
    if aged {
        plant.record = SwingRecord(vec2<f32>(0.0), 0.0, 0u);
    }
    return Touched(aged, plant.record, false, 0u, Leaning());
}
