use sward::{model::NoAssets, scene::Scene, world::World};
fn main() {
    let text = std::env::args().nth(1).map(|f| std::fs::read_to_string(f).unwrap()).unwrap_or_else(|| "(version: 1, stands: [(species: Meadow)], interactors: [(shape: Truck, path: Keyframes(keys: [(time: 0, at: (-10, 1)), (time: 4, at: (10, 1))]))])".into());
    let mut world = World::new(Scene::parse(&text, "x").unwrap(), &sward::model::Folder(".".into()))
        .or_else(|_| World::new(Scene::parse(&text, "x").unwrap(), &NoAssets))
        .unwrap();
    let t = std::time::Instant::now();
    for s in 0..600 {
        world.step();
        if s % 30 == 0 {
            let st = &world.state.stands[0];
            let row: Vec<String> = [0.0, 0.7, 1.0, 1.5, 2.2, 3.0]
                .iter()
                .map(|z| {
                    let b = world.bend_at(0, [0.0, *z]).unwrap();
                    format!("({:.3},{:.3})", b[0], b[1])
                })
                .collect();
            println!("{s} awake {} {:?} {} t={:?}", st.awake.len(), st.counters, row.join(" "), t.elapsed());
        }
    }
}
