//! Curves of how plants lean, of worlds that step.

use std::path::Path;

use super::Written;
use super::curves::{Chart, Line, draw};
use super::field::{BAR, PASSED, ends, field, lean, run, watch};

const TIME: &str = "seconds since the bar";
const LEAN: &str = "lean, rad";

/// How plants in the middle lean along the bar's way, from shortly before it until `until` s.
fn passed(stand: &str, until: f64) -> Result<Vec<(f64, f64)>, Box<dyn std::error::Error>> {
    let mut world = field(stand, BAR)?;
    let upright = lean(&world)[1];
    run(&mut world, PASSED - 0.2);
    Ok(watch(&mut world, until, |world| lean(world)[1] - upright))
}

/// One chart of the same release of several stands, each with a label.
fn releases(path: &Path, title: &str, until: f64, stands: &[(&str, &str)]) -> Written {
    let lines: Result<Vec<Line>, _> =
        stands.iter().map(|(label, stand)| passed(stand, until).map(|points| Line::new(*label, points))).collect();
    draw(path, &[Chart { title, across: TIME, up: LEAN, lines: lines? }])
}

pub(crate) fn release(path: &Path) -> Written {
    releases(
        path,
        "meadow, one release, each response by itself",
        4.5,
        &[
            ("Continuum", "species: Meadow, cells: 32"),
            ("Oscillator", "species: Meadow, cells: 32, response: Oscillator()"),
            ("VirtualInertia", "species: Meadow, cells: 32, response: VirtualInertia()"),
            ("Springs", "species: Meadow, cells: 32, response: Springs()"),
        ],
    )
}

pub(crate) fn frequency(path: &Path) -> Written {
    releases(
        path,
        "Continuum(frequency: …, damping: 0.2)",
        4.5,
        &[
            ("0.8 Hz", "species: Meadow, cells: 32, response: Continuum(frequency: 0.8, damping: 0.2)"),
            ("1.7 Hz", "species: Meadow, cells: 32, response: Continuum(frequency: 1.7, damping: 0.2)"),
            ("3.4 Hz", "species: Meadow, cells: 32, response: Continuum(frequency: 3.4, damping: 0.2)"),
        ],
    )
}

pub(crate) fn damping(path: &Path) -> Written {
    releases(
        path,
        "Continuum(frequency: 1.7, damping: …)",
        3.5,
        &[
            ("0.1", "species: Meadow, cells: 32, response: Continuum(frequency: 1.7, damping: 0.1)"),
            ("0.36", "species: Meadow, cells: 32, response: Continuum(frequency: 1.7, damping: 0.36)"),
            ("1", "species: Meadow, cells: 32, response: Continuum(frequency: 1.7, damping: 1)"),
            ("2.5", "species: Meadow, cells: 32, response: Continuum(frequency: 1.7, damping: 2.5)"),
        ],
    )
}

pub(crate) fn creep(path: &Path) -> Written {
    releases(
        path,
        "tracks that stay: Continuum(frequency: 0.36, damping: …)",
        16.0,
        &[
            ("1", "species: Meadow, cells: 32, response: Continuum(frequency: 0.36, damping: 1)"),
            ("4", "species: Meadow, cells: 32, response: Continuum(frequency: 0.36, damping: 4)"),
            ("10", "species: Meadow, cells: 32, response: Continuum(frequency: 0.36, damping: 10)"),
        ],
    )
}

/// How far plants lean beside a box that stands.
pub(crate) fn coupling(path: &Path) -> Written {
    let line = |speed: f32| {
        let stand = format!("species: Meadow, cells: 64, response: Continuum(c0: {speed}, mu: 0)");
        let mut world = field(&stand, "interactors: [(shape: Box(size: (28, 0.5, 2)), clearance: 0.1)]")?;
        run(&mut world, 5.0);
        let at = |k: u32| f64::from(k) * 0.125 + 0.563;
        let tilt = |k: u32| (at(k) - 1.0, world.bend_at(0, [0.0, at(k)]).map_or(0.0, |bend| f64::from(bend[1])));
        Ok::<_, Box<dyn std::error::Error>>(Line::new(format!("c0 {speed} m/s"), (0..16).map(tilt).collect()))
    };
    let lines = [0.5, 2.0, 5.0].into_iter().map(line).collect::<Result<_, _>>()?;
    draw(path, &[Chart { title: "a box that stands: how far the press reaches", across: "metres from its edge", up: LEAN, lines }])
}

/// How foot and tip of reed go after the bar, with several delays.
pub(crate) fn trail(path: &Path) -> Written {
    let chart = |title: &'static str, delay: f32| {
        let stand = format!("species: Reed, cells: 32, response: Continuum(gamma_top: {delay}, gamma_recover: {delay})");
        let mut world = field(&stand, BAR)?;
        run(&mut world, PASSED - 0.2);
        let mut foot = Vec::new();
        let tip = watch(&mut world, 4.0, |world| {
            let [low, high] = ends(world);
            foot.push((world.time() - PASSED, low));
            high
        });
        let lines = vec![Line::new("foot", foot), Line::new("tip", tip)];
        Ok::<_, Box<dyn std::error::Error>>(Chart { title, across: TIME, up: LEAN, lines })
    };
    draw(path, &[chart("gamma 0 s", 0.0)?, chart("gamma 0.2 s", 0.2)?, chart("gamma 0.4 s", 0.4)?])
}

