// How the plants of a cell resist being bent. Twin: resistance.rs, where everything is explained. Needs bend, interaction/reaction.

fn continuum_leaning(
    co: ContinuumCoefficients,
    inertia: f32,
    kappa: f32,
    before: ContinuumCell,
    held: ContinuumCell,
    height: f32,
    rest: vec2<f32>,
) -> Leaning {
    let tilt = continuum_length(held.bend);
    let towards = held.bend / math_upper(tilt, 1e-9);
    let away = held.bend - rest;
    let pull = towards * (kappa * away + (held.rate - before.rate) / co.step);
    let moment = math_upper(inertia * (pull.x + pull.y), 0.0);
    let lever = height / math_upper(math_sin_cos(tilt).y, 1e-3);
    let fell = tilt > REACTION_CRUSHED && continuum_length(before.bend) <= REACTION_CRUSHED;
    let energy = 0.5 * inertia * kappa * (away.x * away.x + away.y * away.y);
    return Leaning(tilt, towards, moment, lever, co.plant_height, 1.0, select(0.0, energy, fell));
}
