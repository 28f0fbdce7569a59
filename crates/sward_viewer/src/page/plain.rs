//! Where there is neither WebGPU nor WebGL: the picture alone on a plain canvas, driven by the same keys.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::rc::Rc;

use wasm_bindgen::prelude::Closure;
use wasm_bindgen::{Clamped, JsCast};
use web_sys::{CanvasRenderingContext2d, HtmlCanvasElement, ImageData, KeyboardEvent};
use web_time::Instant;

use super::surroundings::{mention, publish, say};
use crate::address::Address;
use crate::camera::{Camera, Kind};
use crate::clock::Clock;
use crate::drive::{Asked, Drive, Vehicle};
use crate::loading::{Loading, What};
use crate::painter::{Means, Shot, Shown};
use crate::source::Source;
use crate::stage::{Backend, Changed, Move, Stage};
use crate::status::{Body, Status};
use crate::timing::Times;

/// What a page without panels says of its keys.
const KEYS: &str = "This browser gives no WebGL either, so there are no panels. W A S D drive, E takes the wheel or leaves it, Tab chooses a body, C the camera, \
    P pauses, the full stop takes one step, R begins again; ?scene=NAME in the address opens another scene.";

/// The picture, and whoever plays in it.
struct Play {
    canvas: HtmlCanvasElement,
    surface: CanvasRenderingContext2d,
    source: Source,
    stage: Stage,
    loading: Option<Loading>,
    clock: Clock,
    camera: Camera,
    chosen: usize,
    drive: Option<Drive>,
    /// Keys that are down, as the browser names their places.
    held: BTreeSet<String>,
    before: Instant,
    pictures: u64,
    status: bool,
    notice: String,
    problem: Option<String>,
}

/// Shows the picture from now on.
pub(super) async fn run(canvas: HtmlCanvasElement, address: Address, notice: String) -> Result<(), String> {
    let source = address.scene.unwrap_or_else(|| Source::named("hello"));
    let surface = canvas.get_context("2d").ok().flatten().and_then(|surface| surface.dyn_into().ok());
    let play = Play {
        surface: surface.ok_or("this browser gives no canvas at all")?,
        canvas,
        stage: Stage::new(&Means::Processor, (source.clone(), None), source.scene()?, Backend::Cpu).await?,
        loading: None,
        source,
        clock: Clock { fixed: address.steps, ..Clock::default() },
        camera: Camera::default(),
        chosen: 0,
        drive: None,
        held: BTreeSet::new(),
        before: Instant::now(),
        pictures: 0,
        status: address.status,
        notice: [&notice, KEYS, address.problem.as_deref().unwrap_or("")].join(" "),
        problem: None,
    };
    say("");
    mention(&play.notice);
    let play = Rc::new(RefCell::new(play));
    listen(&play).ok_or("this browser tells of no keys")?;
    go_on(play);
    Ok(())
}

/// Hears keys.
fn listen(play: &Rc<RefCell<Play>>) -> Option<()> {
    let window = web_sys::window()?;
    for (name, down) in [("keydown", true), ("keyup", false)] {
        let play = Rc::clone(play);
        let heard = Closure::<dyn FnMut(KeyboardEvent)>::new(move |event: KeyboardEvent| {
            if event.ctrl_key() || event.meta_key() || event.alt_key() {
                return;
            }
            event.prevent_default();
            play.borrow_mut().key(event.code(), down && !event.repeat(), down);
        });
        window.add_event_listener_with_callback(name, heard.as_ref().unchecked_ref()).ok()?;
        // As long as the page.
        heard.forget();
    }
    Some(())
}

/// Draws whenever the browser shows a picture.
fn go_on(play: Rc<RefCell<Play>>) {
    let again = Rc::new(RefCell::new(None::<Closure<dyn FnMut()>>));
    let next = Rc::clone(&again);
    let ask = |closure: &RefCell<Option<Closure<dyn FnMut()>>>| {
        if let (Some(window), Some(frame)) = (web_sys::window(), &*closure.borrow()) {
            let _ = window.request_animation_frame(frame.as_ref().unchecked_ref());
        }
    };
    *again.borrow_mut() = Some(Closure::new(move || {
        play.borrow_mut().picture();
        ask(&next);
    }));
    ask(&again);
}

