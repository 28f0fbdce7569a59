//! Leaves: a few triangles folded along the middle.

use glam::Vec3;

use super::mesh::{MeshVertex, Piece};

/// A leaf to be.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leaf {
    /// Where it is fixed.
    pub(super) base: Vec3,
    /// Unit, from base to tip.
    pub(super) along: Vec3,
    /// Unit, square to it, of its upper face.
    pub(super) up: Vec3,
    pub(super) length: f32,
    /// Half of its width at the widest.
    pub(super) half: f32,
    /// How far its edges are lifted from its middle, as a share of `half`.
    pub(super) fold: f32,
    /// How far its tip hangs, as a share of the length.
    pub(super) droop: f32,
}

/// How detailed leaves are, by their triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Detail {
    /// A folded rhomb.
    Two,
    /// A folded outline, widest near the base.
    Four,
    /// The same, hanging over at its middle.
    Six,
}

impl Detail {
    pub(super) fn triangles(self) -> u64 {
        match self {
            Self::Two => 2,
            Self::Four => 4,
            Self::Six => 6,
        }
    }

    /// A leaf's area as a share of length times half width.
    pub(super) fn area(self) -> f32 {
        match self {
            Self::Two => 1.0,
            Self::Four | Self::Six => 1.28,
        }
    }
}

/// Adds a leaf. Texture coordinates run from the base at (0, 0) to the tip at (1, 1), so u + v grows along it.
pub(super) fn leaf(piece: &mut Piece, leaf: &Leaf, detail: Detail) {
    let side = leaf.along.cross(leaf.up);
    let first = piece.vertices.len() as u32;
    let mut push = |t: f32, across: f32| {
        let width = leaf.half * across;
        let lift = if width < 0.0 { -width } else { width };
        // The curve hangs down more and more.
        let sink = leaf.droop * t * t;
        let place = leaf.base
            + leaf.along * (leaf.length * (t - 0.3 * sink * leaf.droop))
            + side * width
            + leaf.up * (leaf.fold * lift - leaf.length * sink);
        let tilt = leaf.fold
            * if across > 0.0 {
                -1.0
            } else if across < 0.0 {
                1.0
            } else {
                0.0
            };
        let normal = (leaf.up + side * tilt + leaf.along * (2.0 * leaf.droop * t)).normalize_or(leaf.up);
        let aside = 0.45 * across;
        piece.vertices.push(MeshVertex {
            position: place.to_array(),
            normal: normal.to_array(),
            uv: [t + aside * (1.0 - t), t - aside * (1.0 - t)],
        });
    };
    let corners: &[[u32; 3]] = match detail {
        Detail::Two => {
            [(0.0, 0.0), (0.42, 1.0), (1.0, 0.0), (0.42, -1.0)].iter().for_each(|(t, across)| push(*t, *across));
            &[[0, 1, 2], [0, 2, 3]]
        }
        Detail::Four => {
            let outline = [(0.0, 0.0), (0.26, 0.92), (0.66, 0.74), (1.0, 0.0), (0.66, -0.74), (0.26, -0.92)];
            outline.iter().for_each(|(t, across)| push(*t, *across));
            &[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]]
        }
        Detail::Six => {
            let outline = [(0.0, 0.0), (0.26, 0.92), (0.66, 0.74), (1.0, 0.0), (0.66, -0.74), (0.26, -0.92), (0.5, 0.0)];
            outline.iter().for_each(|(t, across)| push(*t, *across));
            &[[0, 1, 6], [1, 2, 6], [2, 3, 6], [3, 4, 6], [4, 5, 6], [5, 0, 6]]
        }
    };
    piece.triangles.extend(corners.iter().map(|corners| corners.map(|corner| first + corner)));
}
