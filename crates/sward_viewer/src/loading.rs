//! Opening scenes beside the window: nothing waits for it.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use sward::scene::Scene;
use sward_wgpu::gpu::Gpu;

use crate::source::Source;
use crate::stage::{Backend, Stage};

/// A scene that is being opened.
pub struct Loading {
    /// Where it comes from.
    pub source: Source,
    /// Whether it is a changed scene that is shown already.
    pub changed: bool,
    answer: Receiver<Result<Stage, String>>,
}

impl Loading {
    /// Begins to open a scene; with `scene` instead of what the source says now. `done` is called at the end, from elsewhere.
    pub fn begin(gpu: &Arc<Gpu>, source: Source, scene: Option<Scene>, backend: Backend, done: impl FnOnce() + Send + 'static) -> Self {
        let (tell, answer) = channel();
        let changed = scene.is_some();
        let (gpu, from) = (Arc::clone(gpu), source.clone());
        elsewhere(move || {
            let opened = scene.map_or_else(|| from.scene(), Ok).and_then(|scene| Stage::new(&gpu, from, scene, backend));
            // Nobody waits any more if another scene was asked for.
            let _ = tell.send(opened);
            done();
        });
        Self { source, changed, answer }
    }

    /// The scene, once it is there.
    pub fn poll(&self) -> Option<Result<Stage, String>> {
        match self.answer.try_recv() {
            Ok(answer) => Some(answer),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(Err("the scene was not opened: its thread ended".to_owned())),
        }
    }
}

#[cfg(not(target_arch = "wasm32"))]
fn elsewhere(work: impl FnOnce() + Send + 'static) {
    std::thread::spawn(work);
}

/// A page has one thread.
#[cfg(target_arch = "wasm32")]
fn elsewhere(work: impl FnOnce() + 'static) {
    work();
}
