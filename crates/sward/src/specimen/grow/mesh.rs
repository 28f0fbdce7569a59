//! A grown plant before it is ready, or written.

use bytemuck::{Pod, Zeroable};

use super::super::progress::Told;
use super::super::soup::Soup;
use super::super::{Finish, Kind, Size, Specimen, SpecimenError};

/// A corner as files have it, 32 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct MeshVertex {
    /// Where it is, m.
    pub position: [f32; 3],
    /// Unit, outwards.
    pub normal: [f32; 3],
    /// Texture coordinates; of a leaf, u + v is smallest where it is fixed.
    pub uv: [f32; 2],
}

/// Triangles of one finish.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// What they look like.
    pub finish: Finish,
    /// Corners.
    pub vertices: Vec<MeshVertex>,
    /// Three corners each, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl Piece {
    pub(super) fn new(name: &str, kind: Kind, colour: [f32; 3]) -> Self {
        let finish = Finish { kind, colour, picture: None, cutoff: 0.0, two_sided: kind == Kind::Leaf, name: name.to_owned() };
        Self { finish, vertices: Vec::new(), triangles: Vec::new() }
    }
}

/// A grown plant: leaf pieces, then wood pieces, none of them empty.
#[derive(Clone, Debug, PartialEq)]
pub struct Grown {
    /// One for each finish.
    pub pieces: Vec<Piece>,
    /// How many leaves grew.
    pub leaves: u64,
}

impl Grown {
    /// Triangles of all pieces.
    pub fn triangles(&self) -> u64 {
        self.pieces.iter().map(|piece| piece.triangles.len() as u64).sum()
    }

    pub(super) fn without_empty(mut self) -> Self {
        self.pieces.retain(|piece| !piece.triangles.is_empty());
        self
    }

    /// Scales it, so that its top is so high.
    pub(super) fn scale_to(&mut self, height: f32) {
        let places = self.pieces.iter().flat_map(|piece| &piece.vertices);
        let top = places.fold(0.0, |top: f32, vertex| if vertex.position[1] > top { vertex.position[1] } else { top });
        let factor = if top > 0.0 { height / top } else { 1.0 };
        let vertices = self.pieces.iter_mut().flat_map(|piece| &mut piece.vertices);
        vertices.for_each(|vertex| vertex.position = vertex.position.map(|part| part * factor));
    }

    /// Makes it ready. `progress` hears of shares done, 0..=1.
    ///
    /// # Errors
    /// A size out of range, or no memory.
    pub fn specimen(self, size: Size, progress: &mut dyn FnMut(f32)) -> Result<Specimen, SpecimenError> {
        let mut progress = Told::new(progress);
        let mut gathering = progress.part(0.0, 0.2);
        let vertices: u64 = self.pieces.iter().map(|piece| piece.vertices.len() as u64).sum();
        let mut soup = Soup::with_room(vertices, vertices, self.triangles())?;
        // Each piece is given back before the next is taken.
        for Piece { finish, vertices: own, triangles } in self.pieces {
            soup.begin(finish);
            let base = soup.vertices.len() as u32;
            for vertex in &own {
                gathering.item(soup.vertices.len(), vertices as usize);
                soup.push(vertex.position, vertex.normal, Some(vertex.uv));
            }
            soup.triangles(base, triangles.into_iter());
        }
        soup.ready(size, &mut progress.part(0.2, 1.0))
    }
}
