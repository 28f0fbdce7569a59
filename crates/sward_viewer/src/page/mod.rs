//! The same in a browser: with WebGPU as in a window; without it the processor draws, and WebGL shows that; without either, a plain canvas does.

mod adapter;
pub mod clip;
pub mod files;
mod plain;
mod surroundings;

use eframe::egui_wgpu;
use wasm_bindgen::{JsCast, JsValue};

use crate::address::Address;
use crate::status::Log;
use crate::viewer::{Settings, Viewer};
use adapter::Adapter;
pub use surroundings::publish;
use surroundings::{canvas, fresh_canvas, say, search, watch};

/// What a page says that has no device.
const WITHOUT: &str = "This browser gives no graphics device (WebGPU), so the processor does everything, and its pictures are small. Chrome and Edge have WebGPU, \
    on Linux behind chrome://flags/#enable-unsafe-webgpu; Firefox since 141 on Windows, Safari since 26. Pages must come by https or from localhost.";

/// Fills the page, as its address says.
pub fn open() {
    let _ = eframe::WebLogger::init(log::LevelFilter::Warn);
    wasm_bindgen_futures::spawn_local(async {
        if let Err(problem) = begin(Address::of(&search())).await {
            say(&format!("The page could not be started: {problem}"));
        }
    });
}

async fn begin(address: Address) -> Result<(), String> {
    let adapter = if address.raster || address.plain { Adapter::None } else { adapter::find().await };
    let mut notice = (adapter == Adapter::None && !address.raster).then(|| WITHOUT.to_owned());
    if adapter != Adapter::None {
        let settings = Settings { software: adapter == Adapter::Software, ..settings(&address, None) };
        match run(canvas()?, eframe::Renderer::Wgpu, settings).await {
            Ok(()) => return Ok(()),
            Err(problem) => notice = Some(format!("{WITHOUT} The device that was there could not be used: {problem}")),
        }
        // One that was asked for a device gives nothing else.
        fresh_canvas()?;
    }
    if !address.plain {
        let settings = settings(&address, notice.clone());
        if run(canvas()?, eframe::Renderer::Glow, settings).await.is_ok() {
            return Ok(());
        }
        fresh_canvas()?;
    }
    plain::run(canvas()?, address, notice.unwrap_or_default()).await
}

/// How the page begins.
fn settings(address: &Address, notice: Option<String>) -> Settings {
    Settings {
        scene: address.scene.clone(),
        steps: address.steps,
        fineness: address.pixels,
        near: address.plants,
        status: address.status.then_some(Log::Page),
        backend: address.backend,
        notice: Some([notice, address.problem.clone()].into_iter().flatten().collect::<Vec<_>>().join("\n"))
            .filter(|words| !words.is_empty()),
        ..Settings::default()
    }
}

/// Hands the canvas to eframe.
async fn run(canvas: web_sys::HtmlCanvasElement, renderer: eframe::Renderer, settings: Settings) -> Result<(), String> {
    let options = eframe::WebOptions { renderer, wgpu_options: egui_wgpu::WgpuConfiguration::default(), ..Default::default() };
    let runner = eframe::WebRunner::new();
    let begun = runner.start(canvas.clone(), options, Box::new(|context| Ok(Box::new(Viewer::new(context, settings))))).await;
    begun.map_err(|problem| words(&problem))?;
    say("");
    // Keys go to what has the focus.
    let _ = canvas.focus();
    watch(move || runner.panic_summary().map(|summary| summary.message()));
    Ok(())
}

/// Lets the browser answer, and show a picture.
pub async fn breathe() {
    let later = js_sys::Promise::new(&mut |resolve, _| {
        if let Some(window) = web_sys::window() {
            let _ = window.set_timeout_with_callback(&resolve);
        }
    });
    let _ = wasm_bindgen_futures::JsFuture::from(later).await;
}

/// What a browser throws, in words.
fn words(thrown: &JsValue) -> String {
    let error = thrown.dyn_ref::<js_sys::Error>().map(|error| String::from(error.message()));
    error.or_else(|| thrown.as_string()).unwrap_or_else(|| format!("{thrown:?}"))
}
