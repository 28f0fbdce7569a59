//! What plants do to bodies, and the events of it.

use sward::interaction::Hit;
use sward::model::NoAssets;
use sward::response::continuum::{Coefficients, Resistance, contact};
use sward::response::oscillator::{OscillatorCoefficients, Own, Plant, Push, Record, touch};
use sward::scene::Scene;
use sward::state::{Event, Happening, Reaction};
use sward::world::World;

/// Every response.
const RESPONSES: [&str; 6] = [
    "species: Meadow, cells: 64",
    "species: Meadow, cells: 64, response: Oscillator()",
    "species: Meadow, cells: 64, response: Springs()",
    "species: Meadow, cells: 32, response: Chain(), representation: Blade(blades: 4)",
    "species: Meadow, cells: 32, response: VirtualInertia(), representation: Blade(blades: 4)",
    "species: Shrub, cells: 8, height: (0.8, 1.0)",
];

fn world(stand: &str, bodies: &str) -> World {
    let text = format!("(version: 1, field: (patch_side: 8), stands: [({stand})], interactors: [{bodies}])");
    World::new(Scene::parse(&text, "reactions.ron").unwrap_or_else(|error| panic!("{error}\n{text}")), &NoAssets).unwrap()
}

/// A ball that drives along x, `clearance` m over the ground: three seconds at 1.4 m/s, one second where it is then, and up and away. What it feels, and the events.
fn driven(stand: &str, clearance: f64) -> (Vec<Reaction>, Vec<Event>) {
    let ball = format!("(name: \"ball\", shape: Sphere(radius: 0.4), clearance: {clearance}, path: Driven(at: (0, 2)))");
    let mut world = world(stand, &ball);
    let mut felt = Vec::new();
    for step in 0..300_u32 {
        let up = if step < 240 { clearance } else { 5.0 };
        world.drive(0, [f64::from(step.min(180)) / 60.0 * 1.4, 2.0], 0.0, up);
        world.step();
        felt.push(world.reaction(0).unwrap());
    }
    (felt, world.take_events())
}

/// The mean of some steps.
fn mean(felt: &[Reaction], part: impl Fn(&Reaction) -> f64) -> f64 {
    felt.iter().map(part).sum::<f64>() / felt.len() as f64
}

#[test]
fn bodies_feel_what_they_push() {
    let mut sizes = Vec::new();
    for (number, stand) in RESPONSES.into_iter().enumerate() {
        let (felt, events) = driven(stand, 0.0);
        let moving = &felt[60..180];
        let [x, y, z] = [0, 1, 2].map(|axis: usize| mean(moving, |felt| felt.force[axis]));
        let (power, plants) = (mean(moving, |felt| felt.power), mean(moving, |felt| f64::from(felt.plants)));
        println!("{stand}: {x:.2} {y:.2} {z:.2} N, {power:.2} W, {plants:.0} plants, {} events", events.len());
        assert!(x < -0.05 && y >= 0.0 && z.abs() < 0.4 * x.abs(), "{stand}: plants hold it up and back: {x} {y} {z}");
        assert!((power + 1.4 * x).abs() < 1e-6 * power, "{stand}: {power} W");
        assert!(plants > 1.0);
        assert!(felt[200..239].iter().all(|felt| felt.power == 0.0), "{stand}: a body at rest does no work");
        assert!(felt[250..].iter().all(|felt| *felt == Reaction::default()), "{stand}: in the air nothing touches it");
        let count = |what: fn(&Happening) -> bool| events.iter().filter(|event| what(&event.what)).count();
        assert_eq!(count(|what| matches!(what, Happening::Entered)), 1, "{stand}");
        assert_eq!(count(|what| matches!(what, Happening::Left)), 1, "{stand}");
        assert_eq!(
            (events.first().map(|event| event.what), events.last().map(|event| event.what)),
            (Some(Happening::Entered), Some(Happening::Left))
        );
        let crushed = events.iter().filter_map(|event| match event.what {
            Happening::Crushed { plants, energy } => Some((plants, energy)),
            _ => None,
        });
        let crushed: Vec<(u32, f64)> = crushed.collect();
        // Bushes only move.
        assert_eq!(crushed.len() > 10, number < 5, "{stand}: {crushed:?}");
        assert!(crushed.iter().all(|(plants, energy)| *plants > 0 && *energy > 0.0));
        // At most every tenth of a second.
        assert!(crushed.len() <= 50);
        let blades = if number == 3 || number == 4 { 32.0 } else { 1.0 };
        sizes.push(x.abs() * blades);
        let (felt, events) = driven(stand, 3.0);
        assert!(events.is_empty() && felt.iter().all(|felt| *felt == Reaction::default()), "control: {stand}: nothing reaches so high");
    }
    // Of the same meadow: of the stands by blade an eighth of the blades stands on a quarter of the cells.
    let (least, most) = sizes[..5].iter().fold((f64::MAX, 0.0_f64), |(least, most), size| (least.min(*size), most.max(*size)));
    assert!(most < 5.0 * least, "responses agree no better than {least:.2} to {most:.2} N");
}

