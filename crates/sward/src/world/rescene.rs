//! Another scene in place of a world's own while it runs: what still fits of the state goes on, the rest begins anew.
//!
//! All that can fail comes before anything is changed.

mod plants;

use std::collections::VecDeque;
use std::sync::Arc;

use super::kept::{Fate, Kept};
use super::{Input, World, due};
use crate::model::{Assets, Model, rebased};
use crate::response::harmonic::LayeredStand;
use crate::scene::{Interactor, Scene, SceneError};
use crate::state::{BodyState, State, WindState};
use crate::terrain::Edits;
use crate::wind::fluid::FluidState;
use plants::same_stands;

/// What concerns everything that has a place or a time.
#[derive(Clone, Copy)]
struct Changes {
    /// Positions are counted from another corner.
    moved: bool,
    /// Steps are of another length.
    paced: bool,
    /// Patches are of another size, or the field has others.
    divided: bool,
    /// The ground is another.
    ground: bool,
}

const MOVED: &str = "positions are counted from another origin";
const PACED: &str = "steps are of another length";
const SCATTERED: &str = "all edits together would lie too far apart";
const NEW: &str = "it was not there before";

impl World {
    /// Puts a changed scene in place of the world's own while it runs, between two steps, and keeps what still fits of its state. `scene` is as
    /// its author wrote it: not [`World::scene`], whose positions are counted from the origin patch.
    ///
    /// Time goes on, and so do the edits of the ground from code; those of the scene are as if it had always been this one. A body goes on if it has
    /// the same name; one without a name if nothing of it has changed, or if it has the same place in the list and the same shape. A stand is known by its
    /// name, else by its place in the list. It goes on if its state is stored in the same way: patches, cells, method and segments are the same, and the
    /// budget still has room. A plane of air goes on if it has the same size. What does not go on begins at rest. All of it begins anew
    /// with another origin, and all but bodies and the edited ground with another length of steps. The same scene again changes nothing, to the bit.
    ///
    /// Where a GPU steps, download its cells before, and make a new `GpuStep` of the world afterwards: a stand whose cells are not here begins anew.
    ///
    /// # Errors
    /// What is wrong with the scene or a file it names; the world is as it was, to the bit.
    pub fn rescene(&mut self, scene: Scene, assets: &dyn Assets) -> Result<Kept, SceneError> {
        scene.validate()?;
        let authored = self.log.is_some().then(|| scene.clone());
        let scene = rebased(scene);
        let model = Model::compile(&scene, assets)?;
        authored.into_iter().for_each(|scene| self.note(|| Input::Scene(Box::new(scene))));
        // Nothing fails from here on.
        let mut old = std::mem::take(&mut self.state);
        let texels = Arc::clone(&model.maps.texels);
        let corner = |scene: &Scene| scene.origin.map(|patch| f64::from(patch) * f64::from(scene.field.patch_side));
        let mut changes = Changes {
            moved: corner(&scene) != corner(&self.scene),
            paced: model.rate != self.model.rate,
            divided: model.patch_side != self.model.patch_side
                || model.field != self.model.field
                || scene.budget.beyond != self.scene.budget.beyond,
            ground: false,
        };
        let mut next = Self {
            scene,
            model,
            state: State::default(),
            lanes: self.lanes,
            viewed: self.viewed,
            texels,
            events: VecDeque::new(),
            log: self.log.take(),
        };
        next.take_time(self, &mut old, changes);
        let ground = next.take_ground(self, &mut old, changes);
        changes.ground = !next.model.terrain.is_same(&self.model.terrain);
        let bodies = next.take_bodies(self, &old.bodies, changes);
        let fluids = next.take_fluids(self, &old.fluids, changes);
        let stands = next.take_plants(self, &mut old, changes);
        next.take_reactions(self, &old, changes);
        *self = next;
        Ok(Kept { ground, bodies, stands, fluids })
    }

