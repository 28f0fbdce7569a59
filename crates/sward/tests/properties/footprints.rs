//! Swept footprints (§5.1): area, sign, quantisation, paths and undersides.

use crate::common::Dice;
use sward::interaction::{ABREAST, Footprint, Grid, Hit, Pose, contact_at, contacts_of_row, pieces_of, pose_on_path, swept};
use sward::scene::{BoxShape, Ellipsoid, Polygon, Scene, Shape, Sphere};
use sward::terrain::Terrain;

const GRID: Grid = Grid { spacing: 0.25, plant_height: 0.4 };

fn pose(ground: [f64; 2], yaw: f64) -> Pose {
    Pose { ground, yaw, height: 0.0, slope: [0.0; 2] }
}

/// Corners at both ends of a step, as std would turn them.
fn corners(outline: &[[f64; 2]], ends: [&Pose; 2]) -> Vec<[f64; 2]> {
    let turned = |pose: &Pose, p: &[f64; 2]| {
        let (s, c) = pose.yaw.sin_cos();
        [pose.ground[0] + c * p[0] + s * p[1], pose.ground[1] - s * p[0] + c * p[1]]
    };
    ends.iter().flat_map(|pose| outline.iter().map(|p| turned(pose, p))).collect()
}

/// How far a point is inside the hull of some points, m: the least room over all directions (negative outside).
fn room(points: &[[f64; 2]], at: [f64; 2]) -> f64 {
    let mut least = f64::MAX;
    for a in points {
        for b in points {
            let way = [b[0] - a[0], b[1] - a[1]];
            let size = way[0].hypot(way[1]);
            if size < 1e-9 {
                continue;
            }
            let normal = [way[1] / size, -way[0] / size];
            let over = |p: &[f64; 2]| normal[0] * (p[0] - a[0]) + normal[1] * (p[1] - a[1]);
            if points.iter().all(|p| over(p) <= 1e-9) {
                least = least.min(-over(&at));
            }
        }
    }
    least
}

fn shape(dice: &mut Dice) -> Shape {
    match (dice.unit() * 3.0) as u32 {
        0 => Shape::Box(BoxShape { size: [dice.between(0.3, 3.0) as f32, 1.0, dice.between(0.3, 6.0) as f32] }),
        1 => Shape::Ellipsoid(Ellipsoid { radii: [dice.between(0.3, 2.0) as f32, 0.5, dice.between(0.3, 2.0) as f32] }),
        _ => Shape::Polygon(Polygon { points: vec![[-0.6, -0.6], [0.6, -0.6], [0.1, 0.9]], height: 1.0 }),
    }
}

#[test]
fn cells_inside_are_those_of_the_exact_hull_up_to_the_grid() {
    let (mut dice, mut agreed, mut doubtful, mut quantum) = (Dice(2), 0, 0, 0.0_f64);
    for _ in 0..300 {
        let start = pose([dice.between(-500.0, 500.0), dice.between(-500.0, 500.0)], dice.between(-9.0, 9.0));
        let speed = if dice.unit() < 0.2 { 140.0 } else { 30.0 };
        let way = [0, 1].map(|_| dice.between(-speed, speed) / 60.0);
        let end = pose([start.ground[0] + way[0], start.ground[1] + way[1]], start.yaw + dice.between(-0.1, 0.1));
        let piece = &pieces_of(&shape(&mut dice))[0];
        let footprint = swept(piece, &start, &end, 1.0 / 60.0, &GRID, 0).expect("large enough");
        let exact = corners(&piece.outline, [&start, &end]);
        let unit = GRID.spacing / f64::from(1 << footprint.contact.shift);
        assert_eq!(footprint.contact.shift, 8, "a cell in 256 parts");
        check_edges(&footprint, &exact, unit, &mut quantum);
        for v in -2..footprint.contact.size[1] + 2 {
            for u in -2..footprint.contact.size[0] + 2 {
                let at = [0, 1].map(|k| (footprint.corner[k] as f64 + f64::from([u, v][k]) + 0.5) * GRID.spacing);
                let exact_room = room(&exact, at);
                let mut flat = footprint.contact;
                (flat.kind, flat.form, flat.start[2], flat.end[2]) = (0, [0.0; 4], 0.0, 0.0);
                let hit = contact_at(&flat, &footprint.edges, [u, v], 0.0, 0.4);
                if exact_room.abs() < unit {
                    doubtful += 1;
                    continue;
                }
                agreed += 1;
                assert_eq!(hit.is_some(), exact_room > 0.0, "{exact_room} m inside");
                if let Some(hit) = hit {
                    assert!((f64::from(hit.depth) - exact_room).abs() < 1.5 * unit, "{} for {exact_room}", hit.depth);
                }
            }
        }
    }
    println!("{agreed} cells agree, {doubtful} lie within a unit of the edge; corners off by {quantum:.3} units at most");
    assert!(agreed > 20_000 && doubtful < agreed / 50);
}

