//! Pictures of scenes, how far two are apart, and the stored ones they are held against.

use std::path::PathBuf;

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};
use libtest_mimic::Failed;
use sward::model::Folder;
use sward::scene::Scene;
use sward::world::World;
use sward_wgpu::compute::GpuStep;
use sward_wgpu::gpu::Gpu;
use sward_wgpu::picture::Picture;
use sward_wgpu::studio::{CellsAt, Studio};

use crate::adapter::{Verdict, ensure};

/// Size of all pictures here, pixels.
pub(crate) const SIZE: [u32; 2] = [240, 135];
/// Most bytes of a stored picture.
const LARGEST: usize = 64 << 10;

/// The repository.
fn root() -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

/// A world of the repository's files, at time 0.
pub(crate) fn world_of(scene: Scene) -> Result<World, Failed> {
    Ok(World::new(scene, &Folder(root()))?)
}

/// A shipped scene.
pub(crate) fn shipped(name: &str) -> Result<Scene, Failed> {
    let text = std::fs::read_to_string(root().join("scenes").join(format!("{name}.ron")))?;
    Ok(Scene::parse(&text, name)?)
}

/// Steps on the CPU to `seconds`, and a picture of that moment.
pub(crate) fn taken(gpu: &Gpu, scene: Scene, seconds: f64) -> Result<Picture, Failed> {
    let mut world = world_of(scene)?;
    let steps = (seconds / world.model.dt).round() as u64;
    (0..steps).for_each(|_| world.step());
    drawn(gpu, &world)
}

/// As [`taken`], stepped on the GPU.
pub(crate) fn taken_on_gpu(gpu: &Gpu, scene: Scene, seconds: f64) -> Result<Picture, Failed> {
    let mut world = world_of(scene)?;
    let mut step = GpuStep::new(gpu, &world)?;
    for _ in 0..(seconds / world.model.dt).round() as u64 {
        step.step(gpu, &mut world)?;
    }
    Ok(Studio::new(gpu, &world)?.draw(gpu, &world, CellsAt::Gpu(&step), SIZE)?)
}

/// A picture of a world whose cells are on the CPU.
fn drawn(gpu: &Gpu, world: &World) -> Result<Picture, Failed> {
    Ok(Studio::new(gpu, world)?.draw(gpu, world, CellsAt::Cpu, SIZE)?)
}

/// How far two pictures of equal size are apart, in code values of 0 to 255.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Difference {
    /// Mean over all channels.
    pub(crate) mean: f64,
    /// Share of pixels of which a channel differs by more than the threshold.
    pub(crate) share: f64,
}

/// Difference of two pictures; sizes that differ are infinitely far apart.
pub(crate) fn difference(a: &Picture, b: &Picture, threshold: u8) -> Difference {
    if [a.width, a.height] != [b.width, b.height] || a.rgba8.is_empty() {
        return Difference { mean: f64::INFINITY, share: 1.0 };
    }
    let sum: f64 = a.rgba8.iter().zip(&b.rgba8).map(|(a, b)| f64::from(a.abs_diff(*b))).sum();
    let pixels = a.rgba8.chunks_exact(4).zip(b.rgba8.chunks_exact(4));
    let over = pixels.filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > threshold)).count();
    let channels = a.rgba8.len() as f64 * 0.75;
    Difference { mean: sum / channels, share: over as f64 / (a.rgba8.len() / 4) as f64 }
}

/// The first word of the adapter's name, in small letters: `llvmpipe`, `swiftshader`.
pub(crate) fn driver(gpu: &Gpu) -> String {
    let name = gpu.adapter_info.name.to_lowercase();
    name.split(|letter: char| !letter.is_ascii_alphanumeric()).find(|word| !word.is_empty()).unwrap_or("unknown").to_owned()
}

/// Whether `SWARD_GOLDEN` is `<word>:<name>` or `<word>:all`.
fn asked(word: &str, name: &str) -> bool {
    let value = std::env::var("SWARD_GOLDEN").unwrap_or_default();
    value.split_once(':').is_some_and(|(asked, which)| asked == word && (which == name || which == "all"))
}

