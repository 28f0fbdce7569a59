//! What panels and keys asked for, done once the window is laid out.

use eframe::egui;

use super::Viewer;
use crate::camera::Kind;
use crate::drive::{Drive, Vehicle};
use crate::panels::tools::Wish;

impl Viewer {
    pub(super) fn grant(&mut self, context: &egui::Context, wish: Wish) {
        match wish {
            Wish::Restart => {
                if let Some(stage) = &self.stage {
                    let source = stage.source.clone();
                    self.open(context, source);
                }
            }
            Wish::Camera(kind) => {
                if let Some(stage) = &self.stage {
                    let view = stage.world.camera();
                    self.camera.take(kind, &view);
                }
            }
            Wish::Choose(body) => {
                (self.chosen, self.drive) = (Some(body), None);
            }
            Wish::Wheel => self.drive = if self.drive.is_some() { None } else { self.take_wheel() },
            Wish::Step(backend) => {
                self.backend = backend;
                let both = self.stage.iter_mut().chain(&mut self.beside.stage);
                match both.map(|stage| stage.step_on(backend)).try_fold(true, |all, own| own.map(|own| all & own)) {
                    Ok(true) => self.problem = None,
                    // Its cells are on their way.
                    Ok(false) => self.later.push(wish),
                    Err(problem) => self.problem = Some(problem),
                }
            }
            Wish::Undo => {
                if let Some(scene) = self.history.pop() {
                    self.change(context, scene);
                }
            }
            Wish::Record => self.record(),
            Wish::Compare(response) => self.compare(context, response),
        }
    }

    pub(super) fn take_wheel(&mut self) -> Option<Drive> {
        let (stage, body) = (self.stage.as_mut()?, self.chosen?);
        let place = stage.world.take_over(body)?;
        let shape = &stage.world.scene.interactors.get(body)?.shape;
        if self.camera.kind == Kind::Scene {
            let view = stage.world.camera();
            self.camera.take(Kind::Follow, &view);
        }
        Some(Drive::new(body, Vehicle::of(shape, place.2), place))
    }
}
