//! The menu of scenes.

use eframe::egui;
use sward_scenes::SHIPPED;

use crate::source::Source;

/// What a scene's own first lines say of it.
fn about(text: &str) -> String {
    let lines = text.lines().map_while(|line| line.strip_prefix("//")).map(str::trim);
    lines.collect::<Vec<_>>().join(" ")
}

/// Shows all scenes; the answer is one that was chosen.
pub fn show(ui: &mut egui::Ui, now: Option<&Source>) -> Option<Source> {
    let mut chosen = None;
    let current = now.map(Source::name);
    egui::ScrollArea::vertical().id_salt("scenes").max_height(260.0).auto_shrink([false, true]).show(ui, |ui| {
        for shipped in SHIPPED {
            let selected = current.as_deref() == Some(shipped.name);
            let line = ui.add_sized([ui.available_width(), 24.0], egui::Button::selectable(selected, shipped.name));
            if line.on_hover_text(about(shipped.text)).clicked() {
                chosen = Some(Source::Shipped(shipped));
            }
        }
    });
    chosen
}

#[cfg(test)]
mod tests {
    #[test]
    fn every_scene_says_what_it_is() {
        for shipped in sward_scenes::SHIPPED {
            assert!(super::about(shipped.text).len() > 20, "{}", shipped.name);
        }
    }
}
