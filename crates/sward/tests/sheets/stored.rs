//! Saved in the midst of it, continued as if never stopped; the same bits for any number of threads.

use super::{deformed, meadow};

const SCENE: &str = "wind: [Natural()], interactors: [(shape: Truck, path: Circle(centre: (4, 4), radius: 5, speed: 4)), (shape: Sphere(radius: 0.4), path: Circle(radius: 2, speed: 2))]";

#[test]
fn continuing_equals_never_having_stopped() {
    let mut first = meadow("", SCENE);
    (0..77).for_each(|_| first.step());
    let saved = first.save();
    (0..60).for_each(|_| first.step());
    let mut second = meadow("", SCENE);
    second.restore(&saved).expect("it is sound");
    assert_eq!(second.save(), saved);
    (0..60).for_each(|_| second.step());
    assert!(!deformed(&second).is_empty());
    assert_eq!(second.hash(), first.hash());
    assert_eq!(second.save(), first.save());
    let mut control = meadow("", SCENE);
    (0..60).for_each(|_| control.step());
    assert_ne!(control.hash(), first.hash());
}

#[test]
fn threads_change_nothing() {
    let hash = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| {
            let mut world = meadow("", SCENE);
            (0..90).for_each(|_| world.step());
            world.hash()
        })
    };
    assert_eq!(hash(1), hash(4));
}
