//! Where a scene comes from: one that is shipped, or a file of one's own that may change while it is shown.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use sward::model::Assets;
use sward::scene::{Scene, SceneError};
use sward_scenes::{Embedded, Near, Shipped};

/// The picture of the wind that is being painted, if there is one.
pub type Painted = Option<Arc<Vec<u8>>>;

/// Files, and the wind that is being painted.
struct WithPainted {
    wind: Arc<Vec<u8>>,
    others: Box<dyn Assets>,
}

impl Assets for WithPainted {
    fn read(&self, path: &str) -> Result<Vec<u8>, String> {
        if path == crate::painting::PATH { Ok(self.wind.to_vec()) } else { self.others.read(path) }
    }
}

/// Where a scene comes from.
#[derive(Clone, Debug)]
pub enum Source {
    /// It comes with sward.
    Shipped(&'static Shipped),
    /// A file.
    File(PathBuf),
    /// A text that was dropped where there are no files: its name, and itself.
    Text(String, String),
}

impl Source {
    /// A shipped scene's name, or a file's path.
    pub fn named(name: &str) -> Self {
        sward_scenes::shipped(name).map_or_else(|| Self::File(name.into()), Self::Shipped)
    }

    /// How it is named the next time; `None` for a text that was dropped.
    pub fn remembered(&self) -> Option<String> {
        match self {
            Self::Shipped(shipped) => Some(shipped.name.to_owned()),
            Self::File(path) => Some(path.display().to_string()),
            Self::Text(..) => None,
        }
    }

    /// Whether it can still be opened.
    pub fn is_there(&self) -> bool {
        if let Self::File(path) = self { path.is_file() } else { true }
    }

    /// What a title says.
    pub fn name(&self) -> String {
        match self {
            Self::Shipped(shipped) => shipped.name.to_owned(),
            Self::File(path) => path.file_stem().map_or_else(|| "scene".to_owned(), |stem| stem.to_string_lossy().into_owned()),
            Self::Text(name, _) => name.clone(),
        }
    }

    /// The file's name in messages.
    fn file(&self) -> String {
        match self {
            Self::Shipped(shipped) => format!("{}.ron", shipped.name),
            Self::File(path) => path.display().to_string(),
            Self::Text(name, _) => name.clone(),
        }
    }

    /// The scene's text.
    ///
    /// # Errors
    /// Why the file cannot be read, in plain words.
    pub fn text(&self) -> Result<String, String> {
        match self {
            Self::Shipped(shipped) => Ok(shipped.text.to_owned()),
            Self::Text(_, text) => Ok(text.clone()),
            Self::File(path) if cfg!(target_arch = "wasm32") => {
                let names: Vec<&str> = sward_scenes::SHIPPED.iter().map(|shipped| shipped.name).collect();
                Err(format!(
                    "{}: no scene of this name comes with sward. These do: {}. Drop a file on the page to open it",
                    path.display(),
                    names.join(", ")
                ))
            }
            Self::File(path) => std::fs::read_to_string(path).map_err(|error| format!("{}: cannot be read: {error}", path.display())),
        }
    }

    /// The scene.
    ///
    /// # Errors
    /// What is wrong, where, and what to type instead.
    pub fn scene(&self) -> Result<Scene, String> {
        let (text, file) = (self.text()?, self.file());
        Scene::parse(&text, &file).map_err(|error| error.to_string())
    }

    /// An error of compiling the scene, with the place in its text.
    pub fn located(&self, error: SceneError) -> String {
        match self.text() {
            Ok(text) => error.located(&text, &self.file()).to_string(),
            Err(_) => error.to_string(),
        }
    }

    /// The files it names; among them the wind that is being painted.
    pub fn assets(&self, painted: Painted) -> Box<dyn Assets> {
        let others: Box<dyn Assets> = match self {
            Self::File(path) => {
                let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
                Box::new(Near(folder.to_owned()))
            }
            _ => Box::new(Embedded),
        };
        match painted {
            Some(wind) => Box::new(WithPainted { wind, others }),
            None => others,
        }
    }

    /// When its file was last written; `None` for what is no file, or is gone.
    pub fn written(&self) -> Option<std::time::SystemTime> {
        match self {
            Self::File(path) => std::fs::metadata(path).and_then(|about| about.modified()).ok(),
            _ => None,
        }
    }
}
