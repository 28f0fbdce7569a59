//! The part of a glTF file's JSON that bodies need. Everything else is skipped.
//!
//! glTF 2.0 specification, §5. Numbers that point into lists are looked up with `get`: a wrong one is an error with its place.

use serde::Deserialize;

use super::error::{FigureError, data};

/// Extensions a file may require: what they add is read, or concerns only a finish we do not draw.
const KNOWN: [&str; 5] =
    ["KHR_mesh_quantization", "KHR_materials_unlit", "KHR_texture_transform", "KHR_materials_specular", "KHR_materials_emissive_strength"];

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Root {
    pub(super) asset: Asset,
    pub(super) extensions_required: Vec<String>,
    pub(super) scene: Option<usize>,
    pub(super) scenes: Vec<Scene>,
    pub(super) nodes: Vec<Node>,
    pub(super) meshes: Vec<Mesh>,
    pub(super) skins: Vec<Skin>,
    pub(super) animations: Vec<Animation>,
    pub(super) accessors: Vec<Accessor>,
    pub(super) buffer_views: Vec<BufferView>,
    pub(super) buffers: Vec<Buffer>,
    pub(super) materials: Vec<Material>,
    pub(super) textures: Vec<Texture>,
    pub(super) images: Vec<Image>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Asset {
    pub(super) version: String,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Scene {
    pub(super) nodes: Vec<usize>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Node {
    pub(super) name: String,
    pub(super) children: Vec<usize>,
    pub(super) mesh: Option<usize>,
    pub(super) skin: Option<usize>,
    pub(super) matrix: Option<[f64; 16]>,
    pub(super) translation: Option<[f64; 3]>,
    pub(super) rotation: Option<[f64; 4]>,
    pub(super) scale: Option<[f64; 3]>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Mesh {
    pub(super) primitives: Vec<Primitive>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Primitive {
    pub(super) attributes: Attributes,
    pub(super) indices: Option<usize>,
    pub(super) material: Option<usize>,
    pub(super) mode: Option<u32>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "UPPERCASE", default)]
pub(super) struct Attributes {
    pub(super) position: Option<usize>,
    pub(super) normal: Option<usize>,
    pub(super) texcoord_0: Option<usize>,
    pub(super) texcoord_1: Option<usize>,
    pub(super) color_0: Option<usize>,
    pub(super) joints_0: Option<usize>,
    pub(super) weights_0: Option<usize>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Skin {
    pub(super) inverse_bind_matrices: Option<usize>,
    pub(super) joints: Vec<usize>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Animation {
    pub(super) name: String,
    pub(super) channels: Vec<Channel>,
    pub(super) samplers: Vec<Sampler>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Channel {
    pub(super) sampler: usize,
    pub(super) target: Target,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Target {
    pub(super) node: Option<usize>,
    pub(super) path: String,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Sampler {
    pub(super) input: usize,
    pub(super) output: usize,
    pub(super) interpolation: String,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Accessor {
    pub(super) buffer_view: Option<usize>,
    pub(super) byte_offset: u64,
    pub(super) component_type: u32,
    pub(super) count: u64,
    #[serde(rename = "type")]
    pub(super) shape: String,
    pub(super) normalized: bool,
    pub(super) sparse: Option<Sparse>,
}

/// Elements that replace others of an accessor.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Sparse {
    pub(super) count: u64,
    pub(super) indices: SparsePart,
    pub(super) values: SparsePart,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct SparsePart {
    pub(super) buffer_view: usize,
    pub(super) byte_offset: u64,
    pub(super) component_type: u32,
}

impl Accessor {
    /// Which elements are replaced, and by what, as accessors of their own.
    pub(super) fn replaced(&self) -> Option<[Self; 2]> {
        let sparse = self.sparse.as_ref()?;
        let part = |part: &SparsePart, component_type: u32, shape: &str| Self {
            buffer_view: Some(part.buffer_view),
            byte_offset: part.byte_offset,
            component_type,
            count: sparse.count,
            shape: shape.to_owned(),
            normalized: self.normalized,
            sparse: None,
        };
        let indices = part(&sparse.indices, sparse.indices.component_type, "SCALAR");
        Some([indices, part(&sparse.values, self.component_type, &self.shape)])
    }
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct BufferView {
    pub(super) buffer: usize,
    pub(super) byte_offset: u64,
    pub(super) byte_length: u64,
    pub(super) byte_stride: Option<u64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Buffer {
    pub(super) uri: Option<String>,
    pub(super) byte_length: u64,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Material {
    pub(super) pbr_metallic_roughness: Finish,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Finish {
    pub(super) base_color_factor: Option<[f32; 4]>,
    pub(super) base_color_texture: Option<TextureUse>,
    pub(super) metallic_factor: Option<f32>,
    pub(super) roughness_factor: Option<f32>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct TextureUse {
    pub(super) index: usize,
    pub(super) tex_coord: u32,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Texture {
    pub(super) source: Option<usize>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Image {
    pub(super) name: Option<String>,
    pub(super) uri: Option<String>,
    pub(super) buffer_view: Option<usize>,
}

impl Root {
    pub(super) fn parse(text: &[u8]) -> Result<Self, FigureError> {
        // A byte-order mark is not allowed, but some exporters write one.
        let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
        let root: Self = serde_json::from_slice(text).map_err(|error| FigureError::Json(error.to_string()))?;
        if !root.asset.version.starts_with("2.") {
            let found = if root.asset.version.is_empty() { "no version" } else { &root.asset.version };
            return Err(FigureError::Json(format!("`asset.version` is {found}, needed is 2.0; export it as glTF 2.0")));
        }
        match root.extensions_required.iter().find(|name| !KNOWN.contains(&name.as_str())) {
            Some(name) => Err(FigureError::Extension(name.clone())),
            None => Ok(root),
        }
    }
}

/// Element `index` of a list called `name`, or an error that says who asked.
pub(super) fn at<'a, T>(list: &'a [T], index: usize, name: &str, place: &str) -> Result<&'a T, FigureError> {
    list.get(index).ok_or_else(|| data(place, format!("points to {name}[{index}], but there are {}", list.len())))
}
