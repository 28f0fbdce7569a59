//! What plants in layers cost: steps and pictures of a tree of 80 thousand and of 5 million triangles, in 3 and in 5 layers; pictures in which it is cut
//! anew, pictures between two cuts, and pictures in which the same mesh is simply drawn. Run: `cargo bench -p sward_wgpu --bench layers`, with `-- 80000` for one
//! number of triangles.

#[path = "../../sward/benches/measure/mod.rs"]
mod measure;

use measure::{PAIRS, median, pair, seconds};
use sward::geometry::mesh::{Mesh, Vertex};
use sward::model::NoAssets;
use sward::picture::frame::BodyDraw;
use sward::picture::layers::{self, CutPlan, Origin};
use sward::picture::subject::Frame;
use sward::response::harmonic::LayeredStand;
use sward::scene::Scene;
use sward::specimen::Specimen;
use sward::world::World;
use sward_wgpu::compute::GpuStep;
use sward_wgpu::gpu::Gpu;
use sward_wgpu::picture::{Renderer, Setup};
use sward_wgpu::render::layers::LayerDraws;
use sward_wgpu::render::plants::PlantDraws;

const SIZE: [u32; 2] = [1024, 768];
const STEPS: u32 = 60;

fn world(triangles: u32, near: u32) -> World {
    let text = format!(
        "(version: 1, stands: [(species: Tree, places: [(at: (0, 9), height: 7)], representation: Layers(near: {near}, mesh: Grown(form: Tree, triangles: {triangles})))],
        wind: [Fluid()], camera: (eye: (0, 2, 0), target: (0, 3.2, 9)))"
    );
    World::new(Scene::parse(&text, "layers.ron").expect("valid"), &NoAssets).expect("it compiles")
}

/// The same mesh, to be drawn as it is.
fn plain(specimen: &Specimen) -> Mesh {
    let vertex = |corner: &sward::specimen::SpecimenVertex| Vertex {
        position: corner.position,
        normal: corner.normal(),
        colour: [0.06, 0.16, 0.03, 0.0],
        surface: [0.8, 0.04],
    };
    let mut mesh = Mesh { vertices: specimen.vertices.iter().map(vertex).collect(), indices: specimen.triangles.concat() };
    // Buffers of a body are one piece: what does not fit is left out.
    let most = (240 << 20) / size_of::<Vertex>();
    if mesh.vertices.len() > most {
        mesh.indices =
            mesh.indices.chunks_exact(3).filter(|corners| corners.iter().all(|at| (*at as usize) < most)).flatten().copied().collect();
        mesh.vertices.truncate(most);
    }
    mesh
}

struct Picture<'a> {
    gpu: &'a Gpu,
    renderer: Renderer,
    world: &'a World,
    frame: Frame,
    plans: [Vec<CutPlan>; 2],
    step: &'a GpuStep,
    body: Option<BodyDraw>,
}

impl Picture<'_> {
    fn draw(&mut self, layered: bool) -> f64 {
        let view = self.world.camera();
        let bodies: Vec<BodyDraw> = self.body.filter(|_| !layered).into_iter().collect();
        let input = self.frame.input(self.world, &view, &bodies);
        let waves: Vec<_> = self.step.layered().map(|waves| waves.waves()).collect();
        let stands: &[LayeredStand] = &self.world.model.layered;
        let layers = LayerDraws { stands, origin: Origin(self.frame.corner), plans: &self.plans, waves: &waves };
        let plants = PlantDraws { layers: layered.then_some(layers), ..PlantDraws::default() };
        seconds(|| {
            self.renderer.draw(self.gpu, &input, &plants, SIZE).expect("drawn");
            drop(self.renderer.read(self.gpu).expect("read"));
        })
    }

    /// As if the view had turned: the camera's cut is made anew.
    fn turn(&mut self) {
        self.plans[0].iter_mut().for_each(|plan| plan.key.step += 1);
    }
}

fn main() {
    let gpu = Gpu::new().expect("an adapter");
    println!("{}, {SIZE:?} pixels, {PAIRS} pairs in ABBA order", gpu.adapter_info.name);
    let mut counters = Vec::new();
    let asked: Vec<u32> = std::env::args().filter_map(|argument| argument.parse().ok()).collect();
    for triangles in if asked.is_empty() { vec![80_000, 5_000_000] } else { asked } {
        for near in [1, 3] {
            let mut world = world(triangles, near);
            let mut step = GpuStep::new(&gpu, &world).expect("a step");
            for _ in 0..STEPS {
                step.step(&gpu, &mut world).expect("stepped");
            }
            step.wait(&gpu, &mut world).expect("done");
            counters.push(format!("{:?}", step.work));
            let (frame, _) = Frame::of(&world, &world.camera(), 0.0);
            let input = frame.input(&world, &world.camera(), &[]);
            let plans = layers::plan(&world, 0.0, SIZE[1], &input);
            let mut renderer = Renderer::new(&gpu, &Setup::default()).expect("a renderer");
            let mesh = renderer.add_mesh(&gpu, &plain(&world.model.layered[0].specimen));
            let transform =
                glam::Mat4::from_translation(glam::Vec3::new((0.0 - frame.corner[0]) as f32, 0.0, (9.0 - frame.corner[1]) as f32))
                    * glam::Mat4::from_scale(glam::Vec3::splat(7.0 / world.model.layered[0].specimen.high[1]));
            let body = Some(BodyDraw { mesh, transform, paint: [0.1; 3], ground: 0.0, number: 1 });
            let mut picture = Picture { gpu: &gpu, renderer, world: &world, frame, plans, step: &step, body };
            let layers = picture.plans[0][0].edges.len() - 1;
            picture.draw(true);
            picture.draw(false);
            // Of millions a picture takes seconds.
            let pairs = if triangles > 1_000_000 { 4 } else { PAIRS };
            let (mut ratios, mut between, mut anew, mut drawn) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
            for number in 0..pairs {
                let picture = std::cell::RefCell::new(&mut picture);
                let [a, b] = pair(number, || picture.borrow_mut().draw(true), || picture.borrow_mut().draw(false));
                ratios.push(a / b);
                between.push(500.0 * a);
                drawn.push(500.0 * b);
            }
            for _ in 0..pairs.min(8) {
                picture.turn();
                anew.push(1000.0 * picture.draw(true));
            }
            let [low, middle, high] = median(&mut ratios);
            println!(
                "{triangles} triangles, {layers} layers: cut anew {:.1} ms; between cuts {:.1} ms; drawn as it is {:.1} ms, ratio {middle:.3} ({low:.3} to {high:.3})",
                median(&mut anew)[1],
                median(&mut between)[1],
                median(&mut drawn)[1]
            );
        }
    }
    println!("{STEPS} steps on the GPU: {}", counters[0]);
    assert!(counters.iter().all(|other| *other == counters[0]), "{counters:?}");
    println!("equal for all triangles and layers");
}
