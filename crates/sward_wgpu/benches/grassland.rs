//! What wind and a body cost the paper's grassland: frames in which blades move against frames of the same blades and passes with the
//! joints frozen, at 1024×768; and what a field of 28 km costs against one of 280 m. Run: `cargo bench -p sward_wgpu --bench grassland`, or with
//! `-- car` or `-- field` one of them.

#[path = "../../sward/benches/measure/mod.rs"]
mod measure;

use measure::{PAIRS, median, pair, seconds};
use sward::model::Folder;
use sward::scene::{Representation, Scene};
use sward::world::World;
use sward_wgpu::gpu::Gpu;
use sward_wgpu::studio::{CellsAt, Studio};

const SIZE: [u32; 2] = [1024, 768];
/// Steps before anything is timed: patches are awake, the car drives.
const WARM_UP: u32 = 60;

fn world(edit: impl Fn(&mut Scene)) -> World {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
    let text = std::fs::read_to_string(format!("{root}/scenes/grassland.ron")).expect("shipped");
    let mut scene = Scene::parse(&text, "grassland.ron").expect("valid");
    edit(&mut scene);
    let mut world = World::new(scene, &Folder(root.into())).expect("it compiles");
    (0..WARM_UP).for_each(|_| world.step());
    world
}

fn main() {
    let gpu = Gpu::new().expect("an adapter");
    println!("{}, {SIZE:?} pixels, {PAIRS} pairs in ABBA order, steps on the CPU", gpu.adapter_info.name);
    // One of the two by a word of its name, or both.
    let wanted = std::env::args().nth(1).filter(|word| !word.starts_with('-'));
    for (name, body) in [("wind over frozen joints", false), ("wind and a car over frozen joints", true)] {
        if wanted.as_ref().is_some_and(|word| !name.contains(word.as_str())) {
            continue;
        }
        let mut moving = world(|scene| {
            if !body {
                scene.interactors.clear()
            }
        });
        let mut studio = Studio::new(&gpu, &moving).expect("a studio");
        let frozen = moving.clone();
        let mut frames = [0, 1].map(|_| Vec::new());
        let mut draw = |world: &World| drop(studio.draw(&gpu, world, CellsAt::Cpu, SIZE).expect("drawn"));
        draw(&frozen);
        for number in 0..PAIRS {
            let [a, b] = {
                let draw = std::cell::RefCell::new(&mut draw);
                pair(number, || seconds(|| (moving.step(), (draw.borrow_mut())(&moving)).1), || seconds(|| (draw.borrow_mut())(&frozen)))
            };
            frames[0].push(a / b);
            frames[1].push(500.0 * b);
        }
        let [low, middle, high] = median(&mut frames[0]);
        println!("{name}: {middle:.3} ({low:.3} to {high:.3}); a frozen frame takes {:.0} ms", median(&mut frames[1])[1]);
    }
    if wanted.is_none_or(|word| "a field of 28 km".contains(word.as_str())) {
        field(&gpu);
    }
}

/// Steps and pictures of a hundred times the field, of blades that end before the smaller one does.
fn field(gpu: &Gpu) {
    let of = |patches: u32| {
        world(|scene| {
            scene.field.patches = Some([patches; 2]);
            let Some(Representation::Blade(blade)) = &mut scene.stands[0].representation else { panic!("blades") };
            blade.distance = Some(100.0);
        })
    };
    let (mut small, mut large) = (of(8), of(800));
    let mut studio = Studio::new(gpu, &small).expect("a studio");
    let mut frame = |world: &mut World| {
        seconds(|| {
            world.step();
            drop(studio.draw(gpu, world, CellsAt::Cpu, SIZE).expect("drawn"));
        })
    };
    frame(&mut small);
    frame(&mut large);
    let mut ratios = Vec::new();
    for number in 0..PAIRS {
        let frame = std::cell::RefCell::new(&mut frame);
        let [a, b] = pair(number, || (frame.borrow_mut())(&mut large), || (frame.borrow_mut())(&mut small));
        ratios.push(a / b);
        let counters = [&small, &large].map(|world| format!("{:?}", world.state.stands[0].counters));
        assert_eq!(counters[0], counters[1]);
    }
    let [low, middle, high] = median(&mut ratios);
    println!("a field of 28 km over one of 280 m: {middle:.3} ({low:.3} to {high:.3}), equal counters");
}
