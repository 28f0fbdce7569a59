//! A scene's picture from the CPU and from the GPU, and pictures that must not look like it.

use std::path::PathBuf;
use std::time::Instant;

use image::ImageEncoder;
use libtest_mimic::Failed;
use sward::model::{Assets, Folder};
use sward::picture::Picture;
use sward::scene::{CameraKey, Scene};
use sward::world::World;
use sward_wgpu::gpu::Gpu;
use sward_wgpu::studio::{CellsAt, Studio};

use crate::adapter::{Verdict, ensure};

/// Size of the pictures, pixels.
const SIZE: [u32; 2] = [320, 180];
/// Largest mean difference over pixels and channels, of 255, on software adapters. 0.06 to 0.27 when this was written.
const SOFTWARE: f64 = 0.5;
/// Hardware spreads alpha over samples in its own way.
const HARDWARE: f64 = 4.0;

fn difference(a: &Picture, b: &Picture) -> f64 {
    if [a.width, a.height] != [b.width, b.height] || a.rgba8.is_empty() {
        return f64::INFINITY;
    }
    let sum: f64 = a.rgba8.iter().zip(&b.rgba8).map(|(a, b)| f64::from(a.abs_diff(*b))).sum();
    sum / (0.75 * a.rgba8.len() as f64)
}

/// The files of the repository, and a picture of surroundings made here.
struct Files(Folder);

impl Assets for Files {
    fn read(&self, path: &str) -> Result<Vec<u8>, String> {
        match path {
            SURROUNDINGS => Ok(surroundings_hdr()),
            DIRECTIONS => Ok(directions_png()),
            _ => self.0.read(path),
        }
    }
}

/// Name of that picture.
const SURROUNDINGS: &str = "made here.hdr";

/// Name of a picture of directions.
const DIRECTIONS: &str = "made here.png";

/// Grass combed one way on the left and another on the right, some 0.7 rad.
fn directions_png() -> Vec<u8> {
    let pixels: Vec<u8> = (0..64).flat_map(|at| if at % 8 < 4 { [210, 128, 225] } else { [90, 50, 225] }).collect();
    let mut bytes = Vec::new();
    let encoder = image::codecs::png::PngEncoder::new(&mut bytes);
    encoder.write_image(&pixels, 8, 8, image::ExtendedColorType::Rgb8).expect("written to memory");
    bytes
}

/// A blue sky that is bright on one side, a low sun there, brown ground; Radiance RGBE.
fn surroundings_hdr() -> Vec<u8> {
    let (columns, rows) = (128_u32, 64_u32);
    let pixel = |at: u32| {
        let turn = ((at % columns) as f32 + 0.5) / columns as f32 * std::f32::consts::TAU - std::f32::consts::PI;
        let (level, up) = (((at / columns) as f32 + 0.5) / rows as f32 * std::f32::consts::PI).sin_cos();
        let direction = [level * turn.cos(), up, level * turn.sin()];
        let towards = 0.5 + 0.5 * (0.8 * direction[0] + 0.6 * direction[2]);
        let sun = (0.74 * direction[0] + 0.38 * up + 0.555 * direction[2]) > 0.9985;
        let sky = if up > 0.0 { [0.4 + 0.8 * towards, 0.6 + 0.5 * towards, 0.9] } else { [0.15, 0.12, 0.08] };
        if sun { [400.0, 340.0, 240.0] } else { sky }
    };
    let pixels: Vec<[f32; 3]> = (0..columns * rows).map(pixel).collect();
    let mut bytes = Vec::new();
    let encoder = image::codecs::hdr::HdrEncoder::new(&mut bytes);
    encoder.write_image(bytemuck::cast_slice(&pixels), columns, rows, image::ExtendedColorType::Rgb32F).expect("written to memory");
    bytes
}

fn world_of(scene: Scene, root: PathBuf) -> Result<World, Failed> {
    Ok(World::new(scene, &Files(Folder(root)))?)
}

/// Compares a shipped scene's default view after `seconds`. Controls: the picture of a quarter of a second later, and that of other
/// plants.
fn same(gpu: &Gpu, name: &str, seconds: f64) -> Verdict {
    same_changed(gpu, name, seconds, |_| ())
}

fn same_changed(gpu: &Gpu, name: &str, seconds: f64, change: impl Fn(&mut Scene)) -> Verdict {
    same_unlike(gpu, name, seconds, change, |_| ()).map(|_| ())
}

