//! Blades without a state against the same blades with one: the virtually-inertial model.

use super::{STEP, coefficients, distance, gusty, settled, species, spread, tip};
use sward::math::{hash, unit};
use sward::response::chain::{Bends, ChainCoefficients, ChainState, Frame, FullChain, UPRIGHT, moments, planted, pose, step, turned};

/// Bases of blades planted any way round, leaning by up to `most` \[rad\].
fn bases(count: u32, most: f32) -> Vec<Frame> {
    let random = |i, purpose| unit(hash(7, 0, 0, i, purpose));
    (0..count).map(|i| planted(random(i, 1) * std::f32::consts::TAU, random(i, 2) * most)).collect()
}

/// What a blade in `base` shows of a virtual one.
fn shown(co: &ChainCoefficients, base: &Frame, virtual_blade: &ChainState, turn: bool) -> ChainState {
    let held: Bends = moments(co, &UPRIGHT, &virtual_blade.bends());
    let held = if turn { held.map(|m| turned(base, &UPRIGHT, m)) } else { held };
    ChainState::still(&pose(co, base, 0.0, &held))
}

#[test]
fn a_planted_blade_is_where_its_own_chain_would_be() {
    let wind = gusty(62);
    for (name, blade) in species() {
        let co = coefficients(&blade);
        let bases = bases(24, 0.3);
        // Each stands where its own weight holds it, as it would have grown.
        let mut own: Vec<ChainState> = bases.iter().map(|base| settled(&co, base, [0.0; 3], STEP as f32, 600)).collect();
        let mut virtual_blade = ChainState::default();
        let (mut right, mut raw) = (Vec::new(), Vec::new());
        for (i, w) in wind.iter().enumerate() {
            virtual_blade = step(&co, &UPRIGHT, 0.0, *w, STEP as f32, &virtual_blade);
            for (base, state) in bases.iter().zip(&mut own) {
                *state = step(&co, base, 0.0, *w, STEP as f32, state);
                if i >= 120 && i % 6 == 0 {
                    let exact = tip(&co, base, state);
                    right.push(distance(tip(&co, base, &shown(&co, base, &virtual_blade, true)), exact) / blade.length());
                    raw.push(distance(tip(&co, base, &shown(&co, base, &virtual_blade, false)), exact) / blade.length());
                }
            }
        }
        let ((rms, p95), (wrong, _)) = (spread(right), spread(raw));
        println!(
            "{name}: tip off by rms {:.2} %, p95 {:.2} % of the length; moments not turned rms {:.1} %",
            rms * 100.0,
            p95 * 100.0,
            wrong * 100.0
        );
        assert!(rms < 0.05, "{name}: {rms}");
        assert!(wrong > 0.05 && wrong > 3.0 * rms, "{name}: moments not turned must be far worse: {wrong}");
    }
}

#[test]
fn planted_blades_of_both_models_stay_near_the_full_chain() {
    let wind = gusty(22);
    for (name, blade) in species() {
        let co = coefficients(&blade);
        let (mut simplified, mut shown_off) = (Vec::new(), Vec::new());
        for base in bases(3, 0.3) {
            let mut full = FullChain::new(&blade, &base).unwrap();
            let (mut own, mut virtual_blade) = (ChainState::default(), ChainState::default());
            for (i, w) in wind.iter().enumerate() {
                full.step(w.map(f64::from), STEP);
                own = step(&co, &base, 0.0, *w, STEP as f32, &own);
                virtual_blade = step(&co, &UPRIGHT, 0.0, *w, STEP as f32, &virtual_blade);
                if i >= 120 {
                    let exact = full.joints()[blade.segments as usize];
                    simplified.push(distance(tip(&co, &base, &own), exact) / blade.length());
                    shown_off.push(distance(tip(&co, &base, &shown(&co, &base, &virtual_blade, true)), exact) / blade.length());
                }
            }
        }
        let ((a, a95), (b, b95)) = (spread(simplified), spread(shown_off));
        println!(
            "{name}: planted blades, simplified rms {:.2} p95 {:.2} %, virtual rms {:.2} p95 {:.2} %",
            a * 1e2,
            a95 * 1e2,
            b * 1e2,
            b95 * 1e2
        );
        assert!(a < 0.08 && b < 0.08, "{name}: {a} {b}");
    }
}

#[test]
fn the_virtual_blade_itself_is_shown_as_it_is() {
    for (name, blade) in species() {
        let co = coefficients(&blade);
        let state = settled(&co, &UPRIGHT, [5.0, 0.0, 2.0], STEP as f32, 300);
        let exact = tip(&co, &UPRIGHT, &state);
        let off = distance(tip(&co, &UPRIGHT, &shown(&co, &UPRIGHT, &state, true)), exact) / blade.length();
        println!("{name}: three turns leave {off:.1e} of the length");
        assert!(off < 2e-3, "{name}: {off:.1e}");
        let elsewhere = settled(&co, &UPRIGHT, [5.0, 0.0, 2.2], STEP as f32, 300);
        assert!(distance(tip(&co, &UPRIGHT, &elsewhere), exact) / blade.length() > 2e-3, "{name}: another wind must show");
    }
}
