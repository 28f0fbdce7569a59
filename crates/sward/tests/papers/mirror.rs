//! A straight pass over flat ground: left and right mirror each other, bit for bit.

use crate::common::world;
use sward::world::World;

/// A body that drives along +x, `off` metres beside the middle line, seen after half a second.
fn pass(shape: &str, off: f64) -> World {
    let mut world = world(&format!(
        "field: (patch_side: 8.0), stands: [(species: Meadow, cells: 32)], interactors: [(shape: {shape}, clearance: 0.05,
         path: Keyframes(keys: [(time: 0.0, at: (-6.0, {off:?})), (time: 1.0, at: (7.0, {off:?}))]))]"
    ));
    (0..50).for_each(|_| world.step());
    world
}

/// Plants of one side and how many of them differ from their mirror image in any bit.
fn differing(world: &World) -> (usize, usize) {
    let (mut bent, mut different) = (0, 0);
    for j in 0..24 {
        for i in -40..48 {
            let place = [f64::from(i) * 0.25 + 0.125, f64::from(j) * 0.25 + 0.125];
            let [left, right] = [[place[0], place[1]], [place[0], -place[1]]].map(|at| world.bend_at(0, at).expect("a stand"));
            bent += usize::from(left[0].abs() + left[1].abs() > 0.01);
            different += usize::from(left[0] != right[0] || left[1] != -right[1]);
        }
    }
    (bent, different)
}

#[test]
fn left_and_right_of_a_straight_pass_mirror_each_other_bit_for_bit() {
    for shape in ["Truck", "Box(size: (1.7, 1.0, 3.0))", "Polygon(points: [(-0.6, -0.6), (0.6, -0.6), (0.0, 0.9)])"] {
        let (bent, different) = differing(&pass(shape, 0.0));
        println!("{shape}: {bent} plants bent, {different} differ");
        assert!(bent > 200 && different == 0, "{shape}: {different} of {bent}");
        assert!(differing(&pass(shape, 0.06)).1 > 50, "control: beside the middle line it must not");
    }
}
