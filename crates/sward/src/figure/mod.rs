//! Bodies from glTF files: triangles on a tree of nodes that clips move, and the convex pieces that follow them.
//!
//! glTF 2.0 specification. A vertex follows up to four **frames**: a frame is a node with a matrix before it (the inverse bind
//! matrix of a joint, or none for a rigid node). Each frame's own triangles or vertices are split into convex parts once, in bind
//! pose; from then on parts and picture follow the frames. Everything a step reads is f64 and our own functions: the same bits everywhere.
//! Read by hand from the JSON, not through the crates `gltf` and `parry3d`: their readers and hulls may panic on damaged or degenerate
//! files, and the latter's V-HACD needs library mathematics.
//! Not read: morph targets (a mesh keeps its own shape), compressed meshes, a second set of joints.

mod accessor;
mod clip;
pub(crate) mod container;
pub(crate) mod error;
mod hull;
pub(crate) mod json;
pub(crate) mod material;
mod part;
pub(crate) mod primitive;
mod read;
mod split;
mod thin;
pub(crate) mod tree;

use glam::DMat4;

pub use clip::Clip;
pub use error::FigureError;
pub use part::{Part, Posed};
pub use tree::Node;

/// Most triangles of a file.
pub const MOST_TRIANGLES: u64 = 1_000_000;
/// Most nodes of a file.
pub const MOST_NODES: u64 = 4096;
/// Most frames: joints, and nodes with a mesh.
pub const MOST_FRAMES: u64 = 512;
/// Most convex parts of all frames.
pub const MOST_PARTS: u64 = 1024;

/// A node's space as vertices refer to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Index of the node.
    pub node: u32,
    /// From the vertices' space to the node's.
    pub offset: DMat4,
    /// Whether it is a joint of a skin, not a rigid node with a mesh of its own.
    pub joint: bool,
}

/// One corner of a triangle, in file units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FigureVertex {
    /// In the space of its frames.
    pub position: [f32; 3],
    /// Unit, outwards.
    pub normal: [f32; 3],
    /// Linear RGB, and 1 where the body's own paint replaces it (no material), else 0.
    pub colour: [f32; 4],
    /// Roughness, 0 mirror to 1 chalk, and gloss, the mirror share seen straight on.
    pub surface: [f32; 2],
    /// Frames it follows.
    pub frames: [u16; 4],
    /// How much of each; the sum is 1.
    pub weights: [f32; 4],
}

/// A body read from a glTF file, in file units. Read-only.
#[derive(Clone, Debug)]
pub struct Figure {
    /// Nodes, parents before children.
    pub nodes: Vec<Node>,
    /// What vertices follow.
    pub frames: Vec<Frame>,
    /// Corners.
    pub vertices: Vec<FigureVertex>,
    /// Three corners each, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Animations in the file's order.
    pub clips: Vec<Clip>,
    /// Convex parts, frame by frame.
    pub parts: Vec<Part>,
}

impl Figure {
    /// Reads a `.glb` or `.gltf`. `neighbour` reads files beside it by name; each rigid frame is split into at most `pieces` (1..=64)
    /// convex parts, each joint is one.
    ///
    /// # Errors
    /// What is wrong with the file, and where in it.
    pub fn read(bytes: &[u8], neighbour: &dyn Fn(&str) -> Result<Vec<u8>, String>, pieces: u32) -> Result<Self, FigureError> {
        let mut figure = read::figure(&container::open(bytes, neighbour)?)?;
        figure.parts = part::parts(&figure, pieces as usize)?;
        Ok(figure)
    }

    /// The clip of a name.
    ///
    /// # Errors
    /// None is called so; the error suggests the nearest.
    pub fn clip(&self, name: &str) -> Result<usize, FigureError> {
        if let Some(found) = self.clips.iter().position(|clip| clip.name == name) {
            return Ok(found);
        }
        let names: Vec<&str> = self.clips.iter().map(|clip| clip.name.as_str()).collect();
        let likeness = |other: &str| strsim::jaro_winkler(&name.to_lowercase(), &other.to_lowercase());
        let nearest = names.iter().max_by(|a, b| likeness(a).total_cmp(&likeness(b))).filter(|other| likeness(other) > 0.7);
        let guess = nearest.map_or_else(String::new, |near| format!("did you mean `{near}`? "));
        let known =
            if names.is_empty() { "the file has none: leave `clip` out".to_owned() } else { format!("known: {}", names.join(", ")) };
        Err(FigureError::Clip { asked: name.to_owned(), known: guess + &known })
    }

    /// From each frame's vertices to the figure, at `time` \[s\] of a clip, or at rest.
    pub fn pose(&self, clip: Option<usize>, time: f64) -> Vec<DMat4> {
        let mut local: Vec<_> = self.nodes.iter().map(|node| node.rest).collect();
        if let Some(clip) = clip.and_then(|clip| self.clips.get(clip)) {
            clip.apply(time, &mut local);
        }
        let mut global: Vec<DMat4> = Vec::with_capacity(local.len());
        for (node, local) in self.nodes.iter().zip(&local) {
            let matrix = local.matrix();
            global.push(node.parent.map_or(matrix, |parent| global[parent as usize] * matrix));
        }
        self.frames.iter().map(|frame| global[frame.node as usize] * frame.offset).collect()
    }
}