#[test]
fn plants_on_one_side_turn_a_body() {
    for (side, sign) in [("((-20, -20), (20, -20), (20, 2), (-20, 2))", -1.0), ("((-20, 2), (20, 2), (20, 20), (-20, 20))", 1.0)] {
        for response in ["Continuum()", "Oscillator()", "Springs()"] {
            let text = format!(
                "(version: 1, field: (patch_side: 8), stands: [(species: Meadow, cells: 64, response: {response})],
                 exclusions: [(area: Polygon(points: [{}]))],
                 interactors: [(shape: Box(size: (0.8, 1, 0.8)), path: Driven(at: (0, 2)))])",
                side.trim_start_matches('(')
                    .trim_end_matches(')')
                    .replace("), (", "),(")
                    .split("),(")
                    .map(|point| format!("({point})"))
                    .collect::<Vec<_>>()
                    .join(", ")
            );
            let mut world =
                World::new(Scene::parse(&text, "side.ron").unwrap_or_else(|error| panic!("{error}\n{text}")), &NoAssets).unwrap();
            let mut turning = 0.0;
            for step in 0..90 {
                world.drive(0, [f64::from(step) / 60.0, 2.0], 0.0, 0.1);
                world.step();
                turning += world.reaction(0).unwrap().torque[1];
            }
            assert!(turning * sign > 0.1, "{response}: {turning} N·m beside {side}");
        }
    }
}

#[test]
fn a_body_that_is_gone_has_left() {
    let mut world = world(RESPONSES[1], "(name: \"ball\", shape: Sphere(radius: 0.4), path: Driven(at: (2, 2)))");
    (0..10).for_each(|_| world.step());
    assert!(world.reaction(0).unwrap().plants > 0);
    assert_eq!(world.reaction(1), None);
    assert!(world.take_events().last().is_some_and(|event| event.what != Happening::Left));
    world.remove_body(0);
    assert_eq!(world.take_events().into_iter().map(|event| event.what).collect::<Vec<_>>(), [Happening::Left]);
    world.step();
    assert_eq!(world.reaction(0), Some(Reaction::default()));
}

#[test]
fn reactions_go_on_in_a_saved_state() {
    let bodies = "(shape: Sphere(radius: 0.4), path: Circle(radius: 2, speed: 2))";
    let mut world = world(RESPONSES[1], bodies);
    (0..50).for_each(|_| world.step());
    let mut again = self::world(RESPONSES[1], bodies);
    again.restore(&world.save()).unwrap();
    assert_eq!(again.reaction(0), world.reaction(0));
    world.take_events();
    for _ in 0..60 {
        world.step();
        again.step();
        assert_eq!(again.reaction(0), world.reaction(0));
    }
    assert_eq!(again.take_events(), world.take_events());
    assert_ne!(world.reaction(0), Some(Reaction::default()), "control: it feels something");
}

/// A board at a height of 0.1 m passes over one plant that swings by itself: its work on the plant, what the plant's spring holds at the end, and its motion when it is struck, J.
fn passed_over(speed: f32, rate: f32) -> [f32; 3] {
    let world = world("species: Meadow, response: Oscillator()", "");
    let (model, dt, height, clearance) = (&world.model.stands[0], 1.0 / rate, 0.4, 0.1);
    let co = OscillatorCoefficients { dt, ..model.oscillator.as_ref().unwrap().coefficients };
    let (own, inertia) = (Own::of(&co, 0x8000_8000, height), 0.064 * model.inertia);
    let (mut record, mut work, mut depth, mut now) = (Record::default(), 0.0, 0.0_f32, 1000);
    while depth < 1.0 {
        depth += speed * dt;
        now += 1;
        let (under, out) = ((clearance / height).acos(), (depth / clearance).atan());
        let tilt = under.min(out);
        let aside = if out < under { 1.0 } else { 0.0 };
        let push = Push { tilt, outward: [1.0, 0.0], pace: speed / clearance, lever: (clearance / tilt.cos()).min(height), aside };
        let plant = Plant { own, record, wind: [0.0; 2], inertia, length: height };
        if let Some(touched) = touch(&co, &plant, std::iter::once((0, push, 1.0)), now) {
            record = touched.record;
            work -= touched.leaning.map_or(0.0, |(_, leaning)| leaning.felt([0.0; 3]).force[0]) * speed * dt;
        }
    }
    let [x, z] = record.deviation;
    let rate = speed / clearance;
    [work, 0.5 * inertia * own.omega_squared * (x * x + z * z), 0.5 * inertia * rate * rate]
}