/// The same; returns how far from the picture one is of a world that `spoil` changed, and how far one may be.
fn same_unlike(gpu: &Gpu, name: &str, seconds: f64, change: impl Fn(&mut Scene), spoil: impl Fn(&mut World)) -> Result<[f64; 2], Failed> {
    let root = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    let text = std::fs::read_to_string(root.join("scenes").join(format!("{name}.ron")))?;
    let mut scene = Scene::parse(&text, name)?;
    // A gale wakes all the patches it may; the nearest are what is seen, and take a tenth of the time.
    scene.budget.patches = scene.budget.patches.min(25);
    change(&mut scene);
    let mut world = world_of(scene, root)?;
    let steps = |world: &mut World, seconds: f64| (0..(seconds / world.model.dt).round() as u64).for_each(|_| world.step());
    steps(&mut world, seconds);
    let theirs = Studio::new(gpu, &world)?.draw(gpu, &world, CellsAt::Cpu, SIZE)?;
    let studio = sward_raster::Studio::new(&world);
    let begun = Instant::now();
    let apart = difference(&studio.draw(&world, SIZE), &theirs);
    let took = begun.elapsed().as_secs_f64();
    let mut spoilt = world.clone();
    spoil(&mut spoilt);
    let unlike = difference(&studio.draw(&spoilt, SIZE), &theirs);
    steps(&mut world, 0.25);
    let later = difference(&studio.draw(&world, SIZE), &theirs);
    world.model.stands.iter_mut().for_each(|stand| stand.placement.seed ^= 1);
    let meshes = world.state.layered.iter_mut().flat_map(|stand| stand.near.values_mut().flatten());
    meshes.for_each(|plant| plant.yaw += 1.0);
    let others = difference(&sward_raster::Studio::new(&world).draw(&world, SIZE), &theirs);
    println!("{name}: {apart:.3} of 255 (drawn in {took:.1} s), later {later:.3}, other plants {others:.3}");
    let software = gpu.adapter_info.device_type == wgpu::DeviceType::Cpu;
    let most = if software { SOFTWARE } else { HARDWARE };
    ensure(apart <= most, || format!("{name}: CPU and GPU differ by {apart:.3} of 255 on average, allowed {most}"))?;
    ensure(later > most || !software, || format!("{name}: a quarter of a second later looks the same: {later:.3} of 255"))?;
    ensure(others > HARDWARE, || format!("{name}: other plants look the same: {others:.3} of 255"))?;
    Ok([unlike, most])
}

pub(crate) fn hello(gpu: &Gpu) -> Verdict {
    same(gpu, "hello", 6.2)
}

/// Pictures for slow devices, thinned out. Control: the usual picture.
pub(crate) fn sparse(gpu: &Gpu) -> Verdict {
    let root = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    let mut world = world_of(Scene::parse(&std::fs::read_to_string(root.join("scenes/hello.ron"))?, "hello")?, root)?;
    (0..60).for_each(|_| world.step());
    let (mut theirs, mut own) = (Studio::new(gpu, &world)?, sward_raster::Studio::new(&world));
    let usual = own.draw(&world, SIZE);
    theirs.thin(0.2);
    own.thin(0.2);
    let theirs = theirs.draw(gpu, &world, CellsAt::Cpu, SIZE)?;
    let (apart, control) = (difference(&own.draw(&world, SIZE), &theirs), difference(&usual, &theirs));
    println!("sparse: {apart:.3} of 255, the usual picture {control:.3}");
    let most = if gpu.adapter_info.device_type == wgpu::DeviceType::Cpu { SOFTWARE } else { HARDWARE };
    ensure(apart <= most, || format!("CPU and GPU differ by {apart:.3} of 255 on average, allowed {most}"))?;
    ensure(control > 2.0 * apart, || format!("the usual picture looks the same: {control:.3} of 255"))
}

/// Shrubs, without the meadow between them, while new cuts take over from older ones. Control: with all layers at the same place.
pub(crate) fn layers(gpu: &Gpu) -> Verdict {
    let change = |scene: &mut Scene| {
        scene.stands.remove(0);
        scene.camera.keys =
            [(0.0, -1.6), (0.6, 1.6)].map(|(time, x)| CameraKey { time, eye: [x, 1.3, -1.6], target: [0.0, 0.8, 3.0] }).to_vec();
    };
    let still = |world: &mut World| {
        world.state.layered.iter_mut().flat_map(|state| &mut state.notes).flatten().for_each(|wave| *wave = [0.0; 2]);
    };
    let [still, most] = same_unlike(gpu, "shrub", 0.5, change, still)?;
    ensure(still > most, || format!("shrubs that stand still look the same: {still:.3} of 255"))
}

pub(crate) fn lawn(gpu: &Gpu) -> Verdict {
    same(gpu, "lawn", 6.0)
}

pub(crate) fn reed(gpu: &Gpu) -> Verdict {
    same(gpu, "reed", 2.0)
}

pub(crate) fn crossing(gpu: &Gpu) -> Verdict {
    same(gpu, "crossing", 3.0)
}

/// Bare ground, and ground that was changed before and during the run.
pub(crate) fn road(gpu: &Gpu) -> Verdict {
    same(gpu, "road", 4.0)
}

pub(crate) fn paper(gpu: &Gpu) -> Verdict {
    same(gpu, "paper", 1.0)
}

pub(crate) fn endless(gpu: &Gpu) -> Verdict {
    same(gpu, "endless", 1.0)
}

