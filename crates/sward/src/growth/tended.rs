//! What was cut, burnt or has grown again while a world runs: a share of each plant, patch by patch. Patches that nobody tended have no map.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::placement::Growing;

/// All of a plant.
pub const WHOLE: u8 = 255;

/// How much of what would grow by itself stands in each cell, 0 to 255, row by row, of patches that were tended.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Tended {
    maps: BTreeMap<[i32; 2], Box<[u8]>>,
    /// Changes so far; 0: never tended.
    changes: u64,
}

impl Tended {
    /// Changes since the world began.
    pub fn changes(&self) -> u64 {
        self.changes
    }

    /// The map of a patch; `None` where everything stands as it would by itself.
    pub fn map(&self, patch: [i32; 2]) -> Option<&[u8]> {
        self.maps.get(&patch).map(|map| &**map)
    }

    /// Patches that have a map, in key order.
    pub fn patches(&self) -> impl Iterator<Item = [i32; 2]> {
        self.maps.keys().copied()
    }

    /// Changes the cells of a patch of `cells` a side: `change` gets the number of a cell and its share, and gives another. Returns whether one differs.
    pub(crate) fn change(&mut self, patch: [i32; 2], cells: u32, mut change: impl FnMut(u32, u8) -> u8) -> bool {
        let area = cells * cells;
        let old = self.maps.get(&patch);
        let new: Box<[u8]> = (0..area).map(|cell| change(cell, old.map_or(WHOLE, |map| map[cell as usize]))).collect();
        let same = match old {
            Some(old) => **old == *new,
            None => new.iter().all(|share| *share == WHOLE),
        };
        if same {
            return false;
        }
        self.changes += 1;
        if new.iter().all(|share| *share == WHOLE) {
            self.maps.remove(&patch);
        } else {
            self.maps.insert(patch, new);
        }
        true
    }

    /// Whether it is one of a stand of `cells` cells a patch side.
    pub(crate) fn fits(&self, cells: u32) -> bool {
        (self.changes > 0 || self.maps.is_empty()) && self.maps.values().all(|map| map.len() == (cells * cells) as usize)
    }
}

/// What is left of a plant of which `share` of 255 are left of what grows there.
pub(super) fn left(growing: Growing, share: u8) -> Growing {
    match (u32::from(growing.share), u32::from(share)) {
        (0, _) | (_, 0) => Growing::default(),
        // At least 1: what grows is not nothing.
        (own, share) => Growing { share: ((own * share + 127) / 255).max(1) as u8, ..growing },
    }
}