/// The same of a cell of a stand that moves as one.
fn passed_over_cell(speed: f32, rate: f32) -> [f32; 3] {
    let world = world("species: Meadow", "");
    let model = &world.model.stands[0];
    let (co, _) = Coefficients::new(&model.species.continuum, f64::from(1.0 / rate), 0.125, 0.4);
    let resistance = Resistance { inertia: model.cell_inertia(), kappa: model.species.continuum.kappa };
    let (mut cell, mut work, mut depth) = ([0.0_f32; 4], 0.0, 0.0);
    while depth < 1.0 {
        depth += speed / rate;
        let hit = Hit { speed, direction: [1.0, 0.0], along: speed, height: 0.1, normal: [1.0, 0.0], depth: 0.0 };
        let held = contact(&co, [cell[0], cell[1]], [0.0; 2], &[hit]).unwrap();
        work -= resistance.leaning(&co, cell, &held, [0.0; 2], 0.4).felt([0.0; 3]).force[0] * speed / rate;
        cell = [held.bend[0], held.bend[1], held.rate[0], held.rate[1]];
    }
    let held = cell[0] * cell[0] + cell[1] * cell[1];
    [work, 0.5 * resistance.inertia * resistance.kappa * held, 0.5 * resistance.inertia * (speed / 0.1) * (speed / 0.1)]
}

#[test]
fn work_becomes_energy() {
    type Passed = fn(f32, f32) -> [f32; 3];
    let ways: [(&str, Passed); 2] = [("oscillator", passed_over), ("continuum", passed_over_cell)];
    for (name, passed) in ways {
        for rate in [60.0, 1000.0] {
            let [work, energy, _] = passed(0.1, rate);
            let off = work / energy - 1.0;
            println!("{name}, 0.1 m/s, {rate} Hz: work {work:.4} J of {energy:.4} J, {:+.1} %", 1e2 * off);
            assert!(off.abs() < 0.05, "{name}: {off}");
            // A fast one strikes it: what it gives as motion, too, and as much again is lost in the blow.
            let [work, energy, motion] = passed(2.0, rate);
            println!("{name}, 2 m/s, {rate} Hz: work {work:.4} J of {energy:.4} J, and {motion:.4} J of motion");
            assert!((energy + motion..energy + 2.2 * motion).contains(&work), "{name}: {work} J of {energy} and {motion} J");
            assert!(work > 1.5 * energy, "control: that is no slow push");
        }
    }
}

/// Energy of all plants' springs, J: J κ θ²/2 of what stands in each cell, of blades that of their joints.
fn held(world: &World) -> f64 {
    let model = &world.model.stands[0];
    let mut energy = 0.0;
    for z in -16..24 * 8 {
        for x in -32..32 * 8 {
            let place = [f64::from(x), f64::from(z)].map(|k| (k + 0.5) * model.spacing);
            let Some([bx, bz]) = world.bend_at(0, place) else { continue };
            let cell = place.map(|metres| (metres / model.spacing).floor() as i64);
            let side = i64::from(model.cells);
            let (patch, [i, j]) = (cell.map(|k| k.div_euclid(side) as i32), cell.map(|k| k.rem_euclid(side) as u32));
            let theta = f64::from(bx * bx + bz * bz);
            let plant = sward::placement::plant(&model.placement, patch, [i, j]);
            energy += match (&model.oscillator, &model.springs) {
                (Some(oscillator), _) => plant.map_or(0.0, |plant| {
                    let variety = sward::placement::variety(&model.placement, patch, j * model.cells + i);
                    let own = sward::response::oscillator::Own::of(&oscillator.coefficients, variety, plant.height);
                    0.5 * f64::from(model.inertia * plant.height.powi(3) * own.omega_squared) * theta
                }),
                (_, Some(_)) => {
                    plant.map_or(0.0, |plant| 0.5 * f64::from(model.inertia * plant.height.powi(3) * model.species.continuum.kappa) * theta)
                }
                _ => 0.5 * f64::from(model.cell_inertia() * model.species.continuum.kappa) * theta,
            };
        }
    }
    energy
}

/// A box is pushed two metres through a meadow, `speed` m/s; its work, and what the springs of all plants hold, J.
fn box_work(stand: &str, speed: f64) -> [f64; 2] {
    let mut world = world(stand, "(name: \"box\", shape: Box(size: (1, 1, 2)), clearance: 0.1, path: Driven(at: (0, 2)))");
    let (mut work, steps) = (0.0, (2.0 / speed * 60.0) as u32);
    for step in 0..steps {
        world.drive(0, [f64::from(step) / 60.0 * speed, 2.0], 0.0, 0.1);
        world.step();
        work += world.reaction(0).unwrap().power / 60.0;
    }
    [work, held(&world)]
}

/// The box has bent plants on twice the ground on which it holds them in the end, so its work is twice what those hold: the residual of each measure, with all that is
/// around a body. What is let go beside and behind it, and what it turns to its sides, counts in it.
#[test]
fn a_box_works_on_a_meadow() {
    for (stand, most) in RESPONSES[..3].iter().zip([0.2, 0.6, 0.3]) {
        let [work, energy] = box_work(stand, 0.25);
        let residual = work / (2.0 * energy) - 1.0;
        println!("{stand}: work {work:.2} J, twice the energy held {:.2} J: {:+.0} %", 2.0 * energy, 1e2 * residual);
        assert!(residual.abs() < most, "{stand}: {residual}");
    }
}
