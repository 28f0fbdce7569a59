//! Pictures that egui knows.

use std::sync::Arc;

use eframe::{egui, egui_wgpu};
use sward::picture::Picture;

use super::Viewer;
use crate::painter::Shown;

/// A picture that egui knows.
pub(super) enum Hung {
    /// On the device.
    Texture(wgpu::Texture, egui::TextureId),
    /// Handed over from here, whenever it is another one.
    Pixels(Arc<Picture>, egui::TextureHandle),
}

impl Hung {
    /// What egui calls it.
    pub(super) fn id(&self) -> egui::TextureId {
        match self {
            Self::Texture(_, id) => *id,
            Self::Pixels(_, handle) => handle.id(),
        }
    }

    /// Width and height, pixels.
    #[cfg(not(target_arch = "wasm32"))]
    pub(super) fn size(&self) -> [u32; 2] {
        match self {
            Self::Texture(texture, _) => [texture.width(), texture.height()],
            Self::Pixels(picture, _) => [picture.width, picture.height],
        }
    }
}

impl Viewer {
    /// Tells egui of a picture, when it is another one.
    pub(super) fn hang(&mut self, context: &egui::Context, half: usize, shown: Shown) {
        let before = self.hung[half].take();
        self.hung[half] = match (shown, &self.device) {
            (Shown::Texture(texture), Some(device)) => Some(on_device(device, texture, before)),
            (Shown::Texture(_), None) => before,
            (Shown::Pixels(picture), _) => Some(handed_over(context, picture, before)),
        };
    }
}

fn on_device(device: &egui_wgpu::RenderState, texture: wgpu::Texture, before: Option<Hung>) -> Hung {
    let mut renderer = device.renderer.write();
    match before {
        Some(Hung::Texture(known, id)) if known == texture => return Hung::Texture(known, id),
        Some(Hung::Texture(_, id)) => renderer.free_texture(&id),
        _ => {}
    }
    let view = texture.create_view(&Default::default());
    let id = renderer.register_native_texture(&device.device, &view, wgpu::FilterMode::Linear);
    Hung::Texture(texture, id)
}

fn handed_over(context: &egui::Context, picture: Arc<Picture>, before: Option<Hung>) -> Hung {
    let image = || egui::ColorImage::from_rgba_unmultiplied([picture.width as usize, picture.height as usize], &picture.rgba8);
    match before {
        Some(Hung::Pixels(known, handle)) if Arc::ptr_eq(&known, &picture) => Hung::Pixels(known, handle),
        Some(Hung::Pixels(_, mut handle)) => {
            handle.set(image(), egui::TextureOptions::LINEAR);
            Hung::Pixels(picture, handle)
        }
        _ => {
            let handle = context.load_texture("picture", image(), egui::TextureOptions::LINEAR);
            Hung::Pixels(picture, handle)
        }
    }
}
