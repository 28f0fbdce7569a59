//! What is cut, burnt and grows again while a world runs.

use crate::growth::{Tended, WHOLE};
use crate::placement;
use crate::scene::{Change, Edit};
use crate::state::{PatchKey, Regrowth, in_field};
use crate::world::World;

/// Steps from one growth of what grows again to the next.
const PACE: u64 = 6;

/// A stand's growth to be changed: what of it stands where.
struct Ground<'a> {
    tended: &'a mut Tended,
    placement: &'a placement::PlacementParameters,
    patch_side: f64,
}

impl Ground<'_> {
    /// Changes the cells whose middles are under a brush: `change` gets the height of a cell's plant \[m\] and its share. Returns the patches that have
    /// changed.
    fn brush(&mut self, edit: &Edit, field: Option<[[i32; 2]; 2]>, change: impl Fn(f32, u8) -> u8) -> Vec<PatchKey> {
        let (radius, spacing) = (f64::from(edit.radius), self.patch_side / f64::from(self.placement.cells));
        let span = |axis: usize| {
            let patch = |metres: f64| (metres / self.patch_side).floor() as i32;
            patch(edit.at[axis] - radius)..=patch(edit.at[axis] + radius)
        };
        let mut changed = Vec::new();
        for patch in span(1).flat_map(|z| span(0).map(move |x| [x, z])).filter(|patch| in_field(field, *patch)) {
            let corner = patch.map(|along| f64::from(along) * self.patch_side);
            let (placement, cells) = (self.placement, self.placement.cells);
            let differs = self.tended.change(patch, cells, |index, share| {
                let cell = [index % cells, index / cells];
                let way = [0, 1].map(|axis: usize| corner[axis] + (f64::from(cell[axis]) + 0.5) * spacing - edit.at[axis]);
                if way[0] * way[0] + way[1] * way[1] > radius * radius {
                    return share;
                }
                let height = placement::plant(placement, patch, cell).map_or(placement.height[1], |plant| plant.height);
                change(height, share)
            });
            if differs {
                changed.push(patch);
            }
        }
        changed
    }
}

impl World {
    /// Cuts, burns, or lets grow again what grows under a brush. Plants follow in the next step, pictures at once.
    pub(in crate::world) fn tend(&mut self, edit: &Edit) {
        match &edit.change {
            Change::Cut(cut) => {
                // To the nearest 255th, but never to nothing.
                let least = u32::from(cut.height > 0.0);
                let left = |height: f32| ((cut.height / height * 255.0 + 0.5) as u32).clamp(least, 255) as u8;
                self.stroke(edit, |height, share| share.min(left(height)));
            }
            Change::Burn => self.stroke(edit, |_, _| 0),
            Change::Regrow(regrow) => {
                let ticks = (f64::from(regrow.over) / self.model.dt / PACE as f64).ceil() as u64;
                if ticks == 0 {
                    self.stroke(edit, |_, _| WHOLE);
                } else {
                    self.state.regrowing.push(Regrowth { at: edit.at, radius: edit.radius, stands: edit.stands.clone(), ticks });
                }
            }
            Change::Raise(_) | Change::Flatten(_) => (),
        }
    }

    fn stroke(&mut self, edit: &Edit, change: impl Fn(f32, u8) -> u8) {
        let (field, patch_side) = (self.model.field, self.model.patch_side);
        let named = |name: &String, usual: bool| if edit.stands.is_empty() { usual } else { edit.stands.contains(name) };
        let grass = self.model.stands.iter_mut().filter(|stand| named(&stand.name, true));
        let grass = grass.map(|stand| Ground { tended: &mut stand.growth.tended, placement: &stand.placement, patch_side });
        let meshes = self.model.layered.iter_mut().filter(|stand| named(&stand.name, false));
        let meshes = meshes.map(|stand| Ground { tended: &mut stand.growth.tended, placement: &stand.placement, patch_side });
        for mut ground in grass.chain(meshes) {
            self.state.edited.extend(ground.brush(edit, field, &change));
        }
    }

    /// Lets grow what grows again, before a step is planned.
    pub(in crate::world) fn regrow(&mut self) {
        // Those of the scene and from code alike.
        if self.state.regrowing.is_empty() || !self.state.step.is_multiple_of(PACE) {
            return;
        }
        for mut regrowth in std::mem::take(&mut self.state.regrowing) {
            let edit = Edit { at: regrowth.at, radius: regrowth.radius, stands: std::mem::take(&mut regrowth.stands), ..Edit::default() };
            // Each time an equal part of what is missing then: all of it the last time.
            let left = regrowth.ticks.max(1) as u32;
            self.stroke(&edit, |_, share| share + u32::from(WHOLE - share).div_ceil(left) as u8);
            if left > 1 {
                self.state.regrowing.push(Regrowth { stands: edit.stands, ticks: regrowth.ticks - 1, ..regrowth });
            }
        }
    }
}
