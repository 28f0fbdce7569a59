//! A volume of light as bytes, and where they are kept.
//!
//! `SWARDLIGHT`, format version (u32), key (u128), columns, rows, layers (u32), the texels as half-precision numbers, and a checksum of all
//! before it (u128); little-endian throughout. Key and checksum are FNV-1a of 128 bits: they find damage and what is out of date; nobody is kept
//! from forging a file in their own cache.

use half::f16;
use thiserror::Error;

use super::inputs::Inputs;
use crate::shading::volume::{FACES, Volume};

const MAGIC: &[u8; 10] = b"SWARDLIGHT";
/// Raised with every change of what is stored, or of how it is worked out.
const VERSION: u32 = 1;
/// Bytes before the texels.
const HEAD: usize = MAGIC.len() + 4 + 16 + 12;

/// The name a volume is kept under.
pub fn key_name(key: u128) -> String {
    format!("{key:032x}.light")
}

/// Why stored bytes are not the volume looked for.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub enum StoredError {
    /// They are something else.
    #[error("this is no volume of light")]
    Other,
    /// They were written by another version.
    #[error("it has format version {0}")]
    Version(u32),
    /// They are of another scene.
    #[error("it belongs to another scene")]
    Key,
    /// They have changed since.
    #[error("it is damaged")]
    Damaged,
}

/// FNV-1a of 128 bits.
pub(super) struct Hash(u128);

impl Hash {
    /// That of nothing but the version.
    pub(super) fn new() -> Self {
        let mut hash = Self(0x6c62_272e_07bb_0142_62b8_2175_6295_c58d);
        hash.bytes(MAGIC);
        hash.u32s(&[VERSION]);
        hash
    }

    fn bytes(&mut self, bytes: &[u8]) {
        self.0 = bytes.iter().fold(self.0, |hash, byte| (hash ^ u128::from(*byte)).wrapping_mul(0x0000_0000_0100_0000_0000_0000_0000_013b));
    }

    pub(super) fn u32s(&mut self, values: &[u32]) {
        values.iter().for_each(|value| self.bytes(&value.to_le_bytes()));
    }

    pub(super) fn f32s(&mut self, values: &[f32]) {
        values.iter().for_each(|value| self.bytes(&value.to_le_bytes()));
    }

    pub(super) fn f64s(&mut self, values: &[f64]) {
        values.iter().for_each(|value| self.bytes(&value.to_le_bytes()));
    }

    pub(super) fn value(&self) -> u128 {
        self.0
    }
}

fn checksum(bytes: &[u8]) -> u128 {
    let mut hash = Hash::new();
    hash.bytes(bytes);
    hash.value()
}

/// A volume whose inputs have this key, as bytes.
pub(super) fn bytes(key: u128, volume: &Volume) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(HEAD + volume.texels.len() * 8 + 16);
    bytes.extend_from_slice(MAGIC);
    bytes.extend_from_slice(&VERSION.to_le_bytes());
    bytes.extend_from_slice(&key.to_le_bytes());
    volume.size.iter().for_each(|side| bytes.extend_from_slice(&side.to_le_bytes()));
    volume.texels.iter().flatten().for_each(|value| bytes.extend_from_slice(&value.to_le_bytes()));
    let sum = checksum(&bytes);
    bytes.extend_from_slice(&sum.to_le_bytes());
    bytes
}

/// The volume of inputs that have this key, from bytes.
pub(super) fn read(inputs: &Inputs, key: u128, bytes: &[u8]) -> Result<Volume, StoredError> {
    let (magic, rest) = bytes.split_first_chunk::<10>().ok_or(StoredError::Other)?;
    if magic != MAGIC {
        return Err(StoredError::Other);
    }
    let (version, rest) = rest.split_first_chunk::<4>().ok_or(StoredError::Damaged)?;
    let version = u32::from_le_bytes(*version);
    if version != VERSION {
        return Err(StoredError::Version(version));
    }
    let (own, rest) = rest.split_first_chunk::<16>().ok_or(StoredError::Damaged)?;
    let (before, sum) = bytes.split_last_chunk::<16>().ok_or(StoredError::Damaged)?;
    if u128::from_le_bytes(*sum) != checksum(before) {
        return Err(StoredError::Damaged);
    }
    if u128::from_le_bytes(*own) != key {
        return Err(StoredError::Key);
    }
    let room = &inputs.room;
    let size: Vec<u8> = room.size.iter().flat_map(|side| side.to_le_bytes()).collect();
    let texels = rest.strip_prefix(&*size).and_then(|rest| rest.strip_suffix(sum)).ok_or(StoredError::Damaged)?;
    let count = room.columns() * room.size[2] as usize * FACES.len();
    if texels.len() != 8 * count {
        return Err(StoredError::Damaged);
    }
    let half = |bytes: &[u8; 2]| f16::from_le_bytes(*bytes);
    let texels = texels.as_chunks::<8>().0.iter().map(|texel| {
        let [a, b, c, d] = [0, 2, 4, 6].map(|at| half(&[texel[at], texel[at + 1]]));
        [a, b, c, d]
    });
    Ok(Volume { size: room.size, corner: room.corner, extent: room.extent(), height: room.height, texels: texels.collect() })
}
