//! Records what is shown as a clip, picture by picture, beside the window.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, SyncSender, TrySendError, channel, sync_channel};

use sward::picture::Picture;
use sward_clip::Clip;

/// Pictures a second of the clip.
pub const RATE: u32 = 30;
/// Pictures that may wait for the encoder.
const WAITING: usize = 24;

/// A clip in the making.
pub struct Recording {
    path: PathBuf,
    size: [u32; 2],
    frames: Option<SyncSender<Vec<u8>>>,
    ended: Receiver<Result<(), String>>,
    /// Pictures taken.
    pub taken: u32,
}

/// A name that no file has yet: `meadow.mp4`, `meadow-2.mp4`, …
pub fn free(folder: &Path, stem: &str) -> PathBuf {
    let name = |number: u32| if number == 1 { format!("{stem}.mp4") } else { format!("{stem}-{number}.mp4") };
    let paths = (1..).map(|number| folder.join(name(number)));
    paths.into_iter().find(|path| !path.exists()).unwrap_or_else(|| folder.join("clip.mp4"))
}

impl Recording {
    /// Begins a clip of pictures of this size; an odd row or column is left out.
    ///
    /// # Errors
    /// The file cannot be written, or the size cannot be a clip's.
    pub fn begin(path: PathBuf, size: [u32; 2]) -> Result<Self, String> {
        let size = size.map(|side| side & !1);
        let unwritable = |error: std::io::Error| format!("{}: cannot be written: {error}", path.display());
        let beside = path.with_extension("part");
        let open = |path: &Path| File::options().read(true).write(true).create(true).truncate(true).open(path);
        let samples = open(&beside).map_err(unwritable)?;
        // Gone from the folder at once where the system allows it, else at the end.
        let mut clip = Clip::new(size, RATE, samples).map_err(|error| error.to_string())?;
        let (frames, taken) = sync_channel::<Vec<u8>>(WAITING);
        let (tell, ended) = channel();
        let file = path.clone();
        std::thread::spawn(move || {
            let pushed = taken.iter().try_for_each(|frame| clip.push(&frame).map_err(|error| error.to_string()));
            let written = pushed.and_then(|()| {
                let out = File::create(&file).map_err(|error| format!("{}: cannot be written: {error}", file.display()))?;
                clip.finish(out).map_err(|error| error.to_string())
            });
            let _ = std::fs::remove_file(beside);
            let _ = tell.send(written);
        });
        Ok(Self { path, size, frames: Some(frames), ended, taken: 0 })
    }

    /// Takes pictures that lie side by side; `false`: the encoder is not there yet, try again with the same one.
    pub fn take(&mut self, pictures: &[Picture]) -> bool {
        let Some(frames) = &self.frames else { return true };
        match frames.try_send(joined(pictures, self.size)) {
            Ok(()) => self.taken += 1,
            Err(TrySendError::Full(_)) => return false,
            // What went wrong is told at the end.
            Err(TrySendError::Disconnected(_)) => self.frames = None,
        }
        true
    }

    /// No more pictures; what is waiting is still encoded.
    pub fn stop(&mut self) {
        self.frames = None;
    }

    /// Whether it still takes pictures.
    pub fn runs(&self) -> bool {
        self.frames.is_some()
    }

    /// Where it is, once it is written.
    pub fn done(&self) -> Option<Result<PathBuf, String>> {
        let ended = self.ended.try_recv().ok()?;
        Some(ended.map(|()| self.path.clone()))
    }
}

/// Rows of red, green and blue of pictures side by side, cut or filled up to `size`.
fn joined(pictures: &[Picture], [width, height]: [u32; 2]) -> Vec<u8> {
    let mut rgb = Vec::with_capacity(3 * (width * height) as usize);
    for row in 0..height {
        let before = rgb.len();
        for picture in pictures.iter().filter(|picture| row < picture.height) {
            let line = &picture.rgba8[4 * (row * picture.width) as usize..][..4 * picture.width as usize];
            rgb.extend(line.chunks_exact(4).flat_map(|pixel| &pixel[..3]));
        }
        rgb.resize(before + 3 * width as usize, 0);
    }
    rgb
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plain(width: u32, height: u32, value: u8) -> Picture {
        Picture { width, height, rgba8: vec![value; 4 * (width * height) as usize] }
    }

    #[test]
    fn two_halves_make_one_frame() {
        let frame = joined(&[plain(3, 2, 10), plain(2, 2, 20)], [4, 4]);
        assert_eq!(frame.len(), 3 * 16);
        assert_eq!(frame[..12], [10, 10, 10, 10, 10, 10, 10, 10, 10, 20, 20, 20]);
        assert!(frame[24..].iter().all(|value| *value == 0), "no picture is so high");
    }

    #[test]
    fn a_clip_is_written_and_named_anew() {
        let folder = std::env::temp_dir().join(format!("sward recording {}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("writable");
        let path = free(&folder, "meadow");
        let mut recording = Recording::begin(path.clone(), [33, 33]).expect("begins");
        for value in 0..3 {
            while !recording.take(&[plain(33, 33, 80 * value)]) {
                std::thread::yield_now();
            }
        }
        recording.stop();
        let written = loop {
            if let Some(done) = recording.done() {
                break done.expect("written");
            }
            std::thread::yield_now();
        };
        assert_eq!((written.clone(), recording.taken), (path, 3));
        assert!(std::fs::read(&written).expect("there").windows(4).any(|four| four == b"av01"));
        assert_ne!(free(&folder, "meadow"), written);
        std::fs::remove_dir_all(folder).expect("removable");
    }
}