    /// Time, and what does not depend on the scene.
    fn take_time(&mut self, before: &Self, old: &mut State, changes: Changes) {
        // The same wind blows on as it does.
        let (winds, same) = (WindState::all(&self.scene), before.scene.wind == self.scene.wind && !changes.paced);
        let state = &mut self.state;
        state.winds = if same { std::mem::take(&mut old.winds) } else { winds };
        state.dropped_steps = old.dropped_steps;
        if changes.paced {
            state.step = (old.step as f64 * before.model.dt / self.model.dt).round() as u64;
            state.edited_steps = state.step;
        } else {
            (state.step, state.edited_steps, state.pending_seconds) = (old.step, old.edited_steps, old.pending_seconds);
        }
        if !changes.moved {
            (state.focuses, state.pinned) = (std::mem::take(&mut old.focuses), std::mem::take(&mut old.pinned));
        }
    }

    /// The ground with all edits so far: those of the scene, and those from code.
    fn take_ground(&mut self, before: &Self, old: &mut State, changes: Changes) -> Fate {
        let edited = before.model.terrain.edits();
        let same = before.scene.edits == self.scene.edits && before.model.terrain.is_like(&self.model.terrain);
        if before.scene.edits == self.scene.edits && !changes.moved && !changes.divided {
            self.take_growth(before, old);
        }
        if same && !changes.moved && !changes.paced {
            if !changes.divided {
                self.state.edited = old.edited.union(&old.resampled).copied().collect();
            }
            let put = self.model.terrain.put_edits(edited.clone());
            return Fate::unless(&[(!put, SCATTERED)]);
        }
        self.apply_edits(f64::NEG_INFINITY, self.state.edited_steps as f64 * self.model.dt);
        // Whoever goes on samples all of it again.
        self.state.edited.clear();
        if changes.moved {
            return Fate::Anew(MOVED);
        }
        let usual = before.usual_edits(old.edited_steps);
        let added = self.model.terrain.add_beyond(edited, &usual);
        Fate::unless(&[(!added, SCATTERED)])
    }

    /// What was cut and burnt stays so in stands of the same name and cells, and grows again as it did.
    fn take_growth(&mut self, before: &Self, old: &mut State) {
        for stand in &mut self.model.stands {
            if let Some(known) = before.model.stands.iter().find(|known| known.name == stand.name && known.cells == stand.cells) {
                stand.growth.tended = known.growth.tended.clone();
            }
        }
        for stand in &mut self.model.layered {
            let alike = |known: &&LayeredStand| known.name == stand.name && known.placement.cells == stand.placement.cells;
            if let Some(known) = before.model.layered.iter().find(alike) {
                stand.growth.tended = known.growth.tended.clone();
            }
        }
        self.state.regrowing = std::mem::take(&mut old.regrowing);
    }

    /// What the scene alone has edited after a number of steps.
    fn usual_edits(&self, steps: u64) -> Edits {
        let mut terrain = self.model.terrain.unedited();
        for edit in due(&self.scene, f64::NEG_INFINITY, steps as f64 * self.model.dt) {
            // There was room for all of them.
            let _ = terrain.edit(&edit);
        }
        terrain.edits().clone()
    }

    /// Bodies that are the same ones stay where they are; others are where their path begins to lead them.
    fn take_bodies(&mut self, before: &Self, old: &[BodyState], changes: Changes) -> Vec<Fate> {
        let known = same_bodies(&before.scene.interactors, &self.scene.interactors);
        self.state.bodies = vec![BodyState::default(); known.len()];
        let time = self.time();
        let mut fates = Vec::new();
        for (index, known) in known.into_iter().enumerate() {
            let state = known.and_then(|known| old.get(known)).filter(|_| !changes.moved);
            if let Some(state) = state {
                self.state.bodies[index] = *state;
            }
            if state.is_none() || changes.paced {
                let pose = self.pose(index, time);
                let clock = [time - self.scene.interactors[index].from; 2];
                self.state.bodies[index] = BodyState { pose, before: pose, clock, ..self.state.bodies[index] };
            }
            fates.push(Fate::unless(&[(known.is_none(), NEW), (changes.moved, MOVED)]));
        }
        fates
    }

