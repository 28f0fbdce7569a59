//! What a body feels of a blade does as much work as the blade takes up: the measure of reactions on the full chain.

use super::{coefficients, species};
use sward::response::chain::pressed::{Pressed, felt};
use sward::response::chain::{Bends, Blade, ChainCoefficients, FullChain, UPRIGHT, bend_towards, product, rotation, to_local};
use sward::scene::Species;
use sward::state::Root;

/// The bends of a full chain on an upright root.
fn bends_of(chain: &FullChain, segments: usize) -> Bends {
    let (mut frame, mut bends) = (UPRIGHT, Bends::default());
    for i in 0..segments {
        bends[i] = bend_towards(to_local(&frame, chain.directions[i].map(|part| part as f32)));
        frame = product(&frame, &rotation(bends[i]));
    }
    bends
}

/// A board comes along x, `pace` lengths a second, and pushes the end of one segment, as hard as it is deep in it, until that is half its height away. Returns its work, the energy the blade has taken up, and the work of what
/// [`felt`] says it feels, J.
fn pushed(blade: &Blade, co: &ChainCoefficients, (segment, joint): (usize, usize), pace: f64) -> [f64; 3] {
    let n = blade.segments as usize;
    let mut chain = FullChain::new(blade, &UPRIGHT).unwrap();
    let (rest, dt, length) = (chain.energy(), 2e-6 / pace.max(0.1) + 3e-5, blade.length());
    let root = Root { length: length as f32, ..Root::default() };
    let (mut board, speed) = (0.0, pace * length);
    // A thousand times as stiff as the blade there.
    let hard = 1e3 * blade.stiffness(0) / (length * length);
    let (mut work, mut by_measure) = (0.0, 0.0);
    let mut before = Bends::default();
    while board < 0.5 * length * (segment + 1) as f64 / n as f64 {
        board += speed * dt;
        let at = chain.joints()[segment + 1];
        let force = (hard * (board - at[0])).max(0.0);
        chain.loads[segment] = [force, 0.0, 0.0];
        chain.step([0.0; 3], dt);
        work += force * speed * dt;
        if force > 0.0 {
            let below = chain.joints()[joint];
            let arm = [0, 1, 2].map(|axis| (at[axis] - below[axis]) as f32);
            let pressed = Pressed { solid: 0, joint: joint as u32, arm, normal: [1.0, 0.0, 0.0] };
            let bends = bends_of(&chain, n);
            by_measure -= f64::from(felt(co, &root, &UPRIGHT, &pressed, &before, &bends, [0.0; 3]).force[0]) * speed * dt;
            before = bends;
        }
    }
    [work, chain.energy() - rest, by_measure]
}

#[test]
fn a_body_works_as_much_as_a_blade_takes_up() {
    for (name, mut blade) in species() {
        blade.drag = 0.0;
        let n = blade.segments as usize;
        for segment in [n - 1, n / 2] {
            let [work, energy, by_measure] = pushed(&blade, &coefficients(&blade), (segment, segment), 0.1);
            let off = [energy, work].map(|of| by_measure / of - 1.0);
            println!(
                "{name}, end of segment {segment}: {by_measure:.3e} J, of its energy {:+.1} %, of the work {:+.1} %",
                1e2 * off[0],
                1e2 * off[1]
            );
            assert!(off.iter().all(|off| off.abs() < 0.05), "{name}: {off:?}");
        }
    }
}

#[test]
fn springs_of_the_simplified_chain_would_work_too_little() {
    let blade = Blade { drag: 0.0, ..Blade::of(&Species::Reed) };
    let mut co = coefficients(&blade);
    let above = |joint: usize| (blade.segments as usize - joint) as f32;
    (0..blade.segments as usize).for_each(|joint| co.joints[joint].stiffness /= above(joint) * above(joint));
    let [_, energy, by_measure] = pushed(&blade, &co, (3, 3), 0.1);
    assert!((by_measure / energy - 1.0).abs() > 0.05, "control: {by_measure} J of {energy} J");
}

/// The measure is of springs and weight: what a fast body gives the blade as motion it does not feel.
#[test]
fn how_much_of_a_blow_is_felt() {
    for (name, mut blade) in species() {
        blade.drag = 0.0;
        let tip = blade.segments as usize - 1;
        for pace in [1.0, 4.0] {
            let [work, _, by_measure] = pushed(&blade, &coefficients(&blade), (tip, tip), pace);
            println!("{name}, {:.2} m/s: {:+.0} % of the work", pace * blade.length(), 1e2 * (by_measure / work - 1.0));
            assert!(by_measure > 0.0 && by_measure < 1.5 * work, "{name}: {by_measure} of {work}");
        }
    }
}
