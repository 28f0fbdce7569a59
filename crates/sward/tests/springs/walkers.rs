//! Persons of simple shape that walk through: no vertex stays in them, none jumps, none sinks, no column stretches.

use glam::Vec3;
use sward::response::springs::{HeldSheet, Maps, ROUNDS, SheetRoot, push, sweep};

use crate::Test;
use crate::bodies::{block, egg};
use crate::field::{Plant, coefficients, head, pass, root, row};

pub(crate) const TESTS: &[Test] = &[
    ("a_round_walker_goes_through", a_round_walker_goes_through),
    ("an_upright_box_goes_through", an_upright_box_goes_through),
    ("finer_sheets_and_slopes_too", finer_sheets_and_slopes_too),
    ("the_order_of_the_paper_alone_stretches", the_order_of_the_paper_alone_stretches),
];

fn a_round_walker_goes_through() {
    let co = coefficients(3, 3);
    for (name, lift) in [("round walker", 0.0), ("round walker, sunk by 0.1 m", -0.1)] {
        let walker = egg(name, Vec3::new(0.25, 0.9, 0.25), lift, 64, 48);
        let seen = pass(&co, &walker, &row(0.25, 0.4), 1.5, None);
        seen.print(name);
        assert!(seen.touched > 1000, "it must touch: {seen:?}");
        assert!(seen.deepest < 0.005 && seen.truly < 0.012, "{seen:?}");
        assert!(seen.jump < 0.35 && seen.stretch < 1e-3 && seen.lowest > 0.9e-3, "{seen:?}");
        // Control: at 12 m/s without moments between it is in them.
        let fast = pass(&co, &walker, &row(0.25, 0.4), 12.0, Some(1));
        assert!(fast.deepest > 0.012, "too fast a body must show: {fast:?}");
    }
}

fn an_upright_box_goes_through() {
    let co = coefficients(3, 3);
    for (name, lift, height) in [("box walker", 0.0, 1.8), ("box walker, sunk by 0.1 m", -0.1, 1.9), ("box walker, 5 cm up", 0.05, 1.8)] {
        let seen = pass(&co, &block(name, Vec3::new(0.5, height, 0.3), lift, 64), &row(0.25, 0.4), 1.5, None);
        seen.print(name);
        assert!(seen.touched > 1000, "it must touch: {seen:?}");
        assert!(seen.over[0] == 0 && seen.deepest < 0.005 && seen.truly < 0.012, "{seen:?}");
        assert!(seen.jump < 0.35 && seen.stretch < 1e-3 && seen.lowest > 0.9e-3, "{seen:?}");
    }
}

fn finer_sheets_and_slopes_too() {
    let walker = egg("round walker", Vec3::new(0.25, 0.9, 0.25), -0.15, 64, 48);
    for (side, slope) in [(2, 0.0), (5, 0.0), (9, 0.0), (3, 0.3), (5, -0.4)] {
        let co = coefficients(side, side);
        let tilt = |root: SheetRoot| SheetRoot { at: [root.at[0], slope * root.at[0], 0.0], slope: [slope, 0.0], ..root };
        let roots: Vec<SheetRoot> = row(0.25, 0.4).into_iter().step_by(3).map(tilt).collect();
        let seen = pass(&co, &walker, &roots, 1.5, None);
        seen.print(&format!("{side} × {side} on a slope of {slope}"));
        assert!(seen.touched > 300, "it must touch: {seen:?}");
        assert!(seen.deepest < 0.012, "{seen:?}");
        assert!(seen.jump < 0.35 && seen.stretch < 1e-3 && seen.lowest > 0.9e-3, "{seen:?}");
    }
}

/// Push-out and springs, with no pass over lengths.
fn the_order_of_the_paper_alone_stretches() {
    let (co, walker) = (coefficients(3, 3), egg("walker", Vec3::new(0.25, 0.9, 0.25), 0.0, 64, 48));
    let mut stretch = 0.0f32;
    for x in [0.0, 0.05, 0.1, 0.2] {
        let mut plant = Plant::new(&co, root(x, 0.0, 0.0, 0.4));
        let mut held: HeldSheet = plant.held;
        for frame in 0..60 {
            let heads = [head(&walker.map, 0, Vec3::Z * (0.025 * frame as f32 - 0.75), 0.0)];
            let maps = Maps { heads: &heads, texels: &walker.map.texels };
            for _ in 0..ROUNDS {
                push(&co, &plant.root, &maps, 0, &mut held.stored, &mut held.faces);
            }
            held.stored = sweep(&co, &plant.root, &held.stored, &[false; 81]);
        }
        plant.shown = held.stored;
        stretch = stretch.max(plant.shown.stretch(&co, &plant.root));
    }
    println!("springs and push-out alone stretch a segment by {:.0} %", stretch * 100.0);
    assert!(stretch > 0.05, "lengths must be lost without their pass: {stretch}");
}
