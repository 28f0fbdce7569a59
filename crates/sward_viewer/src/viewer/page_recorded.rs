//! A clip of the page.

use super::Viewer;
use crate::page::clip::Clip;

impl Viewer {
    /// Begins a clip, or ends it: the browser saves it then.
    pub(super) fn record(&mut self) {
        let done = match self.recording.take() {
            Some(clip) => clip.end().map(|name| self.notice = Some(format!("saved among the downloads: {name}"))),
            None => {
                let stem = self.stage.as_ref().map_or_else(|| "clip".to_owned(), |stage| stage.source.name());
                Clip::begin(stem.trim_end_matches(".ron")).map(|clip| self.recording = Some(clip))
            }
        };
        if let Err(problem) = done {
            self.problem = Some(problem);
        }
    }
}
