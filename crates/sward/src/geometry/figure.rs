//! Meshes of glTF bodies: every vertex follows its frames (linear blend skinning, glTF 2.0 §3.7.3.3).

use glam::Vec3;

use super::mesh::{Mesh, Vertex};
use crate::interaction::FigureBody;
use crate::interaction::skin::blended;

/// The body's mesh in its own frame, m, `elapsed` seconds after it appeared. Vertices keep their number and order.
pub fn figure_mesh(body: &FigureBody, elapsed: f64) -> Mesh {
    let frames = body.pose(elapsed);
    let vertices = body.figure.vertices.iter().map(|vertex| {
        let matrix = blended(&frames, vertex).as_mat4();
        Vertex {
            position: matrix.transform_point3(vertex.position.into()).to_array(),
            normal: matrix.transform_vector3(vertex.normal.into()).normalize_or(Vec3::Y).to_array(),
            colour: vertex.colour,
            surface: vertex.surface,
        }
    });
    Mesh { vertices: vertices.collect(), indices: body.figure.triangles.iter().flatten().copied().collect() }
}
