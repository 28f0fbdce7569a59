//! Which billboards have a sheet of their own: see [`crate::response::springs::pool`] for the rule.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use super::{NONE, PatchKey, StandState};

/// A billboard: its patch, and the number of its cell there.
pub type Billboard = (PatchKey, u32);

/// The sheets of a stand.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Sheets {
    /// Who has which place.
    pub pool: SheetPool,
    /// Steps since a body was last near whoever has each place.
    pub since: Vec<u32>,
}

impl StandState {
    /// Writes down for each cell of some awake patches where its sheet is: what pictures look up. `area` is a patch's cells.
    pub fn lay_places(&mut self, patches: impl IntoIterator<Item = PatchKey>, area: usize) {
        let now = &mut self.cells.now;
        for patch in patches {
            let Some(slot) = self.awake.get(&patch).map(|awake| awake.slot as usize) else { continue };
            if now.len() <= slot {
                now.resize(slot + 1, Box::default());
            }
            let mut places = vec![f32::from_bits(NONE); area];
            for ((_, cell), place) in self.sheets.pool.taken_in(patch) {
                if let Some(value) = places.get_mut(cell as usize) {
                    *value = f32::from_bits(place);
                }
            }
            now[slot] = places.into();
        }
    }
}

/// Places for sheets, and who has them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SheetPool {
    /// Places there are.
    capacity: u32,
    /// Who has which.
    taken: BTreeMap<Billboard, u32>,
    /// Places that nobody has, of those ever used.
    free: BTreeSet<u32>,
    /// Places ever used: those from here on are free too.
    used: u32,
    /// Sheets that had to make room before they had recovered.
    pub evicted: u64,
    /// Contacts that got none.
    pub refused: u64,
}

impl SheetPool {
    /// A pool of a number of places.
    pub fn new(capacity: u32) -> Self {
        Self { capacity, ..Self::default() }
    }

    /// The place of a billboard's sheet.
    pub fn place(&self, billboard: Billboard) -> Option<u32> {
        self.taken.get(&billboard).copied()
    }

    /// Who has a sheet, and where, in order.
    pub fn taken(&self) -> impl Iterator<Item = (Billboard, u32)> {
        self.taken.iter().map(|(billboard, place)| (*billboard, *place))
    }

    /// Who has a sheet in one patch, and where, in order.
    pub fn taken_in(&self, patch: PatchKey) -> impl Iterator<Item = (Billboard, u32)> {
        self.taken.range((patch, 0)..=(patch, u32::MAX)).map(|(billboard, place)| (*billboard, *place))
    }

    /// A billboard has recovered: its place is free.
    pub fn release(&mut self, billboard: Billboard) {
        self.free.extend(self.taken.remove(&billboard));
    }

    /// Gives places to billboards that something touches: each with its distance from the nearest focus, m. `steps` tells of a place how many
    /// steps ago its sheet was last touched, 0 in contact. Returns who got one, and where; whoever had one keeps it.
    pub fn request(&mut self, contacts: &[(Billboard, f32)], steps: impl Fn(u32) -> u32) -> Vec<(Billboard, u32)> {
        let mut wanted: Vec<(Billboard, f32)> = contacts.iter().filter(|(who, _)| !self.taken.contains_key(who)).copied().collect();
        wanted.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
        wanted.dedup_by_key(|(who, _)| *who);
        // Who gives way, the last of these first.
        let touched: BTreeSet<Billboard> = contacts.iter().map(|(who, _)| *who).collect();
        let mut leaving: Vec<(u32, Billboard)> = self
            .taken()
            .filter(|(who, _)| !touched.contains(who))
            .map(|(who, place)| (steps(place), who))
            .filter(|(steps, _)| *steps > 0)
            .collect();
        leaving.sort_by(|a, b| a.0.cmp(&b.0).then(b.1.cmp(&a.1)));
        let mut given = Vec::new();
        for (who, _) in wanted {
            if self.taken.contains_key(&who) {
                continue;
            }
            let Some(place) = self.next(&mut leaving) else {
                self.refused += 1;
                continue;
            };
            self.taken.insert(who, place);
            given.push((who, place));
        }
        given
    }

    /// A free place, or one that is made free.
    fn next(&mut self, leaving: &mut Vec<(u32, Billboard)>) -> Option<u32> {
        if let Some(place) = self.free.pop_first() {
            return Some(place);
        }
        if self.used < self.capacity {
            self.used += 1;
            return Some(self.used - 1);
        }
        let (_, who) = leaving.pop()?;
        self.evicted += 1;
        self.taken.remove(&who)
    }

    /// Places ever used: all that are taken lie below.
    pub fn used(&self) -> u32 {
        self.used
    }

    /// Whether no billboard has a sheet.
    pub fn is_empty(&self) -> bool {
        self.taken.is_empty()
    }

    /// Whether it is one of `capacity` places that could have come about: each place taken or free, and once.
    pub fn is_sound(&self, capacity: u32) -> bool {
        let places: BTreeSet<u32> = self.taken.values().chain(&self.free).copied().collect();
        let counted = self.taken.len() + self.free.len() == places.len() && places.len() == self.used as usize;
        self.capacity == capacity && self.used <= capacity && counted && places.iter().all(|place| *place < self.used)
    }
}
