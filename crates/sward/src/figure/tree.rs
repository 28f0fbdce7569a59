//! Nodes: who stands on whom, and where.

use glam::{DMat4, DQuat, DVec3};

use super::MOST_NODES;
use super::error::{FigureError, data};
use super::json::{self, Root, at};

/// Where a node stands on its parent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stance {
    /// Scale, then turn, then shift; what clips move.
    Parts {
        /// Shift.
        translation: [f64; 3],
        /// Unit quaternion (x, y, z, w).
        rotation: [f64; 4],
        /// Factors.
        scale: [f64; 3],
    },
    /// A whole matrix, column-major.
    Matrix(DMat4),
}

impl Stance {
    pub(crate) const IDENTITY: Self = Self::Parts { translation: [0.0; 3], rotation: [0.0, 0.0, 0.0, 1.0], scale: [1.0; 3] };

    /// As a matrix.
    pub fn matrix(&self) -> DMat4 {
        match *self {
            Self::Matrix(matrix) => matrix,
            Self::Parts { translation, rotation, scale } => DMat4::from_scale_rotation_translation(
                DVec3::from_array(scale),
                DQuat::from_array(rotation),
                DVec3::from_array(translation),
            ),
        }
    }
}

/// A node, after its parent in the list.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Name in the file.
    pub name: String,
    /// Index of the parent, lower than its own.
    pub parent: Option<u32>,
    /// Where it stands without a clip.
    pub rest: Stance,
}

/// Nodes in order, and where each of the file's nodes went.
pub(crate) struct Tree {
    pub(crate) nodes: Vec<Node>,
    /// Place in `nodes` of each of the file's.
    pub(crate) place: Vec<u32>,
    /// The file's nodes that belong to its scene, in order of `nodes`.
    pub(crate) shown: Vec<usize>,
}

/// A unit quaternion; none for zero.
pub(crate) fn unit(q: [f64; 4]) -> [f64; 4] {
    let length = (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]).sqrt();
    if length > 1e-12 { q.map(|part| part / length) } else { [0.0, 0.0, 0.0, 1.0] }
}

fn stance(node: &json::Node, index: usize) -> Result<Stance, FigureError> {
    let place = || format!("nodes[{index}]");
    let finite = |numbers: &[f64]| numbers.iter().all(|number| (-1e9..=1e9).contains(number));
    if let Some(matrix) = node.matrix {
        return match finite(&matrix) {
            true => Ok(Stance::Matrix(DMat4::from_cols_array(&matrix))),
            false => Err(data(place(), "has a `matrix` with numbers beyond ±1e9")),
        };
    }
    let (translation, scale) = (node.translation.unwrap_or([0.0; 3]), node.scale.unwrap_or([1.0; 3]));
    let rotation = node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]);
    if finite(&translation) && finite(&scale) && finite(&rotation) {
        Ok(Stance::Parts { translation, rotation: unit(rotation), scale })
    } else {
        Err(data(place(), "stands at numbers beyond ±1e9"))
    }
}

/// Puts parents before children. All nodes are kept, since joints may lie outside the scene; only the scene's are shown.
pub(crate) fn tree(root: &Root) -> Result<Tree, FigureError> {
    let count = root.nodes.len();
    if count as u64 > MOST_NODES {
        let instead = "join objects before exporting";
        return Err(FigureError::TooMany { what: "nodes", found: count as u64, most: MOST_NODES, instead });
    }
    let mut parent: Vec<Option<usize>> = vec![None; count];
    for (index, node) in root.nodes.iter().enumerate() {
        for &child in &node.children {
            let place = format!("nodes[{index}]");
            at(&root.nodes, child, "nodes", &place)?;
            if let Some(other) = parent[child].replace(index) {
                return Err(data(format!("nodes[{child}]"), format!("is a child of nodes[{other}] and of nodes[{index}]")));
            }
        }
    }
    let tops: Vec<usize> = (0..count).filter(|index| parent[*index].is_none()).collect();
    let shown_tops: Vec<usize> = match root.scenes.get(root.scene.unwrap_or(0)) {
        Some(scene) => scene.nodes.clone(),
        None => tops.clone(),
    };
    let mut place = vec![u32::MAX; count];
    let (mut nodes, mut order) = (Vec::with_capacity(count), Vec::with_capacity(count));
    let mut open: Vec<usize> = tops.into_iter().rev().collect();
    while let Some(index) = open.pop() {
        let node = &root.nodes[index];
        place[index] = nodes.len() as u32;
        let name = if node.name.is_empty() { format!("nodes[{index}]") } else { node.name.clone() };
        nodes.push(Node { name, parent: parent[index].map(|parent| place[parent]), rest: stance(node, index)? });
        order.push(index);
        open.extend(node.children.iter().rev());
    }
    // With one parent each, whatever no top reaches goes round in a ring.
    if let Some(index) = place.iter().position(|place| *place == u32::MAX) {
        return Err(data(format!("nodes[{index}]"), "is its own ancestor; a tree is needed"));
    }
    let mut is_shown = vec![false; count];
    for top in shown_tops {
        at(&root.nodes, top, "nodes", "scenes")?;
        is_shown[top] = true;
    }
    for &index in &order {
        is_shown[index] |= parent[index].is_some_and(|parent| is_shown[parent]);
    }
    Ok(Tree { nodes, place, shown: order.into_iter().filter(|index| is_shown[*index]).collect() })
}
