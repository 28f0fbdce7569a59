// What plants do to the bodies that bend them. Twin: reaction.rs, where everything is explained.

const REACTION_CRUSHED: f32 = 1.0;
const REACTION_NEAREST: f32 = 0.02;

// What a body feels of one plant: force, moment, and the energy of one that has just been crushed.
struct Felt {
    force: vec3<f32>,
    moment: vec3<f32>,
    crushed: f32,
}

// A plant that a body holds.
struct Leaning {
    tilt: f32,
    towards: vec2<f32>,
    moment: f32,
    lever: f32,
    length: f32,
    aside: f32,
    crushed: f32,
}

// What the body feels about a point from which the root is `root` m away.
fn reaction_felt(plant: Leaning, root: vec3<f32>) -> Felt {
    let turn = math_sin_cos(plant.tilt);
    let aside = math_upper(plant.lever, REACTION_NEAREST);
    let lever = math_lower(aside, math_upper(plant.length, REACTION_NEAREST));
    let level = plant.aside * plant.moment * turn.y / aside;
    let borne = plant.moment * (1.0 - plant.aside * turn.y * turn.y) / (lever * math_upper(turn.x, 0.1));
    let force = vec3<f32>(-level * plant.towards.x, borne, -level * plant.towards.y);
    let arm = root + lever * vec3<f32>(turn.x * plant.towards.x, turn.y, turn.x * plant.towards.y);
    return Felt(force, cross(arm, force), plant.crushed);
}
