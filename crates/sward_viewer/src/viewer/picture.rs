//! Lets time pass, and draws.

use eframe::egui;
use sward::world::World;
use web_time::Instant;

use super::Viewer;
use crate::camera::Kind;
use crate::clock::Passing;
use crate::compare::names;
use crate::marks::mark;
use crate::overlay::Closely;
use crate::painter::{Shot, Shown};
use crate::sight::Sight;
use crate::stage::{Move, Stage};

/// Half the side of the place where plants are looked at one by one, m.
const CLOSELY: f64 = 1.6;

impl Viewer {
    /// The picture, or two of them side by side.
    pub(super) fn pictures(&mut self, ui: &mut egui::Ui) {
        let room = ui.available_size();
        let (area, response) = ui.allocate_exact_size(room, egui::Sense::click_and_drag());
        let halves = match self.beside.stage {
            Some(_) => {
                let (left, right) = area.split_left_right_at_fraction(0.5);
                vec![left, right.with_min_x(right.left() + 2.0)]
            }
            None => vec![area],
        };
        let half = halves[0];
        mark(ui, "picture", half);
        self.follow_fingers(ui, half);
        self.mouse(&response, half);
        let pixels = half.size() * ui.ctx().pixels_per_point() * self.fineness;
        let size = [pixels.x, pixels.y].map(|side| side.round().max(16.0) as u32);
        self.advance(ui.ctx(), size);
        #[cfg(not(target_arch = "wasm32"))]
        self.roll();
        let painter = ui.painter_at(area);
        painter.rect_filled(area, 0.0, egui::Color32::from_gray(14));
        for (half, hung) in halves.iter().zip(&self.hung) {
            if let Some(hung) = hung {
                let whole = egui::Rect::from_min_max(egui::pos2(0.0, 0.0), egui::pos2(1.0, 1.0));
                painter.image(hung.id(), *half, whole, egui::Color32::WHITE);
            }
        }
        self.inside(ui, &halves);
        self.show_stick(ui, half);
        self.fold(ui, half);
        let small = egui::FontId::proportional(14.0);
        if let (Some(first), Some(second)) = (&self.stage, &self.beside.stage) {
            for (stage, half) in [first, second].into_iter().zip(&halves) {
                let at = half.center_top() + egui::vec2(0.0, 10.0);
                label(&painter, at, egui::Align2::CENTER_TOP, &names(&stage.edited), small.clone());
            }
        }
        #[cfg(not(target_arch = "wasm32"))]
        if let Some(recording) = &self.recording {
            let words = if recording.runs() { format!("● {} pictures", recording.taken) } else { "writing the clip …".to_owned() };
            label(&painter, area.left_top() + egui::vec2(18.0, 12.0), egui::Align2::LEFT_TOP, &words, small.clone());
        }
        let waits = self.loading.iter().chain(&self.beside.loading).next();
        if let Some(loading) = waits {
            let verb = if loading.changed { "changing" } else { "opening" };
            let at = area.center_bottom() - egui::vec2(0.0, 20.0);
            let words = format!("{verb} {} …", loading.source.name());
            label(&painter, at, egui::Align2::CENTER_BOTTOM, &words, egui::FontId::proportional(17.0));
        }
    }

    /// Looks inside, over the pictures.
    fn inside(&mut self, ui: &egui::Ui, halves: &[egui::Rect]) {
        let middle = self.closely(ui, halves[0]);
        if let Some(stage) = &self.stage {
            self.probe.take(&stage.world);
        }
        if let Some(stage) = self.stage.as_ref().filter(|_| self.status.is_some()) {
            bodies(ui, &stage.world, &Sight::new(&stage.world.camera(), halves[0]));
        }
        let stages = self.stage.iter_mut().chain(&mut self.beside.stage);
        for (index, (stage, half)) in stages.zip(halves).enumerate() {
            let sight = Sight::new(&stage.world.camera(), *half);
            let painter = ui.painter_at(*half);
            if self.overlays.any() {
                match stage.bring() {
                    Ok(true) => self.overlays.draw(&painter, index, &sight, &stage.world, Closely { at: middle, radius: CLOSELY }),
                    Ok(false) => self.overlays.again(&painter, index),
                    Err(problem) => self.problem = Some(problem),
                }
            }
            if let Some([x, z]) = self.probe.at.filter(|_| self.curves[1]) {
                let ground = stage.world.model.terrain.height_at(x, z);
                if let Some(line) = sight.line([x, ground, z], [x, ground + 0.8, z]) {
                    painter.line_segment(line, egui::Stroke::new(2.0, egui::Color32::WHITE));
                    painter.circle_filled(line[1], 4.0, egui::Color32::WHITE);
                }
            }
        }
    }

    /// Where plants are looked at one by one: below the mouse, else around the body chosen, else where the camera looks.
    fn closely(&self, ui: &egui::Ui, half: egui::Rect) -> [f64; 2] {
        let Some(stage) = &self.stage else { return [0.0; 2] };
        let view = stage.world.camera();
        let body = self.drive.map(|drive| drive.body).or(self.hand.map(|hand| hand.body)).or(self.chosen);
        let pose = body.and_then(|body| stage.world.pose_before(body, 0.0));
        let mouse = ui.ctx().pointer_latest_pos().filter(|at| half.contains(*at));
        let below = mouse.and_then(|at| Sight::new(&view, half).ground(&stage.world.model.terrain, at));
        below.or(pose.map(|pose| pose.ground)).unwrap_or([view.target[0], view.target[2]])
    }

