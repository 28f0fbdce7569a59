//! Lets time pass, and draws.

use eframe::egui;
use web_time::Instant;

use super::Viewer;
use crate::camera::Kind;

impl Viewer {
    /// Lets time pass and draws.
    pub(super) fn advance(&mut self, context: &egui::Context, size: [u32; 2]) {
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
    pub(super) fn hang(&mut self, texture: wgpu::Texture) {
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
}
