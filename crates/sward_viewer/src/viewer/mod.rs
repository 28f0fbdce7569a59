//! The window: reads keys and mouse, lets time pass, draws, and lays out what lies around the picture.

mod editing;
mod input;
mod opening;
mod picture;
mod side;
mod told;
mod wishes;

use std::sync::Arc;

use eframe::{egui, egui_wgpu};
use sward_wgpu::gpu::Gpu;
use web_time::Instant;

use crate::camera::Camera;
use crate::clock::Clock;
use crate::drive::Drive;
use crate::loading::Loading;
use crate::panels::help;
use crate::source::Source;
use crate::stage::{Backend, Stage};
use crate::status::Log;

/// How a window begins.
#[derive(Debug, Default)]
pub struct Settings {
    /// The scene.
    pub scene: Option<Source>,
    /// Steps for every picture, whatever the wall's clock says.
    pub steps: Option<u32>,
    /// Pixels drawn for each of the window's; `None` lets the adapter decide.
    pub fineness: Option<f32>,
    /// The window's width and height; `None`: as last time.
    pub size: Option<[f32; 2]>,
    /// Where a line goes after every picture.
    pub status: Option<Log>,
    /// Where cells move.
    pub backend: Backend,
}

/// Seconds between two looks at a scene's file.
const LOOK: f32 = 0.4;

/// The window's contents.
pub struct Viewer {
    gpu: Arc<Gpu>,
    device: egui_wgpu::RenderState,
    stage: Option<Stage>,
    loading: Option<Loading>,
    /// What is wrong with the last scene that was asked for, or with the device.
    problem: Option<String>,
    /// Scenes before each change, the last one last.
    history: Vec<sward::scene::Scene>,
    texture: Option<(wgpu::Texture, egui::TextureId)>,
    camera: Camera,
    clock: Clock,
    chosen: Option<usize>,
    drive: Option<Drive>,
    backend: Backend,
    fineness: f32,
    help: bool,
    /// When the scene's file was last written, and when that was last looked at.
    written: Option<std::time::SystemTime>,
    looked: Instant,
    before: Instant,
    longest: f64,
    pictures: u64,
    status: Option<Log>,
    #[cfg(not(target_arch = "wasm32"))]
    dialog: egui_file_dialog::FileDialog,
}

impl Viewer {
    /// In a window that eframe opened on wgpu.
    ///
    /// # Errors
    /// There is no graphics device.
    pub fn new(context: &eframe::CreationContext<'_>, settings: Settings) -> Result<Self, String> {
        let device = context.wgpu_render_state.clone().ok_or("this window has no graphics device")?;
        let info = device.adapter.get_info();
        // A software adapter shares the processor with everything else.
        let usual = if info.device_type == wgpu::DeviceType::Cpu { 0.5 } else { 1.0 };
        let gpu = Arc::new(Gpu::watch(device.device.clone(), device.queue.clone(), info));
        if let Some(size) = settings.size {
            context.egui_ctx.send_viewport_cmd(egui::ViewportCommand::InnerSize(size.into()));
        }
        let now = Instant::now();
        let mut viewer = Self {
            gpu,
            device,
            stage: None,
            loading: None,
            problem: None,
            history: Vec::new(),
            texture: None,
            camera: Camera::default(),
            clock: Clock { fixed: settings.steps, ..Clock::default() },
            chosen: None,
            drive: None,
            backend: settings.backend,
            fineness: settings.fineness.unwrap_or(usual).clamp(0.2, 1.0),
            help: false,
            written: None,
            looked: now,
            before: now,
            longest: 0.0,
            pictures: 0,
            status: settings.status,
            #[cfg(not(target_arch = "wasm32"))]
            dialog: egui_file_dialog::FileDialog::new()
                .title("Open a scene")
                .add_file_filter_extensions("scenes", vec!["ron"])
                .default_file_filter("scenes"),
        };
        viewer.open(&context.egui_ctx, settings.scene.unwrap_or_else(|| Source::named("hello")));
        Ok(viewer)
    }
}

impl eframe::App for Viewer {
    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        let context = ui.ctx().clone();
        self.arrive();
        self.reload(&context);
        self.receive(&context);
        let mut wishes = Vec::new();
        self.keys(&context, &mut wishes);
        egui::Panel::left("tools").resizable(true).default_size(290.0).show(ui, |ui| self.side(ui, &mut wishes));
        egui::Panel::right("parameters").resizable(true).default_size(330.0).show(ui, |ui| self.parameters(ui));
        if let Some(problem) = self.problem.clone() {
            egui::Panel::bottom("problem").show(ui, |ui| {
                ui.horizontal(|ui| {
                    if ui.button("×").on_hover_text("I have seen it").clicked() {
                        self.problem = None;
                    }
                    let words = egui::RichText::new(problem).monospace().color(egui::Color32::from_rgb(255, 140, 110));
                    ui.add(egui::Label::new(words).wrap());
                });
            });
        }
        egui::CentralPanel::default().frame(egui::Frame::NONE).show(ui, |ui| {
            let room = ui.available_size();
            let pixels = room * ui.ctx().pixels_per_point() * self.fineness;
            let size = [pixels.x, pixels.y].map(|side| side.round().max(16.0) as u32);
            self.advance(&context, size);
            let (area, response) = ui.allocate_exact_size(room, egui::Sense::click_and_drag());
            if let Some((_, id)) = &self.texture {
                let whole = egui::Rect::from_min_max(egui::pos2(0.0, 0.0), egui::pos2(1.0, 1.0));
                ui.painter().image(*id, area, whole, egui::Color32::WHITE);
            }
            if let Some(loading) = &self.loading {
                let words = format!("opening {} …", loading.source.name());
                ui.painter().text(
                    area.center_bottom() - egui::vec2(0.0, 24.0),
                    egui::Align2::CENTER_BOTTOM,
                    words,
                    egui::FontId::proportional(18.0),
                    egui::Color32::WHITE,
                );
            }
            self.mouse(&response, room.y);
        });
        help::show(&context, &mut self.help);
        for wish in wishes {
            self.grant(&context, wish);
        }
        self.pictures += 1;
        if let Some(log) = &self.status
            && let Err(error) = log.write(&self.told())
        {
            log::warn!("the status file cannot be written: {error}");
            self.status = None;
        }
        context.request_repaint();
    }
}
