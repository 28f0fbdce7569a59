//! Small pictures of the shipped scenes. `examples/thumbnails.rs` draws them.

use eframe::egui;

macro_rules! pictures {
    ($($name:literal)*) => { &[$(($name, include_bytes!(concat!("../thumbnails/", $name, ".jpg")))),*] };
}

/// Names and JPEGs.
const PICTURES: &[(&str, &[u8])] = pictures! {
    "hello" "lawn" "reed" "crossing" "downwash" "road" "paper" "endless" "blades" "grassland" "footsteps" "stamp" "walkers" "eddies" "shrub"
    "crown" "aquarium" "field" "everything"
};

/// The picture of a scene, which egui keeps from the first time on; `None` for a scene without one, or not yet: they are read one a pass, so that the
/// first pass does not take long.
pub fn of(context: &egui::Context, name: &str) -> Option<egui::TextureHandle> {
    let (_, bytes) = PICTURES.iter().find(|(of, _)| *of == name)?;
    let place = egui::Id::new(("thumbnail", name));
    if let Some(known) = context.data(|data| data.get_temp::<egui::TextureHandle>(place)) {
        return Some(known);
    }
    let (pass, last) = (context.cumulative_pass_nr(), egui::Id::new("last thumbnail"));
    if context.data(|data| data.get_temp(last)) == Some(pass) {
        return None;
    }
    context.data_mut(|data| data.insert_temp(last, pass));
    let picture = image::load_from_memory_with_format(bytes, image::ImageFormat::Jpeg).ok()?.into_rgb8();
    let size = [picture.width() as usize, picture.height() as usize];
    let texture = context.load_texture(name, egui::ColorImage::from_rgb(size, &picture), egui::TextureOptions::LINEAR);
    context.data_mut(|data| data.insert_temp(place, texture.clone()));
    Some(texture)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scene_has_a_picture() {
        let context = egui::Context::default();
        for shipped in sward_scenes::SHIPPED {
            context.begin_pass(egui::RawInput::default());
            let picture = of(&context, shipped.name);
            let _ = context.end_pass();
            assert!(picture.is_some_and(|picture| picture.size() == [192, 108]), "{}", shipped.name);
        }
        assert!(of(&context, "nothing").is_none(), "control");
    }

    #[test]
    fn one_is_read_a_pass() {
        let context = egui::Context::default();
        let read = |name| of(&context, name).is_some();
        context.begin_pass(egui::RawInput::default());
        assert_eq!([read("hello"), read("lawn"), read("hello")], [true, false, true]);
        let _ = context.end_pass();
        context.begin_pass(egui::RawInput::default());
        assert_eq!([read("lawn"), read("reed")], [true, false]);
        let _ = context.end_pass();
    }
}
