//! Volumes that are kept: found again, and never trusted blindly.

use std::cell::RefCell;
use std::collections::BTreeMap;

use sward::picture::volume::{Found, Lighting, Store};
use sward::shading::volume::Volume;
use sward::world::World;

use crate::Test;
use crate::scenes::{small, white, world};

pub(crate) const TESTS: &[Test] = &[
    ("a_volume_is_found_again", again),
    ("a_damaged_volume_is_made_anew", damaged),
    ("another_scenes_volume_is_not_taken", stolen),
    ("a_store_that_fails_is_told_of", failing),
];

/// A store in memory.
#[derive(Default)]
struct Memory(RefCell<BTreeMap<String, Vec<u8>>>);

impl Store for Memory {
    fn load(&self, name: &str) -> Result<Option<Vec<u8>>, String> {
        Ok(self.0.borrow().get(name).cloned())
    }

    fn save(&self, name: &str, bytes: &[u8]) -> Result<(), String> {
        self.0.borrow_mut().insert(name.to_owned(), bytes.to_vec());
        Ok(())
    }
}

struct Broken;

impl Store for Broken {
    fn load(&self, _: &str) -> Result<Option<Vec<u8>>, String> {
        Err("cannot be read".to_owned())
    }

    fn save(&self, _: &str, _: &[u8]) -> Result<(), String> {
        Err("cannot be written".to_owned())
    }
}

fn meadow() -> World {
    let volume = sward::scene::LightVolume { reach: 3.0, layers: 4, samples: 32, ..small() };
    world("stands: [(species: Meadow)]", white(), volume)
}

fn light(world: &World, store: &dyn Store) -> (Volume, Found) {
    let (lighting, found) = Lighting::stored(world, store, &mut |_| ()).expect("a volume");
    (lighting.volume, found)
}

fn again() {
    let (memory, meadow) = (Memory::default(), meadow());
    let (made, first) = light(&meadow, &memory);
    let (kept, second) = light(&meadow, &memory);
    assert!(made == kept, "what comes back is what was made");
    assert!(!first.stored && second.stored && second.trouble.is_empty(), "{first:?} {second:?}");
    // Another scene is another file.
    let mut other = meadow.clone();
    other.model.stands[0].placement.seed ^= 1;
    assert!(!light(&other, &memory).1.stored);
    assert_eq!(memory.0.borrow().len(), 2);
}

/// Every byte counts, and so does every length.
fn damaged() {
    let (memory, meadow) = (Memory::default(), meadow());
    let (made, _) = light(&meadow, &memory);
    let (name, good) = memory.0.borrow().first_key_value().map(|(name, bytes)| (name.clone(), bytes.clone())).expect("kept");
    let mut bad: Vec<Vec<u8>> = [0, 9, 10, 14, 20, 30, 34, 41, 42, good.len() / 2, good.len() - 1]
        .map(|at| {
            let mut bytes = good.clone();
            bytes[at] ^= 0x10;
            bytes
        })
        .into();
    bad.extend([0, 1, 10, 13, 42, 57, 58, 200, good.len() - 1].map(|length| good[..length].to_vec()));
    bad.push([&good[..], &[0]].concat());
    bad.push(vec![0xff; good.len()]);
    for (case, bytes) in bad.into_iter().enumerate() {
        memory.0.borrow_mut().insert(name.clone(), bytes);
        let (anew, found) = light(&meadow, &memory);
        assert!(!found.stored && found.trouble.len() == 1, "case {case}: {found:?}");
        assert!(anew == made, "case {case}: made anew");
        assert!(memory.0.borrow()[&name] == good, "case {case}: the file is whole again");
    }
    assert!(light(&meadow, &memory).1.stored, "control: the good one is taken");
}

/// A good file under a wrong name.
fn stolen() {
    let (memory, meadow) = (Memory::default(), meadow());
    light(&meadow, &memory);
    let mut other = meadow.clone();
    other.model.stands[0].placement.cover = 0.3;
    light(&other, &memory);
    let files: Vec<Vec<u8>> = memory.0.borrow().values().cloned().collect();
    memory.0.borrow_mut().values_mut().zip(files.iter().rev()).for_each(|(file, other)| file.clone_from(other));
    let found = light(&meadow, &memory).1;
    assert!(!found.stored && found.trouble[0].contains("another scene"), "{found:?}");
}

fn failing() {
    let found = light(&meadow(), &Broken).1;
    assert_eq!(found.trouble, ["cannot be read", "cannot be written"]);
}
