//! Which billboards have a sheet: only those that something touches or that still recover.
//!
//! Orthmann et al. 2009, §5.1 and §7 (60 000 billboards in 12 MB); methods §4. A sheet takes [`words`] words of 32 bits; whoever is
//! touched gets the lowest free place. Where none is free, the sheet nearest to having recovered makes room (of equal ones the lowest billboard); where none
//! recovers, the new contacts farthest from the focus are refused, and counted. Differs from the paper: billboards, not nodes of a tree.

use std::collections::{BTreeMap, BTreeSet};

use super::sheet::{MOST_VERTICES, Sheet, SheetRoot, SpringsCoefficients};
use super::step::HeldSheet;
use crate::state::PatchKey;

/// A billboard: its patch, and its number there.
pub type Billboard = (PatchKey, u32);

/// Words of a stored sheet: three for each vertex above the roots, one for four ways out, one for the steps since the last contact.
pub fn words(co: &SpringsCoefficients) -> usize {
    let (columns, rows) = co.sides();
    let vertices = columns * (rows - 1);
    3 * vertices + vertices.div_ceil(4) + 1
}

/// Bytes of a number of billboards, `sheets` of which have a sheet: roots, an index each, sheets.
pub fn bytes(co: &SpringsCoefficients, billboards: u64, sheets: u64) -> u64 {
    billboards * (size_of::<SheetRoot>() as u64 + 4) + sheets * 4 * words(co) as u64
}

/// Sheets that fit in `budget` bytes beside what all billboards take; no more than there are billboards.
pub fn sheets_within(co: &SpringsCoefficients, billboards: u64, budget: u64) -> u64 {
    (budget.saturating_sub(bytes(co, billboards, 0)) / (4 * words(co) as u64)).min(billboards)
}

/// Writes a sheet to its words; what does not fit is left out.
pub fn store(co: &SpringsCoefficients, held: &HeldSheet, to: &mut [u32]) {
    let (columns, rows) = co.sides();
    let vertices = columns..columns * rows;
    let points = held.stored.at[vertices.clone()].iter().flatten().map(|part| part.to_bits());
    let byte = |quad: &[u8], k: usize| u32::from(quad.get(k).copied().unwrap_or(0)) << (8 * k);
    let faces = held.faces[vertices].chunks(4).map(|quad| (0..4).fold(0, |word, k| word | byte(quad, k)));
    to.iter_mut().zip(points.chain(faces).chain([held.steps])).for_each(|(to, from)| *to = from);
}

/// Reads a sheet from its words; missing ones are 0.
pub fn load(co: &SpringsCoefficients, root: &SheetRoot, from: &[u32]) -> HeldSheet {
    let (columns, rows) = co.sides();
    let word = |k: usize| from.get(k).copied().unwrap_or(0);
    let count = columns * (rows - 1);
    let mut held = HeldSheet { stored: Sheet { at: [[0.0; 3]; MOST_VERTICES] }, steps: 0, faces: [0; MOST_VERTICES] };
    for column in 0..columns {
        held.stored.at[column] = root.foot(co, column);
    }
    for k in 0..count {
        held.stored.at[columns + k] = [0, 1, 2].map(|axis| f32::from_bits(word(3 * k + axis)));
        held.faces[columns + k] = (word(3 * count + k / 4) >> (8 * (k % 4))) as u8;
    }
    held.steps = word(3 * count + count.div_ceil(4));
    held
}

/// Places for sheets, and who has them.
#[derive(Clone, Debug, Default, PartialEq)]
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
}