pub(crate) fn recover(path: &Path) -> Written {
    releases(
        path,
        "Springs(recover: …)",
        6.5,
        &[
            ("1 s", "species: Meadow, cells: 32, response: Springs(recover: 1)"),
            ("2.5 s", "species: Meadow, cells: 32, response: Springs(recover: 2.5)"),
            ("5 s", "species: Meadow, cells: 32, response: Springs(recover: 5)"),
            ("5 s, recovery: Cubic", "species: Meadow, cells: 32, response: Springs(recover: 5, recovery: Cubic)"),
        ],
    )
}

/// How far plants lean in steady wind of several speeds, after three seconds of it.
fn in_wind(stand: &str) -> Result<Vec<(f64, f64)>, Box<dyn std::error::Error>> {
    let calm = lean(&field(stand, "")?)[0];
    let mut points = Vec::new();
    for speed in (0..=16).step_by(2) {
        let mut world = field(stand, &format!("wind: [Uniform(velocity: ({speed}, 0))]"))?;
        run(&mut world, 3.0);
        points.push((f64::from(speed), lean(&world)[0] - calm));
    }
    Ok(points)
}

fn winds(path: &Path, title: &str, stands: &[(&str, &str)]) -> Written {
    let lines: Result<Vec<Line>, _> = stands.iter().map(|(label, stand)| in_wind(stand).map(|points| Line::new(*label, points))).collect();
    draw(path, &[Chart { title, across: "steady wind, m/s", up: LEAN, lines: lines? }])
}

pub(crate) fn steady(path: &Path) -> Written {
    winds(
        path,
        "meadow in steady wind, each response by itself",
        &[
            ("Continuum", "species: Meadow, cells: 32"),
            ("Oscillator", "species: Meadow, cells: 32, response: Oscillator()"),
            ("VirtualInertia", "species: Meadow, cells: 32, response: VirtualInertia()"),
            ("Springs", "species: Meadow, cells: 32, response: Springs()"),
        ],
    )
}

pub(crate) fn gain(path: &Path) -> Written {
    winds(
        path,
        "Continuum(wind: …)",
        &[
            ("0.1", "species: Meadow, cells: 32, response: Continuum(wind: 0.1)"),
            ("0.0356, the meadow's", "species: Meadow, cells: 32"),
            ("0.01", "species: Meadow, cells: 32, response: Continuum(wind: 0.01)"),
        ],
    )
}

/// Twelve plants by themselves, let go at once, for several spreads.
pub(crate) fn spread(path: &Path) -> Written {
    let chart = |title: &'static str, spread: f32| {
        let stand = format!(
            "species: Meadow, cells: 32, height: (0.4, 0.4), clumping: 0, \
             response: Oscillator(frequency: 1.7, damping: 0.1, spread_stiffness: {spread}, spread_damping: {spread})"
        );
        let mut world = field(&stand, BAR)?;
        run(&mut world, PASSED - 0.2);
        let cells: Vec<[u32; 2]> = (0..12).map(|i| [i, 0]).collect();
        let mut lines: Vec<Line> = cells.iter().map(|_| Line::new("", Vec::new())).collect();
        while world.time() < 4.0 {
            (0..2).for_each(|_| world.step());
            for (line, cell) in lines.iter_mut().zip(&cells) {
                let bend = world.bend_of_plant(0, [0, 0], *cell).unwrap_or_default();
                line.points.push((world.time() - PASSED, f64::from(bend[1])));
            }
        }
        Ok::<_, Box<dyn std::error::Error>>(Chart { title, across: TIME, up: LEAN, lines })
    };
    draw(path, &[chart("spread 0", 0.0)?, chart("0.15", 0.15)?, chart("0.5", 0.5)?])
}

/// How a meadow leans for a while in gusts.
pub(crate) fn gusts(path: &Path) -> Written {
    let line = |turbulence: f32| {
        let wind = format!("wind: [Natural(velocity: (5, 0), turbulence: {turbulence})]");
        let mut world = field("species: Meadow, cells: 32", &wind)?;
        run(&mut world, PASSED);
        let points = watch(&mut world, 21.0, |world| lean(world)[0]);
        Ok::<_, Box<dyn std::error::Error>>(Line::new(format!("turbulence {turbulence}"), points))
    };
    let lines = [0.6, 0.25, 0.0].into_iter().map(line).collect::<Result<_, _>>()?;
    draw(path, &[Chart { title: "meadow, Natural(velocity: (5, 0), turbulence: …)", across: "seconds", up: "lean along x, rad", lines }])
}
