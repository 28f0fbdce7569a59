//! Files of a page: chosen in the browser's own dialog, and saved where it saves downloads.

use std::cell::RefCell;
use std::rc::Rc;

use js_sys::{Array, Uint8Array};
use wasm_bindgen::JsCast;
use wasm_bindgen::prelude::Closure;
use wasm_bindgen_futures::{JsFuture, spawn_local};
use web_sys::{Blob, HtmlAnchorElement, HtmlInputElement, Url};

/// A file's name, and what is in it.
pub type Chosen = (String, Vec<u8>);

/// A file that is being chosen.
#[derive(Clone, Debug, Default)]
pub struct Dialog(Rc<RefCell<Option<Chosen>>>);

impl Dialog {
    /// Opens the browser's dialog for files that end in `ending`; `done` is called when one was chosen and read. `None` where there is no page.
    pub fn pick(&self, ending: &str, done: impl Fn() + 'static) -> Option<()> {
        let input: HtmlInputElement = web_sys::window()?.document()?.create_element("input").ok()?.dyn_into().ok()?;
        input.set_type("file");
        input.set_accept(ending);
        let (place, from, done) = (self.clone(), input.clone(), Rc::new(done));
        let chosen = Closure::<dyn FnMut()>::new(move || {
            let Some(file) = from.files().and_then(|files| files.get(0)) else { return };
            let (place, done) = (place.clone(), Rc::clone(&done));
            spawn_local(async move {
                if let Ok(bytes) = JsFuture::from(file.array_buffer()).await {
                    *place.0.borrow_mut() = Some((file.name(), Uint8Array::new(&bytes).to_vec()));
                    done();
                }
            });
        });
        input.set_onchange(Some(chosen.as_ref().unchecked_ref()));
        // It lives as long as the dialog, whose end nobody tells when nothing is chosen.
        chosen.forget();
        input.click();
        Some(())
    }

    /// What was chosen since the last call.
    pub fn take(&self) -> Option<Chosen> {
        self.0.borrow_mut().take()
    }
}

/// Saves a file where the browser saves downloads.
///
/// # Errors
/// The browser refuses it.
pub fn save(name: &str, bytes: &[u8]) -> Result<(), String> {
    let refused = || format!("{name}: the browser does not save it");
    let blob = Blob::new_with_u8_array_sequence(&Array::of1(&Uint8Array::from(bytes))).map_err(|_| refused())?;
    save_blob(name, &blob)
}

/// Saves what the browser holds already.
///
/// # Errors
/// The browser refuses it.
pub fn save_blob(name: &str, blob: &Blob) -> Result<(), String> {
    let refused = || format!("{name}: the browser does not save it");
    let address = Url::create_object_url_with_blob(blob).map_err(|_| refused())?;
    let document = web_sys::window().and_then(|window| window.document()).ok_or_else(refused)?;
    let anchor: HtmlAnchorElement = document.create_element("a").ok().and_then(|element| element.dyn_into().ok()).ok_or_else(refused)?;
    anchor.set_href(&address);
    anchor.set_download(name);
    anchor.click();
    Url::revoke_object_url(&address).map_err(|_| refused())
}
