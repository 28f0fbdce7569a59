//! From the JSON's lists to vertices, triangles and frames.

use std::collections::BTreeMap;

use glam::{DMat4, Vec3};

use super::container::Opened;
use super::error::{FigureError, data};
use super::json::{Primitive, at};
use super::material::{Picture, corner, finish, pictures};
use super::primitive::same_length;
use super::tree::{Tree, tree};
use super::{Clip, Figure, FigureVertex, Frame, MOST_FRAMES, MOST_TRIANGLES};

/// Most elements of an accessor of vertices: every triangle may have its own three.
const MOST_VERTICES: u64 = 3 * MOST_TRIANGLES;
/// Farther out, file units, no vertex may lie.
const FARTHEST: f32 = 1e7;

fn too_many_triangles(found: u64) -> FigureError {
    let instead = "simplify it before exporting (Blender: Decimate)";
    FigureError::TooMany { what: "triangles", found, most: MOST_TRIANGLES, instead }
}

/// The figure without its parts.
pub(super) fn figure(opened: &Opened<'_>) -> Result<Figure, FigureError> {
    let tree = tree(&opened.root)?;
    let clips = Clip::all(opened, &tree)?;
    let mut gathered = Gathered {
        opened,
        pictures: pictures(opened, Picture::of)?,
        frames: Vec::new(),
        skins: BTreeMap::new(),
        vertices: Vec::new(),
        triangles: Vec::new(),
    };
    for &node in &tree.shown {
        if let Some(mesh) = opened.root.nodes[node].mesh {
            gathered.mesh(node, mesh, &tree)?;
        }
    }
    if gathered.triangles.is_empty() {
        return Err(FigureError::NoTriangles);
    }
    let Gathered { frames, vertices, triangles, .. } = gathered;
    Ok(Figure { nodes: tree.nodes, frames, vertices, triangles, clips, parts: Vec::new() })
}

struct Gathered<'a> {
    opened: &'a Opened<'a>,
    pictures: Vec<Option<Picture>>,
    frames: Vec<Frame>,
    /// First frame and number of joints of each skin met so far.
    skins: BTreeMap<usize, (usize, u32)>,
    vertices: Vec<FigureVertex>,
    triangles: Vec<[u32; 3]>,
}

