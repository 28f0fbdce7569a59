//! Depth cube maps drawn on the GPU against those of the core, and how long both take.

use std::path::PathBuf;
use std::time::Instant;

use libtest_mimic::Failed;
use sward::interaction::FigureBody;
use sward::interaction::distance_map::{Cube, DistanceMap, EMPTY};
use sward::math;
use sward::model::Folder;
use sward::scene::Scene;
use sward::world::World;
use sward_wgpu::compare::{Deviation, Tolerance};
use sward_wgpu::compute::Work;
use sward_wgpu::compute::distance_maps::{DistanceMapPasses, MapInput};
use sward_wgpu::compute::readback;
use sward_wgpu::gpu::Gpu;

use crate::adapter::{Verdict, ensure};
use crate::kernels::{Random, line};

/// Triangles to be drawn in a map of so many texels.
struct Body {
    name: String,
    points: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
    cube: Cube,
    size: u32,
}

impl Body {
    fn new(name: &str, size: u32, (points, triangles): Triangles) -> Self {
        let cube = Cube::around(&points, size);
        Self { name: name.to_owned(), points, triangles, cube, size }
    }

    fn on_cpu(&self) -> DistanceMap {
        DistanceMap::new(self.cube, self.size, &self.points, self.triangles.iter().copied())
    }

    fn input(&self, first: u32) -> MapInput<'_> {
        MapInput { points: &self.points, triangles: &self.triangles, cube: self.cube, size: self.size, first }
    }

    fn texels(&self) -> u32 {
        6 * self.size * self.size
    }
}

/// A ball around a place off the middle, in rings.
pub(crate) fn ball(rings: u32) -> Triangles {
    let part = std::f32::consts::PI / rings as f32;
    let (mut points, mut triangles) = (Vec::new(), Vec::new());
    for ring in 0..=rings {
        let (wide, high) = math::sin_cos(part * ring as f32);
        for step in 0..2 * rings {
            let (s, c) = math::sin_cos(part * step as f32);
            points.push([0.3 + 0.5 * wide * s, 0.5 * high, 0.5 * wide * c - 0.1]);
            if ring < rings {
                let [a, b] = [step, (step + 1) % (2 * rings)].map(|step| ring * 2 * rings + step);
                triangles.extend([[a, a + 2 * rings, b], [b, a + 2 * rings, b + 2 * rings]]);
            }
        }
    }
    (points, triangles)
}

/// A box turned about two axes.
pub(crate) fn block() -> Triangles {
    let ((s, c), (t, d)) = (math::sin_cos(0.4), math::sin_cos(0.7));
    let corner = |k: u32| {
        let side = |bit: u32, half: f32| if k & bit == 0 { -half } else { half };
        let [x, y, z] = [side(1, 0.9), side(2, 0.4), side(4, 0.6)];
        let (x, z) = (c * x + s * z, c * z - s * x);
        [d * x - t * y, t * x + d * y, z]
    };
    let sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    (Vec::from_iter((0..8).map(corner)), Vec::from_iter(sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]])))
}

/// Triangles anywhere, of any size, far beyond the cube too, damaged ones among them.
fn litter() -> Triangles {
    let mut random = Random::new(7);
    let mut points = Vec::new();
    for k in 0..300 {
        let near = [0, 1, 2].map(|_| random.drawn(-1.0, 1.0));
        let spread = if k % 100 == 99 { 200.0 } else { [0.02, 0.1, 0.3][k % 3] };
        points.extend([[0; 3]; 3].map(|_| near.map(|part| part + spread * random.drawn(-1.0, 1.0))));
    }
    let mut triangles: Vec<[u32; 3]> = (0..300).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
    triangles.extend([[0, 0, 1], [5, 6, 900], [u32::MAX, 3, 4], [901, 1, 2]]);
    points.extend([[f32::NAN, 0.0, 0.0], [f32::INFINITY; 3]]);
    (points, triangles)
}

/// Points, and triangles by the indices of their corners.
type Triangles = (Vec<[f32; 3]>, Vec<[u32; 3]>);