/// Corners of the footprint are corners of the exact hull to half a unit, and normals point outwards.
fn check_edges(footprint: &Footprint, exact: &[[f64; 2]], unit: f64, quantum: &mut f64) {
    for edge in &footprint.edges {
        let corner = [0, 1].map(|k| footprint.corner[k] as f64 * GRID.spacing + f64::from(edge.start[k]) * unit);
        let off = exact.iter().map(|p| (p[0] - corner[0]).abs().max((p[1] - corner[1]).abs())).fold(f64::MAX, f64::min) / unit;
        *quantum = quantum.max(off);
        assert!(off <= 0.5 + 1e-6, "{off}");
        let middle = exact.iter().fold([0.0, 0.0], |sum, p| [sum[0] + p[0], sum[1] + p[1]]).map(|sum| sum / exact.len() as f64);
        let outwards = (corner[0] - middle[0]) * f64::from(edge.normal[0]) + (corner[1] - middle[1]) * f64::from(edge.normal[1]);
        assert!(outwards > 0.0 && (edge.normal[0].hypot(edge.normal[1]) - 1.0).abs() < 1e-6);
    }
}

#[test]
fn speed_turn_and_direction_have_the_signs_of_the_motion() {
    let piece = &pieces_of(&Shape::Box(BoxShape { size: [2.0, 1.0, 4.0] }))[0];
    let footprint = swept(piece, &pose([0.0, 0.0], 0.0), &pose([0.1, 0.2], 0.02), 1.0 / 60.0, &GRID, 3).expect("wide");
    assert_eq!(footprint.contact.body, 3);
    assert!((footprint.contact.velocity[0] - 6.0).abs() < 1e-4 && (footprint.contact.velocity[1] - 12.0).abs() < 1e-4);
    assert!((footprint.contact.yaw_rate - 1.2).abs() < 1e-4);
    // Turning +z towards +x: the front moves to +x on top of the way.
    let cell_of = |at: [f64; 2]| [0, 1].map(|k| ((at[k] / GRID.spacing).floor() as i64 - footprint.corner[k]) as i32);
    let front = contact_at(&footprint.contact, &footprint.edges, cell_of([0.1, 1.45]), 0.0, 0.4).expect("inside");
    let back = contact_at(&footprint.contact, &footprint.edges, cell_of([0.1, -1.3]), 0.0, 0.4).expect("inside");
    let side = |hit: &sward::interaction::Hit| hit.direction[0] / hit.direction[1];
    assert!(side(&front) > side(&back), "{front:?} {back:?}");
    assert!((front.height - 0.02).abs() < 1e-7, "on the ground the lower bound wins");
    // Within 0.4 m of a side the plant is pushed outwards too; in the middle straight on.
    let left = contact_at(&footprint.contact, &footprint.edges, cell_of([0.98, 0.1]), 0.0, 0.4).expect("inside");
    assert!(left.direction[0] > 0.8 && left.normal[0] > 0.9, "{left:?}");
    let straight = contact_at(&footprint.contact, &footprint.edges, cell_of([0.1, 0.1]), 0.0, 0.4).expect("inside");
    assert!((side(&straight) - 0.5).abs() < 0.05 && (straight.along - straight.speed).abs() < 1e-4, "{straight:?}");
}

