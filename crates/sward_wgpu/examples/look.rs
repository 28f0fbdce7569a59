//! One picture of a meadow with a truck, its plants posed by hand: for working on the looks without a simulation.
//!
//! `cargo run -p sward_wgpu --example look -- OUT.png [key=value …]` with keys size=960x540, view=0..5, dem=FILE, azimuth,
//! elevation, haze, fog, clouds, exposure, kind=meadow|lawn|reed|tussock, time.

use std::collections::HashMap;
use std::error::Error;
use std::time::Instant;

use glam::{Mat4, Quat, Vec2, Vec3};
use sward::geometry::truck::truck;
use sward::shading::clump::Kind;
use sward_wgpu::gpu::Gpu;
use sward_wgpu::picture::{Renderer, Setup};
use sward_wgpu::render::frame::{BodyDraw, FrameInput, LightInput, View};
use sward_wgpu::render::ground::Relief;
use sward_wgpu::render::plants::{Look, PLANTS_PER_INSTANCE, Plant, PlantBatch, PlantCount, PlantDraws};
use wgpu::util::DeviceExt;

/// Ground position of the frame origin.
const ORIGIN: [f64; 2] = [96.0, -64.0];
/// The truck's circle, relative to the frame origin: centre and radius.
const CIRCLE: (Vec2, f32) = (Vec2::new(-8.0, 26.0), 22.0);

struct Options(HashMap<String, String>);

impl Options {
    fn text(&self, key: &str, default: &str) -> String {
        self.0.get(key).cloned().unwrap_or_else(|| default.to_owned())
    }
    fn number(&self, key: &str, default: f32) -> f32 {
        self.0.get(key).and_then(|value| value.parse().ok()).unwrap_or(default)
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let out = arguments.first().cloned().unwrap_or_else(|| "look.png".into());
    let options = Options(arguments.iter().skip(1).filter_map(|pair| pair.split_once('=')).map(|(k, v)| (k.into(), v.into())).collect());
    let size = options.text("size", "960x540");
    let (width, height) = size.split_once('x').ok_or("size is WIDTHxHEIGHT")?;
    let size = [width.parse()?, height.parse()?];

    let start = Instant::now();
    let gpu = Gpu::new()?;
    let ground = Ground(relief(&options)?);
    let kind = match options.text("kind", "meadow").as_str() {
        "lawn" => Kind::Lawn,
        "reed" => Kind::Reed,
        "tussock" => Kind::Tussock,
        _ => Kind::Meadow,
    };
    let fade = options.number("fade", 110.0);
    let looks = vec![Look { fade: [0.64 * fade, fade], ..Look::of(kind) }];
    let mut renderer = Renderer::new(&gpu, &Setup { relief: ground.0.clone(), looks: looks.clone(), ..Setup::default() })?;
    let mesh = renderer.add_mesh(&gpu, &truck());
    println!("set up in {:?} on {}", start.elapsed(), gpu.adapter_info.name);

    let view = view(&options, &ground);
    let body = place_truck(&ground, mesh);
    let start = Instant::now();
    let scene = Scene { ground: &ground, view: &view, look: looks[0], fade: looks[0].fade[1] };
    let split = options.number("split", 40.0);
    let near = scene.plants(0.0, split, segments(kind));
    let far = scene.plants(split, scene.fade, 1);
    println!("{} + {} plants in {:?}", near.0.len(), far.0.len(), start.elapsed());
    let near_buffers = upload(&gpu, &near);
    let far_buffers = upload(&gpu, &far);
    let batch = |buffers: &'static str, plants, joints, count, segments, shadows| {
        let _ = buffers;
        PlantBatch { plants, joints, count: PlantCount::Direct(count), segments, cards: 2, look: 0, shadows }
    };
    let batches = [
        batch("near", &near_buffers.0, &near_buffers.1, near.0.len() as u32, segments(kind), true),
        batch("far", &far_buffers.0, &far_buffers.1, far.0.len() as u32, 1, true),
    ];
    let input = FrameInput {
        view,
        origin: ORIGIN,
        focus: focus(&view, &ground),
        light: LightInput {
            azimuth: options.number("azimuth", 0.6),
            elevation: options.number("elevation", 0.22),
            strength: 1.0,
            haze: options.number("haze", 0.3),
            fog: options.number("fog", 0.0015),
            exposure: options.number("exposure", 0.0),
            clouds: options.number("clouds", 0.4),
        },
        bodies: &[body],
        time: f64::from(options.number("time", 10.0)),
    };
    for pass in 0..options.number("repeat", 1.0) as u32 {
        let start = Instant::now();
        renderer.draw(&gpu, &input, &PlantDraws { batches: &batches }, size)?;
        let picture = renderer.read(&gpu)?;
        println!("picture {pass} in {:?}", start.elapsed());
        report(&options, &picture);
        image::save_buffer(&out, &picture.rgba8, picture.width, picture.height, image::ColorType::Rgba8)?;
    }
    Ok(())
}

