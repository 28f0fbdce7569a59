//! What authors write: hertz and damping ratio, or k, b and l₀; what cannot be is refused in words.

use sward::model::{Model, NoAssets};
use sward::scene::Scene;

use super::field::{coefficients, field, touched};

fn refusal(response: &str) -> String {
    let text = format!("(version: 1, stands: [(species: Meadow, response: Oscillator({response}))])");
    match Scene::parse(&text, "test.ron") {
        Err(error) => error.to_string(),
        Ok(scene) => Model::compile(&scene, &NoAssets).map(|_| String::new()).unwrap_or_else(|error| error.to_string()),
    }
}

#[test]
fn both_ways_of_saying_it_agree() {
    let by_hertz = coefficients(&field("height: (0.4, 0.4), response: Oscillator(frequency: 2, damping: 0.3)", ""));
    let angular = std::f32::consts::TAU * 2.0;
    let (k, b) = (9.81 + angular * angular * 0.4, 2.0 * 0.3 * angular * 0.4);
    assert!((by_hertz.stiffness / k - 1.0).abs() < 1e-5 && (by_hertz.damping / b - 1.0).abs() < 1e-5, "{by_hertz:?}");
    let text = format!("height: (0.4, 0.4), response: Oscillator(stiffness: {k}, damping_coefficient: {b})");
    let world = field(&text, "");
    let by_numbers = coefficients(&world);
    assert!((by_numbers.stiffness / k - 1.0).abs() < 1e-6 && (by_numbers.damping / b - 1.0).abs() < 1e-6);
    let model = world.model.stands[0].oscillator.as_ref().expect("it swings");
    assert!((model.frequency - 2.0).abs() < 1e-4 && (model.damping_ratio - 0.3).abs() < 1e-4, "{model:?}");
    // A longer rod swings slower at the same k.
    let longer = field(&format!("height: (0.4, 0.4), response: Oscillator(stiffness: {k}, length: 1.6)"), "");
    let longer = longer.model.stands[0].oscillator.as_ref().expect("it swings").frequency;
    assert!((longer - 1.0).abs() < 1e-4, "{longer}");
}

#[test]
fn what_cannot_be_is_refused() {
    let weak = refusal("stiffness: 9.0");
    assert!(weak.contains("the blade cannot stand") && weak.contains("`stiffness` to"), "{weak}");
    let spread = refusal("frequency: 0.2");
    assert!(spread.contains("the blade cannot stand") && spread.contains("spread_stiffness"), "{spread}");
    let both = refusal("frequency: 2, stiffness: 60");
    assert!(both.contains("both `frequency` and `stiffness`"), "{both}");
    let both = refusal("damping: 2, damping_coefficient: 60");
    assert!(both.contains("both `damping` and `damping_coefficient`"), "{both}");
    assert_eq!(refusal("frequency: 0.2, spread_stiffness: 0"), "");
}

/// Of each plant its own: frequency and damping differ by what is asked for, and not more.
#[test]
fn plants_differ() {
    let body = "interactors: [(shape: Box(size: (6, 1, 6)), path: Still(at: (0, 0)))]";
    let spread = |stand: &str| {
        let mut world = field(stand, body);
        (0..10).for_each(|_| world.step());
        let found = touched(&world);
        assert!(found.len() > 200, "{}", found.len());
        let range = |pick: &dyn Fn(&super::field::Found) -> f32| {
            let values = found.iter().map(|(_, found)| pick(found));
            values.fold([f32::MAX, f32::MIN], |[low, high], value| [low.min(value), high.max(value)])
        };
        [range(&|found| found.own.omega_squared), range(&|found| found.own.gamma)]
    };
    let [stiff, damped] = spread("height: (0.4, 0.4), response: Oscillator()");
    let co = coefficients(&field("height: (0.4, 0.4), response: Oscillator()", ""));
    let (k, b) = (co.stiffness, co.damping);
    let [low, high] = stiff.map(|squared| (squared * 0.4 + 9.81) / k);
    assert!((0.85..0.87).contains(&low) && (1.13..1.1501).contains(&high), "{low} {high}");
    let [low, high] = damped.map(|gamma| gamma * 0.8 / b);
    assert!((0.8..0.83).contains(&low) && (1.17..1.2001).contains(&high), "{low} {high}");
    let [alike, _] = spread("height: (0.4, 0.4), response: Oscillator(spread_stiffness: 0)");
    assert!((alike[1] / alike[0] - 1.0).abs() < 1e-4, "{alike:?}");
    let [by_height, _] = spread("height: (0.2, 0.4), response: Oscillator(spread_stiffness: 0)");
    assert!(by_height[1] / by_height[0] > 1.5, "taller ones are slower: {by_height:?}");
}
