//! Keys, and what they do.

use eframe::egui;

/// Every key.
const KEYS: [(&str, &str); 22] = [
    ("W A S D, arrows", "drive; with the flying camera and nobody at a wheel: fly"),
    ("Space", "hand brake; with a helicopter and the flying camera: up"),
    ("Shift", "down; flying faster"),
    ("E", "take the wheel of the body chosen, or leave it"),
    ("Tab", "choose the next body"),
    ("C", "next camera: the scene's, orbit, fly, follow"),
    ("drag a body", "take it in your hand"),
    ("drag", "turn the camera"),
    ("drag with the right button", "move it"),
    ("wheel", "come nearer"),
    ("P", "pause, go on"),
    (". (full stop)", "one step"),
    (", (comma)", "slow motion"),
    ("R", "begin again"),
    ("M", "milliseconds of each stage"),
    ("T, then click", "watch how the plants of a place lean"),
    ("Ctrl Z", "take the last change back"),
    ("Ctrl +, Ctrl -", "larger, smaller letters"),
    ("O, Ctrl S", "open a scene, save it"),
    ("F9", "record a clip, or end it"),
    ("drop a file", "open it"),
    ("F1", "this list"),
];

/// The list, in a window of its own.
pub fn show(context: &egui::Context, open: &mut bool) {
    egui::Window::new("Keys").open(open).collapsible(false).resizable(false).show(context, |ui| {
        egui::Grid::new("keys").num_columns(2).spacing([24.0, 6.0]).show(ui, |ui| {
            for (key, what) in KEYS {
                ui.strong(key);
                ui.label(what);
                ui.end_row();
            }
        });
    });
}
