//! 22 trees that were pulled and let go: their strain gauges, and fits made by others.

use std::collections::BTreeMap;
use std::path::PathBuf;

use sward::fit::{Recording, Swing, swing};

use crate::Test;
use crate::engine;

pub(crate) const TESTS: &[Test] = &[
    ("trees_swing_as_others_found", trees_swing_as_others_found),
    ("oscillator_swings_as_the_trees_do", oscillator_swings_as_the_trees_do),
    ("harmonic_swings_as_the_trees_do", harmonic_swings_as_the_trees_do),
];

/// The folder of recordings made by others: beside this checkout, or as `SWARD_SHARED` says.
pub(crate) fn folder() -> Option<PathBuf> {
    let beside = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared");
    let folder = std::env::var_os("SWARD_SHARED").map_or_else(|| PathBuf::from(beside), PathBuf::from).join("data/sway");
    folder.is_dir().then_some(folder)
}

/// A recording, and what others found: how often it swings \[Hz\], damping ratio; nothing where it is not one mode. And how high the tree is, m.
struct Tree {
    name: String,
    recording: Recording,
    found: Option<[f64; 2]>,
    height: f64,
}

fn rows(file: &str) -> Vec<Vec<String>> {
    let path = folder().expect("ignored without it").join(file);
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    text.lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

fn trees() -> Vec<Tree> {
    let mut samples: BTreeMap<String, [Vec<f64>; 2]> = BTreeMap::new();
    for row in rows("tree_sway.csv") {
        let [times, values] = samples.entry(row[0].clone()).or_default();
        times.push(row[1].parse().expect("a number"));
        values.push(row[2].parse().expect("a number"));
    }
    let tree = |row: Vec<String>| {
        let [times, values] = samples.remove(&row[0]).expect("a recording of each");
        let number = |column: usize| row[column].parse::<f64>().ok();
        Tree {
            recording: Recording::new(times, values).unwrap_or_else(|error| panic!("{}: {error}", row[0])),
            found: number(8).zip(number(9)).map(|(frequency, damping)| [frequency, damping]),
            height: number(5).expect("a height"),
            name: row[0].clone(),
        }
    };
    let trees: Vec<Tree> = rows("tree_sway_fits.csv").into_iter().map(tree).collect();
    assert!(trees.len() == 22 && trees.iter().filter(|tree| tree.found.is_some()).count() == 16 && samples.is_empty());
    trees
}

/// Those of one mode, as found here.
fn swings(trees: &[Tree]) -> Vec<(&Tree, Swing)> {
    trees
        .iter()
        .filter(|tree| tree.found.is_some())
        .map(|tree| (tree, swing(&tree.recording).unwrap_or_else(|error| panic!("{}: {error}", tree.name))))
        .collect()
}

/// How far two swings are apart, as shares of the second: how often, and the damping ratio.
fn apart(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [0, 1].map(|k| (a[k] / b[k] - 1.0).abs())
}

fn of(swing: &Swing) -> [f64; 2] {
    [swing.swings_at(), swing.damping_ratio]
}

fn trees_swing_as_others_found() {
    let trees = trees();
    let mut worst = [0.0_f64; 2];
    for (tree, swing) in swings(&trees) {
        let off = apart(of(&swing), tree.found.expect("of one mode"));
        println!(
            "{}: {:.4} Hz, {:.4}, R² {:.4}; off by {:.2} and {:.1} %",
            tree.name,
            swing.swings_at(),
            swing.damping_ratio,
            swing.r_squared,
            100.0 * off[0],
            100.0 * off[1]
        );
        worst = [0, 1].map(|k| worst[k].max(off[k]));
        assert!(off[0] < 0.005 && off[1] < 0.10, "{}: {off:?}", tree.name);
        let others = trees.iter().filter(|other| other.found.is_some() && other.name != tree.name);
        let mistaken = others
            .filter(|other| apart(of(&swing), other.found.expect("of one mode")).iter().zip([0.005, 0.10]).all(|(off, most)| *off < most));
        assert!(mistaken.count() < 2, "control: {} is taken for others", tree.name);
    }
    println!("worst: {worst:?}");
    for tree in trees.iter().filter(|tree| tree.found.is_none()) {
        let why = swing(&tree.recording).expect_err(&tree.name);
        println!("{}: {why}", tree.name);
    }
}

/// Plays each tree's numbers: what is measured in the engine is within 5 % of how often the tree swings, and within 20 % of its damping ratio.
fn played(play: fn(&Swing, f64) -> Recording) {
    let (all, most) = (trees(), [0.05, 0.20]);
    let trees = swings(&all);
    let fits = |a: [f64; 2], b: [f64; 2]| apart(a, b).iter().zip(most).all(|(off, most)| *off <= most);
    let (mut worst, mut strangers) = ([0.0_f64; 2], 0);
    for (number, (tree, measured)) in trees.iter().enumerate() {
        let again = swing(&play(measured, tree.height)).unwrap_or_else(|error| panic!("{}: {error}", tree.name));
        let off = apart(of(&again), tree.found.expect("of one mode"));
        println!(
            "{}: {:.4} Hz, {:.4}; off by {:.2} and {:.1} %",
            tree.name,
            again.swings_at(),
            again.damping_ratio,
            100.0 * off[0],
            100.0 * off[1]
        );
        worst = [0, 1].map(|k| worst[k].max(off[k]));
        assert!(off[0] <= most[0] && off[1] <= most[1], "{}: {off:?}", tree.name);
        // Control: other trees, and other numbers for this one.
        let others = trees.iter().filter(|(other, _)| other.name[..3] != tree.name[..3]);
        strangers += others.filter(|(_, other)| !fits(of(&again), of(other))).count();
        if number % 5 == 0 {
            let wrong = Swing { frequency: 1.07 * measured.frequency, damping_ratio: 1.25 * measured.damping_ratio, ..*measured };
            let off = apart(of(&swing(&play(&wrong, tree.height)).expect("a swing")), of(measured));
            assert!(off[0] > most[0] && off[1] > most[1], "control: {off:?}");
        }
    }
    println!("worst {worst:?}; {strangers} times another tree is told apart");
    assert!(strangers > 150, "{strangers}");
}

fn oscillator_swings_as_the_trees_do() {
    played(engine::oscillator);
}

fn harmonic_swings_as_the_trees_do() {
    played(engine::harmonic);
}
