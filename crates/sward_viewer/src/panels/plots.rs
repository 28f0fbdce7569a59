//! Curves: milliseconds of each stage, and how the plants of a place lean.

use eframe::egui;
use egui_plot::{Legend, Line, Plot, PlotPoints};
use sward::world::World;

use crate::probe::Probe;
use crate::timing::Times;

/// Milliseconds of each stage, picture by picture.
pub fn times(ui: &mut egui::Ui, times: &Times) {
    let legend = Legend::default().position(egui_plot::Corner::LeftTop).background_alpha(0.6);
    Plot::new("times")
        .height(ui.available_height())
        .legend(legend)
        .y_axis_label("ms")
        .include_y(0.0)
        .allow_scroll(false)
        .allow_drag(false)
        .show_axes([false, true])
        .show(ui, |plot| {
            let mut rows: Vec<_> = times.rows().iter().collect();
            rows.sort_by(|a, b| b.mean().total_cmp(&a.mean()));
            for row in rows {
                let points: PlotPoints<'_> = row.past.iter().enumerate().map(|(at, value)| [at as f64, f64::from(*value)]).collect();
                let device = if row.on_device { "GPU " } else { "" };
                plot.line(Line::new(format!("{device}{} {:.2}", row.name, row.mean()), points).width(1.5));
            }
        });
}

/// How the plants of a place lean over time.
pub fn probe(ui: &mut egui::Ui, probe: &mut Probe, world: Option<&World>) {
    let Some([x, z]) = probe.at else {
        ui.weak("click a place in the picture to watch how its plants lean");
        return;
    };
    let names: Vec<String> = world.map_or_else(Vec::new, |world| {
        let stands = world.model.stands.iter().map(|stand| &world.scene.stands[stand.index]);
        stands.map(|stand| if stand.name.is_empty() { format!("{:?}", stand.species).to_lowercase() } else { stand.name.clone() }).collect()
    });
    ui.horizontal(|ui| {
        ui.label(format!("{x:.2}, {z:.2} m"));
        let before = probe.stand;
        for (index, name) in names.iter().enumerate() {
            ui.selectable_value(&mut probe.stand, index, name);
        }
        if probe.stand != before {
            probe.past.clear();
        }
        if let Some(lean) = probe.lean() {
            ui.strong(format!("{:.1}°", lean.to_degrees()));
        }
    });
    let legend = Legend::default().position(egui_plot::Corner::LeftTop).background_alpha(0.6);
    let plot = Plot::new("probe")
        .height(ui.available_height())
        .legend(legend)
        .x_axis_label("s")
        .y_axis_label("°")
        .allow_scroll(false)
        .allow_drag(false);
    plot.show(ui, |plot| {
        let line = |name: &str, value: &dyn Fn([f32; 2]) -> f32| {
            let points: PlotPoints<'_> = probe.past.iter().map(|(time, lean)| [*time, f64::from(value(*lean)).to_degrees()]).collect();
            Line::new(name.to_owned(), points).width(1.5)
        };
        plot.line(line("tilt", &|[x, z]| x.hypot(z)).width(2.5));
        plot.line(line("along x", &|[x, _]| x));
        plot.line(line("along z", &|[_, z]| z));
    });
}
