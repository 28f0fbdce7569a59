//! A meadow of blades, what its blades do, and where they are.

use std::collections::BTreeMap;

use sward::interaction::solid::nearness;
use sward::model::Assets;
use sward::plan::{around, weights};
use sward::response::chain::{self, HeldBlade, Standing};
use sward::scene::Scene;
use sward::state::Root;
use sward::world::World;

use crate::common::world;
use crate::glb::walker;

/// A meadow that moves blade by blade, with a body.
pub(crate) fn meadow(response: &str, wind: &str, body: &str) -> World {
    world(&format!(
        "field: (patch_side: 8), stands: [(species: Meadow, cells: 32, response: {response}, representation: Blade(blades: 4))], wind: [{wind}], \
         interactors: [{body}], budget: (focus_distance: 12), camera: (eye: (0, 1.7, -6), target: (0, 0, 4))"
    ))
}

/// The same with a body from a glTF file: `walker.glb`, which walks on the spot of its feet.
pub(crate) fn meadow_of_walker(body: &str) -> World {
    let text = format!(
        "(version: 1, field: (patch_side: 8), stands: [(species: Meadow, cells: 32, response: VirtualInertia(), representation: Blade(blades: 4))], \
         wind: [Natural(velocity: (4, 1), turbulence: 0.25)], interactors: [{body}], budget: (focus_distance: 12), camera: (eye: (0, 1.7, -6), target: (0, 0, 4)))"
    );
    let scene = Scene::parse(&text, "test.ron").unwrap_or_else(|error| panic!("{error}"));
    World::new(scene, &Walker).unwrap_or_else(|error| panic!("{error}"))
}

/// The one file of [`meadow_of_walker`].
struct Walker;

impl Assets for Walker {
    fn read(&self, path: &str) -> Result<Vec<u8>, String> {
        if path == "walker.glb" { Ok(walker().bytes()) } else { Err(format!("{path} is missing")) }
    }
}

/// The blades with a state: patch by patch, where they stand and how.
pub(crate) fn held(world: &World) -> Vec<(Root, HeldBlade)> {
    let (stand, state) = (&world.model.stands[0], &world.state.stands[0]);
    let chain = stand.chain.as_ref().expect("it moves blade by blade");
    let n = chain.coefficients.segments as usize;
    let mut found = Vec::new();
    for awake in state.awake.values() {
        let Some(values) = state.cells.blades(awake.lag) else { continue };
        let roots = &state.cells.roots[awake.lag as usize];
        let blades = roots.iter().enumerate().map(|(index, root)| (*root, chain::loaded(values, roots.len(), index, n)));
        found.extend(blades.filter(|(root, blade)| root.length > 0.0 && blade.hold > 0.0));
    }
    found
}

/// How deep the joints of held blades lie in bodies after the last planned step, m, and how far below the ground: the most, of blades whose root is
/// outside.
pub(crate) fn deepest(world: &World, plan: &sward::plan::Plan) -> [f32; 2] {
    let (stand, state, plan) = (&world.model.stands[0], &world.state.stands[0], &plan.stands[0]);
    let chain = stand.chain.as_ref().expect("it moves blade by blade");
    let n = chain.coefficients.segments as usize;
    let (mut inside, mut below) = (0.0_f32, 0.0_f32);
    for patch in &plan.patches {
        let Some(values) = state.cells.blades(patch.lag) else { continue };
        let roots = &state.cells.roots[patch.lag as usize];
        let heads = &plan.solids.heads[patch.solids.clone()];
        let last = heads.iter().map(|solid| solid.moment).max().unwrap_or(0);
        for (index, root) in roots.iter().enumerate().filter(|(_, root)| root.length > 0.0) {
            let blade = chain::loaded(values, roots.len(), index, n);
            if blade.hold < 1.0 {
                continue;
            }
            let base = chain::planted(root.yaw, root.lean);
            let joints = chain::joints(&base, root.curl, &chain.coefficients, &blade.state.bends());
            let scale = root.length / (2.0 * n as f32 * chain.coefficients.half_length);
            let joint = |k: usize| [0, 1, 2].map(|axis| root.at[axis] + scale * joints[k][axis]);
            for k in 1..=n {
                let at = joint(k);
                let ground = root.at[1] + root.slope[0] * (at[0] - root.at[0]) + root.slope[1] * (at[2] - root.at[2]);
                below = below.max(ground - at[1]);
                for solid in heads.iter().filter(|solid| solid.moment == last) {
                    let free = nearness(solid, &plan.solids.planes, root.at, true).distance > 0.0;
                    if free {
                        inside = inside.max(-nearness(solid, &plan.solids.planes, at, false).distance);
                    }
                }
            }
        }
    }
    [inside, below]
}

/// A tip, m from the patch's corner; the hold of its blade; its length, m.
pub(crate) type Tip = ([f32; 3], f32, f32);

/// The tips of the blades of patches with room for states, by patch and number: by their own state, by the virtual blades, and as shown.
pub(crate) fn tips(world: &World) -> BTreeMap<([i32; 2], usize), [Tip; 3]> {
    let (stand, state) = (&world.model.stands[0], &world.state.stands[0]);
    let chain = stand.chain.as_ref().expect("it moves blade by blade");
    let n = chain.coefficients.segments as usize;
    let wind = world.wind(stand);
    let mut found = BTreeMap::new();
    for (patch, awake) in &state.awake {
        let Some(values) = state.cells.blades(awake.lag) else { continue };
        let roots = &state.cells.roots[awake.lag as usize];
        let slots = around(state, *patch, |awake| awake.slot);
        let standing = Standing { chain, around: slots, weights: weights(state, *patch), patch_side: stand.patch_side as f32 };
        let phases = wind.patch_phases(*patch, stand.cells / 2);
        for (index, root) in roots.iter().enumerate().filter(|(_, root)| root.length > 0.0) {
            let blade = chain::loaded(values, roots.len(), index, n);
            let base = chain::planted(root.yaw, root.lean);
            let local = [root.at[0], root.at[2]];
            let moments = standing.moments(&state.cells.now, local, || wind.velocity_local(&phases, local));
            let virtual_ = standing.pose(&base, root.curl, &moments);
            let own = blade.state.bends();
            let shown = chain::mixed(&virtual_, &own, blade.hold);
            let scale = root.length / (2.0 * n as f32 * chain.coefficients.half_length);
            let tip = |bends: &chain::Bends| -> Tip {
                let at = chain::joints(&base, root.curl, &chain.coefficients, bends)[n];
                ([0, 1, 2].map(|axis| root.at[axis] + scale * at[axis]), blade.hold, root.length)
            };
            found.insert((*patch, index), [tip(&own), tip(&virtual_), tip(&shown)]);
        }
    }
    found
}
