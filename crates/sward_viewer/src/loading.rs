//! Opening scenes beside the window: nothing waits for it.

use std::sync::mpsc::{Receiver, TryRecvError, channel};

use sward::scene::Scene;
use sward::world::World;

use crate::painter::Means;
use crate::source::Source;
use crate::stage::{Backend, Changed, From, Stage};

/// What is to be made ready.
pub enum What {
    /// What the source says now.
    Source,
    /// A changed scene, from where a world is; and the scene that is drawn now, if what draws it may go on.
    Changed(Box<(Scene, World)>, Option<Box<Scene>>),
}

/// A scene that is being opened.
pub struct Loading {
    /// Where it comes from.
    pub source: Source,
    /// Whether it is a changed scene that is shown already.
    pub changed: bool,
    answer: Receiver<Result<Changed, String>>,
}

impl Loading {
    /// Begins to open a scene. `done` is called at the end, from elsewhere.
    pub fn begin(means: &Means, from: From, what: What, backend: Backend, done: impl FnOnce() + Send + 'static) -> Self {
        let (tell, answer) = channel();
        let changed = matches!(what, What::Changed(..));
        let (means, source) = (means.clone(), from.0.clone());
        elsewhere(async move || {
            let opened = match what {
                What::Source => match from.0.scene() {
                    Ok(scene) => Stage::new(&means, from, scene, backend).await.map(|stage| Changed::Anew(Box::new(stage))),
                    Err(problem) => Err(problem),
                },
                What::Changed(here, running) => Stage::changed(&means, from, running.as_deref(), here.0, here.1, backend).await,
            };
            // Nobody waits any more if another scene was asked for.
            let _ = tell.send(opened);
            done();
        });
        Self { source, changed, answer }
    }

    /// The scene, once it is there.
    pub fn poll(&self) -> Option<Result<Changed, String>> {
        match self.answer.try_recv() {
            Ok(answer) => Some(answer),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(Err("the scene was not opened: its thread ended".to_owned())),
        }
    }
}

#[cfg(not(target_arch = "wasm32"))]
fn elsewhere<F: Future<Output = ()>>(work: impl FnOnce() -> F + Send + 'static) {
    std::thread::spawn(|| pollster::block_on(work()));
}

/// A page has one thread: pictures come between the parts of the work.
#[cfg(target_arch = "wasm32")]
fn elsewhere<F: Future<Output = ()> + 'static>(work: impl FnOnce() -> F + 'static) {
    wasm_bindgen_futures::spawn_local(async {
        breathe().await;
        work().await;
    });
}

/// Lets a page answer, and show a picture, between two parts of long work; elsewhere nothing waits for it.
pub async fn breathe() {
    #[cfg(target_arch = "wasm32")]
    crate::page::breathe().await;
}
