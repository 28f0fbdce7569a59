//! The part of a glTF file's JSON that bodies and plants need. Everything else is skipped.
//!
//! glTF 2.0 specification, §5. Numbers that point into lists are looked up with `get`: a wrong one is an error with its place.

use serde::Deserialize;

use super::error::{FigureError, data};

/// Extensions a file may require: what they add is read, or concerns only a finish we do not draw.
const KNOWN: [&str; 5] =
    ["KHR_mesh_quantization", "KHR_materials_unlit", "KHR_texture_transform", "KHR_materials_specular", "KHR_materials_emissive_strength"];

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(crate) struct Root {
    pub(crate) asset: Asset,
    pub(crate) extensions_required: Vec<String>,
    pub(crate) scene: Option<usize>,
    pub(crate) scenes: Vec<Scene>,
    pub(crate) nodes: Vec<Node>,
    pub(crate) meshes: Vec<Mesh>,
    pub(crate) skins: Vec<Skin>,
    pub(crate) animations: Vec<Animation>,
    pub(crate) accessors: Vec<Accessor>,
    pub(crate) buffer_views: Vec<BufferView>,
    pub(crate) buffers: Vec<Buffer>,
    pub(crate) materials: Vec<Material>,
    pub(crate) textures: Vec<Texture>,
    pub(crate) images: Vec<Image>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Asset {
    pub(crate) version: String,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Scene {
    pub(crate) nodes: Vec<usize>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Node {
    pub(crate) name: String,
    pub(crate) children: Vec<usize>,
    pub(crate) mesh: Option<usize>,
    pub(crate) skin: Option<usize>,
    pub(crate) matrix: Option<[f64; 16]>,
    pub(crate) translation: Option<[f64; 3]>,
    pub(crate) rotation: Option<[f64; 4]>,
    pub(crate) scale: Option<[f64; 3]>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Mesh {
    pub(crate) primitives: Vec<Primitive>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Primitive {
    pub(crate) attributes: Attributes,
    pub(crate) indices: Option<usize>,
    pub(crate) material: Option<usize>,
    pub(crate) mode: Option<u32>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "UPPERCASE", default)]
pub(crate) struct Attributes {
    pub(crate) position: Option<usize>,
    pub(crate) normal: Option<usize>,
    pub(crate) texcoord_0: Option<usize>,
    pub(crate) texcoord_1: Option<usize>,
    pub(crate) color_0: Option<usize>,
    pub(crate) joints_0: Option<usize>,
    pub(crate) weights_0: Option<usize>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(crate) struct Skin {
    pub(crate) inverse_bind_matrices: Option<usize>,
    pub(crate) joints: Vec<usize>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Animation {
    pub(crate) name: String,
    pub(crate) channels: Vec<Channel>,
    pub(crate) samplers: Vec<Sampler>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Channel {
    pub(crate) sampler: usize,
    pub(crate) target: Target,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Target {
    pub(crate) node: Option<usize>,
    pub(crate) path: String,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Sampler {
    pub(crate) input: usize,
    pub(crate) output: usize,
    pub(crate) interpolation: String,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(crate) struct Accessor {
    pub(crate) buffer_view: Option<usize>,
    pub(crate) byte_offset: u64,
    pub(crate) component_type: u32,
    pub(crate) count: u64,
    #[serde(rename = "type")]
    pub(crate) shape: String,
    pub(crate) normalized: bool,
    pub(crate) sparse: Option<Sparse>,
}

/// Elements that replace others of an accessor.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Sparse {
    pub(crate) count: u64,
    pub(crate) indices: SparsePart,
    pub(crate) values: SparsePart,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(crate) struct SparsePart {
    pub(crate) buffer_view: usize,
    pub(crate) byte_offset: u64,
    pub(crate) component_type: u32,
}

impl Accessor {
    /// Which elements are replaced, and by what, as accessors of their own.
    pub(crate) fn replaced(&self) -> Option<[Self; 2]> {
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
pub(crate) struct BufferView {
    pub(crate) buffer: usize,
    pub(crate) byte_offset: u64,
    pub(crate) byte_length: u64,
    pub(crate) byte_stride: Option<u64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(crate) struct Buffer {
    pub(crate) uri: Option<String>,
    pub(crate) byte_length: u64,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(crate) struct Material {
    pub(crate) name: String,
    pub(crate) pbr_metallic_roughness: Finish,
    pub(crate) alpha_mode: String,
    pub(crate) alpha_cutoff: Option<f32>,
    pub(crate) double_sided: bool,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(crate) struct Finish {
    pub(crate) base_color_factor: Option<[f32; 4]>,
    pub(crate) base_color_texture: Option<TextureUse>,
    pub(crate) metallic_factor: Option<f32>,
    pub(crate) roughness_factor: Option<f32>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(crate) struct TextureUse {
    pub(crate) index: usize,
    pub(crate) tex_coord: u32,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Texture {
    pub(crate) source: Option<usize>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(crate) struct Image {
    pub(crate) name: Option<String>,
    pub(crate) uri: Option<String>,
    pub(crate) buffer_view: Option<usize>,
}

impl Root {
    pub(crate) fn parse(text: &[u8]) -> Result<Self, FigureError> {
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
pub(crate) fn at<'a, T>(list: &'a [T], index: usize, name: &str, place: &str) -> Result<&'a T, FigureError> {
    list.get(index).ok_or_else(|| data(place, format!("points to {name}[{index}], but there are {}", list.len())))
}
