//! Air that flows on a plane: its transform, its divergence, its bodies, and that it never ends in numbers that are none.

#[path = "../common/mod.rs"]
mod common;
mod scenes;

use common::Dice;
use sward::wind::fluid::{Drag, Fft, Fluid, FluidModel, Gust, Real, Spectrum, divergence};

/// A field of chance velocities of some m/s.
fn noise<T: Real>(side: usize, seed: u64) -> Vec<[T; 2]> {
    let mut dice = Dice(seed);
    (0..side * side).map(|_| [0, 1].map(|_| T::of(dice.between(-5.0, 5.0)))).collect()
}

#[test]
fn a_row_is_what_its_definition_says() {
    for length in [2, 8, 64, 512] {
        let mut dice = Dice(length as u64);
        let row: Vec<[f64; 2]> = (0..length).map(|_| [dice.between(-1.0, 1.0), dice.between(-1.0, 1.0)]).collect();
        let (mut there, mut room) = (row.clone(), row.clone());
        let fft = Fft::new(length);
        fft.row(&mut there, &mut room, false);
        for (k, found) in there.iter().enumerate() {
            let mut sum = [0.0; 2];
            for (j, [re, im]) in row.iter().enumerate() {
                let (sine, cosine) = (-std::f64::consts::TAU * ((j * k) % length) as f64 / length as f64).sin_cos();
                sum = [sum[0] + re * cosine - im * sine, sum[1] + re * sine + im * cosine];
            }
            assert!((0..2).all(|part| (found[part] - sum[part]).abs() < 1e-11), "{length}, {k}: {found:?} {sum:?}");
        }
        fft.row(&mut there, &mut room, true);
        assert!(there.iter().zip(&row).all(|(a, b)| (0..2).all(|part| (a[part] - b[part]).abs() < 1e-13)), "{length}: back");
    }
}

/// Divergence before and after.
fn projected<T: Real>(side: usize) -> [f64; 2] {
    let (cell, mut flow) = (0.25, noise::<T>(side, 7));
    let before = divergence(&flow, side, cell);
    Spectrum::new(side, cell, 0.0, 1.0 / 60.0).project(&mut flow, false);
    [before, divergence(&flow, side, cell)]
}

#[test]
fn what_is_left_of_divergence_is_rounding() {
    for side in [16, 64, 512] {
        let ([before, single], [_, double]) = (projected::<f32>(side), projected::<f64>(side));
        println!("{side} × {side}: {:.1e} of the divergence in f32, {:.1e} in f64", single / before, double / before);
        assert!(before > 1.0 && single <= 1e-5 * before && double <= 1e-10 * before, "{before} {single} {double}");
    }
}

#[test]
fn what_has_no_divergence_stays() {
    // A shear flow, and a mean wind.
    let side = 32;
    let shear: Vec<[f64; 2]> =
        (0..side * side).map(|k| [2.0 + (std::f64::consts::TAU * (k / side) as f64 / side as f64).sin(), 0.5]).collect();
    let mut flow = shear.clone();
    Spectrum::new(side, 0.5, 0.0, 0.02).project(&mut flow, true);
    assert!(flow.iter().zip(&shear).all(|(a, b)| (0..2).all(|part| (a[part] - b[part]).abs() < 1e-13)));
    // Spreading wears the shear off as the equation says, and not the mean.
    let (viscosity, dt, wave) = (0.3, 0.02, std::f64::consts::TAU / (side as f64 * 0.5));
    let mut flow = shear.clone();
    Spectrum::new(side, 0.5, viscosity, dt).project(&mut flow, true);
    let left = (-viscosity * wave * wave * dt).exp();
    assert!(
        left < 0.9999
            && flow.iter().zip(&shear).all(|(a, b)| (a[0] - 2.0 - left * (b[0] - 2.0)).abs() < 1e-13 && (a[1] - 0.5).abs() < 1e-13)
    );
}

#[test]
fn a_body_drags_a_wake() {
    let model = FluidModel::<f32>::new(64, 0.5, 1e-3, 1.5, 1.0 / 60.0);
    let mut air = Fluid::new(&model);
    for step in 0..90 {
        let x = 4.0 + 8.0 * step as f32 / 60.0;
        air.step(
            &model,
            &[],
            &[Drag { at: [x, 16.0], half: [2.0, 1.2], velocity: [8.0, 0.0], turn: [1.0, 0.0], leaves: 0.1, unused: [0.0; 3] }],
        );
    }
    let at = |x: f32, y: f32| air.flow[(y / 0.5) as usize * 64 + (x / 0.5) as usize];
    let (inside, behind, aside) = (at(15.9, 16.0)[0], at(11.5, 16.0)[0], at(15.9, 20.0)[0]);
    println!("in it {inside:.2} m/s, behind {behind:.2}, beside {aside:.2}");
    assert!(inside > 6.0 && behind > 1.0 && aside < 0.0, "air follows it, and comes back beside it");
}

#[test]
fn it_never_blows_up() {
    let mut dice = Dice(3);
    for (side, cell) in [(16, 0.05), (64, 0.3), (128, 4.0)] {
        let model = FluidModel::<f32>::new(side, cell, 0.0, 1e9, 1.0 / 30.0);
        let mut air = Fluid::new(&model);
        for _ in 0..200 {
            let mut chance = |low: f64, high: f64| dice.between(low, high) as f32;
            let gust = Gust {
                at: [chance(-9.0, 99.0), chance(-9.0, 99.0)],
                radius: chance(0.01, 9.0),
                change: [chance(-50.0, 50.0), chance(-50.0, 50.0)],
                unused: [0.0; 3],
            };
            air.step(&model, &[gust], &[]);
        }
        let most = air.flow.iter().flatten().fold(0.0f32, |most, part| most.max(part.abs()));
        println!("{side} × {side}: {most:.1} m/s at most");
        assert!(air.flow.iter().flatten().all(|part| part.is_finite()) && most < 4000.0);
    }
}

/// Air that nothing pushes slows as asked, whatever it does.
#[test]
fn it_calms() {
    let model = FluidModel::<f32>::new(64, 0.5, 0.0, 1.5, 1.0 / 60.0);
    let mut air = Fluid::new(&model);
    air.flow.fill([3.0, -1.0]);
    (0..90).for_each(|_| air.step(&model, &[], &[]));
    let left = air.flow[77][0] / 3.0;
    assert!((left - (-1.0f32).exp()).abs() < 1e-3, "{left}");
}
