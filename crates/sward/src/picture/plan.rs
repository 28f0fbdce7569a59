//! Which patches are drawn, with how many plants.
//!
//! Memory depends on `budget.visible_plants`, never on the field: patches are drawn in an even order that may be cut anywhere.

use bytemuck::{Pod, Zeroable};

use super::plants::PLANTS_PER_INSTANCE;
use crate::plan::{around, weights};
use crate::response::StandModel;
use crate::shading::look::Look;
use crate::state::{NONE, PatchKey, StandState, in_field};
use crate::terrain::TerrainAnchor;
use crate::view::View;
use crate::world::World;

/// Every plant is drawn up to this many cells away; then fewer and wider ones.
pub(super) const FULL_CELLS: f32 = 104.0;
/// How fast they grow fewer with distance.
pub const THINNING: f32 = 1.25;

/// `PatchDraw` of `prepare.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct PatchDraw {
    /// Patch corner, m from the frame origin.
    pub offset: [f32; 2],
    /// Which patch.
    pub patch: [i32; 2],
    /// Its corner among the terrain's samples.
    pub anchor: TerrainAnchor,
    /// How far cells rule over β_eq at the corners (−−, +−, −+, ++).
    pub weights: [f32; 4],
    /// Slots of the 3×3 patches around it, or none.
    pub slots: [u32; 9],
    /// Lag slots likewise.
    pub lags: [u32; 9],
    /// First plant of this patch in the output.
    pub first: u32,
    /// Places of the drawing order it may fill.
    pub count: u32,
    /// Where its growth map is stored, or none: on a GPU a square of cells of a texture.
    pub growth: u32,
    /// Keeps the size a multiple of 16 bytes.
    pub unused: [u32; 3],
}

/// The patches of one batch: same stand, same number of drawn segments.
#[derive(Clone, Debug, Default)]
pub struct BatchPlan {
    /// Near to far.
    pub draws: Vec<PatchDraw>,
    /// Plants in all.
    pub plants: u32,
}

/// From where, and which moment, a picture shows.
#[derive(Clone, Copy, Debug)]
pub struct Seen<'a> {
    /// The camera.
    pub view: &'a View,
    /// The patch at whose corner frame space begins.
    pub origin: PatchKey,
    /// Share of plants that [`plan`] decided to draw.
    pub fullness: f64,
    /// Share, above 0 to 1, of the distance up to which every plant is drawn: small pictures need fewer far away.
    pub near: f64,
    /// Steps, 0 to 1, that the picture lies before the state.
    pub behind: f64,
}

impl Seen<'_> {
    /// The eye, m in frame space, where patches have this side \[m\].
    pub(super) fn eye(&self, side: f64) -> [f32; 3] {
        let [x, y, z] = self.view.eye;
        [(x - f64::from(self.origin[0]) * side) as f32, y as f32, (z - f64::from(self.origin[1]) * side) as f32]
    }
}

/// A patch in sight.
pub(super) struct Sighted {
    pub(super) patch: PatchKey,
    /// Distance from the eye to the nearest point of it on the ground, m.
    pub(super) distance: f64,
}

pub(super) fn sighted(world: &World, view: &View, gone: f64) -> Vec<Sighted> {
    let side = world.model.patch_side;
    let home = view.focus().map(|metres| (metres / side).floor() as i32);
    let reach = (gone / side).ceil() as i32 + 1;
    let mut list = Vec::new();
    for z in -reach..=reach {
        for x in -reach..=reach {
            let patch = [home[0].saturating_add(x), home[1].saturating_add(z)];
            let outside = |axis: usize| {
                let low = f64::from(patch[axis]) * side;
                (low - view.focus()[axis]).max(view.focus()[axis] - low - side).max(0.0)
            };
            let distance = outside(0).hypot(outside(1));
            if distance < gone && in_field(world.model.field, patch) && view.sees(patch, side) {
                list.push(Sighted { patch, distance });
            }
        }
    }
    list.sort_by(|a, b| a.distance.total_cmp(&b.distance).then(a.patch.cmp(&b.patch)));
    list
}

