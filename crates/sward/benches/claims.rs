//! What must cost nothing, or next to nothing, as ratios of times in ABBA order: a larger terrain, patches asleep, many bodies.
//! `cargo bench -p sward --bench claims`; a claim holds if the upper end of its interval does. It only prints what it finds: time is
//! noisy, so its exit status says nothing of the claims. That no work is done is tested by counters (`properties::placement`,
//! `properties::activation`).

mod measure;

use std::time::Instant;

use measure::{PAIRS, median, pair, seconds};
use sward::model::NoAssets;
use sward::response::continuum::Stage;
use sward::scene::Scene;
use sward::world::World;

fn world(fields: &str) -> World {
    World::new(Scene::parse(&format!("(version: 1, {fields})"), "claims.ron").expect("valid"), &NoAssets).expect("valid")
}

fn after(steps: u32, mut world: World) -> World {
    (0..steps).for_each(|_| world.step());
    world
}

fn report(claim: &str, limit: f64, ratios: &mut [f64]) {
    let [low, middle, high] = median(ratios);
    let verdict = if high <= limit { "holds" } else { "does not hold here" };
    println!("{claim}: {middle:.4} ({low:.4} to {high:.4}); claimed at most {limit}: {verdict}");
}

fn of_size(patches: u32) -> World {
    after(
        30,
        world(&format!(
            "field: (patch_side: 54.864, patches: ({patches}, {patches})), stands: [(species: Meadow, cells: 120)], wind: [Natural()],
             interactors: [(shape: Truck, path: Circle(radius: 30, speed: 8))], budget: (focus_distance: 96)"
        )),
    )
}

/// 225 patches near the focus, awake by the gusts that `wind` has, or asleep in still air; a ball that flies above them either way.
fn resting(wind: &str) -> World {
    after(
        60,
        world(&format!(
            "field: (patches: (15, 15)), stands: [(species: Meadow)], wind: [{wind}], budget: (patches: 225, focus_distance: 400),
             interactors: [(shape: Sphere(radius: 0.5), path: Circle(radius: 3, speed: 4), clearance: 50)]"
        )),
    )
}

/// 512 balls that roll in circles, two or three in each of 225 patches of 128 × 128 cells, all of them awake.
fn crowded() -> World {
    let ball = |k: u32| {
        let (x, z) = (f64::from(k % 23) * 20.8 - 229.0, f64::from(k / 23) * 20.8 - 229.0);
        format!("(shape: Sphere(radius: 0.5), path: Circle(centre: ({x}, {z}), radius: 3, speed: {}))", 3.0 + f64::from(k % 5))
    };
    let balls: Vec<String> = (0..512).map(ball).collect();
    after(
        60,
        world(&format!("stands: [(species: Meadow)], interactors: [{}], budget: (patches: 225, focus_distance: 20)", balls.join(", "))),
    )
}

fn main() {
    let steps = |world: &mut World, count: u32| seconds(|| (0..count).for_each(|_| world.step()));

    let (mut small, mut large) = (of_size(88), of_size(8800));
    assert_eq!(small.state.stands[0].counters, large.state.stands[0].counters);
    let mut ratios: Vec<f64> = (0..PAIRS)
        .map(|number| pair(number, || steps(&mut large, 5), || steps(&mut small, 5)))
        .map(|[large, small]| large / small)
        .collect();
    println!("{} patches awake", small.state.stands[0].awake.len());
    report("a step on 8800 × 8800 patches against 88 × 88", 1.05, &mut ratios);

    let (mut awake, mut asleep) = (resting("Natural()"), resting(""));
    let count = |world: &World| world.state.stands[0].awake.len();
    assert_eq!((count(&awake), count(&asleep)), (225, 0), "the same scene but for its wind");
    let mut ratios: Vec<f64> = (0..PAIRS)
        .map(|number| pair(number, || steps(&mut asleep, 1), || steps(&mut awake, 1)))
        .map(|[asleep, awake]| asleep / awake)
        .collect();
    report("a step with all 225 patches asleep against all awake", 0.01, &mut ratios);

    let mut crowd = crowded();
    println!("{} bodies, {} patches awake", crowd.model.bodies.len(), count(&crowd));
    let times: Vec<[f64; 2]> = (0..2 * PAIRS).map(|_| contact_of_step(&mut crowd)).collect();
    let [contact, step] = [0, 1].map(|which| 1e3 * median(&mut times.iter().map(|pair| pair[which]).collect::<Vec<f64>>())[1]);
    println!("contact {contact:.2} ms of {step:.2} ms");
    let mut shares: Vec<f64> = times.iter().map(|[contact, step]| contact / step).collect();
    report("contact of 512 bodies, share of a step", 0.05, &mut shares);
}

/// Seconds of the contact stage, and of the step it is part of.
fn contact_of_step(world: &mut World) -> [f64; 2] {
    let begun = Instant::now();
    let plan = world.plan();
    let (mut contact, mut last) = (0.0, Instant::now());
    let summaries = world.respond_in_stages(&plan, &mut |stage| {
        if stage == Stage::Contact {
            contact += last.elapsed().as_secs_f64();
        }
        last = Instant::now();
    });
    world.finish(summaries);
    [contact, begun.elapsed().as_secs_f64()]
}
