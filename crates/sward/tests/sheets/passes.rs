//! A body goes through: billboards lean away, keep their lengths, never jump, and recover.

use std::collections::BTreeMap;

use sward::response::springs::CLEAR;

use super::{Deformed, deformed, meadow, model};

fn apart(a: [f32; 3], b: [f32; 3]) -> f32 {
    (0..3).map(|axis| (a[axis] - b[axis]) * (a[axis] - b[axis])).sum::<f32>().sqrt()
}

#[test]
fn a_walker_goes_through_and_all_recover() {
    let walker =
        "interactors: [(shape: Ellipsoid(radii: (0.25, 0.9, 0.25)), path: Circle(centre: (4, 4), radius: 3, speed: 1.5), until: 4)]";
    let mut world = meadow("recover: 1.5", &format!("wind: [Natural(velocity: (3, 1))], {walker}"));
    let (mut jump, mut stretch, mut lowest, mut bent): (f32, f32, f32, u32) = (0.0, 0.0, 1.0, 0);
    let mut before: BTreeMap<_, Deformed> = BTreeMap::new();
    for _ in 0..240 {
        world.step();
        let (columns, rows) = model(&world).coefficients.sides();
        let mut now = BTreeMap::new();
        for sheet in deformed(&world) {
            stretch = stretch.max(sheet.shown.stretch(&model(&world).coefficients, &sheet.root));
            for vertex in columns..columns * rows {
                lowest = lowest.min(sheet.root.height(sheet.shown.at[vertex]));
                // One that has just got its sheet stood as the wind had it.
                let was = before.get(&sheet.billboard).map_or(sheet.target.at[vertex], |before| before.shown.at[vertex]);
                jump = jump.max(apart(sheet.shown.at[vertex], was) / sheet.root.length);
                bent += u32::from(apart(sheet.shown.at[vertex], sheet.target.at[vertex]) > 0.1);
            }
            now.insert(sheet.billboard, sheet);
        }
        before = now;
    }
    println!("walker: {bent} vertices bent over 10 cm, jumps {jump:.2} L, lengths {stretch:.0e}, lowest {:.2} mm", lowest * 1e3);
    assert!(bent > 1000, "{bent}");
    assert!(jump < 0.35 && stretch < 1e-3 && lowest > 0.9 * CLEAR, "{jump} {stretch} {lowest}");
    // Gone: all stand as the wind has them again, and nothing is awake.
    for _ in 0..model(&world).settle + 90 {
        world.step();
    }
    assert!(world.state.stands[0].sheets.pool.is_empty());
    assert!(world.state.stands[0].awake.is_empty());
}

/// Just before a sheet is given back it stands as one without would: giving it back is not seen.
#[test]
fn giving_back_is_not_seen() {
    let mut world =
        meadow("recover: 0.5", "interactors: [(shape: Sphere(radius: 0.5), path: Circle(centre: (4, 4), radius: 2, speed: 3), until: 2)]");
    let (mut last, mut given, mut farthest): (BTreeMap<_, Deformed>, u32, f32) = (BTreeMap::new(), 0, 0.0);
    for _ in 0..240 {
        world.step();
        let now: BTreeMap<_, Deformed> = deformed(&world).into_iter().map(|sheet| (sheet.billboard, sheet)).collect();
        for (billboard, sheet) in last {
            if !now.contains_key(&billboard) {
                given += 1;
                farthest = (0..9).fold(farthest, |far, vertex| far.max(apart(sheet.shown.at[vertex], sheet.target.at[vertex])));
            }
        }
        last = now;
    }
    println!("{given} sheets given back, {farthest:.1e} m from the pose in the wind at most");
    assert!(given > 30 && farthest < 1e-5, "{given} {farthest}");
}

/// Hills, a road, gusts: what grows there and only that, each rooted on its own ground.
#[test]
fn only_what_grows_has_a_sheet() {
    let rest = "exclusions: [(area: Road(points: [(-30, 4), (30, 4)], width: 2))],
        interactors: [(shape: Box(size: (3, 1, 3)), path: Circle(centre: (4, 4), radius: 3, speed: 2))]";
    let mut world = meadow("", rest);
    (0..120).for_each(|_| world.step());
    let found = deformed(&world);
    assert!(found.len() > 40, "{}", found.len());
    let on_road = |sheet: &&Deformed| {
        let z = f64::from(sheet.billboard.0[1]) * 16.0 + f64::from(sheet.root.at[2]);
        (z - 4.0).abs() < 0.99
    };
    assert_eq!(found.iter().filter(on_road).count(), 0);
    let mut free = meadow("", &rest[rest.find("interactors").expect("bodies")..]);
    (0..120).for_each(|_| free.step());
    assert!(deformed(&free).iter().filter(on_road).count() > 5, "without the road there are some");
}
