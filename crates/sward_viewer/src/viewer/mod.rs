//! The window: reads keys and mouse, lets time pass, draws, and lays out what lies around the picture.

mod beside;
mod editing;
mod files;
mod folding;
mod hung;
mod input;
mod opening;
#[cfg(target_arch = "wasm32")]
mod page_files;
#[cfg(target_arch = "wasm32")]
mod page_recorded;
mod painted;
mod picture;
#[cfg(not(target_arch = "wasm32"))]
mod recorded;
mod side;
mod told;
mod touch;
mod wishes;

use eframe::{egui, egui_wgpu};
use sward_wgpu::gpu::Gpu;
use web_time::Instant;

use crate::camera::Camera;
use crate::clock::Clock;
use crate::drive::Drive;
#[cfg(any(feature = "gamepad", not(target_os = "linux")))]
use crate::gamepad::Gamepad;
use crate::hand::Hand;
use crate::loading::Loading;
use crate::marks;
use crate::overlay::Overlays;
#[cfg(target_arch = "wasm32")]
use crate::page::clip::Clip as Recording;
use crate::painter::Means;
use crate::panels::help;
use crate::panels::painting::Canvas;
use crate::panels::tools::Wish;
use crate::probe::Probe;
#[cfg(not(target_arch = "wasm32"))]
use crate::recording::Recording;
use crate::remembered::{KEY, Remembered};
use crate::source::Source;
use crate::stage::{Backend, Stage};
use crate::status::Log;
use crate::timing::Times;
use crate::trails::Trails;
use beside::Beside;
use files::Purpose;
use folding::Around;
use hung::Hung;
use touch::Touch;

/// How a window begins.
#[derive(Debug, Default)]
pub struct Settings {
    /// The scene.
    pub scene: Option<Source>,
    /// Steps for every picture, whatever the wall's clock says.
    pub steps: Option<u32>,
    /// Pixels drawn for each of the window's; `None` lets the adapter decide.
    pub fineness: Option<f32>,
    /// Share of the distance up to which every plant is drawn, 0.05 to 1.
    pub near: Option<f32>,
    /// The window's width and height; `None`: as last time.
    pub size: Option<[f32; 2]>,
    /// Where a line goes after every picture.
    pub status: Option<Log>,
    /// Where cells move; `None`: as last time.
    pub backend: Option<Backend>,
    /// Whether the processor draws, though there may be a graphics device.
    pub raster: bool,
    /// Whether the graphics device is known to be the processor in disguise: it may not say so itself.
    pub software: bool,
    /// What is said at the beginning.
    pub notice: Option<String>,
}

/// Seconds between two looks at a scene's file.
const LOOK: f32 = 0.4;

/// The window's contents.
pub struct Viewer {
    means: Means,
    /// What egui draws with, where that is a device that the picture is drawn on, too.
    device: Option<egui_wgpu::RenderState>,
    stage: Option<Stage>,
    /// The same field with another response, in the other half of the window.
    beside: Beside,
    loading: Option<Loading>,
    /// A change that waits until the one before it is there.
    queued: Option<sward::scene::Scene>,
    /// What is wrong with the last scene that was asked for, or with the device.
    problem: Option<String>,
    /// The scene came in this pass, in which the panels are laid out anew: its first picture is drawn in the next.
    fresh: bool,
    /// What went well.
    notice: Option<String>,
    /// One's own presets, and the name of the next one.
    presets: std::collections::BTreeMap<String, String>,
    preset_name: String,
    canvas: Canvas,
    /// Wishes that wait for cells on their way.
    later: Vec<Wish>,
    /// Scenes before each change, the last one last.
    history: Vec<sward::scene::Scene>,
    /// Whether the mouse button under which the last change was made is still down.
    mid_drag: bool,
    hung: [Option<Hung>; 2],
    camera: Camera,
    clock: Clock,
    chosen: Option<usize>,
    drive: Option<Drive>,
    hand: Option<Hand>,
    #[cfg(any(feature = "gamepad", not(target_os = "linux")))]
    gamepad: Option<Gamepad>,
    touch: Touch,
    around: Around,
    overlays: Overlays,
    probe: Probe,
    times: Times,
    /// Whether curves are shown: milliseconds, the probe.
    curves: [bool; 2],
    backend: Backend,
    fineness: f32,
    /// Share of the distance up to which every plant is drawn.
    near: f32,
    help: bool,
    /// When the scene's file was last written, and when that was last looked at.
    written: Option<std::time::SystemTime>,
    looked: Instant,
    before: Instant,
    /// Milliseconds of the last picture: all, and without the driver's part.
    busy: [f64; 2],
    longest: f64,
    trails: Trails,
    pictures: u64,
    status: Option<Log>,
    #[cfg(not(target_arch = "wasm32"))]
    dialog: egui_file_dialog::FileDialog,
    #[cfg(target_arch = "wasm32")]
    dialog: crate::page::files::Dialog,
    /// For what the browser finishes later.
    #[cfg(target_arch = "wasm32")]
    context: egui::Context,
    /// What the dialog's file is for.
    purpose: Purpose,
    recording: Option<Recording>,
    /// Whether a clip begins with the next picture.
    #[cfg(not(target_arch = "wasm32"))]
    record_next: bool,
    /// Pictures that the encoder has no room for yet.
    #[cfg(not(target_arch = "wasm32"))]
    waiting: Option<Vec<sward::picture::Picture>>,
}

