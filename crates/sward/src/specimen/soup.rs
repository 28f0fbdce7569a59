//! Triangles with finishes, and what is made of them: leaves with roots, metres, shade.

use glam::Vec3;

use super::progress::Share;
use super::vertex::{SpecimenVertex, packed_normal, packed_uv};
use super::{Finish, Kind, Part, Picture, Size, Specimen, SpecimenError, components, shade};

/// A plant before it is ready: file units, leaf parts first.
#[derive(Default)]
pub(super) struct Soup {
    /// Each its own root; those of leaf parts first.
    pub(super) vertices: Vec<SpecimenVertex>,
    /// u + v of each vertex of leaf parts; infinite where there are no texture coordinates.
    pub(super) sums: Vec<f32>,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) parts: Vec<Part>,
    pub(super) finishes: Vec<Finish>,
    pub(super) pictures: Vec<Picture>,
}

impl Soup {
    /// With room for so much. Rooms of this size are not touched before they are used.
    pub(super) fn with_room(vertices: u64, leaf_vertices: u64, triangles: u64) -> Result<Self, SpecimenError> {
        let mut soup = Self::default();
        let memory = |_| SpecimenError::Memory(triangles);
        soup.vertices.try_reserve_exact(vertices as usize).map_err(memory)?;
        soup.sums.try_reserve_exact(leaf_vertices as usize).map_err(memory)?;
        soup.triangles.try_reserve_exact(triangles as usize).map_err(memory)?;
        Ok(soup)
    }

    /// Begins a part; those of leaves come first.
    pub(super) fn begin(&mut self, finish: Finish) {
        let start = self.triangles.len() as u32;
        self.parts.push(Part { triangles: start..start, finish: self.finishes.len() });
        self.finishes.push(finish);
    }

    /// Whether the part that was begun last is of leaves.
    pub(super) fn leafy(&self) -> bool {
        self.finishes.last().is_some_and(|finish| finish.kind == Kind::Leaf)
    }

    /// Adds a vertex to the part that was begun last.
    pub(super) fn push(&mut self, position: [f32; 3], normal: [f32; 3], uv: Option<[f32; 2]>) {
        // −0 becomes 0: both are one place, and places are compared by their bits.
        let position = position.map(|part| part + 0.0);
        let uv_packed = packed_uv(uv.unwrap_or_default());
        self.vertices.push(SpecimenVertex { position, normal: packed_normal(normal), uv: uv_packed, root: position });
        if self.leafy() {
            self.sums.push(uv.map_or(f32::INFINITY, |uv| uv[0] + uv[1]));
        }
    }

    /// Adds triangles to the part that was begun last, `base` being the vertex that they call 0.
    pub(super) fn triangles(&mut self, base: u32, triangles: impl Iterator<Item = [u32; 3]>) {
        self.triangles.extend(triangles.map(|corners| corners.map(|corner| corner + base)));
        if let Some(part) = self.parts.last_mut() {
            part.triangles.end = self.triangles.len() as u32;
        }
    }

    /// Leaves out parts without triangles, and their finishes.
    pub(super) fn drop_empty_parts(&mut self) {
        let empty: Vec<bool> = self.parts.iter().map(|part| part.triangles.is_empty()).collect();
        let mut of_finishes = empty.iter();
        self.finishes.retain(|_| of_finishes.next() == Some(&false));
        self.parts.retain(|part| !part.triangles.is_empty());
        self.parts.iter_mut().enumerate().for_each(|(number, part)| part.finish = number);
    }

    /// Gives a vertex its normal.
    pub(super) fn turn(&mut self, vertex: usize, normal: [f32; 3]) {
        self.vertices[vertex].normal = packed_normal(normal);
    }

    /// Gives a vertex its texture coordinates.
    pub(super) fn texture(&mut self, vertex: usize, uv: [f32; 2]) {
        self.vertices[vertex].uv = packed_uv(uv);
        if let Some(sum) = self.sums.get_mut(vertex) {
            *sum = uv[0] + uv[1];
        }
    }

    /// Normals of the vertices from `base` on, as means over their triangles, by area; triangles of others must not use them.
    pub(super) fn smooth(&mut self, base: usize) {
        let mut sums = vec![Vec3::ZERO; self.vertices.len() - base];
        for corners in self.triangles.iter().rev().take_while(|corners| corners[0] as usize >= base) {
            let [a, b, c] = corners.map(|corner| Vec3::from(self.vertices[corner as usize].position));
            let normal = (b - a).cross(c - a);
            corners.iter().for_each(|corner| sums[*corner as usize - base] += normal);
        }
        sums.iter().zip(base..).for_each(|(sum, vertex)| self.turn(vertex, sum.to_array()));
    }

    /// Finds leaves and roots, scales, and sees how open to the sky each vertex is.
    pub(super) fn ready(mut self, size: Size, progress: &mut Share<'_, '_>) -> Result<Specimen, SpecimenError> {
        self.vertices.shrink_to_fit();
        let sums = std::mem::take(&mut self.sums);
        let leaf_triangles = self.parts.iter().filter(|part| self.finishes[part.finish].kind == Kind::Leaf).map(|part| part.triangles.end);
        let leaf_triangles = leaf_triangles.max().unwrap_or(0) as usize;
        let leaves = components::root(&mut self.vertices[..], &sums, &self.triangles[..leaf_triangles], &mut progress.part(0.0, 0.65));
        drop(sums);
        let (low, high) = self.scale(size)?;
        let wood = leaf_triangles as u32;
        shade::shade(&mut self.vertices, &self.triangles, wood, [low, high], &mut progress.part(0.65, 1.0));
        progress.done(1, 1);
        let Self { vertices, triangles, parts, finishes, pictures, .. } = self;
        Ok(Specimen { vertices, triangles, parts, finishes, pictures, leaves, low: low.to_array(), high: high.to_array() })
    }

    fn bounds(&self) -> (Vec3, Vec3) {
        let mut bounds = [[f32::MAX; 3], [f32::MIN; 3]];
        for vertex in &self.vertices {
            for (axis, part) in vertex.position.into_iter().enumerate() {
                bounds[0][axis] = if part < bounds[0][axis] { part } else { bounds[0][axis] };
                bounds[1][axis] = if part > bounds[1][axis] { part } else { bounds[1][axis] };
            }
        }
        (bounds[0].into(), bounds[1].into())
    }

    /// To metres; the box around it.
    fn scale(&mut self, size: Size) -> Result<(Vec3, Vec3), SpecimenError> {
        let (low, high) = self.bounds();
        let factor = match size {
            Size::Scale(factor) => factor,
            Size::Height(height) if high.y > 0.0 => height / high.y,
            Size::Height(_) => return Err(SpecimenError::NoHeight),
        };
        let across = (high - low).max_element();
        let longest = across * factor;
        if !(0.01..=200.0).contains(&longest) {
            let scale = if across > 0.0 { format!("{:.3e}", 2.0 / across) } else { "1".to_owned() };
            return Err(SpecimenError::Size { size: format!("{longest:.3}"), scale });
        }
        if factor != 1.0 {
            for vertex in &mut self.vertices {
                vertex.position = vertex.position.map(|part| part * factor);
                vertex.root = vertex.root.map(|part| part * factor);
            }
        }
        Ok((low * factor, high * factor))
    }
}
