//! How far a press reaches, and that the wave equation with the speed found from it carries it as far.

use sward::fit::{Translation, reach};
use sward::scene::{ChainOverrides, ContinuumOverrides, Response, Species, Stand};

use crate::Test;
use crate::common::Torus;

pub(crate) const TESTS: &[Test] = &[
    ("plants_that_do_not_touch_pass_nothing_on", plants_that_do_not_touch_pass_nothing_on),
    ("the_wave_carries_a_press_as_far", the_wave_carries_a_press_as_far),
];

fn plants_that_do_not_touch_pass_nothing_on() {
    // A plant 0.4 m high pressed half-way down has its tip 0.28 m aside.
    assert!(reach(0.4, 0.29) == 0.0 && reach(0.4, 0.27) > 0.0);
    assert!(reach(0.0, 0.1) == 0.0 && reach(0.4, 1e9) == 0.0 && reach(f64::NAN, 0.1) == 0.0 && reach(0.4, 0.0) == 0.0);
    // Twice the size, twice as far; and in a dense stand ∫ θ dθ / cos θ over π/4, 0.466 of the height.
    assert!((reach(0.8, 0.1) / reach(0.4, 0.05) - 2.0).abs() < 1e-6);
    assert!((reach(1.0, 1e-4) - 0.466).abs() < 1e-3, "{}", reach(1.0, 1e-4));
}

/// A row held at a bend, everything else at rest: how far it reaches, m.
fn carried(response: &ContinuumOverrides) -> f64 {
    let response = Response::Continuum(ContinuumOverrides { mu: Some(0.0), ..response.clone() }).to_ron();
    let mut torus = Torus::new(&format!("field: (patch_side: 8.0), stands: [(species: Meadow, cells: 64, response: {response})]"));
    let (side, held) = (torus.side, 0.3);
    let spacing = 8.0 / side as f64;
    for _ in 0..900 {
        for level in [&mut torus.cells.now[0], &mut torus.cells.old[0]] {
            level[..side].fill(held);
        }
        torus.step();
    }
    // One side of the row, half of itself included.
    let rows: Vec<f64> = (0..side / 2).map(|j| f64::from(torus.plane(0)[j * side])).collect();
    let whole = spacing * (0.5 * f64::from(held) + rows[1..].iter().sum::<f64>()) / f64::from(held);
    (whole * whole - 0.25 * spacing * spacing).sqrt()
}

/// Plants whose stems stand as far apart as their blades would: 32, 14 and 40 in a cell of a quarter of a metre.
fn the_wave_carries_a_press_as_far() {
    for (species, height, blades) in [(Species::Meadow, 0.4, 32.0), (Species::Reed, 1.2, 14.0), (Species::Tussock, 0.3, 40.0_f64)] {
        let reach = reach(height, 0.25 / blades.sqrt());
        let stand = Stand { species: species.clone(), response: Some(Response::Chain(ChainOverrides::default())), ..Stand::default() };
        let found =
            Translation::of(&stand, &Response::Continuum(ContinuumOverrides::default()), 32.0).unwrap_or_else(|error| panic!("{error}"));
        let Response::Continuum(response) = found.response else { panic!("{:?}", found.response) };
        let far = carried(&response);
        println!("{species:?}: reaches {reach:.3} m, carried {far:.3} m");
        assert!((far / reach - 1.0).abs() < 0.05, "{far}");
        let faster = ContinuumOverrides { c0: response.c0.map(|speed| 1.2 * speed), ..response };
        assert!((carried(&faster) / reach - 1.0).abs() > 0.10, "control: another speed");
    }
}
