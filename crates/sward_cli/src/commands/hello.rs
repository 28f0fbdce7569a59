//! `sward` alone: a first picture, and what to try next.

use std::path::PathBuf;

use super::render;
use crate::arguments::{Caching, Draw, Where};
use crate::cache::Cache;
use crate::console::Console;
use crate::failure::Failure;
use crate::scenes;

/// The scene to begin with. Its moment stands beside its name in the list of scenes.
const SCENE: &str = "hello";
/// Size of the picture, pixels.
const SIZE: [u32; 2] = [960, 540];

/// Draws the scene into the current folder.
pub(crate) fn run(console: &Console) -> Result<(), Failure> {
    let opened = scenes::open(SCENE)?;
    let path = PathBuf::from(format!("{SCENE}.png"));
    crate::output::picture(Some(&path), SCENE)?;
    let shot = render::single(&opened, None, 30, path.clone());
    let world = opened.world(&Cache::new(&Caching::default()), console)?;
    let done = render::draw(world, &[shot], None, None, SIZE, (Where::Auto, Draw::Auto), &Cache::new(&Caching::default()), console)?;
    let place = std::path::absolute(&path).unwrap_or(path);
    let [width, height] = SIZE;
    console.summary(&format!(
        "{}\n{}: {width}x{height}, made in {:.1} s; simulated on {}, drawn on {}.\n\n\
         Try next:\n  \
         sward scenes                                 other scenes\n  \
         sward render reed --time 4                   another picture\n  \
         sward scenes hello > my_scene.ron            a scene to change; then: sward render my_scene.ron\n  \
         cargo run --release -p sward_viewer          a window to play in",
        place.display(),
        opened.scene.title,
        done.seconds,
        done.on,
        done.artist,
    ))
}
