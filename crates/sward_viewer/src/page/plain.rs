//! Where there is neither WebGPU nor WebGL: the picture alone on a plain canvas.

use web_sys::HtmlCanvasElement;

use crate::address::Address;

/// Shows the picture.
pub(super) fn run(_canvas: HtmlCanvasElement, _address: Address, _notice: String) -> Result<(), String> {
    Err("neither WebGPU nor WebGL is there".to_owned())
}
