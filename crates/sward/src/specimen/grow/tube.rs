//! Tubes around branches: rings that share their vertices, closed at the tip.

use super::branch::Joint;
use super::chance::ring;
use super::mesh::{MeshVertex, Piece};

/// Triangles of a tube.
pub(super) fn count(joints: usize, sides: u32) -> u64 {
    u64::from(sides) * (2 * (joints as u64 - 2) + 1)
}

/// Adds a tube; the last joint is its tip. u runs to and fro around it, v in metres along it; `from` is where both begin.
pub(super) fn tube(piece: &mut Piece, joints: &[Joint], sides: u32, from: f32) {
    let Some((tip, rings)) = joints.split_last() else { return };
    let base = piece.vertices.len() as u32;
    let turn = std::f32::consts::TAU / sides as f32;
    let (mut along, mut before) = (from, rings.first().map_or(tip.place, |joint| joint.place));
    for joint in rings {
        along += (joint.place - before).length();
        before = joint.place;
        for k in 0..sides {
            let out = ring(joint.forward, joint.side, k as f32 * turn);
            let around = k.min(sides - k) as f32 * 2.0 / sides as f32;
            piece.vertices.push(MeshVertex {
                position: (joint.place + out * joint.radius).to_array(),
                normal: out.to_array(),
                uv: [from + around, along],
            });
        }
    }
    along += (tip.place - before).length();
    piece.vertices.push(MeshVertex { position: tip.place.to_array(), normal: tip.forward.to_array(), uv: [from + 0.5, along] });
    let count = rings.len() as u32;
    for ring in 0..count {
        for k in 0..sides {
            let next = (k + 1) % sides;
            let (a, b) = (base + ring * sides + k, base + ring * sides + next);
            if ring + 1 < count {
                piece.triangles.push([a, b, a + sides]);
                piece.triangles.push([b, b + sides, a + sides]);
            } else {
                piece.triangles.push([a, b, base + count * sides]);
            }
        }
    }
}