/// Prints the mean code values of a part of the picture: `mean=x0,y0,x1,y1` in pixels.
fn report(options: &Options, picture: &sward_wgpu::picture::Picture) {
    let corners: Vec<u32> = options.text("mean", "").split(',').filter_map(|number| number.parse().ok()).collect();
    if let [x0, y0, x1, y1] = corners[..] {
        let pixels = (y0..y1).flat_map(|y| (x0..x1).map(move |x| 4 * (y * picture.width + x) as usize));
        let mut sum = [0u64; 4];
        for at in pixels {
            (0..3).for_each(|c| sum[c] += u64::from(picture.rgba8[at + c]));
            sum[3] += 1;
        }
        println!("mean {:?}", [0, 1, 2].map(|c| sum[c] / sum[3].max(1)));
    }
}

fn segments(kind: Kind) -> u32 {
    match kind {
        Kind::Lawn => 1,
        Kind::Meadow => 4,
        Kind::Reed => 7,
        Kind::Tussock => 2,
    }
}

fn relief(options: &Options) -> Result<Relief, Box<dyn Error>> {
    if let Some(path) = options.0.get("dem") {
        let scale = 1.0 / 32.0;
        let samples = image::open(path)?.into_luma16();
        let (columns, rows) = samples.dimensions();
        let heights = samples.pixels().map(|p| (236.0 + f32::from(p.0[0]) / 65535.0 * 840.0) * scale as f32).collect();
        let spacing = [74.5732 * scale, 92.475 * scale];
        let corner = [-0.5 * spacing[0] * f64::from(columns) + 96.0, -0.5 * spacing[1] * f64::from(rows) - 64.0];
        return Ok(Relief { heights, columns, rows, spacing, corner });
    }
    let side = 256;
    let wave = |at: u32, turns: f32| (at as f32 / 255.0 * turns * std::f32::consts::TAU).sin();
    let heights = (0..side * side).map(|i| {
        let (x, z) = (i % side, i / side);
        3.5 * wave(x, 2.0) * wave(z, 3.0) + 1.2 * wave(x + z, 5.0) + 0.5 * wave(z, 9.0)
    });
    Ok(Relief { heights: heights.collect(), columns: side, rows: side, spacing: [4.0, 4.0], corner: [-400.0, -560.0] })
}

struct Ground(Relief);

impl Ground {
    /// Height at a point relative to the frame origin; the same formula as the shader's.
    fn height(&self, x: f32, z: f32) -> f32 {
        let relief = &self.0;
        let at = |axis: usize, local: f32| (ORIGIN[axis] + f64::from(local) - relief.corner[axis]) / relief.spacing[axis];
        let (u, v) = (at(0, x), at(1, z));
        let mirror = |index: i64, count: u32| {
            let period = 2 * (i64::from(count) - 1);
            let wrapped = index.rem_euclid(period.max(1));
            wrapped.min(period - wrapped).max(0) as usize
        };
        let (wx, wz) = (weights(u - u.floor()), weights(v - v.floor()));
        let mut sum = 0.0;
        for j in 0..4 {
            for i in 0..4 {
                let column = mirror(u.floor() as i64 + i as i64 - 1, relief.columns);
                let row = mirror(v.floor() as i64 + j as i64 - 1, relief.rows);
                sum += wx[i] * wz[j] * f64::from(relief.heights[row * relief.columns as usize + column]);
            }
        }
        sum as f32
    }
}

fn weights(f: f64) -> [f64; 4] {
    let (g, h) = (f * f, f * f * f);
    [0.5 * (-f + 2.0 * g - h), 0.5 * (2.0 - 5.0 * g + 3.0 * h), 0.5 * (f + 4.0 * g - 3.0 * h), 0.5 * (h - g)]
}

