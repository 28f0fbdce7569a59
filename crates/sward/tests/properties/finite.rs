//! Whatever a valid scene says, the state stays finite and inside its limits.

use crate::common::world;
use proptest::prelude::*;
use sward::response::continuum;
use sward::scene::{
    BoxShape, Continuum, ContinuumOverrides, Driven, Interactor, Lag, Path, Response, Scene, Shape, Species, Sphere, Stand, WindSource,
};
use sward::state::StandState;
use sward::world::World;

/// A number from a field's own range.
fn ranged(name: &'static str) -> impl Strategy<Value = f32> {
    let field = Continuum::FIELDS.iter().find(|field| field.name == name).expect("a field");
    let (low, high) = field.range.expect("a range");
    prop_oneof![4 => low as f32..=high as f32, 1 => Just(low as f32), 1 => Just(high as f32)]
}

fn overrides() -> impl Strategy<Value = ContinuumOverrides> {
    let waves = (ranged("c0"), ranged("mu"), ranged("c_omega"), ranged("lambda_theta"), ranged("lambda_omega"));
    let rest = (ranged("kappa"), ranged("kappa_omega"), ranged("wind"), 0..3_u32, ranged("gamma_top"), ranged("gamma_recover"));
    (waves, rest).prop_map(|((c0, mu, c_omega, lambda_theta, lambda_omega), (kappa, kappa_omega, wind, lag, top, recover))| {
        ContinuumOverrides {
            c0: Some(c0),
            mu: Some(mu),
            c_omega: Some(c_omega),
            lambda_theta: Some(lambda_theta),
            lambda_omega: Some(lambda_omega),
            kappa: Some(kappa),
            kappa_omega: Some(kappa_omega),
            wind: Some(wind),
            lag: Some([Lag::Cascade, Lag::History, Lag::Lookup][lag as usize].clone()),
            gamma_top: Some(top),
            gamma_recover: Some(recover),
            ..ContinuumOverrides::default()
        }
    })
}

fn scene(response: ContinuumOverrides, cells: u32, rate: u32, gusts: [f32; 2]) -> Scene {
    let body = |shape| Interactor { shape, path: Path::Driven(Driven::default()), ..Interactor::default() };
    let mut scene = Scene {
        steps_per_second: rate,
        stands: vec![Stand {
            species: Species::Meadow,
            cells: Some(cells),
            response: Some(Response::Continuum(response)),
            ..Stand::default()
        }],
        interactors: vec![body(Shape::Box(BoxShape { size: [1.5, 1.0, 2.5] })), body(Shape::Sphere(Sphere { radius: 0.8 }))],
        wind: vec![WindSource::Natural(sward::scene::Natural { velocity: gusts, turbulence: 1.0 })],
        ..Scene::default()
    };
    scene.field.patch_side = 8.0;
    scene.field.patches = Some([2, 2]);
    scene.budget.focus_distance = 20.0;
    scene
}

/// The largest |β| and |ω| of a stand; infinite if any number is not finite.
fn extremes(stand: &StandState, area: usize) -> (f32, f32) {
    let mut most = (0.0_f32, 0.0_f32);
    for awake in stand.awake.values() {
        let now = &stand.cells.now[awake.slot as usize];
        for cell in 0..area {
            let length = |x: f32, z: f32| if (x * x + z * z).is_finite() { (x * x + z * z).sqrt() } else { f32::INFINITY };
            most.0 = most.0.max(length(now[cell], now[area + cell]));
            most.1 = most.1.max(length(now[2 * area + cell], now[3 * area + cell]));
        }
        if awake.lag != sward::state::NONE {
            assert!(stand.cells.lag[awake.lag as usize].iter().all(|value| value.is_finite() && value.abs() < 2.0));
        }
    }
    most
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_valid_scene_stays_finite_and_inside_its_limits(
        response in overrides(),
        cells in prop_oneof![Just(8_u32), Just(16), Just(40)],
        rate in prop_oneof![Just(30_u32), Just(60), Just(1000)],
        gusts in prop::array::uniform2(-60.0_f32..=60.0),
        moves in prop::collection::vec((-9.0..9.0_f64, -9.0..9.0_f64, -7.0..7.0_f64, -1.0..1.0_f64), 12),
    ) {
        let scene = scene(response, cells, rate, gusts);
        prop_assert!(scene.validate().is_ok());
        let mut world = World::new(scene, &sward::model::NoAssets).expect("valid");
        for (k, (x, z, yaw, clearance)) in moves.iter().enumerate() {
            for step in 0..10 {
                let reach = if k % 3 == 0 { 1.0 } else { f64::from(step) * 0.1 };
                world.drive(k % 2, [x * reach, z * reach], yaw * reach, *clearance);
                world.step();
                let (bend, rate) = extremes(&world.state.stands[0], (cells * cells) as usize);
                prop_assert!(bend <= continuum::HALF_PI + 1e-5 && rate <= 60.001, "|β| {bend}, |ω| {rate}");
            }
        }
        prop_assert!(world.state.stands[0].counters.patch_steps > 0, "control: something was awake");
    }
}

#[test]
fn numbers_from_callers_cannot_break_a_world() {
    let mut world = world(
        "field: (patch_side: 8.0), stands: [(species: Meadow, cells: 8)], interactors: [(shape: Sphere(radius: 1), path: Driven()), (shape: Truck)]",
    );
    assert!(!world.drive(0, [f64::NAN, 0.0], 0.0, 0.0) && !world.drive(1, [0.0; 2], 0.0, 0.0) && !world.drive(9, [0.0; 2], 0.0, 0.0));
    for huge in [1e7, 1e12, 1e300, -1e300, f64::MAX] {
        world.drive(0, [huge, -huge], huge, huge);
        world.step();
        world.drive(0, [1.0, 1.0], huge, -huge);
        world.step();
        world.state.pinned = vec![[huge, huge], [f64::NAN, 0.0]];
        world.step();
        assert!(world.advance(huge.abs()) == 4 && world.advance(-huge.abs()) == 0);
        assert!(world.state.pending_seconds >= 0.0 && world.state.pending_seconds < 1.0, "{}", world.state.pending_seconds);
        let _ = world.bend_at(0, [huge, huge]);
    }
    assert_eq!(world.advance(f64::NAN), 0);
    assert_eq!(world.advance(f64::INFINITY), 0);
    assert!(world.bend_at(7, [0.0, 0.0]).is_none());
}
