use std::time::Instant;
use sward::{model::Folder, scene::Scene, world::World};
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let text = std::fs::read_to_string(format!("scenes/{}.ron", a[1])).unwrap();
    let mut world = World::new(Scene::parse(&text, "x").unwrap(), &Folder(".".into())).unwrap();
    let steps: u32 = a[2].parse().unwrap();
    (0..steps).for_each(|_| world.step());
    let size = [a[3].parse().unwrap(), a[4].parse().unwrap()];
    let t = Instant::now();
    let studio = sward_raster::Studio::new(&world);
    println!("new {:?}", t.elapsed());
    for _ in 0..2 {
        let t = Instant::now();
        let p = studio.draw(&world, size);
        println!("draw {:?} {}", t.elapsed(), p.rgba8.iter().map(|x| u64::from(*x)).sum::<u64>());
    }
}