fn view(options: &Options, ground: &Ground) -> View {
    // Eye (x, height above ground, z), target, angle of view.
    let (eye, target, angle) = match options.number("view", 0.0) as u32 {
        0 => ([4.0, 2.1, 4.0], [9.0, 1.0, 24.0], 0.8),
        1 => ([20.0, 1.7, 36.0], [12.0, 0.8, 29.0], 0.8),
        2 => ([4.0, 3.0, 6.0], [-20.0, 1.5, 20.0], 0.9),
        3 => ([8.0, 9.0, 2.0], [10.0, 0.0, 24.0], 0.8),
        4 => ([12.0, 1.2, 20.5], [13.5, 0.9, 26.0], 0.7),
        _ => ([4.0, 30.0, -30.0], [4.0, 0.0, 40.0], 0.9),
    };
    let lift = |p: [f32; 3]| Vec3::new(p[0], ground.height(p[0], p[2]) + p[1], p[2]);
    View::looking_at(lift(eye), lift(target), angle)
}

fn focus(view: &View, ground: &Ground) -> Vec3 {
    let ahead = view.rotation * Vec3::NEG_Z;
    let level = Vec2::new(ahead.x, ahead.z).normalize_or(Vec2::Y) * 22.0;
    let (x, z) = (view.position.x + level.x, view.position.z + level.y);
    Vec3::new(x, ground.height(x, z), z)
}

/// Where the truck has come to, as an angle on its circle.
const ARRIVED: f32 = 0.12;

fn place_truck(ground: &Ground, mesh: usize) -> BodyDraw {
    let at = CIRCLE.0 + CIRCLE.1 * Vec2::from_angle(ARRIVED);
    // Driving with growing angle: the heading is the circle's tangent.
    let ahead = Vec2::from_angle(ARRIVED).perp();
    let here = |p: Vec2| Vec3::new(p.x, ground.height(p.x, p.y), p.y);
    let forward = (here(at + 1.5 * ahead) - here(at - 1.5 * ahead)).normalize();
    let side = ahead.perp();
    let left = (here(at - 0.8 * side) - here(at + 0.8 * side)).normalize();
    let up = forward.cross(left).normalize();
    let rotation = Quat::from_mat3(&glam::Mat3::from_cols(up.cross(forward), up, forward));
    let position = here(at) - Vec3::Y * 0.03;
    BodyDraw { mesh, transform: Mat4::from_rotation_translation(rotation, position), paint: [0.035, 0.105, 0.16], ground: position.y }
}

/// Bend (x, z) of a plant at `p`: the track of the wheels and what the floor pan has brushed.
fn track(p: Vec2, chance: f32) -> Vec2 {
    let out = p - CIRCLE.0;
    let angle = out.to_angle();
    let behind = (ARRIVED - angle).rem_euclid(std::f32::consts::TAU);
    let under = (0.0..=2.3).contains(&((angle - ARRIVED) * CIRCLE.1));
    if behind > 3.6 && !under {
        return Vec2::ZERO;
    }
    let offset = out.length() - CIRCLE.1;
    let wheel = (offset.abs() - 0.82).abs();
    let ahead = out.normalize_or(Vec2::X).perp();
    let away = out.normalize_or(Vec2::X) * offset.signum();
    if wheel < 0.22 {
        ahead * (1.38 + 0.08 * chance)
    } else if wheel < 0.60 {
        let near = 1.0 - (wheel - 0.22) / 0.38;
        (ahead * 1.0 + away * 0.7 * if offset.abs() > 0.82 { 1.0 } else { 0.2 }) * near
    } else if offset.abs() < 0.8 {
        ahead * (0.85 + 0.2 * chance)
    } else {
        Vec2::ZERO
    }
}

type Plants = (Vec<Plant>, Vec<[f32; 4]>);

struct Scene<'a> {
    ground: &'a Ground,
    view: &'a View,
    look: Look,
    fade: f32,
}

fn hash(x: i32, z: i32, salt: u32) -> f32 {
    let mut h = (x as u32).wrapping_mul(0x8da6_b343) ^ (z as u32).wrapping_mul(0xd816_3841) ^ salt.wrapping_mul(0xcb1a_b31f);
    h = (h ^ (h >> 15)).wrapping_mul(0x2c1b_3c6d);
    h = (h ^ (h >> 12)).wrapping_mul(0x297a_2d39);
    ((h ^ (h >> 15)) >> 8) as f32 / 16_777_216.0
}

