//! What goes on of stands when the scene of a world changes.

use super::{Changes, MOVED, NEW, PACED};
use crate::model::StandModel;
use crate::response::chain;
use crate::response::harmonic::LayeredStand;
use crate::scene::Stand;
use crate::state::{LayeredState, NONE, SheetPool, StandState, State};
use crate::world::World;
use crate::world::kept::Fate;

const DIVIDED: &str = "patches are of another size, or the field has others";
const METHOD: &str = "its plants move in another way";

impl World {
    /// Stands of both kinds, in the order of the scene.
    pub(super) fn take_plants(&mut self, before: &Self, old: &mut State, changes: Changes) -> Vec<Fate> {
        let known = same_stands(&before.scene.stands, &self.scene.stands);
        let mut fates: Vec<Fate> = known.iter().map(|known| Fate::Anew(if known.is_some() { METHOD } else { NEW })).collect();
        let mut stands = Vec::new();
        for stand in &self.model.stands {
            let known = known[stand.index].and_then(|was| before.model.stands.iter().position(|other| other.index == was));
            let state = known.and_then(|known| old.stands.get_mut(known)).map(std::mem::take);
            let known = known.map(|known| &before.model.stands[known]).zip(state);
            if let Some((known, state)) = &known {
                fates[stand.index] = self.stand_fate(known, stand, state, changes);
            }
            let known = known.filter(|_| fates[stand.index].is_kept());
            stands.push(known.map_or_else(|| self.empty_stand(stand), |(known, state)| self.taken_stand(known, stand, state, changes)));
        }
        self.state.stands = stands;
        let (mut layered, mut unlike) = (Vec::new(), Vec::new());
        for (number, stand) in self.model.layered.iter().enumerate() {
            let known = known[stand.index].and_then(|was| before.model.layered.iter().position(|other| other.index == was));
            let state = known.and_then(|known| old.layered.get_mut(known)).map(std::mem::take);
            let known = known.map(|known| &before.model.layered[known]).zip(state);
            if let Some((known, state)) = &known {
                fates[stand.index] = self.layered_fate(known, stand, state, changes);
            }
            let known = known.filter(|_| fates[stand.index].is_kept());
            if !known.as_ref().is_some_and(|(known, _)| same_plants(known, stand, changes)) {
                unlike.push(number);
            }
            layered.push(known.map_or_else(|| self.empty_layered(stand), |(_, state)| state));
        }
        self.state.layered = layered;
        self.plant_anew(&unlike);
        fates
    }

    fn stand_fate(&self, known: &StandModel, stand: &StandModel, state: &StandState, changes: Changes) -> Fate {
        let (was, is) = (known.layout(), stand.layout());
        let empty = self.empty_stand(stand);
        let has_room = state
            .awake
            .values()
            .all(|awake| empty.free.contains(&awake.slot) && (awake.lag == NONE || empty.lag_free.contains(&awake.lag)));
        Fate::unless(&[
            (changes.moved, MOVED),
            (changes.paced, PACED),
            (changes.divided, DIVIDED),
            (was.method != is.method, METHOD),
            (was.cells != is.cells, "its cells are of another size"),
            (was.segments != is.segments, "its plants have other segments"),
            (was != is, "its state is stored in another way"),
            (!has_room, "the budget has no room for what is awake"),
            (!was.is_whole(state), "its cells are not here"),
        ])
    }

    /// A stand that goes on: its places are shared out as the new budget has them, and what follows from the ground and from where plants stand is
    /// worked out again where these differ.
    fn taken_stand(&self, known: &StandModel, stand: &StandModel, mut state: StandState, changes: Changes) -> StandState {
        let mut empty = self.empty_stand(stand);
        for awake in state.awake.values() {
            empty.free.remove(&awake.slot);
            empty.lag_free.remove(&awake.lag);
        }
        (state.free, state.lag_free) = (empty.free, empty.lag_free);
        let terrain = &self.model.terrain;
        let same = !changes.ground && known.placement == stand.placement && known.growth == stand.growth;
        let cells = &mut state.cells;
        if !same {
            cells.grown.clear();
            for (patch, awake) in &state.awake {
                if let Some(ground) = cells.ground.get_mut(awake.slot as usize) {
                    *ground = stand.ground_of(terrain, *patch);
                }
            }
        }
        if let Some(chain) = stand.chain.as_ref().filter(|_| !same || known.species != stand.species) {
            for (patch, awake) in state.awake.iter().filter(|(_, awake)| awake.lag != NONE) {
                if let Some(roots) = cells.roots.get_mut(awake.lag as usize) {
                    *roots = chain::roots(terrain, stand, chain, *patch);
                }
            }
        }
        state
    }

    fn layered_fate(&self, known: &LayeredStand, stand: &LayeredStand, state: &LayeredState, changes: Changes) -> Fate {
        let sized = known.harmonic.cell == stand.harmonic.cell && stand.fits(state, self.scene.budget.touched_plants);
        Fate::unless(&[
            (changes.moved, MOVED),
            (changes.paced, PACED),
            (changes.divided, DIVIDED),
            (!sized, "its planes are of another size"),
        ])
    }

    /// Finds and cuts the plants of stands of meshes where they are other ones than before; nobody has touched them yet.
    fn plant_anew(&mut self, stands: &[usize]) {
        let camera = self.camera();
        if self.state.focuses.is_empty() {
            self.look_from(&camera);
        }
        for stand in stands {
            let state = &mut self.state.layered[*stand];
            (state.near, state.cuts) = Default::default();
            (state.since, state.touches) = Default::default();
            state.pool = SheetPool::new(self.scene.budget.touched_plants);
            self.follow_plants(*stand);
            self.cut_plants(*stand, &camera);
        }
    }
}

/// Whether the plants of a stand of meshes are the same ones, cut in the same way.
fn same_plants(known: &LayeredStand, stand: &LayeredStand, changes: Changes) -> bool {
    let box_of = |stand: &LayeredStand| (stand.specimen.low, stand.specimen.high);
    !changes.ground
        && known.placement == stand.placement
        && known.growth == stand.growth
        && known.places == stand.places
        && known.layered.layers == stand.layered.layers
        && box_of(known) == box_of(stand)
}

/// Which stand of a list each one of another list is: by name, else by place.
pub(super) fn same_stands(old: &[Stand], new: &[Stand]) -> Vec<Option<usize>> {
    let names = |stands: &[Stand]| -> Vec<String> { stands.iter().map(Stand::label).collect() };
    let (old, new) = (names(old), names(new));
    let renamed = |index: usize| old.get(index).filter(|name| !new.contains(name)).map(|_| index);
    new.iter().enumerate().map(|(index, name)| old.iter().position(|known| known == name).or_else(|| renamed(index))).collect()
}
