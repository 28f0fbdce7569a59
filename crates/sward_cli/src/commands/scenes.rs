//! `sward scenes`: what comes with sward.

use sward::scene::Scene;

use crate::arguments;
use crate::console::Console;
use crate::failure::Failure;
use crate::scenes::{SHIPPED, shipped, unknown};

/// Prints the list, or one scene's text.
pub(crate) fn run(arguments: &arguments::Scenes, console: &Console) -> Result<(), Failure> {
    match &arguments.name {
        Some(name) => console.answer(shipped(name).ok_or_else(|| unknown(name))?.text),
        None => console.answer(&list()?),
    }
}

/// A line for each scene: name, title, and the comment the scene begins with.
fn list() -> Result<String, Failure> {
    let mut text = String::new();
    for shipped in SHIPPED {
        let title = Scene::parse(shipped.text, shipped.name)?.title;
        let about = shipped.text.lines().next().unwrap_or_default().trim_start_matches(['/', ' ']);
        text += &format!("{:<10} {title:<22} {about}\n", shipped.name);
    }
    Ok(text)
}
