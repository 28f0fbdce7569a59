//! Charts: lines over an even ground, one or several beside each other.

use std::path::Path;

use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;

use super::Written;

/// A line of a chart.
pub(crate) struct Line {
    pub(crate) label: String,
    pub(crate) points: Vec<(f64, f64)>,
}

impl Line {
    pub(crate) fn new(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self { label: label.into(), points }
    }
}

/// What a chart shows; lines without a label are thin and have no entry in its legend.
pub(crate) struct Chart<'a> {
    pub(crate) title: &'a str,
    pub(crate) across: &'a str,
    pub(crate) up: &'a str,
    pub(crate) lines: Vec<Line>,
}

/// Colours that are told apart without seeing red or green.
const COLOURS: [RGBColor; 5] =
    [RGBColor(0, 92, 175), RGBColor(217, 105, 0), RGBColor(0, 130, 90), RGBColor(150, 70, 150), RGBColor(90, 90, 90)];

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
/// The axes of a chart.
pub(crate) type Axes<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// Height of all charts, pixels.
const HEIGHT: u32 = 300;

/// One chart, or several with the same ranges side by side.
pub(crate) fn draw(path: &Path, charts: &[Chart<'_>]) -> Written {
    let points = || charts.iter().flat_map(|chart| &chart.lines).flat_map(|line| &line.points);
    let range = |pick: fn(&(f64, f64)) -> f64| {
        let (low, high) = points().map(pick).fold((f64::MAX, f64::MIN), |(low, high), value| (low.min(value), high.max(value)));
        let room = 0.04 * (high - low);
        low - room..high + room
    };
    let across = points().map(|point| point.0).fold(f64::MAX, f64::min)..points().map(|point| point.0).fold(f64::MIN, f64::max);
    let up = range(|point| point.1);
    let root = SVGBackend::new(path, (720, HEIGHT)).into_drawing_area();
    root.fill(&WHITE)?;
    for (area, chart) in root.split_evenly((1, charts.len())).iter().zip(charts) {
        lines(area, chart, [across.clone(), up.clone()])?;
    }
    Ok(root.present()?)
}

fn lines(area: &Area<'_>, chart: &Chart<'_>, [across, up]: [std::ops::Range<f64>; 2]) -> Written {
    let mut axes = ChartBuilder::on(area)
        .caption(chart.title, ("sans-serif", 15))
        .margin(8)
        .margin_right(18)
        .x_label_area_size(36)
        .y_label_area_size(48)
        .build_cartesian_2d(across, up)?;
    axes.configure_mesh()
        .x_desc(chart.across)
        .y_desc(chart.up)
        .x_labels(8)
        .y_labels(6)
        .light_line_style(WHITE)
        .bold_line_style(BLACK.mix(0.12))
        .label_style(("sans-serif", 12))
        .draw()?;
    // The legend where no line is.
    let rises =
        chart.lines.iter().all(|line| line.points.first().zip(line.points.last()).is_some_and(|(first, last)| last.1 > first.1 + 0.1));
    let mut named = 0;
    for (index, line) in chart.lines.iter().enumerate() {
        let colour = COLOURS[index % COLOURS.len()];
        let style = if line.label.is_empty() { colour.mix(0.55).stroke_width(1) } else { colour.stroke_width(2) };
        let drawn = axes.draw_series(LineSeries::new(line.points.iter().copied(), style))?;
        if !line.label.is_empty() {
            named += 1;
            drawn.label(&line.label).legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], colour.stroke_width(2)));
        }
    }
    if named > 0 {
        axes.configure_series_labels()
            .position(if rises { SeriesLabelPosition::UpperLeft } else { SeriesLabelPosition::UpperRight })
            .background_style(WHITE.mix(0.85))
            .border_style(BLACK.mix(0.2))
            .label_font(("sans-serif", 12))
            .draw()?;
    }
    Ok(())
}

/// Axes in metres, equally long on both, for maps side by side; `draw` draws on each.
pub(crate) fn maps(path: &Path, titles: &[&str], half: f64, mut draw: impl FnMut(usize, &mut Axes<'_, '_>) -> Written) -> Written {
    let root = SVGBackend::new(path, (720, 720 / titles.len() as u32 + 24)).into_drawing_area();
    root.fill(&WHITE)?;
    for (index, (area, title)) in root.split_evenly((1, titles.len())).iter().zip(titles).enumerate() {
        let mut axes = ChartBuilder::on(area)
            .caption(title, ("sans-serif", 14))
            .margin(6)
            .margin_right(14)
            .x_label_area_size(22)
            .y_label_area_size(30)
            .build_cartesian_2d(-half..half, -half..half)?;
        axes.configure_mesh().disable_mesh().x_labels(5).y_labels(5).label_style(("sans-serif", 11)).draw()?;
        draw(index, &mut axes)?;
    }
    Ok(root.present()?)
}

/// Arrows from places along ways, m.
pub(crate) fn arrows(axes: &mut Axes<'_, '_>, arrows: &[([f64; 2], [f64; 2])]) -> Written {
    let style = COLOURS[0].stroke_width(1);
    for ([x, z], [along, across]) in arrows {
        let (tip, length) = ((x + along, z + across), along.hypot(*across));
        axes.draw_series(LineSeries::new([(*x, *z), tip], style))?;
        if length > 0.05 {
            let (dx, dz) = (along * 0.3, across * 0.3);
            let head = [(tip.0 - dx - 0.5 * dz, tip.1 - dz + 0.5 * dx), tip, (tip.0 - dx + 0.5 * dz, tip.1 - dz - 0.5 * dx)];
            axes.draw_series(LineSeries::new(head, style))?;
        }
    }
    Ok(())
}