/// Share of plants drawn at a distance, m, where all are up to `full`: the CPU side of `thin` in `prepare.wgsl`.
fn thin(distance: f64, fullness: f64, full: f64) -> f64 {
    (full / distance.max(1e-3)).powf(f64::from(THINNING)).min(1.0) * fullness
}

/// The drawing order of a patch covers 2^bits cells a side.
pub(super) fn bits(cells: u32) -> u32 {
    cells.next_power_of_two().trailing_zeros()
}

/// Places a patch needs, a whole number of instances.
fn places(distance: f64, fullness: f64, near: f64, stand: &StandModel) -> u32 {
    let all = 1_u32 << (2 * bits(stand.cells));
    ((thin(distance, fullness, near * f64::from(FULL_CELLS) * stand.spacing) * f64::from(all)).ceil() as u32)
        .min(all)
        .next_multiple_of(PLANTS_PER_INSTANCE)
}

/// Plants that each stand of billboards or sheets may show.
pub fn share(world: &World) -> u32 {
    let billboards = world.model.stands.iter().filter(|stand| stand.species.blade.is_none()).count();
    world.scene.budget.visible_plants / (billboards.max(1) as u32)
}

/// Decides what of a stand is drawn: plants of all their segments or pieces, and beyond `plain_distance` plain ones. `share` of the plant budget is this
/// stand's. Nothing of a stand of blades.
pub fn plan(world: &World, index: usize, seen: &Seen, look: &Look, share: u32) -> ([BatchPlan; 2], f64) {
    let (stand, state) = (&world.model.stands[index], &world.state.stands[index]);
    if stand.species.blade.is_some() {
        return Default::default();
    }
    let list = sighted(world, seen.view, f64::from(look.fade[1]));
    let wanted = |fullness: f64| list.iter().map(|patch| u64::from(places(patch.distance, fullness, seen.near, stand))).sum::<u64>();
    let mut fullness = 1.0;
    while wanted(fullness) > u64::from(share) && fullness > 1e-3 {
        fullness *= 0.9;
    }
    let plain = f64::from(stand.species.plain_distance());
    let mut batches = [BatchPlan::default(), BatchPlan::default()];
    for patch in &list {
        let far = usize::from(patch.distance > plain || stand.species.pieces() == 1);
        let batch = &mut batches[far];
        let count = places(patch.distance, fullness, seen.near, stand);
        if u64::from(batch.plants) + u64::from(count) > u64::from(share) {
            break;
        }
        batch.draws.push(draw(world, state, patch.patch, seen.origin, batch.plants, count));
        batch.plants += count;
    }
    (batches, fullness)
}

/// The places of a batch, in a world of another moment: the same patches, numbers and order, on the same ground, with that moment's cells.
pub fn plan_then(then: &World, index: usize, origin: PatchKey, now: &BatchPlan) -> BatchPlan {
    let draws = now.draws.iter().map(|now| PatchDraw {
        anchor: now.anchor,
        growth: now.growth,
        ..draw(then, &then.state.stands[index], now.patch, origin, now.first, now.count)
    });
    BatchPlan { draws: draws.collect(), plants: now.plants }
}

pub(super) fn draw(world: &World, state: &StandState, patch: PatchKey, origin: PatchKey, first: u32, count: u32) -> PatchDraw {
    let side = world.model.patch_side;
    PatchDraw {
        offset: [0, 1].map(|axis| (f64::from(patch[axis].wrapping_sub(origin[axis])) * side) as f32),
        patch,
        anchor: world.model.terrain.anchor(patch.map(|p| f64::from(p) * side)),
        weights: weights(state, patch),
        slots: around(state, patch, |awake| awake.slot),
        lags: around(state, patch, |awake| awake.lag),
        first,
        count,
        growth: NONE,
        unused: [0; 3],
    }
}
