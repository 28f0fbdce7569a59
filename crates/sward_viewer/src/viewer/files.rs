//! Files that are opened and saved: scenes, and painted wind.

#[cfg(not(target_arch = "wasm32"))]
use std::path::{Path, PathBuf};

#[cfg(not(target_arch = "wasm32"))]
use eframe::egui;

#[cfg(not(target_arch = "wasm32"))]
use super::Viewer;
#[cfg(not(target_arch = "wasm32"))]
use crate::painting::Painting;
#[cfg(not(target_arch = "wasm32"))]
use crate::source::Source;

/// What a file is for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Purpose {
    /// A scene to open.
    #[default]
    OpenScene,
    /// Where the scene goes.
    SaveScene,
    /// A picture of wind to go on painting.
    OpenWind,
    /// Where the painted wind goes.
    SaveWind,
}

#[cfg(not(target_arch = "wasm32"))]
impl Viewer {
    /// Asks which file.
    pub(super) fn ask_for(&mut self, purpose: Purpose) {
        self.purpose = purpose;
        let stem = self.stage.as_ref().map_or_else(|| "scene".to_owned(), |stage| stage.source.name());
        let config = self.dialog.config_mut();
        match purpose {
            Purpose::OpenScene | Purpose::OpenWind => self.dialog.pick_file(),
            Purpose::SaveScene => {
                config.default_file_name = format!("{stem}.ron");
                self.dialog.save_file();
            }
            Purpose::SaveWind => {
                config.default_file_name = format!("{stem}-wind.png");
                self.dialog.save_file();
            }
        }
    }

    /// What was chosen in the dialog.
    pub(super) fn chosen_files(&mut self, context: &egui::Context) {
        self.dialog.update(context);
        let Some(path) = self.dialog.take_picked() else { return };
        let done = match self.purpose {
            Purpose::OpenScene => {
                self.open(context, Source::File(path));
                Ok(())
            }
            Purpose::SaveScene => self.save_scene(context, path),
            Purpose::OpenWind => self.open_wind(context, &path),
            Purpose::SaveWind => self.save_wind(&path),
        };
        if let Err(problem) = done {
            self.problem = Some(problem);
        }
    }

    /// Writes the scene, and beside it the wind that was painted in it. From then on that file is what is shown.
    pub(super) fn save_scene(&mut self, context: &egui::Context, path: PathBuf) -> Result<(), String> {
        let Some(stage) = &mut self.stage else { return Ok(()) };
        let mut scene = stage.edited.clone();
        if super::painted::blows(&scene) {
            let stem = path.file_stem().map_or_else(|| "scene".into(), |stem| stem.to_string_lossy().into_owned());
            let name = format!("{stem}-wind.png");
            write(&path.with_file_name(&name), stage.painted.as_ref().map_or(&[][..], |bytes| &bytes[..]))?;
            super::painted::named(&mut scene, &name);
        }
        write(&path, scene.to_ron().as_bytes())?;
        self.notice = Some(format!("saved: {}", path.display()));
        self.open(context, Source::File(path));
        Ok(())
    }

    fn open_wind(&mut self, context: &egui::Context, path: &Path) -> Result<(), String> {
        let bytes = std::fs::read(path).map_err(|error| format!("{}: cannot be read: {error}", path.display()))?;
        self.canvas.painting = Painting::from_png(&bytes).map_err(|error| format!("{} {error}", path.display()))?;
        self.blow(context);
        Ok(())
    }

    fn save_wind(&mut self, path: &Path) -> Result<(), String> {
        write(path, &self.canvas.painting.png()?)?;
        self.notice = Some(format!("saved: {}; a scene names it so: Footprint(flow: Image(path: \"…\"))", path.display()));
        Ok(())
    }
}

#[cfg(not(target_arch = "wasm32"))]
fn write(path: &Path, bytes: &[u8]) -> Result<(), String> {
    std::fs::write(path, bytes).map_err(|error| format!("{}: cannot be written: {error}", path.display()))
}
