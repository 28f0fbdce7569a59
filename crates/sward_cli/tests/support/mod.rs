//! Runs the built program in a folder of its own.
#![allow(dead_code)] // Each test program uses its own part.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A small scene that is quick to run: grass, a ball, gusts.
pub(crate) const SMALL: &str = r#"(
    version: 1,
    title: "Small",
    field: (patch_side: 8),
    stands: [(species: Meadow, cells: 16), (species: Lawn, cells: 8, name: "turf / mown")],
    wind: [Natural()],
    interactors: [
        (name: "ball", shape: Sphere(radius: 1), path: Circle(radius: 3, speed: 4)),
        (shape: Truck, from: 100),
    ],
    budget: (focus_distance: 10, lag_distance: 10),
)
"#;

/// An empty folder for one test.
pub(crate) struct Place(pub(crate) PathBuf);

impl Place {
    /// `name` is the test's.
    pub(crate) fn new(name: &str) -> Self {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("sward_cli").join(name);
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).expect("the target folder is writable");
        Self(folder)
    }

    /// The same, with [`SMALL`] as small.ron.
    pub(crate) fn with_small(name: &str) -> Self {
        let place = Self::new(name);
        place.write("small.ron", SMALL);
        place
    }

    pub(crate) fn write(&self, file: &str, text: impl AsRef<[u8]>) {
        let path = self.0.join(file);
        std::fs::create_dir_all(path.parent().expect("inside the folder")).expect("writable");
        std::fs::write(path, text).expect("writable");
    }

    /// Runs `sward` here.
    pub(crate) fn sward(&self, arguments: &[&str]) -> Ran {
        self.sward_with(arguments, &[])
    }

    /// The same, with environment variables.
    pub(crate) fn sward_with(&self, arguments: &[&str], variables: &[(&str, &str)]) -> Ran {
        let mut command = Command::new(env!("CARGO_BIN_EXE_sward"));
        command.current_dir(&self.0).args(arguments).envs(variables.iter().copied());
        Ran::from(command.output().expect("the program starts"))
    }

    /// Every file and folder below, sorted, relative.
    pub(crate) fn files(&self) -> Vec<String> {
        let mut found = Vec::new();
        let mut folders = vec![self.0.clone()];
        while let Some(folder) = folders.pop() {
            for entry in std::fs::read_dir(folder).expect("readable") {
                let path = entry.expect("readable").path();
                found.push(path.strip_prefix(&self.0).expect("below").to_string_lossy().into_owned());
                if path.is_dir() {
                    folders.push(path);
                }
            }
        }
        found.sort();
        found
    }

    /// Checks that `arguments` are refused: status 2, nothing on stdout, nothing written, and all `words` said. Returns all that is said.
    pub(crate) fn refuses(&self, arguments: &[&str], words: &[&str]) -> String {
        let before = self.files();
        let ran = self.sward(arguments);
        assert_eq!(ran.status, 2, "{arguments:?}\n{}", ran.errors);
        assert_eq!(ran.text, "", "{arguments:?}");
        for word in words {
            assert!(ran.errors.contains(word), "{arguments:?}: no `{word}` in\n{}", ran.errors);
        }
        assert_eq!(self.files(), before, "{arguments:?}");
        ran.errors
    }
}

/// What a run left.
pub(crate) struct Ran {
    pub(crate) status: i32,
    pub(crate) text: String,
    pub(crate) errors: String,
}

impl From<Output> for Ran {
    fn from(output: Output) -> Self {
        let words = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
        Self { status: output.status.code().unwrap_or(-1), text: words(output.stdout), errors: words(output.stderr) }
    }
}

impl Ran {
    /// Done, without complaint.
    pub(crate) fn done(self) -> String {
        assert_eq!(self.status, 0, "{}", self.errors);
        assert_eq!(self.errors, "");
        self.text
    }
}
