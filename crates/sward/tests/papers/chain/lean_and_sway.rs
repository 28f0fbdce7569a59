//! The simplified chain against the full one: lean, frequency, a gusty minute (methods §7).

use super::{STEP, as_printed, blade, coefficients, distance, gusty, settled, species, spread, tip};
use sward::response::chain::{Blade, ChainCoefficients, ChainState, DragLaw, FullChain, UPRIGHT, first_mode, joints, step};

/// Tip of the full chain at rest in wind along x, m.
fn full_lean(blade: &Blade, wind: f64) -> f64 {
    let mut chain = FullChain::new(blade, &UPRIGHT).unwrap();
    for _ in 0..60 * 10 {
        chain.step([wind, 0.0, 0.0], STEP);
    }
    chain.joints()[blade.segments as usize][0]
}

fn lean(co: &ChainCoefficients, wind: f32) -> f64 {
    tip(co, &UPRIGHT, &settled(co, &UPRIGHT, [wind, 0.0, 0.0], STEP as f32, 600))[0]
}

#[test]
fn it_leans_as_the_full_chain() {
    for (name, blade) in species() {
        for wind in [2.0, 4.0] {
            let full = full_lean(&blade, f64::from(wind));
            let found = lean(&coefficients(&blade), wind) / full - 1.0;
            let printed = lean(&as_printed(&blade), wind) / full - 1.0;
            println!(
                "{name}: leans {:.2} cm in {wind} m/s, simplified {:+.1} %, as printed {:+.0} %",
                full * 100.0,
                found * 100.0,
                printed * 100.0
            );
            assert!(found.abs() < 0.10, "{name}: {found}");
            assert!(printed.abs() > 0.10, "{name}: the chain as printed must fail: {printed}");
        }
    }
}

#[test]
fn drag_follows_its_power() {
    let laws = [(DragLaw::Linear, 1.0), (DragLaw::FourThirds, 4.0 / 3.0), (DragLaw::FiveThirds, 5.0 / 3.0), (DragLaw::Square, 2.0)];
    for (law, power) in laws {
        // So stiff that the blade hardly leans: then the lean is l f/k.
        let blade = Blade { law, ..blade(1, 0.1, 1e-6, [10.0, 10.0], 1.0, 1e-2) };
        let expected = |power: f64| 0.2 * 0.1 * 1e-2 * 3f64.powf(power) / 10.0;
        for found in [lean(&coefficients(&blade), 3.0), full_lean(&blade, 3.0)] {
            assert!((found / expected(power) - 1.0).abs() < 1e-3, "{law:?}: {found:.3e}, not {:.3e}", expected(power));
            assert!((found / expected(power + 0.1) - 1.0).abs() > 1e-2, "{law:?}: another power must fail");
        }
    }
}

/// Frequency of the tip after a release from a small bend, Hz.
fn sway(co: &ChainCoefficients, shape: &[f64], dt: f64) -> f64 {
    let mut state = ChainState::default();
    let mut below = 0.0;
    for (joint, tilt) in state.joints.iter_mut().zip(&shape[..co.segments as usize]) {
        joint[1] = (0.05 * (tilt - below)) as f32;
        below = *tilt;
    }
    let (mut passes, mut last) = (Vec::new(), tip(co, &UPRIGHT, &state)[0]);
    for i in 1..60_000 {
        state = step(co, &UPRIGHT, 0.0, [0.0; 3], dt as f32, &state);
        let now = tip(co, &UPRIGHT, &state)[0];
        if last * now < 0.0 {
            passes.push((f64::from(i) - now / (now - last)) * dt);
        }
        last = now;
        if passes.len() == 5 {
            return 2.0 / (passes[4] - passes[0]);
        }
    }
    0.0
}

#[test]
fn it_sways_at_the_full_chains_frequency() {
    for (name, mut blade) in species() {
        blade.drag = 0.0;
        blade.damping_ratio = 0.02;
        let mode = first_mode(&blade).unwrap();
        for dt in [STEP, 1.0 / 240.0] {
            let found = sway(&coefficients(&blade), &mode.shape, dt) / mode.frequency - 1.0;
            let printed = sway(&as_printed(&blade), &mode.shape, dt) / mode.frequency - 1.0;
            println!("{name}: {:.2} Hz, simplified {:+.1} %, as printed {:+.0} %", mode.frequency, found * 100.0, printed * 100.0);
            assert!(found.abs() < 0.10, "{name}: {found}");
            assert!(printed.abs() > 0.10, "{name}: the chain as printed must fail: {printed}");
        }
    }
}