#[test]
fn the_underside_is_the_lower_of_both_ends_of_the_step() {
    let piece = &pieces_of(&Shape::Box(BoxShape { size: [2.0, 1.0, 2.0] }))[0];
    let at = |height: f64| Pose { height, ..pose([0.0, 0.0], 0.0) };
    for (start, end) in [(1.0, 0.1), (0.1, 1.0)] {
        let footprint = swept(piece, &at(start), &at(end), 1.0 / 60.0, &GRID, 0).expect("wide");
        let hit = contact_at(&footprint.contact, &footprint.edges, [4, 4], 0.0, 0.4);
        assert!((hit.expect("it came down or rose").height - 0.1).abs() < 1e-6, "{start} to {end}");
    }
    let above = swept(piece, &at(1.0), &at(1.0), 1.0 / 60.0, &GRID, 0).expect("wide");
    assert_eq!(contact_at(&above.contact, &above.edges, [4, 4], 0.0, 0.4), None, "control: it stays above the plants");
}

#[test]
fn a_fast_ball_skips_no_plants() {
    let piece = &pieces_of(&Shape::Sphere(Sphere { radius: 0.4 }))[0];
    for speed in [1.0, 15.0, 60.0, 140.0] {
        let (start, end) = (pose([0.1, 0.1], 0.0), pose([0.1 + speed / 60.0, 0.1], 0.0));
        let footprint = swept(piece, &start, &end, 1.0 / 60.0, &GRID, 0).expect("wide");
        for way in 0..=20 {
            let place = [0.1 + speed / 60.0 * f64::from(way) / 20.0, 0.1];
            let cell = [0, 1].map(|k| ((place[k] / GRID.spacing).floor() as i64 - footprint.corner[k]) as i32);
            let hit = contact_at(&footprint.contact, &footprint.edges, cell, 0.0, 0.05);
            let centre = (footprint.corner[0] as f64 + f64::from(cell[0]) + 0.5) * GRID.spacing;
            // A cell whose centre lies beyond either end may be free.
            if centre > 0.1 && centre < end.ground[0] {
                assert!(hit.is_some(), "{speed} m/s: free at {way}/20 of the way");
            }
        }
    }
}

#[test]
fn an_ellipsoid_has_the_lower_half_of_an_ellipsoid_as_its_underside() {
    let (radii, yaw) = ([1.2_f64, 0.5, 0.7], 0.6_f64);
    let shape = Shape::Ellipsoid(Ellipsoid { radii: radii.map(|r| r as f32) });
    let here = pose([10.3, -4.2], yaw);
    let footprint = swept(&pieces_of(&shape)[0], &here, &here, 1.0 / 60.0, &GRID, 0).expect("wide");
    let mut met = 0;
    for at in 0..footprint.contact.size[0] * footprint.contact.size[1] {
        let cell = [at % footprint.contact.size[0], at / footprint.contact.size[0]];
        let place = [0, 1].map(|k| (footprint.corner[k] as f64 + f64::from(cell[k]) + 0.5) * GRID.spacing - here.ground[k]);
        let (s, c) = yaw.sin_cos();
        let own = [c * place[0] - s * place[1], s * place[0] + c * place[1]];
        let inside = 1.0 - (own[0] / radii[0]).powi(2) - (own[1] / radii[2]).powi(2);
        let exact = radii[1] - radii[1] * inside.max(0.0).sqrt();
        let hit = contact_at(&footprint.contact, &footprint.edges, cell, 0.0, 0.4);
        if inside > 1e-3 && exact < 0.399 {
            met += 1;
            let height = f64::from(hit.expect("below the body").height);
            assert!((height - exact.clamp(0.02, 0.24)).abs() < 1e-4, "{height} for {exact}");
        } else if inside < -1e-3 || exact > 0.401 {
            assert_eq!(hit, None, "{exact} {inside}");
        }
    }
    assert!(met > 20, "{met}");
}

