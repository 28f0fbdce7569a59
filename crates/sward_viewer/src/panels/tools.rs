//! Time, cameras, wheels, and the picture's size.

use eframe::egui;

use crate::camera::Kind;
use crate::clock::Clock;
use crate::compare::RESPONSES;
use crate::drive::Drive;
use crate::marks::mark;
use crate::painter::Means;
use crate::stage::Backend;

/// What a panel asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wish {
    /// Begin the scene again.
    Restart,
    /// Another camera.
    Camera(Kind),
    /// Choose a body.
    Choose(usize),
    /// Take its wheel, or leave it.
    Wheel,
    /// Step elsewhere.
    Step(Backend),
    /// Begin a clip, or end it.
    Record,
    /// Take the last change back.
    Undo,
    /// Split the window, with this response in the other half; or no longer.
    Compare(Option<usize>),
}

/// How time passes, and whether a clip is being made of it.
pub fn time(ui: &mut egui::Ui, clock: &mut Clock, recording: bool, wishes: &mut Vec<Wish>) {
    ui.horizontal(|ui| {
        let pause = ui.button(if clock.paused { "▶" } else { "⏸" }).on_hover_text("Pause, or go on (P)");
        mark(ui, "pause", pause.rect);
        if pause.clicked() {
            clock.paused = !clock.paused;
        }
        if ui.add_enabled(clock.paused, egui::Button::new("⏭")).on_hover_text("One step (full stop)").clicked() {
            clock.single += 1;
        }
        if ui.button("⟲").on_hover_text("Begin again (R)").clicked() {
            wishes.push(Wish::Restart);
        }
        let record = ui.selectable_label(recording, "⏺").on_hover_text("Record a clip, or end it (F9)");
        mark(ui, "record", record.rect);
        if record.clicked() {
            wishes.push(Wish::Record);
        }
        let pace = egui::Slider::new(&mut clock.pace, 0.05..=2.0).logarithmic(true).suffix("×").max_decimals(2);
        ui.add(pace).on_hover_text("Seconds of the scene for each second: slow motion (comma)");
    });
}

/// Which camera.
pub fn camera(ui: &mut egui::Ui, kind: Kind, wishes: &mut Vec<Wish>) {
    ui.horizontal(|ui| {
        for (other, name) in Kind::ALL {
            if ui.selectable_label(kind == other, name).clicked() {
                wishes.push(Wish::Camera(other));
            }
        }
    });
}

/// Which body, and who is at its wheel.
pub fn wheel(ui: &mut egui::Ui, names: &[String], chosen: Option<usize>, drive: Option<&Drive>, wishes: &mut Vec<Wish>) {
    if names.is_empty() {
        ui.weak("no bodies in this scene");
        return;
    }
    ui.horizontal_wrapped(|ui| {
        for (index, name) in names.iter().enumerate() {
            if ui.selectable_label(chosen == Some(index), name).clicked() {
                wishes.push(Wish::Choose(index));
            }
        }
    });
    let words = if drive.is_some() { "leave the wheel" } else { "take the wheel" };
    let wheel = ui.button(words).on_hover_text("E; then W A S D or the arrows");
    mark(ui, words, wheel.rect);
    if wheel.clicked() {
        wishes.push(Wish::Wheel);
    }
    if let Some(drive) = drive {
        egui::Grid::new("wheel").num_columns(2).show(ui, |ui| {
            ui.label("speed");
            ui.monospace(format!("{:5.1} m/s  {:4.0} km/h", drive.speed[0], 3.6 * drive.speed[0]));
            ui.end_row();
            ui.label("steering");
            ui.monospace(format!("{:5.1}°", drive.steering.to_degrees()));
            ui.end_row();
            ui.label("drift");
            ui.monospace(format!("{:5.1}°", drive.drift().to_degrees()));
            ui.end_row();
            ui.label("height");
            ui.monospace(format!("{:5.2} m", drive.clearance));
            ui.end_row();
        });
    }
}

/// Where cells move, and how fine the picture is.
pub fn machine(ui: &mut egui::Ui, backend: Backend, [fineness, near]: [&mut f32; 2], means: &Means, wishes: &mut Vec<Wish>) {
    ui.horizontal(|ui| {
        for (other, name) in [(Backend::Cpu, "step on the CPU"), (Backend::Gpu, "on the GPU")] {
            let there = other == Backend::Cpu || means.gpu().is_some();
            let button = ui.add_enabled(there, egui::Button::selectable(backend == other, name));
            mark(ui, other.name(), button.rect);
            if button.clicked() && backend != other {
                wishes.push(Wish::Step(other));
            }
        }
    });
    ui.add(egui::Slider::new(fineness, 0.2..=1.0).text("pixels").max_decimals(2)).on_hover_text("Pixels drawn for each of the window's");
    let words = "Share of the distance up to which every plant is drawn; beyond it fewer and wider ones stand for all";
    ui.add(egui::Slider::new(near, 0.05..=1.0).text("plants").max_decimals(2)).on_hover_text(words);
    ui.weak(means.name());
}

/// Which response the other half of the window shows.
pub fn compare(ui: &mut egui::Ui, response: Option<usize>, wishes: &mut Vec<Wish>) {
    ui.horizontal_wrapped(|ui| {
        let one = ui.selectable_label(response.is_none(), "one picture").on_hover_text("No other half");
        mark(ui, "compare off", one.rect);
        if one.clicked() && response.is_some() {
            wishes.push(Wish::Compare(None));
        }
        for (index, (name, _)) in RESPONSES.iter().enumerate() {
            let about = "The same field, the same moment, the same hands at the wheel, with this response in the other half";
            let button = ui.selectable_label(response == Some(index), *name).on_hover_text(about);
            mark(ui, &format!("compare {name}"), button.rect);
            if button.clicked() {
                wishes.push(Wish::Compare(Some(index)));
            }
        }
    });
}
