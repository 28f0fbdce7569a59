//! Wind painted by hand, in the scene.

use std::sync::Arc;

use eframe::egui;
use sward::scene::{Flow, FlowImage, Footprint, Path, Scene, Still, WindSource};

use super::Viewer;
use super::files::Purpose;
use crate::painting::PATH;
use crate::panels::painting::{self, Asked};
use crate::source::Painted;

/// The painted footprint of a scene.
fn print(scene: &mut Scene) -> Option<&mut Footprint> {
    scene.wind.iter_mut().find_map(|source| match source {
        WindSource::Footprint(print) if matches!(&print.flow, Flow::Image(image) if image.path == PATH) => Some(print),
        _ => None,
    })
}

/// Whether a scene has painted wind.
pub(super) fn blows(scene: &Scene) -> bool {
    print(&mut scene.clone()).is_some()
}

/// The painted wind is a file from now on.
pub(super) fn named(scene: &mut Scene, path: &str) {
    if let Some(print) = print(scene) {
        print.flow = Flow::Image(FlowImage { path: path.to_owned() });
    }
}

impl Viewer {
    /// The wind that is being painted, as scenes read it.
    pub(super) fn painted(&self) -> Painted {
        self.stage.as_ref().and_then(|stage| stage.painted.clone())
    }

    /// The canvas, and what somebody does on it.
    pub(super) fn canvas(&mut self, context: &egui::Context) {
        if !self.canvas.open {
            return;
        }
        let blown = self.stage.as_ref().is_some_and(|stage| blows(&stage.edited));
        match painting::show(context, &mut self.canvas, blown) {
            Some(Asked::Changed) if blown => self.blow(context),
            Some(Asked::Blow) => self.blow(context),
            Some(Asked::Still) => self.still(context),
            Some(Asked::Save) => self.ask_for(Purpose::SaveWind),
            Some(Asked::Open) => self.ask_for(Purpose::OpenWind),
            Some(Asked::Changed) | None => {}
        }
    }

    /// Lets the painted wind blow: where it is, or else where the camera looks.
    pub(super) fn blow(&mut self, context: &egui::Context) {
        let picture = match self.canvas.painting.png() {
            Ok(picture) => picture,
            Err(problem) => return self.problem = Some(problem),
        };
        let Some(stage) = &mut self.stage else { return };
        stage.painted = Some(Arc::new(picture));
        let mut scene = stage.edited.clone();
        if print(&mut scene).is_none() {
            let view = stage.world.camera();
            let corner = scene.origin.map(|patch| f64::from(patch) * f64::from(scene.field.patch_side));
            // Not farther ahead than one sees what it does.
            let way = [view.target[0] - view.eye[0], view.target[2] - view.eye[2]];
            let share = (25.0 / way[0].hypot(way[1]).max(1e-6)).min(1.0);
            let at = [view.eye[0] + way[0] * share + corner[0], view.eye[2] + way[1] * share + corner[1]];
            let flow = Flow::Image(FlowImage { path: PATH.to_owned() });
            scene.wind.push(WindSource::Footprint(Footprint {
                flow,
                path: Path::Still(Still { at, ..Still::default() }),
                ..Footprint::default()
            }));
        }
        if let Some(print) = print(&mut scene) {
            (print.radius, print.speed) = (self.canvas.radius, self.canvas.speed);
        }
        self.change(context, scene);
    }

    fn still(&mut self, context: &egui::Context) {
        let Some(stage) = &self.stage else { return };
        let mut scene = stage.edited.clone();
        scene.wind.retain(
            |source| !matches!(source, WindSource::Footprint(print) if matches!(&print.flow, Flow::Image(image) if image.path == PATH)),
        );
        self.change(context, scene);
    }
}
