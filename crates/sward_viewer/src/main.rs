//! `sward_viewer`: a window, or a page, in which vegetation reacts.

#![forbid(unsafe_code)]

#[cfg(not(target_arch = "wasm32"))]
mod window;

#[cfg(not(target_arch = "wasm32"))]
fn main() -> std::process::ExitCode {
    window::open()
}

#[cfg(target_arch = "wasm32")]
fn main() {
    sward_viewer::page::open();
}
