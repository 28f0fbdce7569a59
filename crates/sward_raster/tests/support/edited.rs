//! Ground that is edited between two frames: plants on it have not moved, and those that grow there now have numbers.

use sward::picture::aov::Aov;
use sward::picture::identity::Identity;
use sward::scene::{Change, Edit, Flatten, Raise};
use sward::world::World;

use crate::reprojection::world;

/// A hill too steep for the meadow, before a camera that stands still: the ground below it and below its target is not edited.
const HILLS: &str = "(version: 1, field: (patch_side: 16), stands: [(species: Meadow, cells: 96, slope: (0, 0.15))],
    wind: [Natural(velocity: (3, 1))],
    edits: [(at: (-3, 9), radius: 4, change: Raise(height: 1.5))],
    camera: (keys: [(time: 0, eye: (0, 3.5, -4), target: (0, 1, 3))], field_of_view: 0.75),
    budget: (patches: 25, focus_distance: 20, lag_distance: 20))";

/// Middle and radius of the brush that makes plants grow, m.
const BRUSH: ([f64; 2], f64) = ([-3.0, 9.0], 4.0);
/// Most that plants move in a frame, pixels: by the wind alone.
const MOST: f32 = 0.3;

/// The worlds of both frames. Between them a hill is made level, and the grid of edits is laid anew round a far one.
pub(crate) fn worlds() -> [World; 2] {
    let mut now = world(HILLS);
    (0..30).for_each(|_| now.step());
    let before = now.clone();
    let level = Edit {
        at: BRUSH.0,
        radius: BRUSH.1 as f32,
        hardness: 0.8,
        change: Change::Flatten(Flatten { height: Some(0.0) }),
        ..Edit::default()
    };
    let far = Edit { at: [-60.0, -50.0], radius: 5.0, change: Change::Raise(Raise { height: 2.0 }), ..Edit::default() };
    let near = Edit { at: [4.0, 10.0], radius: 3.0, change: Change::Raise(Raise { height: 0.2 }), ..Edit::default() };
    for edit in [level, far, near] {
        now.edit(&edit).expect("within range");
    }
    (0..2).for_each(|_| now.step());
    [before, now]
}

/// The earlier of two worlds, had its ground always been what it is in the later one.
pub(crate) fn always([before, now]: &[World; 2]) -> World {
    let mut always = before.clone();
    always.model.terrain = now.model.terrain.clone();
    always
}

/// Numbers of the plants under the brush.
fn grown(world: &World, aov: &Aov) -> Vec<u32> {
    let (identity, stand) = (Identity::of(world), &world.model.stands[0]);
    let under = |number: &u32| {
        identity.place(*number, [0, 0]).is_some_and(|place| {
            let at = [0, 1].map(|axis| f64::from(place.patch[axis]) * world.model.patch_side + f64::from(place.cell[axis]) * stand.spacing);
            (at[0] - BRUSH.0[0]).hypot(at[1] - BRUSH.0[1]) < 0.8 * BRUSH.1
        })
    };
    aov.plant.iter().copied().filter(under).collect()
}

/// Largest component of the motion, pixels.
fn farthest(aov: &Aov) -> f32 {
    aov.motion.iter().flatten().fold(0.0, |most, motion| if motion.abs() <= most { most } else { motion.abs() })
}

/// What must hold of `frames`, whose motion leads from the one to the other; `same`: the second again, leading to [`always`]; `still`:
/// leading to itself. Controls: the edits matter, and so does the moment before.
pub(crate) fn verdict(worlds: &[World; 2], frames: &[Aov; 2], same: &Aov, still: &Aov) -> Result<(), String> {
    let ensure = |holds: bool, message: String| if holds { Ok(()) } else { Err(message) };
    let sizes = worlds.each_ref().map(|world| world.model.terrain.grid().edit_size);
    ensure(sizes[0] != sizes[1], format!("control: the grid of edits is laid anew: {sizes:?}"))?;
    let [bare, green] = [0, 1].map(|k| grown(&worlds[k], &frames[k]));
    let fresh = green.iter().filter(|number| !bare.contains(number)).count();
    let most = farthest(&frames[1]);
    println!("{fresh} pixels show plants that grow now; motion of at most {most} pixels, {} where nothing moves", farthest(still));
    ensure(fresh > 1000, format!("control: {fresh} pixels show plants that grow now"))?;
    ensure(frames[1].plant == still.plant && frames[1].depth == still.depth, "numbers depend on the past".to_owned())?;
    ensure(most < MOST, format!("plants move by {most} pixels"))?;
    ensure(frames[1].motion == same.motion, "where plants were depends on the ground then".to_owned())?;
    ensure(most > 10.0 * farthest(still), "control: the wind moves nothing".to_owned())
}
