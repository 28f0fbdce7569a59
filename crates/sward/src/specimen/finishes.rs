//! What plants look like: materials and their pictures.

use image::DynamicImage;

use super::{Finish, Kind, Picture};
use crate::figure::FigureError;
use crate::figure::container::Opened;
use crate::figure::json::Material;
use crate::figure::material::{image_of, pictures};

/// Pictures by the file's image.
pub(super) type Pictures = Vec<Option<Picture>>;

/// All pictures that base colours use.
pub(super) fn decoded(opened: &Opened<'_>) -> Result<Pictures, FigureError> {
    let picture = |image: DynamicImage| {
        let image = image.into_rgba8();
        Picture { size: [image.width(), image.height()], texels: image.pixels().map(|pixel| pixel.0).collect() }
    };
    pictures(opened, picture)
}

/// What a material looks like, its picture by the file's image; `None` is what has no material.
pub(super) fn finish(opened: &Opened<'_>, material: Option<usize>, kind: Kind) -> Result<Finish, FigureError> {
    let Some(index) = material else {
        let (colour, name) = ([0.6; 3], "no material".to_owned());
        return Ok(Finish { kind, colour, picture: None, cutoff: 0.0, two_sided: kind == Kind::Leaf, name });
    };
    let Material { name, pbr_metallic_roughness, alpha_mode, alpha_cutoff, double_sided } = &opened.root.materials[index];
    let share = |value: f32| if value > 0.0 { if value < 1.0 { value } else { 1.0 } } else { 0.0 };
    let factor = pbr_metallic_roughness.base_color_factor.unwrap_or([1.0; 4]).map(share);
    let asked = match alpha_mode.as_str() {
        "MASK" => alpha_cutoff.unwrap_or(0.5),
        // Leaves are not sorted by depth: what is half there is there.
        "BLEND" => 0.5,
        _ => 0.0,
    };
    // The factor scales alpha; the picture's own is compared.
    let cutoff = if asked > 0.0 { share(asked / factor[3]) } else { 0.0 };
    let name = if name.is_empty() { format!("materials[{index}]") } else { name.clone() };
    let colour = [factor[0], factor[1], factor[2]];
    Ok(Finish { kind, colour, picture: image_of(&opened.root, index)?, cutoff, two_sided: *double_sided, name })
}
