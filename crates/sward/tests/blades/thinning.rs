//! How blades thin out: nothing pops, nothing exceeds the budget, nothing depends on the size of the field.

use std::collections::BTreeMap;

use crate::solved::{Solved, plan, projection, solve, world};
use glam::{Mat4, Vec3};
use sward::picture::blade_plan::BladePlan;
use sward::world::World;

const MEADOW: &str = "stands: [(species: Meadow, representation: Blade())], wind: [Natural(velocity: (3, 1))],
    camera: (eye: (0, 1.7, -8), target: (0, 0.5, 10))";

/// Pixels of 960 × 540 that a blade covers, about.
fn area(seen: &Mat4, (blade, _, strip): &Solved, width: f32) -> f32 {
    let place = |at: Vec3| {
        let clip = *seen * at.extend(1.0);
        glam::Vec2::new(480.0 * clip.x / clip.w, 270.0 * clip.y / clip.w)
    };
    let away = (*seen * Vec3::from(blade.root).extend(1.0)).w.max(0.1);
    let long: f32 = strip.windows(2).map(|two| place(two[0]).distance(place(two[1]))).sum();
    0.6 * long * width * 540.0 / away
}

/// Whether some point of a blade is in the picture.
fn in_picture(seen: &Mat4, (_, _, strip): &Solved) -> bool {
    let clips = strip.iter().map(|point| *seen * point.extend(1.0));
    clips.into_iter().any(|clip| clip.w > 0.0 && clip.x.abs() < clip.w && clip.y.abs() < clip.w)
}

/// By patch and place in the drawing order.
fn by_place(solved: Vec<Solved>) -> BTreeMap<(u32, u32), Solved> {
    solved.into_iter().map(|one| ((one.0.draw, one.0.rank), one)).collect()
}

/// The same picture, thinned out as seen from `way` m farther on.
fn moved(plan: &BladePlan, way: f32) -> BladePlan {
    let mut moved = plan.clone();
    moved.uniform.eye[2] += way;
    moved
}

/// One centimetre on: blades that come or go cover next to nothing, and no strip changes its shape by a jump. Controls: the same blades as
/// wide as all others; a metre on.
#[test]
fn nothing_pops() {
    let world = world(MEADOW);
    let (plan, seen) = (plan(&world), projection(&world));
    let compare = |way: f32, plan: &BladePlan| {
        let here = by_place(solve(&world, plan));
        let there = by_place(solve(&world, &moved(plan, way)));
        let gone = here.iter().filter(|(place, _)| !there.contains_key(*place));
        let come = there.iter().filter(|(place, _)| !here.contains_key(*place));
        let changed: Vec<&Solved> = gone.chain(come).map(|(_, one)| one).filter(|one| in_picture(&seen, one)).collect();
        let most = changed.iter().map(|one| area(&seen, one, one.0.width)).fold(0.0, f32::max);
        let wide = changed.iter().map(|one| area(&seen, one, 0.02)).fold(0.0, f32::max);
        let jump = here.iter().filter(|(_, one)| in_picture(&seen, one)).filter_map(|(place, one)| {
            let other = there.get(place)?;
            // Those that grow or shrink with the thinning are counted by their area.
            if (one.0.width / other.0.width - 1.0).abs() > 0.002 {
                return None;
            }
            let tip = |one: &Solved| (seen * one.2[one.2.len() - 1].extend(1.0)).truncate() / (seen * one.2[one.2.len() - 1].extend(1.0)).w;
            Some((tip(one) - tip(other)).truncate().length() * 480.0)
        });
        ([here.len(), changed.len()], most, wide, jump.fold(0.0, f32::max))
    };
    let ([all, count], most, wide, jump) = compare(0.01, &plan);
    println!("{all} blades, {count} come or go: {most:.3} pixels at most ({wide:.1} if as wide as others); tips move {jump:.2} pixels");
    assert!(all > 50_000 && count > 5, "{count} of {all}");
    assert!(most < 0.3 && jump < 0.5, "{most} pixels pop, tips jump {jump}");
    assert!(wide > 10.0 * most.max(0.01), "control: {wide}");
    let mut hard = plan.clone();
    hard.uniform.shape[2] = 1e-6;
    let (_, popped, ..) = compare(0.01, &hard);
    assert!(popped > 3.0, "control: without a band {popped} pixels pop");
    let (_, far, ..) = compare(1.0, &plan);
    assert!(far > 3.0, "control: a metre is seen: {far}");
}

