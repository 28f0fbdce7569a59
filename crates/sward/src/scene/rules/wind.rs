//! Checks of the sources of wind.

use super::super::error::{Problem, Trail};
use super::super::fluid::{Fluid, MAX_FLUIDS, MAX_GUSTS};
use super::super::wind::{Flow, MAX_FOOTPRINTS, WindSource};
use super::super::{Interactor, Path};
use super::{Checked, each, known, path};

/// All checks over the sources of a scene.
pub(super) fn check(sources: &[WindSource], interactors: &[Interactor]) -> Checked {
    let wind = Trail::default().key("wind");
    most(sources, &wind, MAX_FOOTPRINTS, "Footprint", |source| matches!(source, WindSource::Footprint(_)))?;
    most(sources, &wind, MAX_FLUIDS, "Fluid", |source| matches!(source, WindSource::Fluid(_)))?;
    each(sources, &wind, |source, trail| wind_source(source, interactors, trail))
}

/// No more than the kernels have room for.
fn most(sources: &[WindSource], trail: &Trail, most: usize, name: &str, is_one: fn(&WindSource) -> bool) -> Checked {
    match sources.iter().enumerate().filter(|(_, source)| is_one(source)).nth(most) {
        Some((index, _)) => {
            let message = format!("this is one `{name}` more than {most}");
            Err(Problem::at(trail.clone().index(index), message).help("remove one"))
        }
        None => Ok(()),
    }
}

/// Squares that halve to the end, and gusts that fit them.
fn fluid(fluid: &Fluid, trail: &Trail) -> Checked {
    if !fluid.cells.is_power_of_two() {
        let above = fluid.cells.next_power_of_two();
        let message = format!("`cells` is {}, allowed are powers of two", fluid.cells);
        return Err(Problem::at(trail.clone().key("cells"), message).help(format!("{} or {above}", above / 2)));
    }
    let gusts = trail.clone().key("gusts");
    if fluid.gusts.len() > MAX_GUSTS {
        let message = format!("this is one gust more than {MAX_GUSTS}");
        return Err(Problem::at(gusts.index(MAX_GUSTS), message).help("remove one"));
    }
    each(&fluid.gusts, &gusts, |gust, trail| {
        if gust.radius <= 0.5 * fluid.side {
            return Ok(());
        }
        let message = format!("`radius` is {} m, but the square is {} m wide", gust.radius, fluid.side);
        Err(Problem::at(trail.clone().key("radius"), message).help(format!("at most {}", 0.5 * fluid.side)))
    })
}

fn wind_source(source: &WindSource, interactors: &[Interactor], trail: &Trail) -> Checked {
    let print = match source {
        WindSource::Footprint(print) => print,
        WindSource::Fluid(of) => return fluid(of, trail),
        WindSource::Uniform(_) | WindSource::Natural(_) => return Ok(()),
    };
    if let Flow::Image(image) = &print.flow
        && image.path.is_empty()
    {
        return Err(Problem::at(trail.clone().key("flow").key("path"), "`path` is empty").help("name a PNG"));
    }
    if let Some(follow) = &print.follow {
        return known(follow, interactors, trail.clone().key("follow"));
    }
    if matches!(print.path, Path::Driven(_)) {
        let help = "drive an interactor, and name it in `follow`";
        return Err(Problem::at(trail.clone().key("path"), "a footprint cannot be driven").help(help));
    }
    path(&print.path, trail)
}
