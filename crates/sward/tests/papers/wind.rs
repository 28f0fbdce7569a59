//! Wind as an equilibrium (§5.3, methods): where grass settles, and that steady wind lets it sleep.

use crate::common::{Torus, world};

fn windy(species: &str) -> String {
    format!("field: (patch_side: 8.0), stands: [(species: {species}, cells: 16)], wind: [Uniform(velocity: (2.4, -3.2))]")
}

#[test]
fn grass_settles_where_the_drag_law_says() {
    for (species, figure) in [("Lawn", 0.10), ("Meadow", 0.22), ("Reed", 0.24), ("Tussock", 0.09)] {
        let mut torus = Torus::new(&windy(species));
        (0..1200).for_each(|_| _ = torus.step());
        let k_w = f64::from(torus.stand.species.continuum.wind);
        let tilt = (k_w * 4.0_f64.powf(4.0 / 3.0)).atan();
        for (x, z) in torus.plane(0).iter().zip(torus.plane(1)) {
            let off = (f64::from(*x) - 0.6 * tilt).abs().max((f64::from(*z) + 0.8 * tilt).abs());
            assert!(off < 2e-6, "{species}: {x} {z}, {off}");
        }
        println!("{species}: {tilt:.3} rad in 4 m/s");
        assert!((tilt - figure).abs() < 0.005, "{species}: {tilt}");
        let other = (k_w * 4.0).atan();
        assert!((tilt - other).abs() > 1e-2, "control: a linear drag gives another tilt");
    }
}

#[test]
fn rest_in_wind_is_exactly_rest() {
    let mut torus = Torus::new(&windy("Meadow"));
    let mut world = world(&windy("Meadow"));
    let rest = world.bend_at(0, [1.0, 1.0]).expect("a stand");
    torus.fill(|_, plane, _, _| if plane < 2 { rest[plane] } else { 0.0 });
    for _ in 0..300 {
        assert!(torus.step().largest.sqrt() < 1e-6);
    }
    (0..60).for_each(|_| world.step());
    assert_eq!(world.state.stands[0].counters.patch_steps, 0, "nothing wakes in steady wind");
    torus.fill(|_, _, _, _| 0.0);
    assert!(torus.step().largest.sqrt() > 0.1, "control: upright is not rest in wind");
}

#[test]
fn patches_go_to_sleep_in_steady_wind() {
    let mut world = world(
        "field: (patch_side: 8.0), stands: [(species: Meadow, cells: 32)], wind: [Uniform(velocity: (8.0, 3.0))],
         interactors: [(shape: Sphere(radius: 0.5), path: Circle(centre: (4.0, 4.0), radius: 1.0, speed: 4.0), until: 1.0)]",
    );
    (0..60).for_each(|_| world.step());
    assert!(!world.state.stands[0].awake.is_empty(), "control: the body wakes its patch");
    while !world.state.stands[0].awake.is_empty() {
        world.step();
        assert!(world.time() < 12.0, "{:?}", world.state.stands[0].awake.keys());
    }
    println!("asleep {:.2} s after the body left", world.time() - 1.0);
}