impl Scene<'_> {
    fn plants(&self, from: f32, until: f32, segments: u32) -> Plants {
        let step = 0.25;
        let eye = self.view.position;
        let reach = (until / step) as i32;
        let middle = [(eye.x / step) as i32, (eye.z / step) as i32];
        let mut cells = Vec::new();
        for j in -reach..=reach {
            for i in -reach..=reach {
                let distance = step * ((i * i + j * j) as f32).sqrt();
                if distance >= from && distance < until && self.seen(i, j) {
                    // Plants near to far in steps of a few metres.
                    cells.push(((distance / 4.0) as u32, middle[0] + i, middle[1] + j));
                }
            }
        }
        cells.sort_unstable();
        let mut plants = (Vec::new(), Vec::new());
        for (_, i, j) in cells {
            self.add(&mut plants, [i, j], step, segments);
        }
        while !plants.0.len().is_multiple_of(PLANTS_PER_INSTANCE as usize) || plants.0.is_empty() {
            plants.0.push(Plant::default());
            plants.1.extend(std::iter::repeat_n([0.0; 4], segments as usize + 1));
        }
        plants
    }

    fn seen(&self, i: i32, j: i32) -> bool {
        let ahead = self.view.rotation * Vec3::NEG_Z;
        let ahead = Vec2::new(ahead.x, ahead.z).normalize_or(Vec2::Y);
        let out = 0.25 * Vec2::new(i as f32, j as f32);
        let turn = out.angle_to(ahead).abs();
        out.length() < 3.0 || turn < 0.95 || out.length() < 40.0 && turn < 1.2
    }

    fn add(&self, plants: &mut Plants, [i, j]: [i32; 2], step: f32, segments: u32) {
        let chance = |salt| hash(i, j, salt);
        let p = step * Vec2::new(i as f32 + chance(1), j as f32 + chance(2));
        let root = Vec3::new(p.x, self.ground.height(p.x, p.y), p.y);
        let (low, width) = match self.look.kind {
            Kind::Lawn => (0.06, 0.24),
            Kind::Meadow => (0.40, 0.55),
            Kind::Reed => (1.20, 0.60),
            Kind::Tussock => (0.32, 0.50),
        };
        let clump = 0.5 + 0.5 * ((p.x * 0.35).sin() * (p.y * 0.28).cos());
        let height = low * (0.70 + 0.35 * chance(3) + 0.25 * clump);
        let wind = Vec2::new(0.16, 0.10) * (1.0 + 0.8 * (p.x * 0.2 + p.y * 0.1).sin()) + 0.12 * Vec2::new(chance(5) - 0.5, chance(6) - 0.5);
        let bend = track(p, chance(7));
        let bend = if bend == Vec2::ZERO { wind } else { bend + 0.3 * wind * (1.0 - bend.length().min(1.0)) };
        plants.0.push(Plant {
            root: root.to_array(),
            height,
            yaw: chance(8) * std::f32::consts::TAU,
            width: width * (0.8 + 0.4 * chance(9)),
            tint: chance(10),
            layer: self.look.layer(chance(11)),
        });
        let mut joint = root;
        for k in 0..=segments {
            joint.y = joint.y.max(self.ground.height(joint.x, joint.z) + 0.001 * k as f32);
            plants.1.push([joint.x, joint.y, joint.z, 0.0]);
            let tilt = bend.length() * if segments == 1 { 0.9 } else { 0.65 + 0.5 * k as f32 / segments as f32 };
            let (sine, cosine) = tilt.min(1.5).sin_cos();
            let way = bend.normalize_or(Vec2::X) * sine;
            joint += Vec3::new(way.x, cosine, way.y) * (height / segments as f32);
        }
    }
}

fn upload(gpu: &Gpu, plants: &Plants) -> (wgpu::Buffer, wgpu::Buffer) {
    let init = |label, contents| {
        gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some(label),
            contents,
            usage: wgpu::BufferUsages::STORAGE,
        })
    };
    (init("plants", bytemuck::cast_slice(&plants.0)), init("joints", bytemuck::cast_slice(&plants.1)))
}
