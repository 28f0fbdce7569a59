//! Scenes by name or path, and the files they need.

use std::path::Path;

use sward::model::Assets;
use sward::scene::Scene;
use sward::world::World;
use sward_scenes::{Embedded, Near, Shipped};
pub(crate) use sward_scenes::{SHIPPED, shipped};

use crate::cache::Cache;
use crate::console::Console;
use crate::failure::Failure;
use crate::fingerprint::{Fingerprint, Witness};

/// A larger file is no scene, bytes.
const LARGEST: u64 = 16 << 20;
/// Moment of a picture of a scene that does not come with sward, s.
const USUAL_TIME: f64 = 5.0;

/// A scene, read and checked, and where its files are.
pub(crate) struct Opened {
    /// Name for files and messages: of the shipped scene, or of the file without its ending.
    pub(crate) name: String,
    /// The scene as written.
    pub(crate) scene: Scene,
    /// A good moment for a picture, s.
    pub(crate) time: f64,
    /// What the author typed, and the file's name.
    source: [String; 2],
    assets: Box<dyn Assets>,
}

impl Opened {
    /// The world at time 0.
    pub(crate) fn world(&self, cache: &Cache, console: &Console) -> Result<World, Failure> {
        Ok(self.world_and_fingerprint(cache, console)?.0)
    }

    /// The world at time 0, and the fingerprint of the scene and of the files it was made of.
    pub(crate) fn world_and_fingerprint(&self, cache: &Cache, console: &Console) -> Result<(World, Fingerprint), Failure> {
        let [text, file] = &self.source;
        let witness = Witness::new(&self.scene, &*self.assets, cache, console);
        let world = World::new(self.scene.clone(), &witness).map_err(|error| error.located(text, file))?;
        Ok((world, witness.seen()))
    }
}

/// Opens a scene by its shipped name or its path.
pub(crate) fn open(scene: &str) -> Result<Opened, Failure> {
    if let Some(shipped) = shipped(scene) {
        let file = format!("{scene}.ron");
        let parsed = Scene::parse(shipped.text, &file)?;
        let source = [shipped.text.to_owned(), file];
        return Ok(Opened { name: scene.to_owned(), scene: parsed, time: shipped.time, source, assets: Box::new(Embedded) });
    }
    let path = Path::new(scene);
    let looks_like_path = scene.contains(['/', '\\']) || path.extension().is_some();
    if !looks_like_path && !path.exists() {
        return Err(unknown(scene));
    }
    let text = text_of(path)?;
    let parsed = Scene::parse(&text, scene)?;
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let name = path.file_stem().map_or_else(|| "scene".to_owned(), |stem| stem.to_string_lossy().into_owned());
    let source = [text, scene.to_owned()];
    Ok(Opened { name, scene: parsed, time: USUAL_TIME, source, assets: Box::new(Near(folder.to_owned())) })
}

fn text_of(path: &Path) -> Result<String, Failure> {
    let shown = path.display();
    let about = std::fs::metadata(path).map_err(|error| {
        let stem = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
        let help = match nearest(stem) {
            Some(name) => format!("check the path, or type the name of a shipped scene: {name}"),
            None => format!("check the path, or type the name of a shipped scene: {}", names()),
        };
        Failure::input(format!("the scene {shown} cannot be read: {error}"), help)
    })?;
    if about.is_dir() {
        return Err(Failure::input(format!("{shown} is a folder, not a scene"), format!("type the file: {shown}/NAME.ron")));
    }
    if !about.is_file() || about.len() > LARGEST {
        return Err(Failure::input(format!("{shown} is not a scene file"), "a scene is a text file of at most 16 MB"));
    }
    let bytes =
        std::fs::read(path).map_err(|error| Failure::input(format!("the scene {shown} cannot be read: {error}"), "check the path"))?;
    String::from_utf8(bytes).map_err(|_| Failure::input(format!("{shown} is not UTF-8 text"), "save it as UTF-8, or name a .ron file"))
}

/// Complains about a name that no shipped scene has.
pub(crate) fn unknown(name: &str) -> Failure {
    let guess = nearest(name).map_or_else(String::new, |near| format!("did you mean `{near}`? "));
    let help = format!("{guess}shipped scenes: {}; for a file of your own, type its path: {name}.ron", names());
    Failure::input(format!("there is no scene called `{name}`"), help)
}

fn names() -> String {
    SHIPPED.iter().map(|scene| scene.name).collect::<Vec<_>>().join(", ")
}

fn nearest(name: &str) -> Option<&'static str> {
    let likeness = |scene: &Shipped| strsim::jaro_winkler(&name.to_lowercase(), scene.name);
    let near = SHIPPED.iter().max_by(|a, b| likeness(a).total_cmp(&likeness(b)))?;
    (likeness(near) > 0.7).then_some(near.name)
}
