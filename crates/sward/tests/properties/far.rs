//! Far from home a scene is the same scene: positions are (patch, local).

use crate::common::world;
use sward::world::World;

/// A drive with gusts, authored `shift` metres from (0, 0), around the origin patch `origin`.
fn drive(shift: [f64; 2], origin: [i32; 2], wind: &str, ground: &str) -> World {
    let [x, z] = shift;
    world(&format!(
        "origin: ({}, {}), field: (patch_side: 16.0), stands: [(species: Meadow, cells: 64)], wind: [{wind}],{ground}
         interactors: [
            (shape: Truck, path: Keyframes(keys: [(time: 0.0, at: ({:?}, {:?})), (time: 1.0, at: ({:?}, {:?})), (time: 2.0, at: ({:?}, {:?}))])),
            (shape: Sphere(radius: 0.5), path: Circle(centre: ({:?}, {:?}), radius: 3.0, speed: 5.0)),
         ],
         camera: (eye: ({:?}, 2.0, {:?}), target: ({:?}, 1.0, {:?})), budget: (focus_distance: 20.0)",
        origin[0], origin[1], x - 8.0, z + 1.0, x + 3.5, z + 2.25, x + 9.0, z - 3.0, x + 2.5, z + 3.0, x, z - 6.0, x, z + 4.0,
    ))
}

const SHIFT: f64 = 8000.0 * 16.0;

#[test]
fn a_scene_moved_with_its_origin_has_the_same_bits() {
    let place = |[x, z]: [f64; 2]| {
        format!("Natural(velocity: (4.0, 1.0)), Fluid(cells: 32, gusts: [(from: Place(at: ({:?}, {:?}))), (from: North)])", x + 2.0, z)
    };
    let mut hashes = Vec::new();
    for ground in ["", "detail: (amplitude: 0.3, wavelength: 3.0, octaves: 4),"] {
        let (mut home, mut away) =
            (drive([0.0; 2], [0, 0], &place([0.0; 2]), ground), drive([SHIFT, -SHIFT], [8000, -8000], &place([SHIFT, -SHIFT]), ground));
        let mut other = drive([SHIFT + 0.25, -SHIFT], [8000, -8000], &place([SHIFT, -SHIFT]), ground);
        for step in 0..90 {
            home.step();
            away.step();
            other.step();
            assert_eq!(home.hash(), away.hash(), "step {step}");
        }
        assert!(!home.state.stands[0].awake.is_empty());
        assert!(home.state.fluids[0].now.iter().flatten().any(|speed| speed.abs() > 0.5), "the air flows");
        assert_ne!(home.hash(), other.hash(), "control: a scene moved by a cell more has other bits");
        hashes.push(home.hash());
    }
    assert_ne!(hashes[0], hashes[1], "control: detail changes what happens");
}

/// Without moving the origin, bodies move 128 km out in f64 and their footprints are rounded otherwise now and then: a unit is 1/1024 m.
#[test]
fn a_scene_far_from_its_origin_differs_by_rounding_only() {
    let (mut home, mut away) = (drive([0.0; 2], [0, 0], "", ""), drive([SHIFT, -SHIFT], [0, 0], "", ""));
    (0..90).for_each(|_| (home.step(), away.step()).0);
    let (mut worst, mut squares, mut count, mut bent) = (0.0_f64, 0.0, 0.0, 0);
    for j in -30..40 {
        for i in -40..50 {
            let at = [f64::from(i) * 0.25 + 0.125, f64::from(j) * 0.25 + 0.125];
            let here = home.bend_at(0, at).expect("a stand");
            let there = away.bend_at(0, [at[0] + SHIFT, at[1] - SHIFT]).expect("a stand");
            let off = f64::from((here[0] - there[0]).hypot(here[1] - there[1]));
            (worst, squares, count) = (worst.max(off), squares + off * off, count + 1.0);
            bent += u32::from(here[0].abs() + here[1].abs() > 0.1);
        }
    }
    let rms = (squares / count).sqrt();
    println!("128 km out: largest difference {worst:.1e} rad, rms {rms:.1e}, {bent} plants bent");
    assert!(worst < 1e-5 && rms < 1e-6 && bent > 300);
}
