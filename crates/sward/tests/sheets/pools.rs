//! When sheets run out: the rule holds, and is counted.

use super::{deformed, meadow};

#[test]
fn who_has_all_but_recovered_makes_room() {
    let bodies = "interactors: [(shape: Sphere(radius: 1), path: Circle(centre: (6, 6), radius: 5, speed: 6))], budget: (sheets: 64)";
    let mut world = meadow("recover: 5", bodies);
    for _ in 0..240 {
        world.step();
        assert!(deformed(&world).len() <= 64);
    }
    let pool = &world.state.stands[0].sheets.pool;
    println!("{} made room, {} were refused", pool.evicted, pool.refused);
    assert!(pool.evicted > 20, "{}", pool.evicted);
    let mut wide = meadow("recover: 5", &bodies.replace("sheets: 64", "sheets: 4096"));
    (0..240).for_each(|_| wide.step());
    assert_eq!((wide.state.stands[0].sheets.pool.evicted, wide.state.stands[0].sheets.pool.refused), (0, 0));
    assert!(deformed(&wide).len() > 64);
}