    /// What bodies felt last, and among which plants they are: of those that go on.
    fn take_reactions(&mut self, before: &Self, old: &State, changes: Changes) {
        if changes.moved || changes.paced || old.reactions.is_empty() {
            return;
        }
        let bodies = same_bodies(&before.scene.interactors, &self.scene.interactors);
        let stands = same_stands(&before.scene.stands, &self.scene.stands);
        let felt = |known: &Option<usize>| known.and_then(|known| old.reactions.get(known)).copied().unwrap_or_default();
        self.state.reactions = bodies.iter().map(felt).collect();
        for (body, known) in bodies.iter().enumerate() {
            for (stand, was) in stands.iter().enumerate() {
                let pair = known.zip(*was).map(|(body, stand)| (body as u32, stand as u32));
                if let Some(among) = pair.and_then(|pair| old.among.get(&pair)) {
                    self.state.among.insert((body as u32, stand as u32), *among);
                }
            }
        }
    }

    /// Air flows on in planes of the same size.
    fn take_fluids(&mut self, before: &Self, old: &[FluidState], changes: Changes) -> Vec<Fate> {
        let mut fates = Vec::new();
        for (index, fluid) in self.model.fluids.iter().enumerate() {
            let known = before.model.fluids.get(index).zip(old.get(index));
            let sized = known.is_some_and(|(own, flow)| {
                (own.model.side, own.model.cell) == (fluid.model.side, fluid.model.cell)
                    && flow.now.len() == own.model.side * own.model.side
            });
            let fate = Fate::unless(&[
                (known.is_none(), NEW),
                (changes.moved, MOVED),
                (changes.paced, PACED),
                (!sized, "its plane is of another size"),
            ]);
            let flow = known.filter(|_| fate.is_kept()).map(|(_, flow)| flow.clone());
            self.state.fluids.push(flow.unwrap_or_else(|| FluidState::still(fluid.model.side)));
            fates.push(fate);
        }
        fates
    }
}

/// Which interactor of a list each one of another list is.
fn same_bodies(old: &[Interactor], new: &[Interactor]) -> Vec<Option<usize>> {
    let mut free = vec![true; old.len()];
    let mut found = vec![None; new.len()];
    let named = |own: &Interactor, other: &Interactor| !own.name.is_empty() && own.name == other.name;
    let nameless = |own: &Interactor, other: &Interactor| own.name.is_empty() && other.name.is_empty();
    let mut match_all = |alike: &dyn Fn(usize, usize) -> bool| {
        for (index, found) in found.iter_mut().enumerate().filter(|(_, found)| found.is_none()) {
            *found = (0..old.len()).find(|known| free[*known] && alike(*known, index));
            found.iter().for_each(|known| free[*known] = false);
        }
    };
    match_all(&|known, index| named(&old[known], &new[index]));
    match_all(&|known, index| nameless(&old[known], &new[index]) && old[known] == new[index]);
    // A body that has got a name, lost it or changed it is the same one too.
    match_all(&|known, index| known == index && old[known].shape == new[index].shape);
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bodies_are_known_by_name_then_as_they_are_then_by_place_and_shape() {
        let text = |bodies: &str| Scene::parse(&format!("(version: 1, interactors: [{bodies}])"), "bodies.ron").unwrap().interactors;
        let old = text("(shape: Truck), (shape: Sphere(radius: 2)), (name: \"a\", shape: Truck), (shape: Sphere(radius: 1))");
        let known = |bodies: &str| same_bodies(&old, &text(bodies));
        assert_eq!(known("(shape: Sphere(radius: 2)), (name: \"a\", shape: Sphere())"), [Some(1), Some(2)]);
        assert_eq!(known("(shape: Truck, clearance: 1), (shape: Sphere(radius: 3))"), [Some(0), None]);
        assert_eq!(known("(name: \"b\", shape: Truck), (name: \"c\", shape: Truck)"), [Some(0), None]);
        assert_eq!(same_bodies(&old, &old), [Some(0), Some(1), Some(2), Some(3)]);
    }
}
