//! Two responses side by side: the same field, the same moment, the same hands at the wheel.

use eframe::egui;

use super::Viewer;
use crate::compare::with_response;
use crate::loading::{Loading, What};
use crate::stage::{Changed, Stage};

/// The other half of the window.
#[derive(Default)]
pub(super) struct Beside {
    /// Number of its response, where there is another half.
    pub(super) response: Option<usize>,
    pub(super) stage: Option<Stage>,
    pub(super) loading: Option<Loading>,
    /// The first half has changed again meanwhile.
    again: bool,
    /// Whether it waits for the cells of the first half.
    due: bool,
}

impl Viewer {
    /// Splits the window, or fills it with one picture again.
    pub(super) fn compare(&mut self, context: &egui::Context, response: Option<usize>) {
        self.beside = Beside { response, ..Beside::default() };
        self.follow_beside(context);
    }

    /// Makes the other half ready from where the first is now.
    pub(super) fn follow_beside(&mut self, context: &egui::Context) {
        let (Some(stage), Some(response)) = (&mut self.stage, self.beside.response) else { return };
        if self.beside.loading.is_some() {
            self.beside.again = true;
            return;
        }
        let scene = with_response(&stage.edited, response);
        self.beside.due = false;
        match stage.bring() {
            Ok(false) => self.beside.due = true,
            Ok(true) => {
                let world = stage.world.clone();
                let (wake, from) = (context.clone(), (stage.source.clone(), stage.painted.clone()));
                let what = What::Changed(Box::new((scene, world)), None);
                self.beside.loading = Some(Loading::begin(&self.means, from, what, self.backend, move || wake.request_repaint()));
            }
            Err(problem) => (self.problem, self.beside.response) = (Some(problem), None),
        }
    }

    /// Takes the other half over when it is ready.
    pub(super) fn arrive_beside(&mut self, context: &egui::Context) {
        if self.beside.due {
            self.follow_beside(context);
        }
        let Some(answer) = self.beside.loading.as_ref().and_then(Loading::poll) else { return };
        self.beside.loading = None;
        match answer {
            Ok(Changed::Anew(stage)) => self.beside.stage = Some(*stage),
            Ok(Changed::Kept(_)) => {}
            Err(problem) => (self.problem, self.beside.response) = (Some(problem), None),
        }
        if std::mem::take(&mut self.beside.again) {
            self.follow_beside(context);
        }
    }
}
