//! A clip of the page, made by the browser's own encoder.

use js_sys::Array;
use wasm_bindgen::prelude::Closure;
use wasm_bindgen::{JsCast, JsValue};
use web_sys::{BlobEvent, MediaRecorder, MediaRecorderOptions, MediaStream, MediaStreamTrack};

use super::files::save_blob;
use super::surroundings::canvas;

/// What a clip may be, the first that the browser writes, and how such a file's name ends.
const KINDS: [(&str, &str); 3] = [("video/mp4;codecs=avc1.640028", "mp4"), ("video/mp4", "mp4"), ("video/webm", "webm")];
/// Grass is full of detail: bits a second.
const BITS: u32 = 24_000_000;

/// A clip in the making. It takes what the canvas shows, when it is shown.
pub struct Clip {
    recorder: MediaRecorder,
    stream: MediaStream,
    /// The file that will be saved.
    pub name: String,
}

impl Clip {
    /// Begins a clip named after a scene.
    ///
    /// # Errors
    /// The browser makes none.
    pub fn begin(stem: &str) -> Result<Self, String> {
        let refused = |_: JsValue| "this browser records no clips of pages".to_owned();
        let kind = KINDS.into_iter().find(|(kind, _)| MediaRecorder::is_type_supported(kind));
        let (kind, ending) = kind.ok_or_else(|| refused(JsValue::NULL))?;
        let stream = canvas()?.capture_stream().map_err(refused)?;
        let options = MediaRecorderOptions::new();
        options.set_mime_type(kind);
        options.set_video_bits_per_second(BITS);
        let recorder = MediaRecorder::new_with_media_stream_and_media_recorder_options(&stream, &options).map_err(refused)?;
        let name = format!("{stem}.{ending}");
        let file = name.clone();
        // All of it comes at the end, in one piece.
        let written = Closure::<dyn FnMut(BlobEvent)>::new(move |event: BlobEvent| {
            if let Some(blob) = event.data()
                && let Err(problem) = save_blob(&file, &blob)
            {
                log::error!("{problem}");
            }
        });
        recorder.set_ondataavailable(Some(written.as_ref().unchecked_ref()));
        // It is called after this clip is gone.
        written.forget();
        recorder.start().map_err(refused)?;
        Ok(Self { recorder, stream, name })
    }

    /// Ends it; the browser saves the file.
    ///
    /// # Errors
    /// The browser has lost it.
    pub fn end(self) -> Result<String, String> {
        self.recorder.stop().map_err(|_| format!("{}: the browser has ended this clip itself", self.name))?;
        let tracks: Array = self.stream.get_tracks();
        tracks.iter().filter_map(|track| track.dyn_into::<MediaStreamTrack>().ok()).for_each(|track| track.stop());
        Ok(self.name)
    }
}
