//! What must cost nothing, or next to nothing, as ratios of times in ABBA order: a larger terrain, patches asleep, many bodies.
//! `cargo bench -p sward --bench claims`, or with `-- terrain`, `asleep`, `swings`, `bodies`, `asking` or `saving` only some of it; a claim holds if the upper end of its interval does. It only prints what it finds: time is
//! noisy, so its exit status says nothing of the claims. That no work is done is tested by counters (`properties::placement`,
//! `properties::activation`).

mod measure;

use std::time::Instant;

use measure::{PAIRS, median, pair, seconds};
use rayon::prelude::*;
use sward::lanes::Lanes;
use sward::model::NoAssets;
use sward::response::continuum::Stage;
use sward::response::oscillator::Poses;
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

/// Balls that roll in circles, in rows over 225 patches of 128 × 128 cells, all of them awake.
fn crowded(balls: u32) -> World {
    let row = f64::from(balls).sqrt().ceil();
    let apart = 478.0 / row;
    let ball = |k: u32| {
        let (x, z) = (f64::from(k) % row * apart - 229.0, (f64::from(k) / row).floor() * apart - 229.0);
        format!("(shape: Sphere(radius: 0.5), path: Circle(centre: ({x}, {z}), radius: 3, speed: {}))", 3.0 + f64::from(k % 5))
    };
    let balls: Vec<String> = (0..balls).map(ball).collect();
    after(
        60,
        world(&format!("stands: [(species: Meadow)], interactors: [{}], budget: (patches: 225, focus_distance: 20)", balls.join(", "))),
    )
}

fn main() {
    let named: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with('-')).collect();
    let parts: [(&str, fn()); 6] = [
        ("terrain", large_terrain),
        ("asleep", sleeping),
        ("swings", swinging),
        ("bodies", many_bodies),
        ("asking", asking),
        ("saving", saving),
    ];
    for (_, part) in parts.iter().filter(|(name, _)| named.is_empty() || named.iter().any(|wanted| wanted == name)) {
        part();
    }
}

fn steps(world: &mut World, count: u32) -> f64 {
    seconds(|| (0..count).for_each(|_| world.step()))
}

fn awake(world: &World) -> usize {
    world.state.stands[0].awake.len()
}

fn large_terrain() {
    let (mut small, mut large) = (of_size(88), of_size(8800));
    assert_eq!(small.state.stands[0].counters, large.state.stands[0].counters);
    let mut ratios: Vec<f64> = (0..PAIRS)
        .map(|number| pair(number, || steps(&mut large, 5), || steps(&mut small, 5)))
        .map(|[large, small]| large / small)
        .collect();
    println!("{} patches awake", awake(&small));
    report("a step on 8800 × 8800 patches against 88 × 88", 1.05, &mut ratios);
}

fn sleeping() {
    let (mut blown, mut still) = (resting("Natural()"), resting(""));
    assert_eq!((awake(&blown), awake(&still)), (225, 0), "the same scene but for its wind");
    let mut ratios: Vec<f64> = (0..PAIRS)
        .map(|number| pair(number, || steps(&mut still, 1), || steps(&mut blown, 1)))
        .map(|[still, blown]| still / blown)
        .collect();
    report("a step with all 225 patches asleep against all awake", 0.01, &mut ratios);
}

fn many_bodies() {
    for (balls, contact_limit, all_limit) in [(512, 0.05, 0.1), (1024, 0.1, 0.1)] {
        let mut crowd = crowded(balls);
        println!("{} bodies, {} patches awake", crowd.model.bodies.len(), awake(&crowd));
        let times: Vec<[f64; 3]> = (0..2 * PAIRS).map(|_| contact_of_step(&mut crowd)).collect();
        let [contact, after, step] =
            [0, 1, 2].map(|which| 1e3 * median(&mut times.iter().map(|part| part[which]).collect::<Vec<f64>>())[1]);
        println!("contact {contact:.2} ms, what bodies feel {after:.2} ms, of {step:.2} ms");
        let mut shares: Vec<f64> = times.iter().map(|[contact, _, step]| contact / step).collect();
        report(&format!("contact of {balls} bodies, share of a step"), contact_limit, &mut shares);
        let mut shares: Vec<f64> = times.iter().map(|[contact, after, step]| (contact + after) / step).collect();
        report(&format!("contact of {balls} bodies and what they feel, share of a step"), all_limit, &mut shares);
    }
}

