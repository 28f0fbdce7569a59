//! Bodies that stand still: what leans on them stays where it is.

use glam::Vec3;
use sward::interaction::distance_map::DistanceMapHead;
use sward::response::springs::{Maps, SheetRoot};

use crate::Test;
use crate::bodies::{Body, block, egg};
use crate::field::{Plant, STEP, coefficients, head, root, row};

pub(crate) const TESTS: &[Test] = &[
    ("nothing_moves_at_a_standing_body", nothing_moves_at_a_standing_body),
    ("a_foot_treads_down_what_it_steps_on", a_foot_treads_down_what_it_steps_on),
];

/// The body comes, stops among the plants, and stands for 10 s (turning by `turn` rad/s there). Returns changes of contact and of faces,
/// the largest move of a vertex \[m\], the deepest one \[m\], and how many billboards it holds.
fn stand(body: &Body, turn: f32) -> (u32, u32, f32, f32, u32) {
    let co = coefficients(3, 3);
    let (mut switches, mut faces, mut moved, mut deepest, mut held) = (0, 0, 0.0f32, 0.0f32, 0);
    for root in row(0.4, 0.4) {
        let mut plant = Plant::new(&co, root);
        for frame in 0..840u32 {
            let z = (frame as f32 * 1.5 * STEP - 1.0).min(-0.1);
            // What it brushed on its way has recovered, or leans on it, by then.
            let still = frame > 240;
            let yaw = if still { (frame - 240) as f32 * turn * STEP } else { 0.0 };
            let heads: [DistanceMapHead; 1] = [head(&body.map, 0, Vec3::Z * z, yaw)];
            let maps = Maps { heads: &heads, texels: &body.map.texels };
            let before = plant.clone();
            plant.step(&co, &maps, [0.0, 1.0]);
            if !still {
                continue;
            }
            switches += u32::from((before.held.steps == 0) != (plant.held.steps == 0));
            faces += before.held.faces.iter().zip(&plant.held.faces).filter(|(a, b)| a != b && **b != 0).count() as u32;
            let way = |(a, b): (&[f32; 3], &[f32; 3])| Vec3::from(*a).distance(Vec3::from(*b));
            if plant.held.steps == 0 {
                moved = plant.shown.at.iter().zip(&before.shown.at).map(way).fold(moved, f32::max);
            }
            deepest = deepest.max(maps.deepest(&co, &plant.root, 0, &plant.shown));
        }
        held += u32::from(plant.held.steps == 0);
    }
    (switches, faces, moved, deepest, held)
}

fn nothing_moves_at_a_standing_body() {
    for body in [
        egg("round", Vec3::new(0.25, 0.9, 0.25), 0.0, 64, 48),
        egg("round, sunk", Vec3::new(0.25, 0.9, 0.25), -0.1, 64, 48),
        block("box", Vec3::new(0.5, 1.8, 0.3), 0.0, 64),
        block("box, 10 cm up", Vec3::new(0.5, 1.8, 0.3), 0.1, 64),
    ] {
        let (switches, faces, moved, deepest, held) = stand(&body, 0.0);
        println!(
            "{}: {switches} changes of contact and {faces} of faces in 10 s, moved {:.4} mm, deepest {:.2} mm, holds {held}",
            body.name,
            moved * 1e3,
            deepest * 1e3
        );
        assert!(held > 20, "{}: it must hold some", body.name);
        assert!(switches == 0 && faces == 0 && moved < 1e-4 && deepest < 0.005, "{}", body.name);
    }
    let (_, faces, moved, ..) = stand(&block("box", Vec3::new(0.5, 1.8, 0.3), 0.0, 64), 1.0);
    assert!(faces > 0 && moved > 1e-4, "a turning box must move them: {faces}, {moved}");
}

/// A flat foot comes down at 1 m/s and stands: what grows under it lies on the ground then, but for some near its rim that lean out.
fn a_foot_treads_down_what_it_steps_on() {
    let co = coefficients(3, 3);
    for thick in [0.06, 0.12, 0.3] {
        let foot = block("foot", Vec3::new(0.5, thick, 0.7), 0.0, 64);
        let (mut under, mut flat, mut beside, mut jump) = (0, 0, 0, 0.0f32);
        for k in 0..121 {
            let (x, z) = ((k % 11) as f32 * 0.06 - 0.3, (k / 11) as f32 * 0.08 - 0.4);
            let narrow = SheetRoot { half_width: [0.03, 0.0], ..root(x, z, 0.0, 0.15) };
            let mut plant = Plant::new(&co, narrow);
            for frame in 0..60 {
                let high = (0.4 - STEP * frame as f32).max(0.0);
                let heads = [head(&foot.map, 0, Vec3::Y * high, 0.0)];
                let before = plant.shown;
                plant.step(&co, &Maps { heads: &heads, texels: &foot.map.texels }, [0.0, 1.0]);
                let moves = plant.shown.at.iter().zip(&before.at).map(|(a, b)| Vec3::from(*a).distance(Vec3::from(*b)) / 0.15);
                jump = moves.fold(jump, f32::max);
            }
            let top = plant.shown.at[3..9].iter().fold(0.0f32, |top, at| top.max(at[1]));
            // Near the rim plants may lean out of it.
            if x.abs() < 0.16 && z.abs() < 0.26 {
                under += 1;
                flat += u32::from(top < 0.01);
            } else if x.abs() > 0.29 || z.abs() > 0.39 {
                beside += u32::from(top > 0.14);
            }
        }
        println!("foot of {thick} m: {flat} of {under} plants under it lie flat, {beside} beside it stand; jump {jump:.2} L");
        assert!(under > 20 && 10 * flat >= 8 * under && beside > 20 && jump < 0.35, "{flat} of {under}, {beside}, {jump}");
    }
}
