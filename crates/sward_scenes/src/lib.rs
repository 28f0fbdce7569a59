//! The scenes that come with sward, and the files they need: one list for the command line, the window and the browser.

#![forbid(unsafe_code)]

use std::path::PathBuf;

use sward::model::{Assets, Folder};

/// A scene that comes with sward.
#[derive(Clone, Copy, Debug)]
pub struct Shipped {
    /// What to type.
    pub name: &'static str,
    /// The scene.
    pub text: &'static str,
    /// A good moment for a picture, s.
    pub time: f64,
}

macro_rules! shipped {
    ($($name:literal at $time:literal;)*) => {
        &[$(Shipped { name: $name, text: include_str!(concat!("../../../scenes/", $name, ".ron")), time: $time }),*]
    };
}

/// All of them. In `hello` the pickup is near the camera at 6.2 s, and its whole track is in view.
pub const SHIPPED: &[Shipped] = shipped! {
    "hello" at 6.2;
    "lawn" at 6.0;
    "reed" at 5.0;
    "crossing" at 7.0;
    "downwash" at 6.5;
    "road" at 6.4;
    "paper" at 5.2;
    "endless" at 5.0;
    "blades" at 5.0;
    "grassland" at 4.0;
    "footsteps" at 5.2;
    "stamp" at 7.3;
    "walkers" at 8.0;
    "eddies" at 3.0;
    "shrub" at 2.0;
    "crown" at 3.0;
    "aquarium" at 3.0;
    "field" at 3.0;
    "everything" at 8.5;
};

/// The files that come with sward.
#[derive(Clone, Copy, Debug)]
pub struct Embedded;

const FILES: &[(&str, &[u8])] = &[
    ("assets/jacksboro.png", include_bytes!("../../../assets/jacksboro.png")),
    ("assets/jacksboro.toml", include_bytes!("../../../assets/jacksboro.toml")),
    ("assets/clump.png", include_bytes!("../../../assets/clump.png")),
    ("assets/helicopter.glb", include_bytes!("../../../assets/helicopter.glb")),
    ("assets/torus.glb", include_bytes!("../../../assets/torus.glb")),
    ("assets/walker.glb", include_bytes!("../../../assets/walker.glb")),
];

impl Assets for Embedded {
    fn read(&self, path: &str) -> Result<Vec<u8>, String> {
        let file = FILES.iter().find(|(name, _)| *name == path);
        file.map(|(_, bytes)| bytes.to_vec()).ok_or_else(|| format!("{path} does not come with sward"))
    }
}

/// Files near a scene: in this folder, in the folder above, or among those that come with sward.
#[derive(Clone, Debug)]
pub struct Near(pub PathBuf);

impl Assets for Near {
    fn read(&self, path: &str) -> Result<Vec<u8>, String> {
        let folders = [self.0.clone(), self.0.join("..")];
        let found = folders.iter().find(|folder| folder.join(path).is_file());
        match found {
            Some(folder) => Folder(folder.clone()).read(path),
            None => Embedded.read(path).map_err(|_| format!("{path} is neither in {} nor in the folder above", self.0.display())),
        }
    }
}

/// The shipped scene of this name.
pub fn shipped(name: &str) -> Option<&'static Shipped> {
    SHIPPED.iter().find(|scene| scene.name == name)
}
