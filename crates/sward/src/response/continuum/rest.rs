//! β_eq over a patch: the bend at which a plant stands in the wind of the moment.
//!
//! methods §1.7. Wind is sampled on nodes two cells apart, one node beyond each border, so that halos of sleeping neighbours are the same
//! numbers their own cells would have. Twin: `rest.wgsl`.

use crate::wind::{WindField, equilibrium};

/// Cells between two wind nodes.
pub const NODE_CELLS: u32 = 2;

/// β_eq of one patch.
#[derive(Clone, Debug, PartialEq)]
pub enum Rest {
    /// The same everywhere: no wind, or steady wind, rad.
    Uniform([f32; 2]),
    /// On nodes −1..=cells/2 + 1 along each axis, row-major, rad.
    Nodes {
        /// Nodes a row.
        width: usize,
        /// β_eq at the nodes.
        values: Vec<[f32; 2]>,
    },
}

/// Node below a cell centre (counted from node −1) and the weight of the node above it: centres lie ¼ or ¾ between nodes.
#[inline(always)]
fn between(cell: i32) -> (usize, f32) {
    let odd = cell & 1;
    (((cell - odd) / 2 + 1) as usize, if odd == 1 { 0.75 } else { 0.25 })
}

#[inline(always)]
fn mixed(a: f32, b: f32, weight: f32) -> f32 {
    a * (1.0 - weight) + b * weight
}

impl Rest {
    /// β_eq of patch `patch` with `cells` cells a side in the wind of this step, for plants of wind response `k_w`.
    pub fn of(wind: &WindField, patch: [i32; 2], cells: u32, k_w: f32) -> Self {
        if !wind.varies() || k_w == 0.0 {
            return Self::Uniform(equilibrium(wind.mean, k_w));
        }
        let intervals = (cells / NODE_CELLS) as i32;
        let phases = wind.patch_phases(patch, intervals as u32);
        let nodes = -1..=intervals + 1;
        let values = nodes
            .clone()
            .flat_map(|z| nodes.clone().map(move |x| [x, z]))
            .map(|node| equilibrium(wind.velocity(&phases, node), k_w))
            .collect();
        Self::Nodes { width: intervals as usize + 3, values }
    }

    /// β_eq at the centre of cell (i, j), −1 ≤ i, j ≤ cells.
    #[inline(always)]
    pub fn at(&self, i: i32, j: i32) -> [f32; 2] {
        match self {
            Self::Uniform(value) => *value,
            Self::Nodes { width, values } => {
                let ((x, wx), (z, wz)) = (between(i), between(j));
                let row = z * width + x;
                let (a, b, c, d) = (values[row], values[row + 1], values[row + width], values[row + width + 1]);
                [0, 1].map(|axis| mixed(mixed(a[axis], b[axis], wx), mixed(c[axis], d[axis], wx), wz))
            }
        }
    }

    /// β_eq of the row at `j`, written plane by plane.
    pub fn row(&self, j: i32, out: [&mut [f32]; 2]) {
        let [out_x, out_z] = out;
        match self {
            Self::Uniform(value) => {
                out_x.fill(value[0]);
                out_z.fill(value[1]);
            }
            Self::Nodes { .. } => {
                for i in 0..out_x.len() {
                    [out_x[i], out_z[i]] = self.at(i as i32, j);
                }
            }
        }
    }
}
