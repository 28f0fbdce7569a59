//! One response from another: the same swing, and what a plant does not say itself.

use sward::fit::{Motion, Translation, let_go};
use sward::response::chain::{Blade, trails};
use sward::scene::{
    ChainOverrides, ContinuumOverrides, HarmonicOverrides, OscillatorOverrides, Response, Species, SpringsOverrides, Stand,
};

use crate::Test;

pub(crate) const TESTS: &[Test] = &[
    ("each_response_swings_as_it_says", each_response_swings_as_it_says),
    ("a_response_made_from_another_swings_as_it_does", a_response_made_from_another_swings_as_it_does),
    ("tips_trail_feet", tips_trail_feet),
    ("what_does_not_swing_or_cannot_be_is_refused", what_does_not_swing_or_cannot_be_is_refused),
];

fn stand(species: &Species, response: Response) -> Stand {
    Stand { species: species.clone(), response: Some(response), ..Stand::default() }
}

fn kinds() -> [Response; 5] {
    [
        Response::Continuum(ContinuumOverrides::default()),
        Response::Oscillator(OscillatorOverrides::default()),
        Response::Chain(ChainOverrides::default()),
        Response::VirtualInertia(ChainOverrides::default()),
        Response::Harmonic(HarmonicOverrides::default()),
    ]
}

fn motion(stand: &Stand) -> Motion {
    let_go(stand).unwrap_or_else(|error| panic!("{error}"))
}

/// Frequency \[Hz\] and damping ratio that a stand without trailing tips, drag or several segments has.
fn each_response_swings_as_it_says() {
    let still = ContinuumOverrides {
        frequency: Some(1.3),
        damping: Some(0.2),
        gamma_top: Some(0.0),
        gamma_recover: Some(0.0),
        ..Default::default()
    };
    let rod = OscillatorOverrides { frequency: Some(1.3), damping: Some(0.2), ..Default::default() };
    let blade = ChainOverrides { frequency: Some(1.3), damping: Some(0.2), drag: Some(0.0), ..Default::default() };
    let leaves = HarmonicOverrides { frequency: Some(1.3), damping: Some(0.2), ..Default::default() };
    let plain = |response: Response| {
        let one = sward::scene::BillboardOverrides { segments: Some(1), ..Default::default() };
        let representation = (!matches!(response, Response::Harmonic(_))).then_some(sward::scene::Representation::Billboard(one));
        Stand { representation, ..stand(&Species::Meadow, response) }
    };
    for (response, most) in [
        (Response::Continuum(still), 6e-3),
        (Response::Oscillator(rod), 6e-3),
        (Response::Chain(blade), 6e-3),
        (Response::Harmonic(leaves), 2e-2),
    ] {
        let swing = motion(&plain(response.clone())).swing();
        let off = [swing.frequency / 1.3 - 1.0, swing.damping_ratio / 0.2 - 1.0];
        println!("{}: {:.4} Hz, {:.4}, R² {:.5}", response.to_ron(), swing.frequency, swing.damping_ratio, swing.r_squared);
        assert!(off.iter().all(|off| off.abs() < most) && swing.r_squared > 0.999, "{off:?}");
        assert!((swing.frequency / 1.35 - 1.0).abs() > most, "control: another frequency");
    }
}

fn a_response_made_from_another_swings_as_it_does() {
    let mut compared = 0;
    for species in [Species::Meadow, Species::Tussock] {
        for (from, kind) in kinds().into_iter().flat_map(|from| kinds().into_iter().map(move |kind| (from.clone(), kind))) {
            let original = stand(&species, from.clone());
            let found = Translation::of(&original, &kind, 32.0).unwrap_or_else(|error| panic!("{from:?} to {kind:?}: {error}"));
            let off = [found.to.frequency / found.from.frequency - 1.0, found.to.damping_ratio / found.from.damping_ratio - 1.0];
            println!("{species:?}, {}: {}, R² {:.4}", from.to_ron(), found.response.to_ron(), found.r_squared);
            assert!(off[0].abs() < 2e-3 && off[1].abs() < 5e-3 && found.r_squared > 0.94, "{off:?} {}", found.r_squared);
            // It is what a scene would have, and the motion is what was measured.
            let again = motion(&stand(&species, found.response.clone()));
            assert_eq!(again.swing(), found.to);
            assert_eq!(motion(&original).explained_by(&again), found.r_squared);
            compared += 1;
        }
        // Control: as the species has them, they differ.
        let [canopy, rod, blade, ..] = kinds().map(|kind| motion(&stand(&species, kind)));
        assert!(rod.explained_by(&canopy) < 0.94 && blade.explained_by(&canopy) < 0.94, "{}", rod.explained_by(&canopy));
    }
    assert_eq!(compared, 50);
}

fn tips_trail_feet() {
    for (species, expected) in [
        (Species::Meadow, [0.061, 0.051]),
        (Species::Reed, [0.128, 0.141]),
        (Species::Tussock, [0.022, 0.017]),
        (Species::Lawn, [0.008, 0.005]),
    ] {
        let found = trails(&Blade::of(&species)).expect("it stands").expect("two segments and more");
        let lags = found.each_ref().map(|trail| trail.lag);
        println!("{species:?}: {lags:.4?} s");
        // From the same equations in another program.
        assert!((0..2).all(|k| (lags[k] - expected[k]).abs() < 6e-4), "{lags:?}");
        assert!(found[0].foot[0] == 0.0 && (found[0].foot[2000] - 1.0).abs() < 1e-3 && found[1].foot[0] == 1.0);
        // Control: a blade four times as heavy is slower, and so its tip is later.
        let heavy = Blade { mass: 1.2 * Blade::of(&species).mass, ..Blade::of(&species) };
        assert!(trails(&heavy).expect("it stands").expect("two segments and more")[0].lag > 1.03 * lags[0]);
    }
    assert_eq!(trails(&Blade { segments: 1, ..Blade::of(&Species::Tussock) }), Ok(None));
    assert!(trails(&Blade { stiffness_tip: 1e-9, ..Blade::of(&Species::Tussock) }).is_err());
}

fn what_does_not_swing_or_cannot_be_is_refused() {
    let meadow = |response: Response| stand(&Species::Meadow, response);
    let springs = Response::Springs(SpringsOverrides::default());
    let refused = |stand: &Stand, kind: &Response| Translation::of(stand, kind, 32.0).expect_err("refused").to_string();
    let [canopy, rod, ..] = kinds();
    for text in [refused(&meadow(springs.clone()), &canopy), refused(&meadow(canopy.clone()), &springs)] {
        assert!(text.contains("`Springs` do not swing"), "{text}");
    }
    let slow = meadow(Response::Harmonic(HarmonicOverrides { frequency: Some(0.1), ..Default::default() }));
    assert!(refused(&slow, &rod).contains("cannot stand"));
    let wrong = meadow(Response::Oscillator(OscillatorOverrides { frequency: Some(900.0), ..Default::default() }));
    assert!(refused(&wrong, &canopy).contains("allowed 0.05 to 50"));
    assert!(refused(&stand(&Species::Tree, rod), &canopy).contains("sway as a whole"));
}
