//! One wind patch tiled over sleeping ones (§4.2, §7): `budget: (beyond: Tiled)`.

use crate::common::world;

fn settled(beyond: &str) -> sward::world::World {
    let mut world = world(&format!(
        "field: (patch_side: 16.0), stands: [(species: Meadow, cells: 64)], wind: [Natural(velocity: (5.0, 2.0), turbulence: 0.4)],
         budget: (patches: 16, focus_distance: 20.0, beyond: {beyond})"
    ));
    (0..120).for_each(|_| world.step());
    world
}

#[test]
fn a_tiled_wind_repeats_with_the_patch_and_has_no_seam() {
    let (tiled, direct) = (settled("Tiled"), settled("Direct"));
    let at = |world: &sward::world::World, x: f64, z: f64| world.bend_at(0, [x, z]).expect("a stand");
    let (mut repeats, mut differs, mut seam, mut inside) = (true, 0, 0.0_f32, 0.0_f32);
    for k in 0..64 {
        let z = 400.0 + 0.25 * f64::from(k) + 0.1;
        repeats &= at(&tiled, 500.3, z) == at(&tiled, 516.3, z) && at(&tiled, 500.3, z) == at(&tiled, 500.3, z + 32.0);
        differs += i32::from(at(&direct, 500.3, z) != at(&direct, 516.3, z));
        let step = |x: f64| {
            let (a, b) = (at(&tiled, x, z), at(&tiled, x + 0.25, z));
            (a[0] - b[0]).hypot(a[1] - b[1])
        };
        (seam, inside) = (seam.max(step(511.9)), inside.max(step(505.1)));
    }
    assert!(repeats, "sleeping patches show the same patch");
    assert!(differs > 32, "control: without the option every place has its own wind");
    assert!(seam < 3.0 * inside + 0.01, "a seam of {seam} rad against {inside} inside");
    assert_eq!(tiled.state.stands[0].awake.len(), direct.state.stands[0].awake.len() + 1, "it costs one patch");
}
