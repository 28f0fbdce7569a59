//! Whatever a valid scene says of plants in layers, their waves stay finite, every leaf has a layer, and two runs are the same run.

use proptest::prelude::*;
use sward::geometry::layers::{Extent, depths, layer_of};
use sward::scene::{Follow, Form, Grown, HarmonicOverrides, LayersOverrides, Natural, Place, PlantMesh};
use sward::scene::{Representation, Response, Scene, Species, Stand, WindSource};
use sward::world::World;

fn harmonic() -> impl Strategy<Value = HarmonicOverrides> {
    let plane = (prop_oneof![Just(16_u32), Just(64)], 1.0..=500.0_f32, prop::option::of(-7.0..=7.0_f32));
    let waves = (0.0..=50.0_f32, 0.05..=10.0_f32, 0.0..=2.0_f32, 0.0..=10.0_f32, 0.0..=10.0_f32);
    (plane, waves).prop_map(|((cells, side, heading), (speed, frequency, damping, gain, touch))| HarmonicOverrides {
        cells: Some(cells),
        side: Some(side),
        heading: Some(heading),
        speed: Some(speed),
        frequency: Some(frequency),
        damping: Some(damping),
        gain: Some(gain),
        touch: Some(touch),
    })
}

fn layers() -> impl Strategy<Value = LayersOverrides> {
    let form = prop_oneof![Just(Form::Bush), Just(Form::Tree), Just(Form::WaterPlant)];
    let cut = ((1..=8_u32, 1..=4_u32, 1..=4_u32), 0.0..=1.0_f32, 0.0..=1.0_f32, 0.01..=0.5_f32, 0.0..=2.0_f32);
    let moves = (prop::array::uniform3(0.0..=100.0_f32), 0.0..=10.0_f32, 0.0..=1.0_f32, 0..3_u32);
    (form, cut, moves).prop_map(|(form, ((near, mid, far), a, b, turn, fade), (scale, rigidity, loss, follow))| LayersOverrides {
        mesh: Some(PlantMesh::Grown(Grown { form, seed: 1, triangles: 2000 })),
        near: Some(near),
        mid: Some(mid),
        far: Some(far),
        bands: Some(if a < b { [a, b] } else { [b, a] }),
        turn: Some(turn),
        fade: Some(fade),
        scale: Some(scale),
        rigidity: Some(rigidity),
        loss: Some(loss),
        follow: Some([Follow::Record, Follow::LookUp, Follow::AtOnce][follow as usize].clone()),
        distance: Some(40.0),
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 20, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_plants_stay_finite_and_repeat(
        (harmonic, layers) in (harmonic(), layers()),
        velocity in prop::array::uniform2(-60.0..=60.0_f32),
        rate in prop_oneof![Just(30_u32), Just(60), Just(1000)],
        height in 0.05..=12.0_f32,
        moves in prop::collection::vec((-3.0..3.0_f64, -3.0..3.0_f64, -1.0..4.0_f64), 6),
    ) {
        let scene = Scene {
            steps_per_second: rate,
            stands: vec![Stand {
                species: Species::Shrub,
                places: vec![Place { at: [0.0, 1.0], yaw: 0.3, height: Some(height) }],
                response: Some(Response::Harmonic(harmonic)),
                representation: Some(Representation::Layers(layers.clone())),
                ..Stand::default()
            }],
            wind: vec![WindSource::Natural(Natural { velocity, turbulence: 1.0 })],
            ..Scene::parse("(version: 1, interactors: [(shape: Truck, path: Driven())])", "plants.ron").expect("valid")
        };
        prop_assert!(scene.validate().is_ok());
        let run = || {
            let mut world = World::new(scene.clone(), &sward::model::NoAssets).expect("valid");
            for (x, z, clearance) in &moves {
                for step in 0..12 {
                    let share = f64::from(step) / 12.0;
                    world.drive(0, [x * share, z * share], 0.0, *clearance);
                    world.step();
                }
            }
            world
        };
        let world = run();
        let (stand, state) = (&world.model.layered[0], &world.state.layered[0]);
        let all = state.notes.iter().flatten().chain(&state.waves.now).chain(state.touches.iter().flat_map(|waves| &waves.now));
        prop_assert!(all.flatten().all(|part| part.abs() < 1e4));
        for (key, cuts) in &state.cuts {
            let plant = state.plant(*key).expect("near");
            let edges = depths(&cuts.now, &Extent::new(plant, stand.specimen.low, stand.specimen.high), stand.layers().bands);
            prop_assert!(edges.windows(2).all(|pair| pair[0] <= pair[1]), "{:?}", edges);
            prop_assert!((0..200).all(|k| layer_of(&edges, 0.1 * k as f32) < edges.len() - 1));
        }
        prop_assert_eq!(world.hash(), run().hash());
    }
}