/// Largest tilt of a segment while a gust of 20 m/s lays the still blade down, rad: of the full chain and of a simplified one.
fn laid_down(blade: &Blade, co: &ChainCoefficients) -> [f64; 2] {
    let n = blade.segments as usize;
    let mut full = FullChain::new(blade, &UPRIGHT).unwrap();
    let mut state = ChainState::default();
    let mut worst = [0.0f64; 2];
    for _ in 0..60 {
        full.step([20.0, 0.0, 0.0], STEP);
        state = step(co, &UPRIGHT, 0.0, [20.0, 0.0, 0.0], STEP as f32, &state);
        let mut tilt = 0.0;
        for i in 0..n {
            tilt += f64::from(state.joints[i][1]);
            worst = [worst[0].max(full.directions[i][0].atan2(full.directions[i][1])), worst[1].max(tilt)];
        }
    }
    worst
}

#[test]
fn a_sudden_gust_lays_it_down_as_the_full_chain() {
    for (name, blade) in species() {
        let [full, found] = laid_down(&blade, &coefficients(&blade));
        let [_, printed] = laid_down(&blade, &as_printed(&blade));
        println!("{name}: laid down to {full:.2} rad, simplified {found:.2}, as printed {printed:.2}");
        assert!((found / full - 1.0).abs() < 0.20, "{name}: {found}, full {full}");
        assert!((printed / full - 1.0).abs() > 0.20, "{name}: the chain as printed must fail: {printed}");
    }
}

/// Tips of the full chain through a wind.
fn full_tips(blade: &Blade, wind: &[[f32; 3]]) -> Vec<[f64; 3]> {
    let mut chain = FullChain::new(blade, &UPRIGHT).unwrap();
    let next = |w: &[f32; 3]| {
        chain.step(w.map(f64::from), STEP);
        chain.joints()[blade.segments as usize]
    };
    wind.iter().map(next).collect()
}

/// Distances of the simplified chain's tip from those, in lengths; the first two seconds, which depend on the start, left out.
fn errors(co: &ChainCoefficients, blade: &Blade, wind: &[[f32; 3]], tips: &[[f64; 3]]) -> Vec<f64> {
    let mut state = ChainState::default();
    let next = |(w, full): (&[f32; 3], &[f64; 3])| {
        state = step(co, &UPRIGHT, 0.0, *w, STEP as f32, &state);
        distance(tip(co, &UPRIGHT, &state), *full) / blade.length()
    };
    wind.iter().zip(tips).map(next).skip(120).collect()
}

#[test]
fn a_gusty_minute_goes_as_for_the_full_chain() {
    let wind = gusty(62);
    for (name, blade) in species() {
        let tips = full_tips(&blade, &wind);
        let (rms, p95) = spread(errors(&coefficients(&blade), &blade, &wind, &tips));
        let (printed, _) = spread(errors(&as_printed(&blade), &blade, &wind, &tips));
        let mut own_drag = coefficients(&blade);
        for joint in &mut own_drag.joints {
            joint.reach = 1.0;
        }
        let (own, _) = spread(errors(&own_drag, &blade, &wind, &tips));
        println!(
            "{name}: tip off by rms {:.2} %, p95 {:.2} % of the length; braked by its own drag only {:.2} %; as printed {:.1} %",
            rms * 100.0,
            p95 * 100.0,
            own * 100.0,
            printed * 100.0
        );
        assert!(rms < 0.08, "{name}: {rms}");
        assert!(printed > 0.08, "{name}: the chain as printed must fail: {printed}");
        assert!(name != "reed" || own > 1.5 * rms, "{name}: what is above must brake too: {own}");
    }
}

#[test]
fn segments_keep_their_length() {
    let wind = gusty(10);
    for (name, blade) in species() {
        let co = coefficients(&blade);
        let mut state = ChainState::default();
        let total = |places: &[[f32; 3]; 9]| -> f64 { places.windows(2).map(|w| distance(w[0].map(f64::from), w[1].map(f64::from))).sum() };
        for w in &wind {
            state = step(&co, &UPRIGHT, 0.0, w.map(|x| 4.0 * x), STEP as f32, &state);
            let off = total(&joints(&UPRIGHT, 0.7, &co, &state.bends())) / blade.length() - 1.0;
            assert!(off.abs() < 1e-5, "{name}: {off:.1e}");
        }
        let mut longer = co;
        longer.half_length *= 1.0001;
        assert!((total(&joints(&UPRIGHT, 0.7, &longer, &state.bends())) / blade.length() - 1.0).abs() > 1e-5);
    }
}