#[test]
fn paths_are_continuous_and_bodies_face_their_motion() {
    let text = "(version: 1, interactors: [
        (shape: Truck, path: Keyframes(keys: [(time: 0.0, at: (0.0, 0.0)), (time: 2.0, at: (9.0, 3.0)), (time: 3.0, at: (9.0, 9.0)), (time: 6.0, at: (-4.0, 2.0))])),
        (shape: Truck, path: Circle(centre: (3.0, 1.0), radius: 4.0, speed: 5.0, start: 1.0)),
        (shape: Truck, path: Circle(centre: (3.0, 1.0), radius: 4.0, speed: -5.0))])";
    let scene = Scene::parse(text, "paths.ron").expect("valid");
    let terrain = Terrain::flat(0.0);
    for interactor in &scene.interactors {
        let at = |time: f64| pose_on_path(interactor, [1.0, 2.0], &terrain, time);
        let mut headed = 0;
        for step in 1..3600 {
            let time = f64::from(step) / 600.0;
            let (before, now) = (at(time - 1.0 / 600.0), at(time));
            let way = [now.ground[0] - before.ground[0], now.ground[1] - before.ground[1]];
            let size = way[0].hypot(way[1]);
            assert!(size < 20.0 / 600.0, "{time}: {size}");
            if size > 1e-3 {
                headed += 1;
                let ahead = (way[0] * now.yaw.sin() + way[1] * now.yaw.cos()) / size;
                assert!(ahead > 0.99, "{time}: {ahead}");
            }
        }
        assert!(headed > 1000);
    }
    let circle = pose_on_path(&scene.interactors[1], [1.0, 2.0], &terrain, 0.0);
    assert!((circle.ground[0] - 3.0 - 4.0 * 1.0_f64.cos()).abs() < 1e-9 && (circle.ground[1] - 1.0 - 4.0 * 1.0_f64.sin()).abs() < 1e-9);
}

/// Cells asked side by side, wherever the first lies, answer as each does alone.
#[test]
fn contacts_of_rows_are_those_of_their_cells() {
    let (mut dice, mut touched, mut shifted) = (Dice(7), 0, 0);
    for _ in 0..200 {
        let start = pose([dice.between(-50.0, 50.0), dice.between(-50.0, 50.0)], dice.between(-9.0, 9.0));
        let way = [0, 1].map(|_| dice.between(-1.0, 1.0));
        let end = pose([start.ground[0] + way[0], start.ground[1] + way[1]], start.yaw + dice.between(-0.1, 0.1));
        let Footprint { contact, edges, .. } =
            swept(&pieces_of(&shape(&mut dice))[0], &start, &end, 1.0 / 60.0, &GRID, 0).expect("large enough");
        let ground = |column: i32| 0.01 * column as f32 - 0.2;
        let alone = |column: i32, row: i32| contact_at(&contact, &edges, [column, row], ground(column), 0.4);
        for row in -1..=contact.size[1] {
            for first in [-9, -3, 0, 5] {
                let mut hits: [Option<Hit>; ABREAST] = [None; ABREAST];
                contacts_of_row(&contact, &edges, [first, row], |k| ground(first + k as i32), 0.4, |k, hit| hits[k] = Some(hit));
                let cells: Vec<Option<Hit>> = (first..first + ABREAST as i32).map(|column| alone(column, row)).collect();
                assert_eq!(hits.to_vec(), cells);
                touched += hits.iter().flatten().count();
                shifted += usize::from(
                    hits.iter().flatten().count() > 0 && (1..=ABREAST as i32).any(|k| hits[k as usize - 1] != alone(first + k, row)),
                );
            }
        }
    }
    assert!(touched > 10_000 && shifted > 1_000, "control: {touched} cells, {shifted} rows differ from those beside them");
}