/// All maps in one buffer, a gap before each.
fn on_gpu(gpu: &Gpu, bodies: &[Body]) -> Result<Vec<Vec<[f32; 4]>>, Failed> {
    let mut next = 5;
    let mut inputs = Vec::new();
    for body in bodies {
        inputs.push(body.input(next));
        next += body.texels() + 3;
    }
    let texels = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: 16 * u64::from(next),
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    DistanceMapPasses::new(gpu).record(gpu, &mut encoder, &inputs, &texels, &mut Work::default(), None);
    gpu.queue.submit([encoder.finish()]);
    let all: Vec<[f32; 4]> = readback::read(gpu, &texels, 16 * u64::from(next))?;
    let maps = inputs.iter().zip(bodies).map(|(input, body)| all[input.first as usize..][..body.texels() as usize].to_vec()).collect();
    ensure(all.iter().filter(|texel| texel[0] == 0.0).count() >= 3 * bodies.len(), || "texels of no map were written".to_owned())?;
    Ok(maps)
}

/// Texels see the same triangle: whole numbers decide that. Depths and normals are some roundings apart, where a device fuses or divides its own
/// way; at an edge that two triangles share such a rounding may choose the other one.
fn compare(name: &str, body: &Body, ours: &[[f32; 4]], theirs: &[[f32; 4]]) -> Verdict {
    let differ = ours.iter().zip(theirs).filter(|(a, b)| (a[0] < EMPTY) != (b[0] < EMPTY)).count();
    let seen: Vec<_> = ours.iter().zip(theirs).filter(|(a, b)| a[0] < EMPTY && b[0] < EMPTY).collect();
    let depth_of = |texel: &[f32; 4]| 0.5 * texel[0] / body.cube.half;
    let normal_of = |texel: &[f32; 4]| [texel[1], texel[2], texel[3]];
    let (here, there): (Vec<f32>, Vec<f32>) = seen.iter().map(|(a, b)| (depth_of(a), depth_of(b))).unzip();
    let depth = Deviation::of(&here, &there, 1e-6);
    let (here, there): (Vec<[f32; 3]>, Vec<[f32; 3]>) = seen.iter().map(|(a, b)| (normal_of(a), normal_of(b))).unzip();
    let normal = Deviation::of(here.as_flattened(), there.as_flattened(), 1e-5);
    let same = ours.iter().zip(theirs).filter(|(a, b)| a == b).count();
    println!("{name}: {differ} of {} texels see something on one side only, {same} are the same bits", ours.len());
    println!("{}\n{}", line("  depth, cubes", &depth), line("  normals", &normal));
    ensure(differ == 0 && ours.len() == theirs.len(), || format!("{name}: {differ} texels differ in whether they see anything"))?;
    ensure(depth.within(&Tolerance { p999: 1e-6, rms: 1e-6, outlier: 1e-6, share: 0.0 }), || format!("{name}: {depth:?}"))?;
    ensure(normal.within(&Tolerance { p999: 1e-5, rms: 1e-2, outlier: 1e-5, share: 1e-3 }), || format!("{name}: {normal:?}"))
}

fn check(gpu: &Gpu, bodies: &[Body]) -> Verdict {
    for (body, theirs) in bodies.iter().zip(on_gpu(gpu, bodies)?) {
        compare(&body.name, body, &body.on_cpu().texels, &theirs)?;
        // Control: the body half a texel to the side.
        let half = body.cube.half / body.size as f32;
        let moved = Body {
            name: String::new(),
            points: body.points.iter().map(|[x, y, z]| [x + half, *y, *z]).collect(),
            triangles: body.triangles.clone(),
            ..*body
        };
        let found = compare("  half a texel to the side", body, &moved.on_cpu().texels, &theirs).is_err();
        ensure(found, || format!("{}: half a texel to the side is not found", body.name))?;
    }
    ensure(!bodies.is_empty(), || "no bodies".to_owned())
}