    /// Lets time pass and draws.
    fn advance(&mut self, context: &egui::Context, size: [u32; 2]) {
        if std::mem::take(&mut self.fresh) {
            return;
        }
        let seconds = self.before.elapsed().as_secs_f64();
        self.before = Instant::now();
        let asked = self.asked_of_all(context);
        let waits = self.loading.iter().chain(&self.beside.loading).any(|loading| loading.changed);
        #[cfg(not(target_arch = "wasm32"))]
        let passing = self.paced().map(Passing::Seconds).unwrap_or_else(|| self.clock.pass(seconds));
        #[cfg(target_arch = "wasm32")]
        let passing = self.clock.pass(seconds);
        let Some(stage) = &mut self.stage else { return };
        if self.drive.is_none() && self.camera.kind == Kind::Fly {
            let way = if context.input(|input| input.modifiers.shift) { 24.0 } else { 6.0 } * seconds;
            self.camera.slide(asked.right * way, asked.up * way, asked.ahead * way);
        }
        // What is being made ready goes on from where this is now. The first picture and the first step take long each: not both in one pass.
        let first = !stage.has_picture();
        let steps = stage.due(if waits || first { Passing::Steps(0) } else { passing });
        for taken in 0..steps {
            let both = [Some(&mut *stage), self.beside.stage.as_mut()].into_iter().flatten();
            let ready = both.map(Stage::ready).try_fold(true, |all, own| own.map(|own| all & own));
            if ready == Ok(false) {
                stage.give_back(steps - taken);
                self.clock.give_back(steps - taken);
                break;
            }
            self.problem = ready.err().or(self.problem.take());
            let dt = stage.world.model.dt;
            let mut moves = Vec::new();
            if let Some(drive) = &mut self.drive {
                drive.go(&asked, dt);
                moves.push(Move { body: drive.body, ground: drive.ground, yaw: drive.yaw, clearance: drive.clearance });
            }
            if let Some(hand) = &mut self.hand {
                hand.go(dt);
                moves.push(Move { body: hand.body, ground: hand.ground, yaw: hand.yaw, clearance: hand.clearance });
            }
            let both = [Some(&mut *stage), self.beside.stage.as_mut()];
            for stage in both.into_iter().flatten() {
                if let Err(problem) = stage.step(&moves, &mut self.times) {
                    self.problem = Some(problem);
                }
            }
            if self.status.is_some() {
                self.trails.take(&stage.world);
            }
        }
        let behind = if self.clock.fixed.is_some() || self.clock.paused { 0.0 } else { stage.world.behind() };
        let followed = self.drive.map(|drive| drive.body).or(self.chosen);
        let view = self.camera.view(&stage.world, followed, seconds);
        let own = stage.world.viewed;
        // Asked once, so that one half does not take the room of the other for ever.
        let free = self.means.is_free();
        let shot = Shot { view, behind, size, near: self.near.into() };
        let drawn = stage.draw(shot, free, &mut self.times);
        // The other half sees what this one sees, and has no keys of its own.
        let seen = view.or(own).unwrap_or_else(|| stage.world.camera_before(behind));
        self.show(context, 0, drawn);
        if let Some(beside) = &mut self.beside.stage {
            let drawn = beside.draw(Shot { view: Some(seen), ..shot }, free, &mut self.times);
            self.show(context, 1, drawn);
        }
    }

    /// Hangs what was drawn, or says why it was not.
    fn show(&mut self, context: &egui::Context, half: usize, drawn: Result<Option<Shown>, String>) {
        match drawn {
            Ok(Some(shown)) => self.hang(context, half, shown),
            Ok(None) => {}
            Err(problem) => self.problem = Some(problem),
        }
    }
}

/// Marks where bodies are seen, for scripts that take them.
fn bodies(ui: &egui::Ui, world: &World, sight: &Sight) {
    for (index, body) in world.scene.interactors.iter().enumerate() {
        let Some(pose) = world.pose_before(index, 0.0) else { continue };
        if let Some(at) = sight.at([pose.ground[0], pose.height + 0.3, pose.ground[1]]).filter(|at| sight.area().contains(*at)) {
            mark(ui, &format!("body {}", body.name), egui::Rect::from_center_size(at, egui::vec2(4.0, 4.0)));
        }
    }
}

/// Words on a picture.
fn label(painter: &egui::Painter, at: egui::Pos2, align: egui::Align2, words: &str, font: egui::FontId) {
    let galley = painter.layout_no_wrap(words.to_owned(), font, egui::Color32::WHITE);
    let room = align.anchor_size(at, galley.size());
    painter.rect_filled(room.expand2(egui::vec2(8.0, 4.0)), 4.0, egui::Color32::from_black_alpha(150));
    painter.galley(room.min, galley, egui::Color32::WHITE);
}
