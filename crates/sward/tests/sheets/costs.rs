//! What costs time: billboards that bodies are near, or that recover; never the others.

use sward::response::springs::pool;

use super::{meadow, model};

fn planned(world: &mut sward::world::World) -> (usize, [u32; 2], usize) {
    let plan = world.plan();
    let found = (plan.stands[0].sheets.active.len(), plan.stands[0].sheets.nodes, plan.stands[0].sheets.heads.len());
    let reports = world.respond(&plan);
    world.finish(reports);
    found
}

#[test]
fn free_nodes_cost_nothing_and_states_follow_bodies() {
    let mut world = meadow("recover: 1", "interactors: [(shape: Sphere(radius: 1.5), path: Still(at: (4, 4)), from: 0.5, until: 1)]");
    let mut seen = Vec::new();
    for step in 0..240 {
        let (active, [colliding, recovering], heads) = planned(&mut world);
        seen.push((active, colliding, recovering));
        let time = f64::from(step + 1) / 60.0;
        if time < 0.5 {
            assert_eq!((active, colliding, recovering, heads), (0, 0, 0, 0), "free nodes cost nothing");
        }
    }
    let during = seen[45];
    assert!(during.0 > 5 && during.1 > 0 && during.2 == 0, "{during:?}");
    let after = seen[90];
    assert!(after.0 == during.0 && after.1 == 0 && after.2 > 0, "all recover: {after:?}");
    assert_eq!(seen[200], (0, 0, 0), "and are free again");
}

/// Twice the area touched, twice the work; ten times the field around it, none.
#[test]
fn work_grows_with_what_is_touched_and_with_nothing_else() {
    let count = |length: f64, patches: u32| {
        let body = format!("interactors: [(shape: Box(size: (4, 1, {length})), path: Still(at: (0, 0)))]");
        let mut world = crate::common::world(&format!(
            "field: (patch_side: 16, patches: ({patches}, {patches})), stands: [(species: Meadow, cells: 32, response: Springs())], {body}"
        ));
        (0..5).for_each(|_| world.step());
        planned(&mut world).0 as f64
    };
    let (short, long, longer) = (count(5.0, 8), count(10.0, 8), count(20.0, 8));
    println!("sheets under bodies of 5, 10 and 20 m: {short}, {long}, {longer}");
    assert!((1.7..2.2).contains(&(long / short)) && (1.8..2.1).contains(&(longer / long)));
    assert_eq!(count(10.0, 80), long);
}

#[test]
fn sixty_thousand_billboards_fit_into_the_papers_memory() {
    let world = meadow("", "");
    let co = &model(&world).coefficients;
    // A place of a sheet a cell, and every single billboard deformed.
    let (cells, sheets) = (60_000 * 4, 60_000 * 4 * pool::words(co) as u64);
    println!("60 000 billboards: {:.2} MB with all of them deformed", (cells + sheets) as f64 / 1e6);
    assert!(cells + sheets < 12_000_000);
}