/// Balls, boxes and litter, from the smallest map to the largest.
pub(crate) fn solids(gpu: &Gpu) -> Verdict {
    let mut bodies = Vec::new();
    for size in [8, 33, 64, 128] {
        bodies.push(Body::new(&format!("ball, {size}²"), size, ball(24)));
        bodies.push(Body::new(&format!("turned box, {size}²"), size, block()));
    }
    for (size, half) in [(16, 1.0), (64, 0.9), (512, 1.1)] {
        let cube = Cube { centre: [0.1, -0.2, 0.05], half };
        bodies.push(Body { cube, ..Body::new(&format!("litter, {size}²"), size, litter()) });
    }
    check(gpu, &bodies)?;
    let none = Body::new("nothing", 8, (Vec::new(), Vec::new()));
    let theirs = on_gpu(gpu, std::slice::from_ref(&none))?;
    ensure(theirs[0] == none.on_cpu().texels, || "a map of nothing sees something".to_owned())
}

/// The folder of bodies made by others: beside this checkout, or as `SWARD_SHARED` says.
fn shared() -> Option<PathBuf> {
    let beside = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared");
    let folder = std::env::var_os("SWARD_SHARED").map_or_else(|| PathBuf::from(beside), PathBuf::from).join("data/bodies");
    folder.is_dir().then_some(folder)
}

/// Why a test is not run: it needs bodies that are not here.
pub(crate) fn missing(name: &str) -> Option<String> {
    (name == "distance_maps_of_figures" && shared().is_none()).then(|| "no bodies made by others: see ../shared, SWARD_SHARED".to_owned())
}

fn figure(file: &str, scale: f32, clip: &str) -> Result<FigureBody, Failed> {
    let body = format!("(shape: Mesh(file: \"{file}.glb\", scale: {scale}, clip: \"{clip}\"))");
    let text = format!("(version: 1, stands: [(species: Meadow)], interactors: [{body}])");
    let folder = shared().ok_or("no bodies")?;
    let world = World::new(Scene::parse(&text, "test.ron").map_err(|e| e.to_string())?, &Folder(folder)).map_err(|e| e.to_string())?;
    world.model.bodies[0].figure.clone().ok_or_else(|| "no figure".into())
}

/// Walking figures at some moments of their clips.
pub(crate) fn figures(gpu: &Gpu) -> Verdict {
    let mut bodies = Vec::new();
    for (file, scale, clip, size) in [("fox", 0.007, "Walk", 64), ("knight", 0.7, "Walking_A", 64), ("knight", 0.7, "Running_A", 128)] {
        let body = figure(file, scale, clip)?;
        for time in [0.0, 0.21, 0.47, 0.83] {
            let triangles = body.figure.triangles.clone();
            bodies.push(Body {
                cube: body.cube(size),
                ..Body::new(&format!("{file} {clip} {size}² at {time} s"), size, (body.points(time), triangles))
            });
        }
    }
    check(gpu, &bodies)?;
    timed(gpu, &bodies[4])
}

/// Prints how long a map takes here and there, the shortest of some runs.
fn timed(gpu: &Gpu, body: &Body) -> Verdict {
    let least = |run: &mut dyn FnMut() -> Verdict| -> Result<f64, Failed> {
        let mut least = f64::MAX;
        for _ in 0..20 {
            let begin = Instant::now();
            run()?;
            least = least.min(begin.elapsed().as_secs_f64());
        }
        Ok(least * 1e3)
    };
    let texels = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: 16 * u64::from(body.texels()),
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });
    let passes = DistanceMapPasses::new(gpu);
    let there = least(&mut || {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        passes.record(gpu, &mut encoder, &[body.input(0)], &texels, &mut Work::default(), None);
        gpu.queue.submit([encoder.finish()]);
        let _: Vec<u32> = readback::read(gpu, &texels, 4)?;
        Ok(())
    })?;
    let here = least(&mut || ensure(body.on_cpu().size == body.size, String::new))?;
    println!("{}: {} triangles, {there:.2} ms on the adapter, {here:.2} ms on one CPU core", body.name, body.triangles.len());
    Ok(())
}
