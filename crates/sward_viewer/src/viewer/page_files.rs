//! Files that are opened and saved on a page: there are names and contents, but no folders.

use eframe::egui;

use super::Viewer;
use super::files::Purpose;
use crate::page::files::save;
use crate::painting::Painting;
use crate::source::Source;

impl Viewer {
    /// Asks which file, or saves one.
    pub(super) fn ask_for(&mut self, purpose: Purpose) {
        self.purpose = purpose;
        let done = match purpose {
            Purpose::OpenScene => self.pick(".ron"),
            Purpose::OpenWind => self.pick(".png"),
            Purpose::SaveScene => self.save_scene(),
            Purpose::SaveWind => self.canvas.painting.png().and_then(|bytes| save(&format!("{}-wind.png", self.stem()), &bytes)),
        };
        if let Err(problem) = done {
            self.problem = Some(problem);
        }
    }

    fn pick(&self, ending: &str) -> Result<(), String> {
        let wake = self.context.clone();
        self.dialog
            .pick(ending, move || wake.request_repaint())
            .ok_or_else(|| "the browser shows no dialog; drop the file on the page".to_owned())
    }

    fn stem(&self) -> String {
        let name = self.stage.as_ref().map_or_else(|| "scene".to_owned(), |stage| stage.source.name());
        name.trim_end_matches(".ron").to_owned()
    }

    /// What was chosen in the dialog.
    pub(super) fn chosen_files(&mut self, context: &egui::Context) {
        let Some((name, bytes)) = self.dialog.take() else { return };
        match self.purpose {
            Purpose::OpenWind => match Painting::from_png(&bytes) {
                Ok(painting) => {
                    self.canvas.painting = painting;
                    self.blow(context);
                }
                Err(problem) => self.problem = Some(format!("{name} {problem}")),
            },
            _ => self.open(context, Source::Text(name, String::from_utf8_lossy(&bytes).into_owned())),
        }
    }

    /// Saves the scene, and beside it the wind that was painted in it.
    fn save_scene(&mut self) -> Result<(), String> {
        let stem = self.stem();
        let Some(stage) = &self.stage else { return Ok(()) };
        let mut scene = stage.edited.clone();
        if super::painted::blows(&scene) {
            let name = format!("{stem}-wind.png");
            save(&name, stage.painted.as_ref().map_or(&[][..], |bytes| &bytes[..]))?;
            super::painted::named(&mut scene, &name);
        }
        save(&format!("{stem}.ron"), scene.to_ron().as_bytes())
    }
}
