//! A grown plant as a `.glb`: one mesh, a primitive for each finish.
//!
//! glTF 2.0 specification, §4.4 and §5. Long lists are written as they are, without a second copy.

use std::io::{Error, ErrorKind, Result, Write};

use serde_json::{Value, json};

use super::Kind;
use super::grow::{Grown, MeshVertex, Piece};

/// Vertices that are put in order at a time.
const AT_ONCE: usize = 4096;

/// The JSON, and how long the binary chunk is.
fn head(grown: &Grown) -> (Value, u64) {
    let (mut views, mut accessors, mut primitives, mut materials) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let mut offset = 0;
    for (number, Piece { finish, vertices, triangles }) in grown.pieces.iter().enumerate() {
        let mut accessor = |bytes: usize, target: u32, more: Value| {
            views.push(json!({"buffer": 0, "byteOffset": offset, "byteLength": bytes, "target": target}));
            offset += bytes as u64;
            let mut accessor = json!({"bufferView": views.len() - 1});
            if let (Some(own), Value::Object(more)) = (accessor.as_object_mut(), more) {
                own.extend(more);
            }
            accessors.push(accessor);
            accessors.len() - 1
        };
        let (mut low, mut high) = ([f32::MAX; 3], [f32::MIN; 3]);
        for (axis, part) in vertices.iter().flat_map(|vertex| vertex.position.into_iter().enumerate()) {
            low[axis] = if part < low[axis] { part } else { low[axis] };
            high[axis] = if part > high[axis] { part } else { high[axis] };
        }
        let count = vertices.len();
        let vector = |shape: &str| json!({"componentType": 5126, "count": count, "type": shape});
        let mut bounded = vector("VEC3");
        bounded["min"] = json!(low);
        bounded["max"] = json!(high);
        let position = accessor(12 * count, 34962, bounded);
        let normal = accessor(12 * count, 34962, vector("VEC3"));
        let uv = accessor(8 * count, 34962, vector("VEC2"));
        let indices = accessor(12 * triangles.len(), 34963, json!({"componentType": 5125, "count": 3 * triangles.len(), "type": "SCALAR"}));
        let attributes = json!({"POSITION": position, "NORMAL": normal, "TEXCOORD_0": uv});
        primitives.push(json!({"attributes": attributes, "indices": indices, "material": number}));
        let [red, green, blue] = finish.colour;
        let roughness = if finish.kind == Kind::Leaf { 0.6 } else { 0.9 };
        materials.push(json!({"name": finish.name, "doubleSided": finish.two_sided, "pbrMetallicRoughness":
            {"baseColorFactor": [red, green, blue, 1.0], "metallicFactor": 0.0, "roughnessFactor": roughness}}));
    }
    let head = json!({"asset": {"version": "2.0", "generator": concat!("sward ", env!("CARGO_PKG_VERSION"))}, "scene": 0,
        "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": "plant"}], "meshes": [{"primitives": primitives}],
        "materials": materials, "accessors": accessors, "bufferViews": views, "buffers": [{"byteLength": offset}]});
    (head, offset)
}

/// One attribute of all vertices.
fn list<const N: usize>(out: &mut impl Write, vertices: &[MeshVertex], pick: impl Fn(&MeshVertex) -> [f32; N]) -> Result<()> {
    let mut bytes = Vec::with_capacity(4 * N * AT_ONCE);
    for vertices in vertices.chunks(AT_ONCE) {
        bytes.clear();
        vertices.iter().flat_map(&pick).for_each(|part| bytes.extend_from_slice(&part.to_le_bytes()));
        out.write_all(&bytes)?;
    }
    Ok(())
}

impl Grown {
    /// Writes it as a `.glb`. Reading it gives the same specimen as [`Self::specimen`].
    ///
    /// # Errors
    /// Those of `out`, and a plant of more than 4 GiB, which is more than the format holds.
    pub fn write(&self, out: &mut impl Write) -> Result<()> {
        let (head, long) = head(self);
        let mut text = head.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let whole = 12 + 8 + text.len() as u64 + 8 + long;
        let Ok(whole) = u32::try_from(whole) else {
            return Err(Error::new(ErrorKind::InvalidInput, format!("the plant takes {whole} bytes, but a .glb holds 4 GiB at most")));
        };
        let words = |words: &[u32]| words.iter().flat_map(|word| word.to_le_bytes()).collect::<Vec<u8>>();
        out.write_all(b"glTF")?;
        out.write_all(&words(&[2, whole, text.len() as u32, 0x4E4F_534A]))?;
        out.write_all(&text)?;
        out.write_all(&words(&[long as u32, 0x004E_4942]))?;
        for piece in &self.pieces {
            list(out, &piece.vertices, |vertex| vertex.position)?;
            list(out, &piece.vertices, |vertex| vertex.normal)?;
            list(out, &piece.vertices, |vertex| vertex.uv)?;
            for triangles in piece.triangles.chunks(AT_ONCE) {
                out.write_all(&words(triangles.as_flattened()))?;
            }
        }
        Ok(())
    }
}