/// Holds a picture against `golden/<name>.<driver>.png`.
///
/// `SWARD_GOLDEN=create:<name>` stores it where none is stored, `SWARD_GOLDEN=update:<name>` in any case; `all` is every name.
pub(crate) fn golden(gpu: &Gpu, name: &str, picture: &Picture, threshold: u8, share: f64) -> Verdict {
    let driver = driver(gpu);
    let path = root().join("golden").join(format!("{name}.{driver}.png"));
    let missing = !path.exists();
    if asked("update", name) || missing && asked("create", name) {
        return store(&path, picture);
    }
    ensure(!missing, || {
        format!(
            "golden/{name}.{driver}.png is missing: look at the picture, then run this test with SWARD_GOLDEN=create:{name} (or create:all)"
        )
    })?;
    let expected = load(&path)?;
    let found = difference(&expected, picture, threshold);
    println!("{name}: mean {:.3}, {:.3} % of pixels over {threshold}", found.mean, 100.0 * found.share);
    if found.share <= share {
        return Ok(());
    }
    let kept = keep(name, &driver, &expected, picture)?;
    let most = 100.0 * share;
    Err(format!(
        "{name}: {:.2} % of the pixels differ by more than {threshold}, allowed {most} %; expected | difference | actual: {}; \
         if the new picture is right: SWARD_GOLDEN=update:{name}",
        100.0 * found.share,
        kept.display()
    )
    .into())
}

fn load(path: &std::path::Path) -> Result<Picture, Failed> {
    let pixels = image::load_from_memory(&std::fs::read(path)?)?.to_rgba8();
    Ok(Picture { width: pixels.width(), height: pixels.height(), rgba8: pixels.into_raw() })
}

/// As RGB: pictures are opaque.
fn png(picture: &Picture) -> Result<Vec<u8>, Failed> {
    let rgb: Vec<u8> = picture.rgba8.chunks_exact(4).flat_map(|pixel| &pixel[..3]).copied().collect();
    let mut bytes = Vec::new();
    let encoder = PngEncoder::new_with_quality(&mut bytes, CompressionType::Best, FilterType::Adaptive);
    encoder.write_image(&rgb, picture.width, picture.height, ExtendedColorType::Rgb8)?;
    Ok(bytes)
}

/// Stored in steps of four code values: grass hardly compresses, and thresholds are coarser than that.
fn store(path: &std::path::Path, picture: &Picture) -> Verdict {
    let coarse = picture.rgba8.iter().map(|value| value.saturating_add(2) & 0xfc).collect();
    let bytes = png(&Picture { rgba8: coarse, ..picture.clone() })?;
    println!("{}: {} bytes", path.display(), bytes.len());
    ensure(bytes.len() <= LARGEST, || format!("{}: {} bytes, allowed {LARGEST}", path.display(), bytes.len()))?;
    std::fs::create_dir_all(root().join("golden"))?;
    Ok(std::fs::write(path, bytes)?)
}

/// Writes expected | difference (eight times as strong) | actual side by side.
fn keep(name: &str, driver: &str, expected: &Picture, actual: &Picture) -> Result<PathBuf, Failed> {
    let folder = root().join("target/golden");
    std::fs::create_dir_all(&folder)?;
    let height = if expected.height > actual.height { expected.height } else { actual.height };
    let width = if expected.width > actual.width { expected.width } else { actual.width };
    let pixel = |picture: &Picture, x: u32, y: u32| {
        let at = 4 * (y * picture.width + x) as usize;
        let inside = x < picture.width && y < picture.height;
        if inside { [picture.rgba8[at], picture.rgba8[at + 1], picture.rgba8[at + 2]] } else { [0; 3] }
    };
    let mut side_by_side = Picture { width: 3 * width, height, rgba8: Vec::new() };
    for y in 0..height {
        for x in 0..3 * width {
            let (a, b) = (pixel(expected, x % width, y), pixel(actual, x % width, y));
            let difference = [0, 1, 2].map(|k| a[k].abs_diff(b[k]).saturating_mul(8));
            side_by_side.rgba8.extend([a, difference, b][(x / width) as usize]);
            side_by_side.rgba8.push(255);
        }
    }
    let path = folder.join(format!("{name}.{driver}.png"));
    std::fs::write(&path, png(&side_by_side)?)?;
    Ok(path)
}
