//! Which graphics device a browser gives.

use js_sys::{Function, Promise, Reflect};
use wasm_bindgen::{JsCast, JsValue};
use wasm_bindgen_futures::JsFuture;

/// What a browser gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Adapter {
    /// Nothing.
    None,
    /// A processor that plays one.
    Software,
    /// A graphics card.
    Hardware,
}

/// Asks the browser.
pub(super) async fn find() -> Adapter {
    match ask().await {
        Ok(adapter) if adapter.is_object() => {
            let info = get(&adapter, "info").unwrap_or_default();
            let plays = [get(&adapter, "isFallbackAdapter"), get(&info, "isFallbackAdapter")];
            let software = plays.into_iter().flatten().any(|plays| plays.is_truthy())
                || get(&info, "architecture").and_then(|kind| kind.as_string()).is_some_and(|kind| kind == "swiftshader");
            if software { Adapter::Software } else { Adapter::Hardware }
        }
        _ => Adapter::None,
    }
}

/// `await navigator.gpu.requestAdapter()`, where that exists.
async fn ask() -> Result<JsValue, JsValue> {
    let navigator = web_sys::window().map(|window| window.navigator()).ok_or(JsValue::NULL)?;
    let gpu = get(&navigator, "gpu").ok_or(JsValue::NULL)?;
    let request = get(&gpu, "requestAdapter").ok_or(JsValue::NULL)?.dyn_into::<Function>()?;
    JsFuture::from(request.call0(&gpu)?.dyn_into::<Promise>()?).await
}

fn get(object: &JsValue, name: &str) -> Option<JsValue> {
    Reflect::get(object, &name.into()).ok().filter(|value| !value.is_undefined() && !value.is_null())
}
