//! A body from a glTF file that plays a clip: its maps are drawn anew in each step, and billboards leave its legs.

use sward::model::Assets;
use sward::response::springs::Maps;
use sward::scene::Scene;
use sward::world::World;

use super::{deformed, model};
use crate::glb::walker;

struct Walker;

impl Assets for Walker {
    fn read(&self, path: &str) -> Result<Vec<u8>, String> {
        if path == "walker.glb" { Ok(walker().bytes()) } else { Err(format!("{path} is missing")) }
    }
}

fn meadow(clip: &str) -> World {
    let text = format!(
        "(version: 1, field: (patch_side: 16), stands: [(species: Meadow, cells: 64, height: (0.4, 0.4), response: Springs(recover: 1))],
        interactors: [(shape: Mesh(file: \"walker.glb\"{clip}), path: Circle(centre: (4, 4), radius: 3, speed: 1))])"
    );
    World::new(Scene::parse(&text, "walker.ron").expect("valid"), &Walker).expect("valid")
}

/// Frames of billboards, those of them with a vertex deeper than 5 mm in the body as it is after the step, the deepest [m], and the largest stretch.
fn walk(world: &mut World) -> (u32, u32, f32, f32) {
    let (mut frames, mut over, mut deepest, mut stretch): (u32, u32, f32, f32) = (0, 0, 0.0, 0.0);
    for _ in 0..180 {
        let plan = world.plan();
        let reports = world.respond(&plan);
        world.finish(reports);
        let sheets = deformed(world);
        for (sheet, active) in sheets.iter().zip(&plan.stands[0].sheets.active) {
            let heads = &plan.stands[0].sheets.heads[active.heads.start as usize..active.heads.end as usize];
            let maps = Maps { heads, texels: &world.texels };
            let co = &model(world).coefficients;
            let deep = maps.deepest(co, &sheet.root, maps.last(), &sheet.shown);
            frames += 1;
            over += u32::from(deep > 0.005);
            deepest = deepest.max(deep);
            stretch = stretch.max(sheet.shown.stretch(co, &sheet.root));
        }
    }
    (frames, over, deepest, stretch)
}

#[test]
fn billboards_leave_legs_that_walk() {
    let mut world = meadow(", clip: \"Walk\"");
    let before = world.texels.clone();
    // Not a whole number of its rounds.
    (0..20).for_each(|_| world.step());
    assert!(world.texels != before, "its map moves");
    let (frames, over, deepest, stretch) = walk(&mut world);
    println!("walking figure: {over} of {frames} frames deeper than 5 mm, deepest {:.1} mm, lengths {stretch:.0e}", 1e3 * deepest);
    assert!(frames > 1000, "{frames}");
    assert!(stretch < 1e-3 && over * 200 < frames, "{over} {deepest} {stretch}");
    // Without its clip it stands stiff, and its map is drawn once.
    let mut stiff = meadow("");
    let before = stiff.texels.clone();
    (0..20).for_each(|_| stiff.step());
    let (frames, ..) = walk(&mut stiff);
    assert!(frames > 100 && stiff.texels == before);
}
