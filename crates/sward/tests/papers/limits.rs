//! Grass and terrain (§4.3, §6): how far plants may bend on slopes, and joints stay above the ground.

use crate::common::{Dice, Torus};
use sward::geometry::billboard::{CLEARANCE, spine};
use sward::interaction::Hit;
use sward::response::continuum::{bend_limit, contact};
use sward::state::Ground;

#[test]
fn the_limit_is_upright_to_ground_along_the_bend() {
    let mut dice = Dice(11);
    for _ in 0..5000 {
        let slope = [dice.between(-3.0, 3.0), dice.between(-3.0, 3.0)];
        let bend = [dice.between(-1.5, 1.5), dice.between(-1.5, 1.5)];
        let size = bend[0].hypot(bend[1]);
        let along = (slope[0] * bend[0] + slope[1] * bend[1]) / size;
        let exact = (std::f64::consts::FRAC_PI_2 - along.atan()).clamp(0.05, std::f64::consts::FRAC_PI_2);
        let limit = bend_limit(slope.map(|v| v as f32), bend.map(|v| v as f32));
        assert!((f64::from(limit) - exact).abs() < 2e-6, "{slope:?} {bend:?}: {limit} for {exact}");
    }
    assert!((bend_limit([1.0, 0.0], [0.5, 0.0]) - std::f32::consts::FRAC_PI_4).abs() < 1e-6, "uphill");
    assert!((bend_limit([1.0, 0.0], [-0.5, 0.0]) - std::f32::consts::FRAC_PI_2).abs() < 1e-6, "downhill as far as level");
    assert_eq!(bend_limit([100.0, 0.0], [0.5, 0.0]), 0.05, "a cliff leaves a little");
}

#[test]
fn bodies_and_waves_respect_the_limit_on_a_slope() {
    let mut torus = Torus::new("field: (patch_side: 8.0), stands: [(species: Meadow, cells: 16)]");
    let slope = [0.8_f32, -0.3];
    let area = 256;
    let values = (0..3 * area).map(|at| [slope[0], slope[1], 0.0][at / area]).collect();
    torus.cells.ground[0] = Ground { values, steepest: (0.64_f32 + 0.09).sqrt(), level: 0.0, grown: Box::default() };
    torus.fill(|level, plane, _, _| if plane == 0 { [0.6, 0.2][level] } else { 0.0 });
    let (mut clamped, mut closest) = (0, f32::MAX);
    for _ in 0..30 {
        clamped += torus.step().clamped;
        for (x, z) in torus.plane(0).iter().zip(torus.plane(1)) {
            let room = bend_limit(slope, [*x, *z]) - (x * x + z * z).sqrt();
            closest = closest.min(room);
            assert!(room > -1e-6, "{x} {z}");
        }
    }
    assert!(clamped > 0 && closest.abs() < 1e-6, "control: the limit is met, {clamped}, {closest}");
    for direction in [[1.0_f32, 0.0], [-1.0, 0.0], [0.6, 0.8]] {
        let hit = Hit { speed: 30.0, direction, along: 30.0, height: 0.1, normal: direction, depth: 1.0 };
        let mut bend = [0.0; 2];
        (0..30).for_each(|_| bend = contact(&torus.stand.coefficients, bend, slope, &[hit]).expect("touched").bend);
        let (size, limit) = ((bend[0] * bend[0] + bend[1] * bend[1]).sqrt(), bend_limit(slope, direction));
        assert!(size <= limit + 1e-6 && size > limit - 0.02, "{direction:?}: {size} for {limit}");
    }
}

#[test]
fn joints_never_lie_below_the_ground() {
    let (mut dice, mut lifted) = (Dice(5), 0);
    for _ in 0..5000 {
        let slope = [dice.between(-2.0, 2.0) as f32, dice.between(-2.0, 2.0) as f32];
        let ground = |x: f32, z: f32| 3.0 + slope[0] * x + slope[1] * z;
        let bends: Vec<[f32; 2]> =
            (0..1 + (dice.unit() * 8.0) as usize).map(|_| [dice.between(-1.1, 1.1) as f32, dice.between(-1.1, 1.1) as f32]).collect();
        let (height, root) = (dice.between(0.03, 1.5) as f32, [0.3, ground(0.3, 0.2), 0.2]);
        let joints = spine(root, height, &bends, ground);
        assert_eq!(joints.len(), bends.len() + 1);
        for joint in &joints[1..] {
            let above = joint[1] - ground(joint[0], joint[2]);
            assert!(above > CLEARANCE - 1e-6, "{above}");
            lifted += u32::from(above < CLEARANCE + 1e-6);
        }
    }
    assert!(lifted > 100, "control: some joints had to be lifted, {lifted}");
}
