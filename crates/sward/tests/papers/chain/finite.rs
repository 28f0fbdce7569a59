//! Finite for every blade that can be calibrated, in any wind, at any step.

use super::species;
use crate::common::Dice;
use sward::response::chain::{
    BEND_LIMIT, Blade, ChainCoefficients, ChainError, ChainState, DragLaw, MOST_SEGMENTS, RATE_LIMIT, UPRIGHT, calibrate, moments, planted,
    pose, step, turned,
};

fn size(v: [f32; 2]) -> f32 {
    (v[0] * v[0] + v[1] * v[1]).sqrt()
}

/// Whether every joint is within the stops.
fn within(co: &ChainCoefficients, state: &ChainState) -> bool {
    state.joints[..co.segments as usize]
        .iter()
        .all(|[x, y, wx, wy]| size([*x, *y]) <= BEND_LIMIT * 1.00001 && size([*wx, *wy]) <= RATE_LIMIT * 1.00001)
}

/// A blade anywhere in the ranges, most numbers spread over their magnitudes.
fn any_blade(dice: &mut Dice) -> Blade {
    let mut magnitude = |low: f64, high: f64| 10f64.powf(dice.between(low, high));
    let (half_length, mass, stiffness_root, stiffness_tip) =
        (magnitude(-4.0, 1.0), magnitude(-9.0, 0.0), magnitude(-7.0, 4.0), magnitude(-7.0, 4.0));
    let (drag, damping_ratio) = (magnitude(-8.0, 2.0), magnitude(-3.0, 1.0));
    let segments = 1 + (dice.unit() * MOST_SEGMENTS as f64) as u32;
    let law = [DragLaw::Linear, DragLaw::FourThirds, DragLaw::FiveThirds, DragLaw::Square][(dice.unit() * 4.0) as usize % 4];
    let frequency = (dice.unit() < 0.3).then(|| 10f64.powf(dice.between(-2.0, 3.0)));
    Blade { segments, half_length, mass, stiffness_root, stiffness_tip, damping_ratio, drag, law, frequency }
}

/// Runs a blade through gusts of up to `speed` that turn at every step; `false` as soon as it leaves the stops.
fn survives(co: &ChainCoefficients, dice: &mut Dice, speed: f64, steps: u32) -> bool {
    let dt = dice.between(1.0 / 1000.0, 1.0 / 30.0) as f32;
    let base = planted(dice.between(0.0, 6.3) as f32, dice.between(0.0, 1.5) as f32);
    let mut state = ChainState::default();
    for joint in &mut state.joints {
        *joint = [1.4, -1.4, 40.0, -40.0].map(|x| x * dice.between(-1.0, 1.0) as f32);
    }
    let mut wind = [0.0; 3];
    for _ in 0..steps {
        if dice.unit() < 0.2 {
            wind = [0; 3].map(|_| dice.between(-speed, speed) as f32);
        }
        state = step(co, &base, 0.4, wind, dt, &state);
        let held = moments(co, &UPRIGHT, &state.bends()).map(|m| turned(&base, &UPRIGHT, m));
        if !(within(co, &state) && within(co, &ChainState::still(&pose(co, &base, 0.4, &held)))) {
            return false;
        }
    }
    true
}

#[test]
fn any_blade_in_any_wind_stays_within_its_stops() {
    let mut dice = Dice(11);
    let (mut stood, mut fell) = (0, 0);
    for i in 0..3000 {
        let blade = any_blade(&mut dice);
        match calibrate(&blade) {
            Ok(co) => {
                assert!(survives(&co, &mut dice, 60.0, 150), "blade {i}: {blade:?}");
                stood += 1;
            }
            Err(ChainError::CannotStand { .. } | ChainError::Buckles) => fell += 1,
            Err(error) => panic!("{blade:?}: {error}"),
        }
    }
    println!("{stood} blades stood, {fell} could not");
    assert!(stood > 500 && fell > 100);
}

#[test]
fn the_species_stay_within_their_stops_at_any_step_in_a_storm() {
    let mut dice = Dice(5);
    for (name, blade) in species() {
        let co = calibrate(&blade).unwrap();
        for _ in 0..20 {
            assert!(survives(&co, &mut dice, 60.0, 2000), "{name}");
        }
        let mut broken = co;
        broken.joints[0].inertia = f32::NAN;
        broken.joints[0].stiffness = f32::NAN;
        assert!(!survives(&broken, &mut dice, 60.0, 10), "{name}: the check must notice what is not a number");
    }
}

#[test]
fn what_cannot_stand_is_told_what_to_change() {
    let (_, reed) = species()[2];
    let weak = Blade { stiffness_root: 0.01, ..reed };
    let error = calibrate(&weak).unwrap_err();
    assert!(matches!(error, ChainError::CannotStand { joint: 1, .. }), "{error}");
    let text = error.to_string();
    assert!(text.starts_with("the blade cannot stand: at joint 1 of 7") && text.contains("at least"), "{text}");
    let ChainError::CannotStand { needed, .. } = error else { return };
    // As told, but for a little: then this joint stands.
    let told = calibrate(&Blade { stiffness_root: needed * 1.001, ..reed });
    assert!(!matches!(told, Err(ChainError::CannotStand { joint: 1, .. })), "{told:?}");
    assert!(matches!(calibrate(&Blade { segments: 9, ..reed }), Err(ChainError::Segments { segments: 9, .. })));
    assert!(matches!(calibrate(&Blade { mass: f64::NAN, ..reed }), Err(ChainError::Range { .. })));
    assert!(calibrate(&reed).is_ok());
}
