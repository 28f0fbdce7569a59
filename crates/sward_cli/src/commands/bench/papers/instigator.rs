//! The article on grass interaction by instigators, parts 1 and 2: it prints a curve, and neither times nor counts.

use sward::response::oscillator::least_tilt;

use super::table::{Column, Line, Table};

/// The article's instigator: radius and half-height.
const RADIUS: f64 = 10.0;
const HALF_HEIGHT: f64 = 3.0;
/// Distances of roots from its middle.
const DISTANCES: [f64; 6] = [0.5, 2.0, 4.0, 6.0, 8.0, 9.5];
/// Plants so long that none ends under it, as the article takes them to be.
const ROD: f64 = 1000.0;

/// θ₀(d) as printed.
fn printed(distance: f64) -> f64 {
    std::f64::consts::FRAC_PI_2 - (2.0 * HALF_HEIGHT * distance / (RADIUS * RADIUS - distance * distance)).atan()
}

/// Works it out.
pub(super) fn run() -> Table {
    let ours = |distance: f64| f64::from(least_tilt((distance / RADIUS) as f32, 0.0, RADIUS as f32, HALF_HEIGHT as f32, ROD as f32));
    Table {
        paper: "Grass interaction by instigators (article)",
        place: "part 1, the curve of θ₀(d)",
        scene: format!("an instigator of radius {RADIUS} and height {HALF_HEIGHT}: tilt of a plant whose root is so far from its middle"),
        columns: DISTANCES.iter().map(|distance| Column::new(format!("d = {distance}"), "rad")).collect(),
        ratios: Vec::new(),
        lines: vec![
            Line::printed("its formula", DISTANCES.map(|distance| Some(printed(distance)))),
            Line::ours("the least tilt at which the plant is outside".to_owned(), DISTANCES.map(|at| Some(ours(at))).into(), Vec::new()),
        ],
        notes: vec!["the article prints no times and no counts: there is nothing else to run".to_owned()],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_is_the_articles() {
        let table = run();
        let [paper, ours] = [0, 1].map(|line: usize| table.lines[line].values.clone());
        assert_eq!((paper.len(), ours.len()), (DISTANCES.len(), DISTANCES.len()));
        let apart = |a: &[Option<f64>], b: &[Option<f64>]| {
            a.iter().zip(b).map(|(a, b)| (a.expect("printed") - b.expect("ours")).abs()).fold(0.0, f64::max)
        };
        assert!(apart(&paper, &ours) < 1e-4, "{paper:?} {ours:?}");
        let other: Vec<Option<f64>> = DISTANCES.map(|distance| Some(printed(0.9 * distance))).into();
        assert!(apart(&other, &ours) > 0.01, "control");
    }
}
