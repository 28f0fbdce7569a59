//! What one step is going to do to a stand of meshes.

use std::ops::Range;

use super::Toucher;
use crate::wind::WindField;

/// What a step does to a stand of meshes.
#[derive(Clone, Debug)]
pub struct LayeredPlan {
    /// The wind on the plane, whose x is along its right and z up.
    pub wind: WindField,
    /// Plants that move by themselves, too.
    pub touched: Vec<TouchPlan>,
    /// Bodies on their planes.
    pub brushes: Vec<Brush>,
    /// Who feels what each of them does.
    pub touchers: Vec<Toucher>,
}

/// A touched plant in a step.
#[derive(Clone, Debug, PartialEq)]
pub struct TouchPlan {
    /// Where its plane is stored.
    pub slot: u32,
    /// It has just been touched: its plane is to be stilled first.
    pub fresh: bool,
    /// Local wind along the plane's right and up, m/s.
    pub wind: [f32; 2],
    /// Its bodies in [`LayeredPlan::brushes`].
    pub brushes: Range<u32>,
    /// Mass of the leaves of a cell of its plane, kg.
    pub cell_mass: f32,
}

/// A body on a plant's plane, in one step. The same bytes in WGSL.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Brush {
    /// Its middle, cells right of the root and above it.
    pub at: [f32; 2],
    /// Half its width and height, cells.
    pub half: [f32; 2],
    /// Its velocity along the plane, m/s.
    pub velocity: [f32; 2],
    /// How fast it comes through the plane, m/s, either way.
    pub through: f32,
    /// How far it holds a cell in this step: share of its change that the cell loses, 0 to 1.
    pub hold: f32,
}
