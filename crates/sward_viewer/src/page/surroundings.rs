//! The page around the picture: its canvas, its words, its address.

use js_sys::{JSON, Reflect};
use wasm_bindgen::prelude::Closure;
use wasm_bindgen::{JsCast, JsValue};
use web_sys::{Document, HtmlCanvasElement};

/// Milliseconds between two looks at whether all is well.
const LOOK: i32 = 500;

fn document() -> Result<Document, String> {
    web_sys::window().and_then(|window| window.document()).ok_or_else(|| "there is no page".to_owned())
}

/// What the address says.
pub(super) fn search() -> String {
    web_sys::window().and_then(|window| window.location().search().ok()).unwrap_or_default()
}

/// Where the picture goes.
pub(super) fn canvas() -> Result<HtmlCanvasElement, String> {
    let canvas = document()?.get_element_by_id("sward").and_then(|element| element.dyn_into().ok());
    canvas.ok_or_else(|| "the page has no canvas named \"sward\"".to_owned())
}

/// Puts a canvas in its place that nobody has drawn on.
pub(super) fn fresh_canvas() -> Result<(), String> {
    let before = canvas()?;
    let failed = |_| "the page's canvas cannot be replaced".to_owned();
    let fresh = document()?.create_element("canvas").map_err(failed)?;
    fresh.set_id("sward");
    before.replace_with_with_node_1(&fresh).map_err(failed)
}

/// Words over the picture; none if they are empty.
pub(super) fn say(words: &str) {
    let Some(place) = document().ok().and_then(|document| document.get_element_by_id("words")) else { return };
    if let Some(paragraph) = place.first_element_child() {
        paragraph.set_text_content(Some(words));
    }
    let _ = place.toggle_attribute_with_force("hidden", words.is_empty());
}

/// Words beside the picture, which do not hide it.
pub(super) fn mention(words: &str) {
    if let Some(place) = document().ok().and_then(|document| document.get_element_by_id("aside")) {
        place.set_text_content(Some(words));
    }
}

/// Tells scripts: `window.sward_status` is what `text`, which is JSON, says.
pub fn publish(text: &str) {
    if let (Some(window), Ok(status)) = (web_sys::window(), JSON::parse(text)) {
        let _ = Reflect::set(&window, &JsValue::from("sward_status"), &status);
    }
}

/// Looks now and then whether the program has ended, and says why.
pub(super) fn watch(ended: impl Fn() -> Option<String> + 'static) {
    let look = Closure::<dyn FnMut()>::new(move || {
        if let Some(why) = ended() {
            say(&format!("sward has stopped, which is a mistake in it: {why}. Please report it; reloading the page begins again."));
        }
    });
    if let Some(window) = web_sys::window() {
        let _ = window.set_interval_with_callback_and_timeout_and_arguments_0(look.as_ref().unchecked_ref(), LOOK);
    }
    look.forget();
}