impl Gathered<'_> {
    fn mesh(&mut self, node: usize, mesh: usize, tree: &Tree) -> Result<(), FigureError> {
        let root = &self.opened.root;
        let list = &at(&root.meshes, mesh, "meshes", &format!("nodes[{node}]"))?.primitives;
        let (first, joints) = match root.nodes[node].skin {
            Some(skin) => self.joints(skin, tree, &format!("nodes[{node}]"))?,
            None => {
                self.frames.push(Frame { node: tree.place[node], offset: DMat4::IDENTITY, joint: false });
                (self.frames.len() - 1, 0)
            }
        };
        if self.frames.len() as u64 > MOST_FRAMES {
            let found = self.frames.len() as u64;
            let instead = "join objects, or use fewer bones";
            return Err(FigureError::TooMany { what: "joints and nodes with a mesh", found, most: MOST_FRAMES, instead });
        }
        for (index, primitive) in list.iter().enumerate() {
            self.primitive(primitive, first as u16, joints, &format!("meshes[{mesh}].primitives[{index}]"))?;
        }
        Ok(())
    }

    /// First frame and number of joints of a skin; adds them when it is met first.
    fn joints(&mut self, index: usize, tree: &Tree, place: &str) -> Result<(usize, u32), FigureError> {
        if let Some(known) = self.skins.get(&index) {
            return Ok(*known);
        }
        let root = &self.opened.root;
        let skin_place = format!("skins[{index}]");
        let skin = at(&root.skins, index, "skins", place)?;
        let first = self.frames.len();
        let matrices: Vec<[f32; 16]> = match skin.inverse_bind_matrices {
            Some(accessor) => self.opened.vectors(accessor, &[16], 0.0, MOST_FRAMES, &skin_place)?,
            None => vec![glam::Mat4::IDENTITY.to_cols_array(); skin.joints.len()],
        };
        if skin.joints.is_empty() || matrices.len() < skin.joints.len() {
            let what = format!("has {} joints and {} inverse bind matrices", skin.joints.len(), matrices.len());
            return Err(data(skin_place, what));
        }
        for (joint, matrix) in skin.joints.iter().zip(&matrices) {
            at(&root.nodes, *joint, "nodes", &skin_place)?;
            self.frames.push(Frame { node: tree.place[*joint], offset: DMat4::from_cols_array(&matrix.map(f64::from)), joint: true });
        }
        let known = (first, skin.joints.len() as u32);
        self.skins.insert(index, known);
        Ok(known)
    }

    fn primitive(&mut self, primitive: &Primitive, first_frame: u16, joints: u32, place: &str) -> Result<(), FigureError> {
        let Some(position) = primitive.attributes.position else { return Ok(()) };
        let opened = self.opened;
        let positions = opened.vectors::<3>(position, &[3], 0.0, MOST_VERTICES, &format!("{place}.POSITION"))?;
        // Primitives may share one accessor: a small file would fill all memory.
        let vertices = (self.vertices.len() + positions.len()) as u64;
        if vertices > MOST_VERTICES {
            let instead = "simplify it before exporting (Blender: Decimate)";
            return Err(FigureError::TooMany { what: "vertices", found: vertices, most: MOST_VERTICES, instead });
        }
        if positions.iter().flatten().any(|part| !(-FARTHEST..=FARTHEST).contains(part)) {
            return Err(data(format!("{place}.POSITION"), "has vertices beyond ±1e7 units"));
        }
        let corners = opened.corners(primitive, positions.len(), 3 * MOST_TRIANGLES, place)?;
        let all = (self.triangles.len() + corners.len()) as u64;
        if all > MOST_TRIANGLES {
            return Err(too_many_triangles(all));
        }
        let skinned = if joints > 0 { self.skinning(primitive, first_frame, joints, positions.len(), place)? } else { None };
        let skinned = skinned.unwrap_or_else(|| vec![([first_frame, 0, 0, 0], [1.0, 0.0, 0.0, 0.0]); positions.len()]);
        let normals = self.normals(primitive, positions.len(), place)?;
        let finish = finish(&opened.root, &self.pictures, primitive, place)?;
        let (uvs, own) = self.colours(primitive, finish.as_ref().map_or(0, |finish| finish.coordinates), positions.len(), place)?;
        let vertex = |at: usize, normal: [f32; 3]| {
            let (colour, surface) = corner(finish.as_ref(), uvs.as_ref().map(|uvs| uvs[at]), own.as_ref().map_or([1.0; 4], |own| own[at]));
            let (frames, weights) = skinned[at];
            FigureVertex { position: positions[at], normal, colour, surface, frames, weights }
        };
        let base = self.vertices.len() as u32;
        match normals {
            Some(normals) => {
                self.vertices.extend(normals.into_iter().enumerate().map(|(at, normal)| vertex(at, normal)));
                self.triangles.extend(corners.iter().map(|t| t.map(|index| base + index)));
            }
            // Without normals every face is flat (§3.7.2.1): its corners are its own.
            None => {
                for (face, t) in corners.iter().enumerate() {
                    let [a, b, c] = t.map(|index| Vec3::from(positions[index as usize]));
                    let normal = (b - a).cross(c - a).normalize_or(Vec3::Y).to_array();
                    self.vertices.extend(t.iter().map(|index| vertex(*index as usize, normal)));
                    let start = base + 3 * face as u32;
                    self.triangles.push([start, start + 1, start + 2]);
                }
            }
        }
        Ok(())
    }

    fn normals(&self, primitive: &Primitive, count: usize, place: &str) -> Result<Option<Vec<[f32; 3]>>, FigureError> {
        let Some(accessor) = primitive.attributes.normal else { return Ok(None) };
        let normals = self.opened.vectors::<3>(accessor, &[3], 0.0, MOST_VERTICES, &format!("{place}.NORMAL"))?;
        same_length(normals.len(), count, "NORMAL", place)?;
        Ok(Some(normals.into_iter().map(|normal| Vec3::from(normal).normalize_or(Vec3::Y).to_array()).collect()))
    }

    /// Texture coordinates and vertex colours, where there are any.
    fn colours(&self, primitive: &Primitive, set: u32, count: usize, place: &str) -> Result<Coloured, FigureError> {
        let attributes = &primitive.attributes;
        let coordinates = if set == 0 { attributes.texcoord_0 } else { attributes.texcoord_1 };
        let uvs = match coordinates {
            Some(accessor) => Some(self.opened.vectors::<2>(accessor, &[2], 0.0, MOST_VERTICES, &format!("{place}.TEXCOORD"))?),
            None => None,
        };
        let own = match attributes.color_0 {
            Some(accessor) => Some(self.opened.vectors::<4>(accessor, &[3, 4], 1.0, MOST_VERTICES, &format!("{place}.COLOR_0"))?),
            None => None,
        };
        same_length(uvs.as_ref().map_or(count, Vec::len), count, "TEXCOORD", place)?;
        same_length(own.as_ref().map_or(count, Vec::len), count, "COLOR_0", place)?;
        Ok((uvs, own))
    }

    /// Frames and weights of each vertex; `None` for a mesh on a skin that has no weights.
    fn skinning(
        &self,
        primitive: &Primitive,
        first: u16,
        joints: u32,
        count: usize,
        place: &str,
    ) -> Result<Option<Vec<Followed>>, FigureError> {
        let (Some(frames), Some(weights)) = (primitive.attributes.joints_0, primitive.attributes.weights_0) else { return Ok(None) };
        let frames = self.opened.integers::<4>(frames, MOST_VERTICES, &format!("{place}.JOINTS_0"))?;
        let weights = self.opened.vectors::<4>(weights, &[4], 0.0, MOST_VERTICES, &format!("{place}.WEIGHTS_0"))?;
        same_length(frames.len(), count, "JOINTS_0", place)?;
        same_length(weights.len(), count, "WEIGHTS_0", place)?;
        let mut followed = Vec::with_capacity(count);
        for (frames, weights) in frames.into_iter().zip(weights) {
            let weights = weights.map(|weight| if weight > 0.0 { weight } else { 0.0 });
            let sum: f32 = weights.iter().sum();
            if let Some(wrong) = frames.iter().zip(&weights).find(|(frame, weight)| **frame >= joints && **weight > 0.0) {
                return Err(data(place, format!("follows joint {}, but its skin has {joints}", wrong.0)));
            }
            let frames = frames.map(|frame| first + if frame < joints { frame as u16 } else { 0 });
            let weights = if sum > 1e-6 && sum.is_finite() { weights.map(|weight| weight / sum) } else { [1.0, 0.0, 0.0, 0.0] };
            followed.push((frames, weights));
        }
        Ok(Some(followed))
    }
}

/// Frames and weights of a vertex.
type Followed = ([u16; 4], [f32; 4]);
/// Texture coordinates and own colours of the vertices of a primitive.
type Coloured = (Option<Vec<[f32; 2]>>, Option<Vec<[f32; 4]>>);