impl Play {
    fn key(&mut self, code: String, pressed: bool, down: bool) {
        if pressed {
            match &*code {
                "KeyP" => self.clock.paused = !self.clock.paused,
                "Period" => (self.clock.paused, self.clock.single) = (true, self.clock.single + 1),
                "KeyC" => self.camera.take(self.camera.kind.next(), &self.stage.world.camera()),
                "KeyE" => self.wheel(),
                "Tab" => {
                    let bodies = self.stage.world.scene.interactors.len().max(1);
                    (self.chosen, self.drive) = ((self.chosen + 1) % bodies, None);
                }
                "KeyR" => {
                    self.loading = Some(Loading::begin(&Means::Processor, (self.source.clone(), None), What::Source, Backend::Cpu, || ()));
                }
                _ => {}
            }
        }
        if down {
            self.held.insert(code)
        } else {
            self.held.remove(&code)
        };
    }

    fn wheel(&mut self) {
        if self.drive.take().is_some() {
            return;
        }
        let Some(place) = self.stage.world.take_over(self.chosen) else { return };
        if self.camera.kind == Kind::Scene {
            self.camera.take(Kind::Follow, &self.stage.world.camera());
        }
        let shape = self.stage.world.scene.interactors.get(self.chosen).map(|body| &body.shape);
        self.drive = shape.map(|shape| Drive::new(self.chosen, Vehicle::of(shape, place.2), place));
    }

    fn asked(&self) -> Asked {
        let down = |codes: [&str; 2]| f64::from(u8::from(codes.iter().any(|code| self.held.contains(*code))));
        Asked {
            ahead: down(["KeyW", "ArrowUp"]) - down(["KeyS", "ArrowDown"]),
            right: down(["KeyD", "ArrowRight"]) - down(["KeyA", "ArrowLeft"]),
            up: down(["Space", "Space"]) - down(["ShiftLeft", "ShiftRight"]),
            brake: self.held.contains("Space"),
        }
    }

    /// Lets time pass, and draws.
    fn picture(&mut self) {
        if let Some(answer) = self.loading.as_ref().and_then(Loading::poll) {
            self.loading = None;
            match answer {
                Ok(Changed::Anew(stage)) => (self.stage, self.drive) = (*stage, None),
                Ok(Changed::Kept(_)) => {}
                Err(problem) => self.problem = Some(problem),
            }
        }
        let seconds = self.before.elapsed().as_secs_f64();
        self.before = Instant::now();
        let (asked, mut times) = (self.asked(), Times::default());
        let dt = self.stage.world.model.dt;
        for _ in 0..self.stage.due(self.clock.pass(seconds)) {
            let driven = self.drive.as_mut().map(|drive| {
                drive.go(&asked, dt);
                Move { body: drive.body, ground: drive.ground, yaw: drive.yaw, clearance: drive.clearance }
            });
            if let Err(problem) = self.stage.step(driven.as_slice(), &mut times) {
                self.problem = Some(problem);
            }
        }
        let behind = if self.clock.fixed.is_some() || self.clock.paused { 0.0 } else { self.stage.world.behind() };
        let view = self.camera.view(&self.stage.world, Some(self.chosen), seconds);
        let size = [self.canvas.client_width(), self.canvas.client_height()].map(|side| side.max(16) as u32);
        let near = Means::Processor.usual(true)[1].into();
        match self.stage.draw(Shot { view, behind, size, near }, true, &mut times) {
            Ok(Some(Shown::Pixels(picture))) => self.put(&picture),
            Ok(_) => {}
            Err(problem) => self.problem = Some(problem),
        }
        self.pictures += 1;
        if let Some(problem) = &self.problem {
            mention(problem);
        }
        if self.status
            && let Ok(text) = serde_json::to_string(&self.told())
        {
            publish(&text);
        }
    }

    fn put(&self, picture: &sward::picture::Picture) {
        if [self.canvas.width(), self.canvas.height()] != [picture.width, picture.height] {
            self.canvas.set_width(picture.width);
            self.canvas.set_height(picture.height);
        }
        if let Ok(data) = ImageData::new_with_u8_clamped_array_and_sh(Clamped(&picture.rgba8), picture.width, picture.height) {
            let _ = self.surface.put_image_data(&data, 0.0, 0.0);
        }
    }

    /// What scripts are told.
    fn told(&self) -> Status {
        let world = &self.stage.world;
        let bodies = world.scene.interactors.iter().enumerate();
        let bodies = bodies.map(|(index, body)| Body {
            name: body.name.clone(),
            at: world.pose_before(index, 0.0).map(|pose| pose.ground),
            ..Body::default()
        });
        Status {
            scene: self.source.name(),
            step: world.state.step,
            drawn: self.stage.drawn(),
            camera: self.camera.kind.name(),
            backend: Backend::Cpu.name(),
            paused: self.clock.paused,
            driving: self.drive.and_then(|drive| Some(world.scene.interactors.get(drive.body)?.name.clone())),
            bodies: bodies.collect(),
            problem: self.problem.clone(),
            notice: Some(self.notice.clone()),
            pictures: self.pictures,
            ..Status::default()
        }
    }
}
