//! Opening scenes: asked for by name, chosen, dropped, or written again.

use eframe::egui;
use web_time::Instant;

use super::{LOOK, Viewer};
use crate::camera::Camera;
use crate::loading::{Loading, What};
use crate::probe::Probe;
use crate::source::Source;
use crate::stage::Changed;

impl Viewer {
    /// Begins to open a scene; the one that is there goes on until the other is.
    pub(super) fn open(&mut self, context: &egui::Context, source: Source) {
        self.written = source.written();
        let wake = context.clone();
        self.loading =
            Some(Loading::begin(&self.means, (source, self.painted()), What::Source, self.backend, move || wake.request_repaint()));
        self.history.clear();
        self.queued = None;
    }

    /// Takes over what was made ready meanwhile.
    pub(super) fn arrive(&mut self, context: &egui::Context) {
        self.arrive_beside(context);
        // What waited for cells on their way.
        if self.loading.is_none()
            && let Some(scene) = self.queued.take()
        {
            self.change(context, scene);
        }
        let Some(answer) = self.loading.as_ref().and_then(Loading::poll) else { return };
        let changed = self.loading.take().is_some_and(|loading| loading.changed);
        match answer {
            Ok(Changed::Kept(kept)) => {
                let (scene, world) = *kept;
                self.problem = self.stage.as_mut().and_then(|stage| stage.go_on(scene, world).err());
                self.next(context);
            }
            Ok(Changed::Anew(mut stage)) => {
                self.problem = None;
                if let Some(before) = self.stage.as_ref().filter(|_| changed) {
                    stage.opened = before.opened.clone();
                } else {
                    let same = self.stage.as_ref().is_some_and(|before| before.source.name() == stage.source.name());
                    (self.drive, self.hand) = (None, None);
                    self.beside.stage = None;
                    if !same {
                        self.camera = Camera::default();
                        self.chosen = (!stage.world.scene.interactors.is_empty()).then_some(0);
                        self.probe = Probe::default();
                    }
                }
                self.longest = 0.0;
                (self.stage, self.fresh) = (Some(*stage), true);
                self.next(context);
            }
            Err(problem) => {
                // What the panel shows is what runs.
                if let Some(stage) = self.stage.as_mut().filter(|_| changed) {
                    stage.refused();
                }
                (self.problem, self.queued) = (Some(problem), None);
            }
        }
    }

    /// Goes on with the change that waits, or else with the other half of the window.
    fn next(&mut self, context: &egui::Context) {
        match self.queued.take() {
            Some(scene) => self.change(context, scene),
            None => self.follow_beside(context),
        }
    }

    /// Opens the scene's file again when somebody has written it.
    pub(super) fn reload(&mut self, context: &egui::Context) {
        if self.looked.elapsed().as_secs_f32() < LOOK || self.loading.is_some() {
            return;
        }
        self.looked = Instant::now();
        let source = self.stage.as_ref().map(|stage| stage.source.clone());
        if let Some(source) = source.filter(|source| source.written().is_some_and(|at| self.written != Some(at))) {
            self.open(context, source);
        }
    }

    /// Files that were dropped on the window.
    pub(super) fn receive(&mut self, context: &egui::Context) {
        let dropped = context.input(|input| input.raw.dropped_files.first().cloned());
        let Some(file) = dropped else { return };
        let text = file.bytes.as_ref().map(|bytes| String::from_utf8_lossy(bytes).into_owned());
        match (file.path, text) {
            (Some(path), _) => self.open(context, Source::File(path)),
            (None, Some(text)) => self.open(context, Source::Text(file.name, text)),
            (None, None) => {}
        }
    }
}
