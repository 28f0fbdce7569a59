//! Saved states: what a damaged one makes of a world.

use sward::model::NoAssets;
use sward::scene::{Change, Edit, Raise, Scene};
use sward::world::World;

use crate::chance::Chance;
use crate::glue::stepped;
use crate::{bytes, run};

/// Bytes before the payload: the format's name, its version, a checksum.
const HEADER: usize = 18;

fn world(lag: &str, wind: &str, more: &str) -> World {
    let text = format!(
        "(version: 1, field: (patch_side: 8), stands: [(species: Meadow, cells: 8{lag}), (species: Lawn, cells: 8)], wind: [{wind}],
         interactors: [(shape: Sphere(radius: 0.6), path: Circle(radius: 4, speed: 3)), (shape: Truck, path: Driven())],
         budget: (patches: 9, focus_distance: 8, beyond: Tiled){more})"
    );
    let mut world = World::new(Scene::parse(&text, "small.ron").expect("a scene"), &NoAssets).expect("a world");
    world.drive(1, [2.0, 1.0], 0.5, 0.0);
    (0..5).for_each(|_| world.step());
    world
}

/// Ground that the scene edits before and after the state is saved, and code just before.
fn edited() -> World {
    let edits = ", detail: (amplitude: 0.2), edits: [(at: (2, 1), radius: 2, change: Raise(height: 0.4)), (time: 0.04, at: (1, 0), change: Flatten()),
        (time: 0.1, at: (3, 3), change: Raise(height: -0.3))]";
    let mut world = world("", "Uniform()", edits);
    world.edit(&Edit { at: [-2.0, 1.0], radius: 1.5, change: Change::Raise(Raise { height: 0.5 }), ..Edit::default() }).expect("near");
    world
}

fn harmed(states: &[Vec<u8>], chance: &mut Chance) -> Vec<u8> {
    let mut state = chance.pick(states).clone();
    if chance.one_in(8) {
        bytes::mutate(&mut state, states, chance);
        return state;
    }
    let mut payload = state.split_off(HEADER);
    let others: Vec<Vec<u8>> = states.iter().map(|state| state[HEADER..].to_vec()).collect();
    if chance.one_in(2) {
        // Numbers of bodies and patches lie at the front; most of the rest are cells.
        let mut front: Vec<u8> = payload.drain(..payload.len().min(700)).collect();
        bytes::mutate(&mut front, &others, chance);
        front.extend(payload);
        payload = front;
    } else {
        bytes::mutate(&mut payload, &others, chance);
    }
    state[14..].copy_from_slice(&crc32fast::hash(&payload).to_le_bytes());
    state.extend(payload);
    state
}

#[test]
fn saved_states_never_panic() {
    let worlds = [world("", "Natural()", ""), world(", response: Continuum(lag: History)", "", ""), world("", "Uniform()", ""), edited()];
    let states: Vec<Vec<u8>> = worlds.iter().map(World::save).collect();
    for (world, state) in worlds.iter().zip(&states) {
        assert_eq!(world.clone().restore(state), Ok(()), "control: unharmed states are taken");
    }
    let tally = run("saved states", 0.10, |chance| {
        let mut world = chance.pick(&worlds).clone();
        let before = world.hash();
        let taken = world.restore(&harmed(&states, chance)).is_ok();
        if taken {
            stepped(&mut world)
        } else {
            assert_eq!(world.hash(), before, "a refused state changes nothing")
        }
        taken
    });
    tally.is_mixed(0.005);
}