/// A million questions on one core, of places side by side and of scattered ones.
fn asking() {
    let world = after(
        60,
        world("stands: [(species: Meadow)], wind: [Natural()], interactors: [(shape: Truck, path: Circle(radius: 6, speed: 5))]"),
    );
    let chance = |k: i32, purpose| f64::from(sward::math::unit(sward::math::hash(7, k, 0, 0, purpose)));
    let dense = (0..1_000_000).map(|k| [f64::from(k % 1000) * 0.04 - 20.0, f64::from(k / 1000) * 0.04 - 20.0]).collect::<Vec<_>>();
    let scattered = (0..1_000_000).map(|k| [40.0 * chance(k, 0) - 20.0, 40.0 * chance(k, 1) - 20.0]).collect::<Vec<_>>();
    for (what, places) in [("side by side", dense), ("scattered", scattered)] {
        let mut times: Vec<f64> = (0..5).map(|_| seconds(|| drop(world.cover_heights_at(&places)))).collect();
        println!("cover height at a million places {what}, one core: {:.2} s; claimed at most 1", median(&mut times)[1]);
    }
}

/// A world of 225 awake patches, saved and loaded.
fn saving() {
    let world = resting("Natural()");
    assert_eq!(awake(&world), 225, "they are blown about");
    let bytes = world.save_world();
    let mut times: Vec<f64> = (0..5).map(|_| seconds(|| drop(world.save_world()))).collect();
    println!("225 patches saved, {} MB: {:.2} s; claimed at most 0.5", bytes.len() >> 20, median(&mut times)[1]);
    let mut times: Vec<f64> = (0..5).map(|_| seconds(|| drop(World::load(&bytes, &NoAssets).expect("its own")))).collect();
    println!("and loaded: {:.2} s; claimed at most 0.5", median(&mut times)[1]);
}

fn swinging() {
    let [mut rates, mut nanoseconds] = swings();
    let [low, middle, high] = median(&mut rates);
    let verdict = if low >= 0.25 { "holds" } else { "does not hold here" };
    println!(
        "a million plants that swing, rate of a copy of their records: {middle:.3} ({low:.3} to {high:.3}); claimed at least 0.25: {verdict}"
    );
    println!("{:.2} ns a plant on all threads", median(&mut nanoseconds)[1] / 2.0);
}

/// Rates of evaluating a million plants over those of copying their records, and nanoseconds a plant; both on all threads there are.
fn swings() -> [Vec<f64>; 2] {
    const PATCHES: usize = 64;
    const AREA: usize = 128 * 128;
    let world = world("stands: [(species: Meadow, response: Oscillator())]");
    let stand = &world.model.stands[0];
    let co = stand.oscillator.as_ref().expect("it swings").coefficients;
    let chance = |k: usize| f32::from(((k * 2_654_435_761) >> 7) as u8) / 128.0 - 1.0;
    let records: Vec<f32> = (0..PATCHES * 4 * AREA)
        .map(|k| match k / AREA % 4 {
            0 | 1 => chance(k),
            2 => 4.0 * chance(k),
            _ => f32::from_bits(((1000 - (k % 90) as u32) << 8) | 128),
        })
        .collect();
    let heights: Vec<f32> = (0..PATCHES * AREA).map(|k| 0.4 + 0.1 * chance(k)).collect();
    let mut out = [vec![0.0; PATCHES * AREA], vec![0.0; PATCHES * AREA]];
    let mut copy = records.clone();
    let mut evaluate = || {
        let [x, z] = &mut out;
        let work =
            records.par_chunks(4 * AREA).zip(heights.par_chunks(AREA)).zip(x.par_chunks_mut(AREA).zip(z.par_chunks_mut(AREA))).enumerate();
        seconds(|| {
            work.for_each(|(k, ((records, heights), (x, z)))| {
                let poses = Poses { co: &co, placement: &stand.placement, patch: [k as i32, 0], records, heights, now: 1000, behind: 0.0 };
                poses.write(Lanes::default(), [x, z]);
            });
        })
    };
    let mut copied =
        || seconds(|| copy.par_chunks_mut(4 * AREA).zip(records.par_chunks(4 * AREA)).for_each(|(to, from)| to.copy_from_slice(from)));
    let pairs: Vec<[f64; 2]> = (0..PAIRS).map(|number| pair(number, &mut evaluate, &mut copied)).collect();
    let rates = pairs.iter().map(|[evaluated, copied]| copied / evaluated).collect();
    [rates, pairs.iter().map(|[evaluated, _]| 1e9 * evaluated / (PATCHES * AREA) as f64).collect()]
}

/// Seconds of the contact stage; of the end of the step, where what bodies feel is summed up and told; and of the step they are part of.
fn contact_of_step(world: &mut World) -> [f64; 3] {
    let begun = Instant::now();
    let plan = world.plan();
    let (mut contact, mut last) = (0.0, Instant::now());
    let reports = world.respond_in_stages(&plan, &mut |stage| {
        if stage == Stage::Contact {
            contact += last.elapsed().as_secs_f64();
        }
        last = Instant::now();
    });
    let responded = Instant::now();
    world.finish(reports);
    [contact, responded.elapsed().as_secs_f64(), begun.elapsed().as_secs_f64()]
}