/// Bumps on the ground, halved in height where the ground's grid is coarse; and what a helicopter blows.
pub(crate) fn detail(gpu: &Gpu) -> Verdict {
    same_changed(gpu, "downwash", 3.0, |scene| {
        scene.detail = Some(sward::scene::Detail { amplitude: 0.3, wavelength: 6.0, ..Default::default() });
    })
}

/// Plants that swing by themselves, as blades and as billboards.
pub(crate) fn footsteps(gpu: &Gpu) -> Verdict {
    same_changed(gpu, "footsteps", 3.0, |scene| scene.budget.visible_blades = 60_000)?;
    same_changed(gpu, "footsteps", 3.0, |scene| {
        scene.stands[0].representation = None;
        scene.stands[0].cells = Some(128);
    })
}

/// Blades and billboards in one picture.
pub(crate) fn blades(gpu: &Gpu) -> Verdict {
    same_changed(gpu, "hello", 6.2, |scene| {
        scene.stands[0].representation = Some(sward::scene::Representation::Blade(Default::default()));
        scene.budget.visible_blades = 60_000;
    })
}

/// Sheets of each kind of response: a continuum, plants that swing by themselves, and blade by blade.
pub(crate) fn sheets(gpu: &Gpu) -> Verdict {
    use sward::scene::{Representation, Response};
    let sheets = |scene: &mut Scene, response: Option<Response>| {
        scene.stands[0].representation = Some(Representation::Sheet(Default::default()));
        scene.stands[0].response = response;
    };
    same_changed(gpu, "hello", 6.2, |scene| sheets(scene, None))?;
    same_changed(gpu, "footsteps", 3.0, |scene| {
        sheets(scene, Some(Response::Oscillator(Default::default())));
        scene.stands[0].cells = Some(128);
    })?;
    same_changed(gpu, "hello", 3.0, |scene| sheets(scene, Some(Response::VirtualInertia(Default::default()))))
}

/// Billboards that bodies deform, drawn as they are. Control: as if none had been touched.
pub(crate) fn deformed_sheets(gpu: &Gpu) -> Verdict {
    let untouched = |world: &mut World| {
        world.state.stands[0].cells.now.iter_mut().for_each(|places| places.fill(f32::from_bits(u32::MAX)));
    };
    let [unlike, most] = same_unlike(gpu, "stamp", 2.3, |_| (), untouched)?;
    println!("stamp, untouched: {unlike:.3} of 255");
    ensure(unlike > most, || format!("untouched it looks the same: {unlike:.3} of 255"))
}

/// Grass that pictures and numbers comb: cards, blades and sheets. Control: upright, it looks otherwise.
pub(crate) fn combed(gpu: &Gpu) -> Verdict {
    for (name, seconds) in [("hello", 1.0), ("blades", 1.0), ("stamp", 2.3)] {
        let comb = |scene: &mut Scene| {
            let [x, _, z] = scene.camera.target;
            scene.stands.iter_mut().for_each(|stand| (stand.lean, stand.messiness) = ([0.1, 0.2], 0.4));
            let mask =
                sward::scene::Mask { direction: DIRECTIONS.to_owned(), at: [x - 6.0, z - 6.0], size: [12.0; 2], ..Default::default() };
            scene.masks.push(mask);
        };
        let upright = |world: &mut World| {
            for stand in &mut world.model.stands {
                stand.growth.combs.clear();
                (stand.placement.lean, stand.placement.messiness) = ([0.0; 2], 0.0);
            }
        };
        let [unlike, most] = same_unlike(gpu, name, seconds, comb, upright)?;
        println!("{name}, upright: {unlike:.3} of 255");
        ensure(unlike > most, || format!("{name}: upright it looks the same: {unlike:.3} of 255"))?;
    }
    Ok(())
}

/// Light of surroundings, and of the volume among cards, blades, sheets, bare ground and bodies.
pub(crate) fn surroundings(gpu: &Gpu) -> Verdict {
    let volume = sward::scene::LightVolume { voxel: 1.0, layers: 6, samples: 32, ..Default::default() };
    let light = |scene: &mut Scene| {
        scene.light.environment =
            Some(sward::scene::Environment { file: SURROUNDINGS.to_owned(), strength: 1.0, turn: 0.4, volume: volume.clone() });
    };
    same_changed(gpu, "crossing", 3.0, |scene| {
        light(scene);
        let [x, _, z] = scene.camera.target;
        let area = sward::scene::Area::Disc(sward::scene::Disc { at: [x, z], radius: 2.0 });
        scene.exclusions.push(sward::scene::Exclusion { area, ..Default::default() });
    })?;
    same_changed(gpu, "hello", 6.2, |scene| {
        light(scene);
        scene.stands[0].representation = Some(sward::scene::Representation::Blade(Default::default()));
        scene.budget.visible_blades = 60_000;
    })?;
    same_changed(gpu, "hello", 6.2, |scene| {
        light(scene);
        scene.stands[0].representation = Some(sward::scene::Representation::Sheet(Default::default()));
    })
}
