//! Colours: base colour factor, texture and vertex colours, brought down to the corners.
//!
//! A texture is sampled once a corner, at its nearest texel: exact for palettes and flat colours, coarse for painted detail on large triangles.

use image::{DynamicImage, ImageFormat, ImageReader, Limits};
use std::borrow::Cow;
use std::io::Cursor;

use super::container::{Opened, resolve};
use super::error::FigureError;
use super::json::{Primitive, Root, at};

/// Largest texture, pixels a side.
const LARGEST: u32 = 8192;
/// Most pixels of all textures of a file.
const MOST_TEXELS: u64 = 1 << 27;
/// Surface of a body without a material: lacquer.
const PAINT: [f32; 2] = [0.28, 0.05];

/// A decoded picture, linear RGB.
pub(crate) struct Picture {
    size: [u32; 2],
    texels: Vec<[u8; 3]>,
}

/// What a primitive looks like.
pub(crate) struct Finish<'a> {
    factor: [f32; 4],
    texture: Option<&'a Picture>,
    pub(crate) surface: [f32; 2],
    /// Which set of texture coordinates.
    pub(crate) coordinates: u32,
}

fn linear(code: u8) -> f32 {
    let c = f32::from(code) / 255.0;
    if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
}

impl Picture {
    pub(super) fn of(image: DynamicImage) -> Self {
        let picture = image.into_rgb8();
        Self { size: [picture.width(), picture.height()], texels: picture.pixels().map(|pixel| pixel.0).collect() }
    }

    /// Texel at (u, v), repeated.
    fn at(&self, uv: [f32; 2]) -> [f32; 3] {
        let along = |value: f32, size: u32| {
            let within = value - value.floor();
            ((within * size as f32) as u32).min(size - 1)
        };
        let (x, y) = (along(uv[0], self.size[0]), along(uv[1], self.size[1]));
        self.texels[(y * self.size[0] + x) as usize].map(linear)
    }
}

/// The picture of a texture. Errors: in words that follow its name.
fn decode(bytes: &[u8]) -> Result<DynamicImage, String> {
    let known = image::guess_format(bytes).ok().filter(|format| matches!(format, ImageFormat::Png | ImageFormat::Jpeg));
    let format = known.ok_or("is neither a PNG nor a JPEG")?;
    let cannot = |error: image::ImageError| format!("cannot be decoded: {error}");
    let (width, height) = ImageReader::with_format(Cursor::new(bytes), format).into_dimensions().map_err(cannot)?;
    if !(1..=LARGEST).contains(&width) || !(1..=LARGEST).contains(&height) {
        return Err(format!("is {width} x {height} pixels"));
    }
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    let mut limits = Limits::default();
    (limits.max_image_width, limits.max_image_height) = (Some(LARGEST), Some(LARGEST));
    reader.limits(limits);
    reader.decode().map_err(cannot)
}

/// Pixels that a picture's header announces; 0 for what is no picture.
fn announced(bytes: &[u8]) -> u64 {
    let reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format().ok();
    let size = reader.and_then(|reader| reader.into_dimensions().ok());
    size.map_or(0, |(width, height)| u64::from(width) * u64::from(height))
}

/// All pictures that base colours use, by image, as `made` of them. How many pixels there are is looked at before any is decoded.
pub(crate) fn pictures<T>(opened: &Opened<'_>, made: impl Fn(DynamicImage) -> T) -> Result<Vec<Option<T>>, FigureError> {
    let root = &opened.root;
    let mut files: Vec<Option<Cow<'_, [u8]>>> = vec![None; root.images.len()];
    let mut texels = 0;
    for index in 0..root.materials.len() {
        let Some(image) = image_of(root, index)?.filter(|image| files[*image].is_none()) else { continue };
        let place = format!("images[{image}]");
        let source = &root.images[image];
        let bytes = match (&source.uri, source.buffer_view) {
            (_, Some(view)) => Cow::Borrowed(opened.view(view, &place)?.0),
            (Some(uri), None) => Cow::Owned(resolve(uri, opened.neighbour, &place)?),
            (None, None) => continue,
        };
        texels += announced(&bytes);
        if texels > MOST_TEXELS {
            let instead = "export smaller textures, like 1024 x 1024";
            return Err(FigureError::TooMany { what: "pixels in its textures", found: texels, most: MOST_TEXELS, instead });
        }
        files[image] = Some(bytes);
    }
    let picture = |(index, bytes): (usize, Option<Cow<'_, [u8]>>)| {
        let name = root.images[index].name.as_ref().map_or_else(String::new, |name| format!(" {name:?}"));
        let bad = |what| FigureError::Texture { image: format!("images[{index}]{name}"), what };
        bytes.map(|bytes| decode(&bytes).map(&made).map_err(bad)).transpose()
    };
    files.into_iter().enumerate().map(picture).collect()
}

/// The image that colours a material.
pub(crate) fn image_of(root: &Root, material: usize) -> Result<Option<usize>, FigureError> {
    let place = format!("materials[{material}]");
    let Some(used) = &root.materials[material].pbr_metallic_roughness.base_color_texture else { return Ok(None) };
    let texture = at(&root.textures, used.index, "textures", &place)?;
    let Some(image) = texture.source else { return Ok(None) };
    at(&root.images, image, "images", &place).map(|_| Some(image))
}

/// What a primitive looks like; `None` without a material.
pub(crate) fn finish<'a>(
    root: &Root,
    pictures: &'a [Option<Picture>],
    primitive: &Primitive,
    place: &str,
) -> Result<Option<Finish<'a>>, FigureError> {
    let Some(index) = primitive.material else { return Ok(None) };
    let material = &at(&root.materials, index, "materials", place)?.pbr_metallic_roughness;
    let share = |value: Option<f32>| value.filter(|value| (0.0..=1.0).contains(value)).unwrap_or(1.0);
    let (metal, roughness) = (share(material.metallic_factor), share(material.roughness_factor));
    let factor = material.base_color_factor.unwrap_or([1.0; 4]).map(|part| if part > 0.0 { part.min(1.0) } else { 0.0 });
    Ok(Some(Finish {
        factor,
        texture: image_of(root, index)?.and_then(|image| pictures[image].as_ref()),
        surface: [roughness.max(0.08), 0.04 + 0.5 * metal * (1.0 - roughness)],
        coordinates: material.base_color_texture.as_ref().map_or(0, |used| used.tex_coord),
    }))
}

/// Colour (with its share of paint) and surface of a corner.
pub(crate) fn corner(finish: Option<&Finish<'_>>, uv: Option<[f32; 2]>, own: [f32; 4]) -> ([f32; 4], [f32; 2]) {
    let Some(finish) = finish else { return ([0.6, 0.6, 0.6, 1.0], PAINT) };
    let texel = finish.texture.zip(uv).map_or([1.0; 3], |(picture, uv)| picture.at(uv));
    let colour = [0, 1, 2].map(|k| finish.factor[k] * texel[k] * own[k].clamp(0.0, 1.0));
    ([colour[0], colour[1], colour[2], 0.0], finish.surface)
}
