//! What can be wrong with a glTF file.

use thiserror::Error;

/// Why a glTF file could not become a body.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum FigureError {
    /// The file is not glTF 2.0, or cut off.
    #[error("not a whole glTF 2.0 file: {0}")]
    Container(String),
    /// The JSON part says something it must not.
    #[error("its JSON is not glTF 2.0: {0}")]
    Json(String),
    /// The file needs something that is not read here.
    #[error("it needs the glTF extension `{}`, which sward does not read; {}", .0, way_out(.0))]
    Extension(String),
    /// Numbers that point nowhere, or data that does not fit.
    #[error("{place} {what}")]
    Data {
        /// Where in the JSON, like `accessors[3]`.
        place: String,
        /// What is wrong there.
        what: String,
    },
    /// A texture that cannot be decoded.
    #[error("the texture {image} {what}; export it with PNG or JPEG textures of at most 8192 x 8192 pixels")]
    Texture {
        /// Which, by number and, if it has one, name: `images[3] "wood"`.
        image: String,
        /// What is wrong with it.
        what: String,
    },
    /// There is nothing to collide with.
    #[error("there are no triangles in its scene; export meshes, not only cameras, lights or curves")]
    NoTriangles,
    /// More than is read.
    #[error("it has {found} {what}, at most {most} are read; {instead}")]
    TooMany {
        /// Of what.
        what: &'static str,
        /// How many there are.
        found: u64,
        /// How many there may be.
        most: u64,
        /// What to do about it.
        instead: &'static str,
    },
    /// There is no clip of that name.
    #[error("no clip is called `{asked}`; {known}")]
    Clip {
        /// What the scene asks for.
        asked: String,
        /// What there is, in words.
        known: String,
    },
    /// The body is far too small or large.
    #[error("as scaled, the body is {size} m across, allowed 0.01 to 200 m; type scale: {scale}")]
    Size {
        /// Longest side, m.
        size: String,
        /// A factor that would do.
        scale: String,
    },
}

/// What to do about an extension that a file requires.
fn way_out(extension: &str) -> &'static str {
    match extension {
        "KHR_draco_mesh_compression" => {
            "export it without compression (Blender: leave Compression off), or type: gltf-transform copy in.glb out.glb"
        }
        "EXT_meshopt_compression" | "KHR_meshopt_compression" => {
            "export it without compression (gltfpack: leave out -c), or type: gltf-transform copy in.glb out.glb"
        }
        "KHR_texture_basisu" | "EXT_texture_webp" | "EXT_texture_avif" => "export it with PNG or JPEG textures",
        _ => "export it without",
    }
}

pub(crate) fn data(place: impl Into<String>, what: impl Into<String>) -> FigureError {
    FigureError::Data { place: place.into(), what: what.into() }
}
