//! The window: reads keys and mouse, lets time pass, draws, and lays out what lies around the picture.

use std::sync::Arc;

use eframe::{egui, egui_wgpu};
use sward_wgpu::gpu::Gpu;
use web_time::Instant;

use crate::camera::{Camera, Kind};
use crate::clock::Clock;
use crate::drive::{Asked, Drive, Vehicle};
use crate::loading::Loading;
use crate::panels::tools::{self, Wish};
use crate::panels::{help, parameters, scenes};
use crate::source::Source;
use crate::stage::{Backend, Stage};
use crate::status::{Body, Log, Status};

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

    /// Begins to open a scene; the one that is there goes on until the other is.
    fn open(&mut self, context: &egui::Context, source: Source) {
        self.written = source.written();
        let wake = context.clone();
        self.loading = Some(Loading::begin(&self.gpu, source, None, self.backend, move || wake.request_repaint()));
        self.history.clear();
    }

    /// Changes the scene: at once where that can be, else beside the one that runs.
    fn change(&mut self, context: &egui::Context, scene: sward::scene::Scene) {
        let Some(stage) = &mut self.stage else { return };
        match stage.adopt(&scene) {
            Ok(true) => self.problem = None,
            Ok(false) => {
                let (wake, source) = (context.clone(), stage.source.clone());
                // What the panel shows is what was asked for; the world follows when it is ready.
                stage.edited = scene.clone();
                self.loading = Some(Loading::begin(&self.gpu, source, Some(scene), self.backend, move || wake.request_repaint()));
            }
            Err(problem) => self.problem = Some(problem),
        }
    }

    /// All parameters, and what can be done with them.
    fn parameters(&mut self, ui: &mut egui::Ui) {
        let Some(stage) = &self.stage else { return };
        let (mut scene, opened) = (stage.edited.clone(), stage.opened.clone());
        let before = scene.clone();
        let mut wanted = None;
        ui.horizontal(|ui| {
            ui.strong("parameters");
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                if ui.small_button("copy as RON").on_hover_text("The whole scene as text, into the clipboard").clicked() {
                    ui.ctx().copy_text(before.to_ron());
                }
                if ui.add_enabled(before != opened, egui::Button::new("reset").small()).on_hover_text("As it was opened").clicked() {
                    wanted = Some(opened.clone());
                }
                if ui.add_enabled(!self.history.is_empty(), egui::Button::new("undo").small()).clicked() {
                    wanted = self.history.pop();
                }
            });
        });
        let undone = wanted.is_some();
        egui::ScrollArea::vertical().id_salt("parameters").auto_shrink([false, false]).show(ui, |ui| {
            if parameters::show(ui, &mut scene) && !undone {
                wanted = Some(scene);
            }
        });
        let context = ui.ctx().clone();
        if let Some(scene) = wanted.filter(|scene| *scene != before) {
            // One entry for a whole drag of a slider.
            if !undone && (self.history.is_empty() || !context.input(|input| input.pointer.is_decidedly_dragging())) {
                self.history.push(before);
            }
            self.change(&context, scene);
        }
    }

    /// Takes over what was opened meanwhile.
    fn arrive(&mut self) {
        let Some(answer) = self.loading.as_ref().and_then(Loading::poll) else { return };
        let changed = self.loading.take().is_some_and(|loading| loading.changed);
        match answer {
            Ok(mut stage) => {
                if let Some(before) = self.stage.as_ref().filter(|_| changed) {
                    stage.opened = before.opened.clone();
                }
                let same = self.stage.as_ref().is_some_and(|before| before.source.name() == stage.source.name());
                self.problem = None;
                self.drive = None;
                if !same {
                    self.camera = Camera::default();
                    self.chosen = (!stage.world.scene.interactors.is_empty()).then_some(0);
                }
                self.stage = Some(stage);
            }
            Err(problem) => self.problem = Some(problem),
        }
    }

    /// Opens the scene's file again when somebody has written it.
    fn reload(&mut self, context: &egui::Context) {
        if self.looked.elapsed().as_secs_f32() < LOOK || self.loading.is_some() {
            return;
        }
        self.looked = Instant::now();
        let source = self.stage.as_ref().map(|stage| stage.source.clone());
        if let Some(source) = source.filter(|source| source.written().is_some_and(|at| self.written != Some(at))) {
            self.open(context, source);
        }
    }

    /// Files that were dropped on the window, or chosen in a dialog.
    fn receive(&mut self, context: &egui::Context) {
        let dropped = context.input(|input| input.raw.dropped_files.first().cloned());
        if let Some(file) = dropped {
            let text = file.bytes.as_ref().map(|bytes| String::from_utf8_lossy(bytes).into_owned());
            match (file.path, text) {
                (Some(path), _) => self.open(context, Source::File(path)),
                (None, Some(text)) => self.open(context, Source::Text(file.name, text)),
                (None, None) => {}
            }
        }
        #[cfg(not(target_arch = "wasm32"))]
        {
            self.dialog.update(context);
            if let Some(path) = self.dialog.take_picked() {
                self.open(context, Source::File(path));
            }
        }
    }

    /// Opens the dialog of files; in a browser files are dropped on the page.
    fn ask_for_file(&mut self) {
        #[cfg(not(target_arch = "wasm32"))]
        self.dialog.pick_file();
        #[cfg(target_arch = "wasm32")]
        {
            self.problem = Some("drop a scene file on the page to open it".to_owned());
        }
    }

    fn grant(&mut self, context: &egui::Context, wish: Wish) {
        match wish {
            Wish::Restart => {
                if let Some(stage) = &self.stage {
                    let source = stage.source.clone();
                    self.open(context, source);
                }
            }
            Wish::Camera(kind) => {
                if let Some(stage) = &self.stage {
                    let view = stage.world.camera();
                    self.camera.take(kind, &view);
                }
            }
            Wish::Choose(body) => {
                (self.chosen, self.drive) = (Some(body), None);
            }
            Wish::Wheel => self.drive = if self.drive.is_some() { None } else { self.take_wheel() },
            Wish::Step(backend) => {
                self.backend = backend;
                let answer = self.stage.as_mut().map_or(Ok(()), |stage| stage.step_on(backend));
                self.problem = answer.err();
            }
        }
    }

    fn take_wheel(&mut self) -> Option<Drive> {
        let (stage, body) = (self.stage.as_mut()?, self.chosen?);
        let place = stage.world.take_over(body)?;
        let shape = &stage.world.scene.interactors.get(body)?.shape;
        if self.camera.kind == Kind::Scene {
            let view = stage.world.camera();
            self.camera.take(Kind::Follow, &view);
        }
        Some(Drive::new(body, Vehicle::of(shape, place.2), place))
    }

    /// Keys that do one thing once.
    fn keys(&mut self, context: &egui::Context, wishes: &mut Vec<Wish>) {
        if context.egui_wants_keyboard_input() {
            return;
        }
        let pressed = |key| context.input(|input| input.key_pressed(key));
        if pressed(egui::Key::P) {
            self.clock.paused = !self.clock.paused;
        }
        if pressed(egui::Key::Period) {
            self.clock.paused = true;
            self.clock.single += 1;
        }
        if pressed(egui::Key::Comma) {
            self.clock.pace = if self.clock.pace < 0.9 { 1.0 } else { 0.2 };
        }
        if pressed(egui::Key::F1) {
            self.help = !self.help;
        }
        if pressed(egui::Key::R) {
            wishes.push(Wish::Restart);
        }
        if pressed(egui::Key::C) {
            wishes.push(Wish::Camera(self.camera.kind.next()));
        }
        if pressed(egui::Key::E) {
            wishes.push(Wish::Wheel);
        }
        if pressed(egui::Key::O) {
            self.ask_for_file();
        }
        let bodies = self.stage.as_ref().map_or(0, |stage| stage.world.scene.interactors.len());
        if pressed(egui::Key::Tab) && bodies > 0 {
            wishes.push(Wish::Choose(self.chosen.map_or(0, |body| (body + 1) % bodies)));
        }
    }

    /// What held keys ask for.
    fn asked(context: &egui::Context) -> Asked {
        if context.egui_wants_keyboard_input() {
            return Asked::default();
        }
        context.input(|input| {
            let down = |keys: &[egui::Key]| f64::from(u8::from(keys.iter().any(|key| input.key_down(*key))));
            Asked {
                ahead: down(&[egui::Key::W, egui::Key::ArrowUp]) - down(&[egui::Key::S, egui::Key::ArrowDown]),
                right: down(&[egui::Key::D, egui::Key::ArrowRight]) - down(&[egui::Key::A, egui::Key::ArrowLeft]),
                up: down(&[egui::Key::Space]) - f64::from(u8::from(input.modifiers.shift)),
                brake: input.key_down(egui::Key::Space),
            }
        })
    }

    /// The mouse over the picture turns, moves and zooms the camera; one that is the scene's becomes one that circles.
    fn mouse(&mut self, response: &egui::Response, rows: f32) {
        let moved = response.drag_delta();
        let wheel = if response.hovered() { response.ctx.input(|input| input.smooth_scroll_delta.y) } else { 0.0 };
        let pinch = if response.hovered() { response.ctx.input(egui::InputState::zoom_delta) } else { 1.0 };
        if moved == egui::Vec2::ZERO && wheel == 0.0 && pinch == 1.0 {
            return;
        }
        if let Some(stage) = self.stage.as_ref().filter(|_| self.camera.kind == Kind::Scene) {
            let view = stage.world.camera();
            self.camera.take(Kind::Orbit, &view);
        }
        let (x, y) = (f64::from(moved.x), f64::from(moved.y));
        if response.dragged_by(egui::PointerButton::Primary) {
            self.camera.turn(0.005 * x, -0.005 * y);
        } else {
            let metres = self.camera.metres(rows);
            self.camera.slide(-x * metres, y * metres, 0.0);
        }
        if wheel != 0.0 || pinch != 1.0 {
            self.camera.zoom(f64::from(pinch) * (0.003 * f64::from(wheel)).exp());
        }
    }

    /// Lets time pass and draws.
    fn advance(&mut self, context: &egui::Context, size: [u32; 2]) {
        let seconds = self.before.elapsed().as_secs_f64();
        self.before = Instant::now();
        let Some(stage) = &mut self.stage else { return };
        let asked = Self::asked(context);
        if self.drive.is_none() && self.camera.kind == Kind::Fly {
            let way = 6.0 * seconds;
            self.camera.slide(asked.right * way, asked.up * way, asked.ahead * way);
        }
        let passed = stage.pass(self.clock.pass(seconds), self.drive.as_mut(), &asked);
        let behind = if self.clock.fixed.is_some() || self.clock.paused { 0.0 } else { stage.world.behind() };
        let followed = self.drive.map(|drive| drive.body).or(self.chosen);
        let view = self.camera.view(&stage.world, followed, seconds);
        let drawn = passed.and_then(|_| stage.draw(view, behind, size).map(|texture| texture.cloned()));
        self.longest = self.before.elapsed().as_secs_f64() * 1e3;
        match drawn {
            Ok(Some(texture)) => self.hang(texture),
            Ok(None) => {}
            Err(problem) => self.problem = Some(problem),
        }
    }

    /// Tells egui of the picture's texture, when it is another one.
    fn hang(&mut self, texture: wgpu::Texture) {
        if self.texture.as_ref().is_some_and(|(known, _)| *known == texture) {
            return;
        }
        let mut renderer = self.device.renderer.write();
        if let Some((_, id)) = self.texture.take() {
            renderer.free_texture(&id);
        }
        let view = texture.create_view(&Default::default());
        let id = renderer.register_native_texture(&self.device.device, &view, wgpu::FilterMode::Linear);
        drop(renderer);
        self.texture = Some((texture, id));
    }

    fn side(&mut self, ui: &mut egui::Ui, wishes: &mut Vec<Wish>) {
        let context = ui.ctx().clone();
        egui::ScrollArea::vertical().show(ui, |ui| {
            ui.horizontal(|ui| {
                ui.heading("sward");
                ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                    if ui.button("?").on_hover_text("Keys (F1)").clicked() {
                        self.help = !self.help;
                    }
                    if ui.button("open…").on_hover_text("A scene file of your own (O); or drop it on the window").clicked() {
                        self.ask_for_file();
                    }
                });
            });
            ui.separator();
            if let Some(source) = scenes::show(ui, self.stage.as_ref().map(|stage| &stage.source)) {
                self.open(&context, source);
            }
            ui.separator();
            tools::time(ui, &mut self.clock, wishes);
            ui.separator();
            ui.strong("camera");
            tools::camera(ui, self.camera.kind, wishes);
            ui.separator();
            ui.strong("bodies");
            let names: Vec<String> = self.names();
            tools::wheel(ui, &names, self.chosen, self.drive.as_ref(), wishes);
            ui.separator();
            let backend = self.stage.as_ref().map_or(self.backend, Stage::backend);
            tools::machine(ui, backend, &mut self.fineness, &self.gpu.adapter_info.name, wishes);
        });
    }

    fn names(&self) -> Vec<String> {
        let bodies = self.stage.iter().flat_map(|stage| stage.world.scene.interactors.iter().enumerate());
        bodies.map(|(index, body)| if body.name.is_empty() { format!("body {}", index + 1) } else { body.name.clone() }).collect()
    }

    /// What scripts are told.
    fn told(&self) -> Status {
        let world = self.stage.as_ref().map(|stage| &stage.world);
        let bend = |at: [f64; 2]| world.and_then(|world| (0..world.model.stands.len()).find_map(|stand| world.bend_at(stand, at)));
        let at = |body: usize| world.and_then(|world| world.pose_before(body, 0.0)).map(|pose| pose.ground);
        let body = |(index, name): (usize, String)| Body { name, at: at(index), bend: at(index).and_then(bend) };
        Status {
            scene: self.stage.as_ref().map_or_else(String::new, |stage| stage.source.name()),
            step: world.map_or(0, |world| world.state.step),
            camera: self.camera.kind.name(),
            paused: self.clock.paused,
            driving: self.drive.and_then(|drive| self.names().get(drive.body).cloned()),
            bodies: self.names().into_iter().enumerate().map(body).collect(),
            longest: self.longest,
            problem: self.problem.clone(),
            pictures: self.pictures,
        }
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
