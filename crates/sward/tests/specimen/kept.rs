//! Specimens that are kept: found again, and never trusted blindly.

use std::cell::RefCell;
use std::collections::BTreeMap;

use sward::specimen::grow::{Form, Grow};
use sward::specimen::{Order, Rule, Size, Specimen};
use sward::store::{Found, Store};

use crate::{Test, bits};

pub(crate) const TESTS: &[Test] = &[
    ("a_specimen_is_found_again", a_specimen_is_found_again),
    ("damaged_specimens_are_made_anew", damaged_specimens_are_made_anew),
    ("other_orders_are_other_specimens", other_orders_are_other_specimens),
    ("neighbouring_files_count", neighbouring_files_count),
    ("a_store_that_fails_is_told_of", a_store_that_fails_is_told_of),
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

impl Memory {
    /// Changes what is kept.
    fn spoil(&self, change: impl Fn(&mut Vec<u8>)) {
        self.0.borrow_mut().values_mut().for_each(change);
    }
}

fn file() -> Vec<u8> {
    let mut bytes = Vec::new();
    let plant = Grow { triangles: 2000, ..Grow::new(Form::Tree) };
    plant.mesh().expect("in range").write(&mut bytes).expect("in memory");
    bytes
}

fn stored(bytes: &[u8], order: &Order, store: &dyn Store) -> (Specimen, Found) {
    Specimen::stored(bytes, &|_| Err(String::new()), order, store, &mut |_| ()).expect("a plant")
}

fn a_specimen_is_found_again() {
    let (memory, file) = (Memory::default(), file());
    let (made, first) = stored(&file, &Order::default(), &memory);
    let (kept, second) = stored(&file, &Order::default(), &memory);
    assert_eq!((first, second), (Found::default(), Found { stored: true, ..Found::default() }));
    assert!(bits(&made) == bits(&kept) && made == kept);
    let names: Vec<String> = memory.0.borrow().keys().cloned().collect();
    assert!(names.len() == 1 && names[0].ends_with(".plant") && names[0].len() == 38, "{names:?}");
}

fn damaged_specimens_are_made_anew() {
    let (memory, file) = (Memory::default(), file());
    let (made, _) = stored(&file, &Order::default(), &memory);
    let whole = memory.0.borrow().values().next().cloned().expect("one");
    let again = |words: &str| {
        let (anew, found) = stored(&file, &Order::default(), &memory);
        assert!(anew == made && !found.stored && found.trouble.len() == 1 && found.trouble[0].contains(words), "{:?}", found.trouble);
        assert_eq!(memory.0.borrow().values().next(), Some(&whole), "the store is put right");
    };
    for k in 0..60 {
        let at = k * (whole.len() - 1) / 59;
        memory.spoil(|bytes| bytes[at] ^= 1 << (k % 8));
        again("");
    }
    for (length, words) in
        [(0, "no plant"), (5, "no plant"), (12, "damaged"), (40, "damaged"), (whole.len() / 2, "damaged"), (whole.len() - 1, "damaged")]
    {
        memory.spoil(|bytes| bytes.truncate(length));
        again(words);
    }
    memory.spoil(|bytes| bytes.push(0));
    again("damaged");
    memory.spoil(|bytes| bytes[10] = 77);
    again("format version");
    memory.spoil(|bytes| *bytes = b"SWARDLIGHT and something else".to_vec());
    again("no plant");
    // A whole one, of another order.
    let other = Memory::default();
    stored(&file, &Order { size: Size::Scale(0.5), ..Order::default() }, &other);
    let foreign = other.0.borrow().values().next().cloned().expect("one");
    memory.spoil(|bytes| bytes.clone_from(&foreign));
    again("another plant");
    assert!(stored(&file, &Order::default(), &memory).1.stored, "control: unharmed it is taken");
}

fn other_orders_are_other_specimens() {
    let (memory, bytes) = (Memory::default(), file());
    let rule = |leaves: &[&str], wood: &[&str]| Rule {
        leaves: leaves.iter().map(|name| (*name).to_owned()).collect(),
        wood: wood.iter().map(|name| (*name).to_owned()).collect(),
    };
    let orders = [
        Order::default(),
        Order { size: Size::Scale(2.0), ..Order::default() },
        Order { size: Size::Height(2.0), ..Order::default() },
        Order { rule: rule(&["bark"], &[]), ..Order::default() },
        Order { rule: rule(&[], &["bark"]), ..Order::default() },
        Order { rule: rule(&[], &["leaves", "bark"]), ..Order::default() },
    ];
    for order in &orders {
        assert!(!stored(&bytes, order, &memory).1.stored, "{order:?}");
    }
    let mut other = bytes.clone();
    // The last triangle turned round.
    let end = other.len();
    other[end - 8..].rotate_left(4);
    assert!(!stored(&other, &Order::default(), &memory).1.stored);
    assert_eq!(memory.0.borrow().len(), orders.len() + 1);
    assert!(orders.iter().all(|order| stored(&bytes, order, &memory).1.stored), "control");
}

fn neighbouring_files_count() {
    let text = r#"{"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri": "leaf.bin"}]}"#;
    let memory = Memory::default();
    let read = |x: f32| {
        let beside: Vec<u8> = [0.0, 0.0, 0.0, x, 0.0, 0.0, 0.0, 1.0, 0.0].iter().flat_map(|part: &f32| part.to_le_bytes()).collect();
        let neighbour = |name: &str| if name == "leaf.bin" { Ok(beside.clone()) } else { Err("nothing else".to_owned()) };
        Specimen::stored(text.as_bytes(), &neighbour, &Order::default(), &memory, &mut |_| ()).expect("a leaf")
    };
    assert!(!read(1.0).1.stored && !read(2.0).1.stored && read(2.0).1.stored);
    assert_eq!(read(2.0).0.high[0], 2.0);
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

fn a_store_that_fails_is_told_of() {
    let (plant, found) = stored(&file(), &Order::default(), &Broken);
    assert_eq!(found, Found { stored: false, trouble: vec!["cannot be read".to_owned(), "cannot be written".to_owned()] });
    assert_eq!(plant, stored(&file(), &Order::default(), &Memory::default()).0);
}
