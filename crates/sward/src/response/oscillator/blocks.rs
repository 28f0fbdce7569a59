//! Which cells bodies can reach in a step: squares of cells, so that neither passes nor pictures visit the others.

use std::collections::BTreeMap;

use crate::plan::{ContactPair, StandPlan};

/// Cells along a block's side: those of a workgroup.
pub const BLOCK: u32 = 8;

/// A square of cells that footprints overlap.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Block {
    /// Index of its patch in the plan.
    pub patch: u32,
    /// Its first cell.
    pub corner: [u32; 2],
    /// First of its pairs in [`Blocks::pairs`].
    pub first: u32,
    /// Number of them.
    pub count: u32,
}

/// All of a step, patch by patch, row by row.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Blocks {
    /// The squares.
    pub blocks: Vec<Block>,
    /// Footprints of each, in body order.
    pub pairs: Vec<ContactPair>,
}

impl Blocks {
    /// Those of a plan for patches of `cells`² cells.
    pub fn of(plan: &StandPlan, cells: u32) -> Self {
        let mut all = Self::default();
        let last = (cells / BLOCK) as i32 - 1;
        for (index, patch) in plan.patches.iter().enumerate() {
            let mut found: BTreeMap<[i32; 2], Vec<ContactPair>> = BTreeMap::new();
            for pair in &plan.pairs[patch.pairs.clone()] {
                let size = plan.contacts[pair.contact as usize].size;
                let span = |axis: usize| {
                    let (low, high) = (pair.corner[axis], pair.corner[axis].saturating_add(size[axis] - 1));
                    low.div_euclid(BLOCK as i32).clamp(0, last + 1)..high.div_euclid(BLOCK as i32).clamp(-1, last) + 1
                };
                let (columns, rows) = (span(0), span(1));
                for row in rows {
                    columns.clone().for_each(|column| found.entry([row, column]).or_default().push(*pair));
                }
            }
            for ([row, column], pairs) in found {
                let corner = [column as u32 * BLOCK, row as u32 * BLOCK];
                let (first, count) = (all.pairs.len() as u32, pairs.len() as u32);
                all.blocks.push(Block { patch: index as u32, corner, first, count });
                all.pairs.extend(pairs);
            }
        }
        all
    }
}