/// Rooms hold what is found, and together no more than the budget.
#[test]
fn blades_keep_within_the_budget() {
    let (mut thinned, mut wasted) = (0, 0.0_f64);
    for budget in [1_500_000, 262_144, 20_000, 2_000] {
        for camera in
            ["eye: (0, 1.7, -8), target: (0, 0.5, 10)", "eye: (3, 30, -8), target: (0, 0, 10)", "eye: (0, 0.3, 0), target: (50, 0.2, 9)"]
        {
            let world = world(&format!(
                r#"terrain: Image(path: "assets/jacksboro.png", scale: 0.03125), stands: [(species: Meadow, representation: Blade())],
                camera: ({camera}), budget: (visible_blades: {budget})"#
            ));
            let plan = plan(&world);
            let mut found = [0; 3];
            solve(&world, &plan).iter().for_each(|(_, level, _)| found[*level] += 1);
            let rooms = plan.uniform.rooms;
            assert!((0..3).all(|level| found[level] <= rooms[level]), "{found:?} in {rooms:?}");
            assert!(rooms[..3].iter().sum::<u32>() <= budget, "{rooms:?} exceed {budget}");
            assert!(plan.uniform.records() <= 1 << 23, "{} do not fit a buffer", plan.uniform.records());
            // Room is not wasted either.
            if budget > 10_000 {
                println!("{camera}: {found:?} in {rooms:?}, distances count {:.1} times", plan.uniform.thinning[3]);
                wasted = wasted.max(rooms[..3].iter().sum::<u32>() as f64 / found.iter().sum::<u32>() as f64);
            }
            thinned += usize::from(plan.uniform.thinning[3] > 1.0);
        }
    }
    assert!(wasted < 1.8, "room for {wasted} times what is found");
    assert!(thinned >= 3, "a short budget thins: {thinned}");
}

/// Many pieces of many blades: what a buffer holds is less than the budget.
#[test]
fn records_fit_a_buffer() {
    let with = |pieces: u32| {
        let world = world(&format!(
            "stands: [(species: Meadow, cells: 256, representation: Blade(blades: 64, pieces: ({pieces}, {pieces}, {pieces}), thinning: (0.01, 0, 0)))],
            camera: (eye: (0, 20, -8), target: (0, 0, 10)), budget: (visible_blades: 1500000)"
        ));
        plan(&world).uniform
    };
    let (few, many) = (with(1), with(12));
    assert!(few.records() <= 1 << 23 && many.records() <= 1 << 23 && many.records() > 1 << 22, "{} and {}", few.records(), many.records());
    let blades = |uniform: &sward::picture::blade_plan::BladeUniform| uniform.rooms[..3].iter().sum::<u32>();
    assert!(blades(&few) > 2 * blades(&many), "control: {} and {}", blades(&few), blades(&many));
}

/// A field of 280 m and one of 28 km: the same patches, workgroups and room.
#[test]
fn the_field_costs_nothing() {
    let plan_of = |patches: u32| {
        let world: World = world(&format!("field: (patches: ({patches}, {patches})), {MEADOW}"));
        let plan = plan(&world);
        (plan.workgroups, plan.draws.len(), plan.uniform.rooms, plan.uniform.records())
    };
    let (small, large) = (plan_of(10), plan_of(1000));
    assert_eq!(small, large);
    assert_ne!(small, plan_of(3), "control: a field smaller than the view");
}
