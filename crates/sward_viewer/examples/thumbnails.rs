//! Draws the small pictures of the scene menu anew: `cargo run --release -p sward_viewer --example thumbnails`; names of scenes after `--` draw
//! only those.

use std::path::Path;

use sward::scene::Scene;
use sward::world::World;
use sward_wgpu::gpu::Gpu;
use sward_wgpu::studio::{CellsAt, Studio};

/// Pixels of a picture; each is the mean of four that are drawn.
const SIZE: [u32; 2] = [192, 108];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let gpu = Gpu::new()?;
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("thumbnails");
    let names: Vec<String> = std::env::args().skip(1).collect();
    for shipped in sward_scenes::SHIPPED.iter().filter(|shipped| names.is_empty() || names.iter().any(|name| name == shipped.name)) {
        let mut world = World::new(Scene::parse(shipped.text, shipped.name)?, &sward_scenes::Embedded)?;
        while world.time() < shipped.time {
            world.step();
        }
        let picture = Studio::new(&gpu, &world)?.draw(&gpu, &world, CellsAt::Cpu, SIZE.map(|side| 2 * side))?;
        let drawn = image::RgbaImage::from_raw(picture.width, picture.height, picture.rgba8).ok_or("no picture")?;
        let [width, height] = SIZE;
        let small = image::imageops::resize(&drawn, width, height, image::imageops::FilterType::Triangle);
        let path = folder.join(format!("{}.jpg", shipped.name));
        let encoder = image::codecs::jpeg::JpegEncoder::new_with_quality(std::fs::File::create(&path)?, 82);
        image::DynamicImage::ImageRgba8(small).into_rgb8().write_with_encoder(encoder)?;
        println!("{}", path.display());
    }
    Ok(())
}
