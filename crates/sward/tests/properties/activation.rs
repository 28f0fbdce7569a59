//! Which patches wake, which sleep, and what that costs (methods behind Chen & Johan 2010, §4.2).

use std::collections::BTreeSet;
use sward::activation::{Circumstances, Sharing, activate};
use sward::state::{PatchKey, StandState};

use crate::common::world;

const SMALL: &str = "field: (patch_side: 8.0), stands: [(species: Meadow, cells: 16)]";

fn awake(world: &sward::world::World) -> Vec<PatchKey> {
    world.state.stands[0].awake.keys().copied().collect()
}

#[test]
fn a_body_wakes_its_patch_and_the_disturbed_border_wakes_the_next() {
    let mut calm = world(SMALL);
    (0..30).for_each(|_| calm.step());
    assert!(awake(&calm).is_empty(), "control: nothing happens, nothing wakes");
    let text = format!("{SMALL}, interactors: [(shape: Sphere(radius: 1.0), path: Circle(centre: (4.0, 4.0), radius: 0.5, speed: 3.0))]");
    let mut world = world(&text);
    world.step();
    assert_eq!(awake(&world), [[0, 0]]);
    (0..90).for_each(|_| world.step());
    assert!(awake(&world).contains(&[1, 0]) && awake(&world).contains(&[0, -1]), "{:?}", awake(&world));
    assert!(!awake(&world).contains(&[4, 0]));
}

#[test]
fn a_focus_wakes_patches_only_in_gusts() {
    for (wind, count) in [("", 0), ("wind: [Uniform(velocity: (6.0, 0.0))]", 0), ("wind: [Natural()]", 12)] {
        let mut world = world(&format!("{SMALL}, budget: (focus_distance: 16.0), {wind}"));
        world.state.pinned = vec![[100.0, -40.0]];
        (0..10).for_each(|_| world.step());
        assert_eq!(awake(&world).len(), count, "{wind}");
        assert!(awake(&world).iter().all(|patch| (f64::from(patch[0]) * 8.0 + 4.0 - 100.0).abs() < 16.0));
    }
}

#[test]
fn patches_sleep_after_a_second_of_rest_and_then_cost_nothing() {
    let mut world = world(&format!(
        "{SMALL}, interactors: [(shape: Sphere(radius: 1.0), path: Circle(centre: (4.0, 4.0), radius: 1.0, speed: 3.0), until: 0.5)]"
    ));
    let mut last_motion = 0;
    while world.state.step < 60 || !awake(&world).is_empty() {
        world.step();
        let stand = &world.state.stands[0];
        let loud = stand.summaries.back().is_some_and(|all| all.1.iter().any(|(_, summary)| summary.largest.sqrt() > 1e-3));
        last_motion = if loud { world.state.step } else { last_motion };
        assert!(world.time() < 20.0);
    }
    let slept = world.state.step - last_motion;
    println!("asleep {slept} steps after the last motion above 1e-3, at {:.2} s", world.time());
    assert!((59..=66).contains(&slept), "{slept}");
    let before = world.state.stands[0].counters;
    (0..600).for_each(|_| world.step());
    assert_eq!(world.state.stands[0].counters, before, "asleep, no patch is stepped");
    assert!(before.slept > 0 && before.woken == before.slept && before.patch_steps > 0);
    assert_eq!(world.state.stands[0].free.len(), world.scene.budget.patches as usize);
}

struct Bench {
    stand: StandState,
    touched: BTreeSet<PatchKey>,
    in_view: bool,
}

impl Bench {
    fn new(slots: u32) -> Self {
        Self { stand: StandState { free: (0..slots).collect(), ..Default::default() }, touched: BTreeSet::new(), in_view: false }
    }

    fn activate(&mut self, touched: &[PatchKey]) {
        self.touched = touched.iter().copied().collect();
        let by = Circumstances {
            step: 0,
            touched: &self.touched,
            focuses: &[[4.0, 4.0]],
            in_view: &|_| self.in_view,
            field: None,
            patch_side: 8.0,
            focus_distance: 0.0,
            lag_distance: 0.0,
            gusty: false,
            tiled: false,
            tolerance: 1e-3,
            rate: 60.0,
            sharing: Sharing::Near,
        };
        activate(&mut self.stand, &by);
    }
}

#[test]
fn at_the_budget_the_farthest_patch_is_released() {
    let line: Vec<PatchKey> = (1..=4).map(|x| [x, 0]).collect();
    let mut bench = Bench::new(4);
    bench.activate(&line);
    bench.activate(&[[0, 0]]);
    assert_eq!(bench.stand.awake.keys().copied().collect::<Vec<_>>(), [[0, 0], [1, 0], [2, 0], [3, 0]]);
    assert_eq!((bench.stand.counters.released, bench.stand.counters.denied), (1, 0));
    // A farther one is refused.
    bench.activate(&[[9, 0]]);
    assert!(!bench.stand.awake.contains_key(&[9, 0]) && bench.stand.counters.denied == 1 && bench.stand.counters.released == 1);
}

#[test]
fn a_patch_in_view_fades_before_its_place_is_given_away_and_only_one_does() {
    let mut bench = Bench::new(4);
    bench.activate(&(1..=4).map(|x| [x, 0]).collect::<Vec<_>>());
    bench.in_view = true;
    let mut kept = Vec::new();
    for _ in 0..40 {
        bench.activate(&[[0, 0]]);
        kept.extend(bench.stand.awake.get(&[4, 0]).map(sward::activation::keep));
    }
    assert!(bench.stand.awake.contains_key(&[0, 0]) && !bench.stand.awake.contains_key(&[4, 0]));
    assert_eq!(bench.stand.counters.released, 1, "one place is wanted, one patch goes");
    assert_eq!(kept.len(), 18, "0.3 s");
    assert!(kept.iter().all(|keep| *keep < 1.0));
    let left: f32 = kept.iter().product();
    assert!(left < 1e-6 && (kept[..9].iter().product::<f32>() - 0.5).abs() < 0.01, "falls evenly: {kept:?}");
}
