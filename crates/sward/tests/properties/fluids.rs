//! Whatever a valid scene says of air that flows, the air and the grass in it stay finite, and two runs are the same run.

use proptest::prelude::*;
use sward::scene::{Fluid, Gust, GustFrom, GustPlace, Scene, Species, Stand, WindSource};
use sward::wind::fluid::FASTEST;
use sward::world::World;

fn gust() -> impl Strategy<Value = Gust> {
    let from = (0..5_u32, prop::array::uniform2(-1e6..=1e6)).prop_map(|(kind, at)| match kind {
        0 => GustFrom::West,
        1 => GustFrom::East,
        2 => GustFrom::North,
        3 => GustFrom::South,
        _ => GustFrom::Place(GustPlace { at }),
    });
    let numbers = (0.0..=1.0_f32, -6.3..=6.3_f32, 0.1..=2.0_f32, -100.0..=100.0_f32, prop_oneof![Just(0.0), 0.0..=10.0_f32], 0.0..=1.0_f32);
    (from, numbers).prop_map(|(from, (along, turn, radius, strength, frequency, phase))| Gust {
        from,
        along,
        turn,
        radius,
        strength,
        frequency,
        phase,
    })
}

fn fluid() -> impl Strategy<Value = Fluid> {
    let shape = (prop_oneof![Just(4.0_f32), Just(512.0), 4.0..=512.0_f32], prop_oneof![Just(16_u32), Just(32)]);
    let air = (prop::array::uniform2(-60.0..=60.0_f32), prop_oneof![Just(0.0), Just(10.0), 0.0..=1.0_f32], 0.05..=60.0_f32);
    (shape, air, prop::collection::vec(gust(), 0..6), any::<bool>()).prop_map(
        |((side, cells), (velocity, viscosity, fade), gusts, bodies)| Fluid { side, cells, velocity, viscosity, fade, gusts, bodies },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_air_stays_finite_and_repeats(
        fluids in prop::collection::vec(fluid(), 1..3),
        rate in prop_oneof![Just(30_u32), Just(60), Just(1000)],
        moves in prop::collection::vec((-20.0..20.0_f64, -20.0..20.0_f64, -7.0..7.0_f64, -1.0..4.0_f64), 8),
    ) {
        let body = |shape: &str| format!("(shape: {shape}, path: Driven())");
        let text = format!("(version: 1, interactors: [{}, {}])", body("Box(size: (0.1, 1, 30))"), body("Truck"));
        let mut scene = Scene {
            steps_per_second: rate,
            stands: vec![Stand { species: Species::Meadow, cells: Some(8), ..Stand::default() }],
            wind: fluids.into_iter().map(WindSource::Fluid).collect(),
            ..Scene::parse(&text, "air.ron").expect("valid")
        };
        scene.field.patch_side = 8.0;
        scene.field.patches = Some([2, 2]);
        prop_assert!(scene.validate().is_ok());
        let run = || {
            let mut world = World::new(scene.clone(), &sward::model::NoAssets).expect("valid");
            for (k, (x, z, yaw, clearance)) in moves.iter().enumerate() {
                for step in 0..8 {
                    let share = f64::from(step) * 0.125;
                    world.drive(k % 2, [x * share, z * share], yaw * share, *clearance);
                    world.step();
                }
            }
            world
        };
        let world = run();
        for fluid in &world.state.fluids {
            prop_assert!(fluid.now.iter().flatten().all(|speed| speed.abs() <= FASTEST));
        }
        let stand = &world.state.stands[0];
        let cells = stand.awake.values().flat_map(|awake| &stand.cells.now[awake.slot as usize][..]);
        prop_assert!(cells.into_iter().all(|value| value.is_finite()));
        prop_assert_eq!(world.hash(), run().hash());
    }
}
