//! The window: what is typed on the command line, and what is said when none can be opened.

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;

use clap::Parser;
use eframe::{egui, egui_wgpu};
use sward_viewer::source::Source;
use sward_viewer::stage::Backend;
use sward_viewer::status::Log;
use sward_viewer::viewer::{Settings, Viewer};
use sward_wgpu::gpu::{CLOCK, flags};

/// A window in which vegetation reacts: drive through it, look inside, change everything.
#[derive(Parser)]
#[command(name = "sward_viewer", version)]
struct Arguments {
    /// A shipped scene's name, or the path of a scene file, which is opened again whenever it is written
    scene: Option<String>,
    /// Move cells on the graphics device
    #[arg(long)]
    gpu: bool,
    /// Move cells on the processor; without either, as last time
    #[arg(long, conflicts_with = "gpu")]
    cpu: bool,
    /// Draw on the processor, in a small picture, as where there is no graphics device
    #[arg(long)]
    raster: bool,
    /// Pixels drawn for each of the window's, 0.2 to 1
    #[arg(long, value_name = "SHARE")]
    pixels: Option<f32>,
    /// Of the distance up to which every plant is drawn, so much, 0.05 to 1; beyond it fewer and wider ones stand for all
    #[arg(long, value_name = "SHARE")]
    plants: Option<f32>,
    /// Width and height of the window; without it, those of last time
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<[f32; 2]>,
    /// Take so many steps for every picture, whatever the clock says: for scripts
    #[arg(long, value_name = "STEPS")]
    steps: Option<u32>,
    /// Write what the window shows to this file as JSON after every picture: for scripts
    #[arg(long, value_name = "FILE")]
    status: Option<PathBuf>,
}

fn size(text: &str) -> Result<[f32; 2], String> {
    let sides = text.split_once('x').and_then(|(width, height)| Some([width.parse().ok()?, height.parse().ok()?]));
    sides
        .filter(|sides| sides.iter().all(|side| (200.0..=16384.0).contains(side)))
        .ok_or_else(|| "type it like 1280x760, 200 to 16384".to_owned())
}

pub(crate) fn open() -> ExitCode {
    // What drivers complain of; RUST_LOG=warn tells more.
    env_logger::Builder::from_env(env_logger::Env::default().default_filter_or("error")).init();
    let arguments = Arguments::parse();
    let settings = Settings {
        scene: arguments.scene.as_deref().map(Source::named),
        steps: arguments.steps,
        size: arguments.size,
        fineness: arguments.pixels,
        near: arguments.plants,
        status: arguments.status.map(Log::new),
        backend: arguments.gpu.then_some(Backend::Gpu).or(arguments.cpu.then_some(Backend::Cpu)),
        raster: arguments.raster,
        ..Settings::default()
    };
    let mut setup = egui_wgpu::WgpuSetupCreateNew::without_display_handle();
    setup.instance_descriptor.flags = flags();
    let usual = Arc::clone(&setup.device_descriptor);
    setup.device_descriptor = Arc::new(move |adapter| {
        let own = usual(adapter);
        // For OpenGL egui asks for what a browser's would give, which is too little to draw plants with.
        let whole = wgpu::Limits::default();
        let required_limits = if whole.check_limits(&adapter.limits()) { whole } else { own.required_limits };
        wgpu::DeviceDescriptor { required_features: own.required_features | (adapter.features() & CLOCK), required_limits, ..own }
    });
    let options = eframe::NativeOptions {
        viewport: egui::ViewportBuilder::default()
            .with_title("sward")
            .with_inner_size(arguments.size.unwrap_or([1280.0, 760.0]))
            .with_min_inner_size([480.0, 320.0]),
        renderer: eframe::Renderer::Wgpu,
        persist_window: arguments.size.is_none(),
        wgpu_options: egui_wgpu::WgpuConfiguration { wgpu_setup: setup.into(), ..Default::default() },
        ..Default::default()
    };
    let opened = eframe::run_native("sward", options, Box::new(|context| Ok(Box::new(Viewer::new(context, settings)))));
    match opened {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!(
                "sward_viewer: no window can be opened: {error}\nwithout one: cargo run --release draws pictures (sward render --help)"
            );
            ExitCode::FAILURE
        }
    }
}
