//! A clip of what is shown.

use super::Viewer;
use super::hung::Hung;
use crate::recording::{RATE, Recording, free};

impl Viewer {
    /// Begins a clip in the folder the window was opened in, or ends it.
    pub(super) fn record(&mut self) {
        match &mut self.recording {
            Some(recording) => recording.stop(),
            None => self.record_next = true,
        }
    }

    /// Seconds that pass for the next picture while a clip is made: a clip runs evenly however long its pictures take. `None`: the clock counts.
    pub(super) fn paced(&self) -> Option<f64> {
        let recording = self.recording.as_ref().filter(|recording| recording.runs())?;
        Some(if self.waiting.is_some() {
            0.0
        } else {
            self.clock.pace / f64::from(RATE) * f64::from(u8::from(recording.runs() && !self.clock.paused))
        })
    }

    /// Takes the pictures just drawn into the clip, and hears whether one is finished.
    pub(super) fn roll(&mut self) {
        if std::mem::take(&mut self.record_next)
            && let Some([width, height]) = self.hung[0].as_ref().map(Hung::size)
        {
            let wide = if self.beside.stage.is_some() { 2 } else { 1 };
            let size = [wide * width, height];
            let stem = self.stage.as_ref().map_or_else(|| "clip".to_owned(), |stage| stage.source.name());
            match Recording::begin(free(&std::env::current_dir().unwrap_or_default(), &stem), size) {
                Ok(recording) => self.recording = Some(recording),
                Err(problem) => self.problem = Some(problem),
            }
        }
        let Some(recording) = &mut self.recording else { return };
        if recording.runs() {
            if self.waiting.is_none() {
                let both = self.stage.iter().chain(&self.beside.stage);
                match both.map(|stage| stage.picture()).collect::<Result<Vec<_>, _>>() {
                    Ok(pictures) => self.waiting = Some(pictures),
                    Err(problem) => self.problem = Some(problem),
                }
            }
            if self.waiting.as_ref().is_some_and(|pictures| recording.take(pictures)) {
                self.waiting = None;
            }
        }
        if let Some(done) = recording.done() {
            let pictures = recording.taken;
            match done {
                Ok(path) => self.notice = Some(format!("{pictures} pictures in {}", path.display())),
                Err(problem) => self.problem = Some(problem),
            }
            (self.recording, self.waiting) = (None, None);
        }
    }
}