impl Viewer {
    /// In a window that eframe opened; where that is not on wgpu, the processor draws.
    pub fn new(context: &eframe::CreationContext<'_>, settings: Settings) -> Self {
        let device = context.wgpu_render_state.clone().filter(|_| !settings.raster);
        let poor = device.as_ref().filter(|device| !wgpu::Limits::default().check_limits(&device.device.limits()));
        let notice = poor.map(|device| {
            let name = device.adapter.get_info().name;
            format!("{name} cannot draw plants, so the processor does everything, and its pictures are small.")
        });
        let device = device.filter(|_| notice.is_none());
        let info = device.as_ref().map(|device| device.adapter.get_info());
        // A software adapter shares the processor with everything else.
        let software = settings.software || info.as_ref().is_some_and(|info| info.device_type == wgpu::DeviceType::Cpu);
        let means = match (&device, info) {
            (Some(device), Some(info)) => Means::device(Gpu::watch(device.device.clone(), device.queue.clone(), info)),
            _ => Means::Processor,
        };
        log::info!("drawn by {}", means.name());
        if let Some(size) = settings.size {
            context.egui_ctx.send_viewport_cmd(egui::ViewportCommand::InnerSize(size.into()));
        }
        let remembered: Remembered = context.storage.and_then(|storage| eframe::get_value(storage, KEY)).unwrap_or_default();
        let usual = means.usual(software);
        let fineness = settings.fineness.or(remembered.fineness).unwrap_or(usual[0]).clamp(0.2, 1.0);
        let near = settings.near.or(remembered.near).unwrap_or(usual[1]).clamp(0.05, 1.0);
        let now = Instant::now();
        if settings.status.is_some() {
            marks::begin(&context.egui_ctx);
        }
        // Pictures look best among dark things.
        context.egui_ctx.set_theme(eframe::egui::Theme::Dark);
        // Where pictures take long, so does a click.
        context.egui_ctx.options_mut(|options| options.input_options.max_click_duration = 30.0);
        let mut viewer = Self {
            means,
            device,
            stage: None,
            beside: Beside::default(),
            loading: None,
            queued: None,
            problem: None,
            fresh: false,
            notice: settings.notice.or(notice),
            presets: remembered.presets.clone(),
            preset_name: String::new(),
            canvas: Canvas::default(),
            later: Vec::new(),
            history: Vec::new(),
            mid_drag: false,
            hung: [None, None],
            camera: Camera::default(),
            clock: Clock { fixed: settings.steps, ..Clock::default() },
            chosen: None,
            drive: None,
            hand: None,
            #[cfg(any(feature = "gamepad", not(target_os = "linux")))]
            gamepad: Gamepad::new(),
            touch: Touch::default(),
            around: Around::default(),
            overlays: Overlays::default(),
            probe: Probe::default(),
            times: Times::default(),
            curves: remembered.curves,
            backend: settings.backend.unwrap_or(if remembered.on_gpu { Backend::Gpu } else { Backend::Cpu }),
            fineness,
            near,
            help: false,
            written: None,
            looked: now,
            before: now,
            busy: [0.0; 2],
            longest: 0.0,
            trails: Trails::default(),
            pictures: 0,
            status: settings.status,
            #[cfg(not(target_arch = "wasm32"))]
            dialog: egui_file_dialog::FileDialog::new()
                .title("Open a scene")
                .add_file_filter_extensions("scenes", vec!["ron"])
                .default_file_filter("scenes"),
            #[cfg(target_arch = "wasm32")]
            dialog: Default::default(),
            #[cfg(target_arch = "wasm32")]
            context: context.egui_ctx.clone(),
            purpose: Purpose::default(),
            recording: None,
            #[cfg(not(target_arch = "wasm32"))]
            record_next: false,
            #[cfg(not(target_arch = "wasm32"))]
            waiting: None,
        };
        let last = remembered.scene.as_deref().map(Source::named).filter(Source::is_there);
        let first = settings.scene.or(last).unwrap_or_else(|| Source::named("hello"));
        viewer.open(&context.egui_ctx, first);
        viewer
    }
}

impl eframe::App for Viewer {
    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        let context = ui.ctx().clone();
        let begun = Instant::now();
        self.arrive(&context);
        self.reload(&context);
        self.receive(&context);
        self.chosen_files(&context);
        let mut wishes = std::mem::take(&mut self.later);
        self.keys(&context, &mut wishes);
        #[cfg(any(feature = "gamepad", not(target_os = "linux")))]
        self.buttons(&context, &mut wishes);
        self.sides(ui, &mut wishes);
        self.said(ui);
        self.plots(ui);
        egui::CentralPanel::default().frame(egui::Frame::NONE).show(ui, |ui| self.pictures(ui));
        self.canvas(&context);
        help::show(&context, &mut self.help);
        for wish in wishes {
            self.grant(&context, wish);
        }
        let whole = begun.elapsed().as_secs_f64() * 1e3;
        self.busy = [whole, whole - self.times.waited()];
        self.longest = self.longest.max(self.busy[1]);
        self.pictures += 1;
        self.times.end();
        if let Some(log) = &self.status
            && let Err(error) = log.write(&self.told(marks::taken(&context)))
        {
            log::warn!("the status file cannot be written: {error}");
            self.status = None;
        }
        context.request_repaint();
    }

    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        let remembered = Remembered {
            fineness: Some(self.fineness),
            near: Some(self.near),
            on_gpu: self.backend == Backend::Gpu,
            scene: self.stage.as_ref().and_then(|stage| stage.source.remembered()),
            curves: self.curves,
            presets: self.presets.clone(),
        };
        eframe::set_value(storage, KEY, &remembered);
    }
}
