//! Recovery: monotone, with exact lengths, the same at every frame rate.

use glam::Vec3;
use sward::math::{hash, unit};
use sward::response::springs::{CLEAR, HeldSheet, Maps, Sheet, SheetRoot, SpringsCoefficients, Wave, pass, pose, step, sway};

use crate::Test;
use crate::field::{coefficients, root};

pub(crate) const TESTS: &[Test] = &[
    ("recovery_is_monotone_and_keeps_lengths", recovery_is_monotone_and_keeps_lengths),
    ("recovery_does_not_depend_on_the_frame_rate", recovery_does_not_depend_on_the_frame_rate),
    ("a_sheet_in_the_wind_keeps_its_lengths", a_sheet_in_the_wind_keeps_its_lengths),
];

/// A sheet left in some heap.
fn heap(co: &SpringsCoefficients, root: &SheetRoot, seed: u32) -> Sheet {
    let random = |vertex: u32, purpose| unit(hash(seed, 0, 0, vertex, purpose)) * 2.0 - 1.0;
    let mut sheet = pose(co, root, [[0.0; 2]; 2]);
    for (vertex, at) in sheet.at.iter_mut().enumerate().take(co.sides().0 * co.sides().1).skip(co.sides().0) {
        *at = [0, 1, 2].map(|axis| at[axis] + 0.3 * random(vertex as u32, axis as u32));
    }
    pass(co, root, &mut sheet);
    sheet
}

/// The sheets of a recovery, `rate` a second, until it is done.
fn recovery(rate: f32, seed: u32, cubic: u32) -> (SpringsCoefficients, SheetRoot, Vec<Sheet>) {
    let mut co = SpringsCoefficients::new([3, 4], 2, 1.0, 2.5, 1.0 / rate);
    co.cubic = cubic;
    let root = root(0.3, 0.2, 0.7, 0.4);
    let target = pose(&co, &root, [[0.1, 0.05], [0.12, 0.0]]);
    let mut held = HeldSheet::new(&target);
    held.stored = heap(&co, &root, seed);
    let count = (2.6 * rate) as u32;
    let sheets = (0..count).map(|_| {
        step(&co, &root, &Maps::NONE, &target, [0.0, 1.0], &mut held);
        held.shown(&co, &root, &target)
    });
    let mut all = vec![heap(&co, &root, seed)];
    all.extend(sheets);
    all.push(target);
    (co, root, all)
}

fn angle(a: &Sheet, b: &Sheet, columns: usize, vertex: usize) -> f32 {
    let way = |sheet: &Sheet| (Vec3::from(sheet.at[vertex + columns]) - Vec3::from(sheet.at[vertex])).normalize();
    way(a).cross(way(b)).length().atan2(way(a).dot(way(b)))
}

fn recovery_is_monotone_and_keeps_lengths() {
    let (mut stretch, mut back, mut lowest, mut shortest) = (0.0f32, 0.0f32, 1.0f32, 1.0f32);
    for (seed, cubic) in (0..40).flat_map(|seed| [(seed, 0), (seed, 1)]) {
        let (co, root, sheets) = recovery(60.0, seed, cubic);
        let (columns, rows) = co.sides();
        let (first, target) = (&sheets[0], &sheets[sheets.len() - 1]);
        for pair in sheets.windows(2) {
            stretch = stretch.max(pair[1].stretch(&co, &root));
            for vertex in 0..columns * (rows - 1) {
                back = back.max(angle(&pair[1], target, columns, vertex) - angle(&pair[0], target, columns, vertex));
                lowest = lowest.min(root.height(pair[1].at[vertex + columns]));
            }
        }
        // Control: positions blended as the paper does.
        for vertex in 0..columns * (rows - 1) {
            let middle = |k: usize| 0.5 * (Vec3::from(first.at[k]) + Vec3::from(target.at[k]));
            shortest = shortest.min(middle(vertex).distance(middle(vertex + columns)) / root.segment(&co));
        }
        let end = sheets[sheets.len() - 2];
        let off = (0..columns * (rows - 1)).map(|vertex| angle(&end, target, columns, vertex)).fold(0.0, f32::max);
        assert!(off < 1e-3, "it must have recovered: {off}");
    }
    println!(
        "lengths {stretch:.0e}, back by {back:.0e} rad at most, lowest {:.2} mm; blended positions shorten a segment to {:.0} %",
        lowest * 1e3,
        shortest * 100.0
    );
    assert!(stretch < 1e-3 && back < 2e-3 && lowest > 0.9 * CLEAR);
    assert!(shortest < 0.9, "blended positions must shorten: {shortest}");
}

fn recovery_does_not_depend_on_the_frame_rate() {
    let (_, _, slow) = recovery(30.0, 3, 0);
    let mut most = 0.0f32;
    let compare = |fast: &[Sheet], rate: f32| {
        let mut most = 0.0f32;
        for tenth in 1..=24 {
            let at = |rate: f32| (tenth as f32 / 10.0 * rate).round() as usize;
            // At 144 Hz tenths of a second lie between steps: the nearest one, and what it moves in half a step.
            for (a, b) in slow[at(30.0)].at.iter().zip(&fast[at(rate)].at) {
                most = most.max(Vec3::from(*a).distance(Vec3::from(*b)));
            }
        }
        most
    };
    for (rate, allowed) in [(60.0, 1e-5), (120.0, 1e-5), (144.0, 2e-3), (1440.0, 1e-4)] {
        let apart = compare(&recovery(rate, 3, 0).2, rate);
        println!("{rate} Hz against 30 Hz: {:.4} mm apart", apart * 1e3);
        assert!(apart < allowed, "{rate}: {apart}");
        most = most.max(apart);
    }
    let cubic = compare(&recovery(60.0, 3, 1).2, 60.0);
    assert!(cubic > 0.01, "another law must show: {cubic}");
}

fn a_sheet_in_the_wind_keeps_its_lengths() {
    let co = coefficients(5, 5);
    let root = SheetRoot { slope: [0.3, -0.2], lean: [0.1, 0.2], ..root(1.0, 2.0, 0.3, 1.2) };
    let mut waves =
        [Wave { bend: [0.3, 0.1], turns: [0.2, 0.05], phase: 0 }, Wave { bend: [-0.1, 0.2], turns: [0.0, 0.7], phase: 1 << 30 }];
    let (mut stretch, mut lowest, mut moved) = (0.0f32, 1.0f32, 0.0f32);
    let mut before = None;
    for _ in 0..600 {
        waves[0].phase = waves[0].phase.wrapping_add(1 << 25);
        waves[1].phase = waves[1].phase.wrapping_add(3 << 24);
        let bends = [0, 4].map(|column| root.foot(&co, column)).map(|foot| sway(&waves, [foot[0], foot[2]]));
        let sheet = pose(&co, &root, bends.map(|bend| bend.map(|part| 3.0 * part)));
        stretch = stretch.max(sheet.stretch(&co, &root));
        for at in &sheet.at[5..25] {
            lowest = lowest.min(root.height(*at));
        }
        let tip = Vec3::from(sheet.at[22]);
        moved = before.replace(tip).map_or(moved, |was| moved.max(tip.distance(was)));
    }
    println!("in wind: lengths {stretch:.0e}, lowest {:.1} mm, a tip moves {:.1} mm a step at most", lowest * 1e3, moved * 1e3);
    assert!(stretch < 1e-3 && lowest > 0.9 * CLEAR && moved > 1e-3 && moved < 0.2);
}
