//! A specimen as bytes, and back.
//!
//! `SWARDPLANT`, format version (u32), key (u128), how long the head is (u32), the head (finishes, parts, sizes), then vertices, triangles and
//! texels as they lie in memory, and a sum over all before it (u128). On a machine that orders bytes otherwise the version reads otherwise, so
//! nothing is taken from there.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::{Finish, Kind, Order, Part, Picture, Size, Specimen, SpecimenError};
use crate::figure::container::{Opened, resolve};
use crate::store::Sum;

const MAGIC: &[u8; 10] = b"SWARDPLANT";
/// Raised with every change of what is stored, or of how it is made.
const VERSION: u32 = 1;

/// Why stored bytes are not the specimen looked for.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub enum StoredError {
    /// They are something else.
    #[error("this is no plant")]
    Other,
    /// They were written by another version.
    #[error("it has format version {0}")]
    Version(u32),
    /// They are of another file, rule or size.
    #[error("it belongs to another plant")]
    Key,
    /// They have changed since.
    #[error("it is damaged")]
    Damaged,
}

/// A finish: whether wood, colour, picture, cutoff, two-sided, name.
type Look = (bool, [f32; 3], Option<u64>, f32, bool, String);

/// What is not a long list.
#[derive(Serialize, Deserialize)]
struct Head {
    vertices: u64,
    triangles: u64,
    leaves: u32,
    low: [f32; 3],
    high: [f32; 3],
    /// First and one past the last triangle, finish.
    parts: Vec<(u32, u32, u64)>,
    finishes: Vec<Look>,
    pictures: Vec<[u32; 2]>,
}

/// The name a specimen is kept under.
pub(super) fn name(key: u128) -> String {
    format!("{key:032x}.plant")
}

/// A sum over all that goes into a specimen.
pub(super) fn key(bytes: &[u8], opened: &Opened<'_>, order: &Order) -> Result<u128, SpecimenError> {
    let mut sum = Sum::default();
    sum.bytes(MAGIC);
    sum.bytes(&VERSION.to_le_bytes());
    for list in [&order.rule.leaves, &order.rule.wood] {
        sum.bytes(&(list.len() as u64).to_le_bytes());
        list.iter().for_each(|name| sum.bytes(name.as_bytes()));
    }
    let (which, size) = match order.size {
        Size::Scale(scale) => (0, scale),
        Size::Height(height) => (1, height),
    };
    sum.bytes(&[which]);
    sum.bytes(&size.to_le_bytes());
    sum.bytes(bytes);
    let outside = |uri: &Option<String>| uri.as_ref().is_some_and(|uri| !uri.starts_with("data:"));
    for (buffer, bytes) in opened.root.buffers.iter().zip(&opened.buffers) {
        if outside(&buffer.uri) {
            sum.bytes(bytes);
        }
    }
    for (index, image) in opened.root.images.iter().enumerate() {
        if let Some(uri) = image.uri.as_ref().filter(|_| outside(&image.uri) && image.buffer_view.is_none()) {
            // One that no material uses may be missing.
            resolve(uri, opened.neighbour, &format!("images[{index}]")).iter().for_each(|bytes| sum.bytes(bytes));
        }
    }
    Ok(sum.value())
}

/// A specimen of this key as bytes.
pub(super) fn bytes(key: u128, specimen: &Specimen) -> Vec<u8> {
    let head = Head {
        vertices: specimen.vertices.len() as u64,
        triangles: specimen.triangles.len() as u64,
        leaves: specimen.leaves,
        low: specimen.low,
        high: specimen.high,
        parts: specimen.parts.iter().map(|part| (part.triangles.start, part.triangles.end, part.finish as u64)).collect(),
        finishes: specimen
            .finishes
            .iter()
            .map(|finish| {
                let Finish { kind, colour, picture, cutoff, two_sided, name } = finish;
                (*kind == Kind::Wood, *colour, picture.map(|picture| picture as u64), *cutoff, *two_sided, name.clone())
            })
            .collect(),
        pictures: specimen.pictures.iter().map(|picture| picture.size).collect(),
    };
    // Writing plain data to memory does not fail.
    let head = postcard::to_stdvec(&head).unwrap_or_default();
    let texels: usize = specimen.pictures.iter().map(|picture| 4 * picture.texels.len()).sum();
    let long = 32 * specimen.vertices.len() + 12 * specimen.triangles.len() + texels;
    let mut bytes = Vec::with_capacity(MAGIC.len() + 4 + 16 + 4 + head.len() + long + 16);
    bytes.extend_from_slice(MAGIC);
    bytes.extend_from_slice(&VERSION.to_ne_bytes());
    bytes.extend_from_slice(&key.to_le_bytes());
    bytes.extend_from_slice(&(head.len() as u32).to_le_bytes());
    bytes.extend_from_slice(&head);
    bytes.extend_from_slice(bytemuck::cast_slice(&specimen.vertices));
    bytes.extend_from_slice(bytemuck::cast_slice(&specimen.triangles));
    specimen.pictures.iter().for_each(|picture| bytes.extend_from_slice(picture.texels.as_flattened()));
    let sum = checksum(&bytes);
    bytes.extend_from_slice(&sum.to_le_bytes());
    bytes
}

fn checksum(bytes: &[u8]) -> u128 {
    let mut sum = Sum::default();
    sum.bytes(bytes);
    sum.value()
}

/// Some elements from the front of bytes.
fn taken<T: bytemuck::Pod>(rest: &mut &[u8], count: u64) -> Option<Vec<T>> {
    let (own, others) = rest.split_at_checked(usize::try_from(count).ok()?.checked_mul(size_of::<T>())?)?;
    *rest = others;
    let mut list = vec![T::zeroed(); count as usize];
    bytemuck::cast_slice_mut::<T, u8>(&mut list).copy_from_slice(own);
    Some(list)
}

/// The specimen of this key, from bytes.
pub(super) fn read(key: u128, bytes: &[u8]) -> Result<Specimen, StoredError> {
    let (magic, rest) = bytes.split_first_chunk::<10>().ok_or(StoredError::Other)?;
    if magic != MAGIC {
        return Err(StoredError::Other);
    }
    let (version, rest) = rest.split_first_chunk::<4>().ok_or(StoredError::Damaged)?;
    let version = u32::from_ne_bytes(*version);
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
    let rest = rest.strip_suffix(sum).ok_or(StoredError::Damaged)?;
    parsed(rest).filter(sound).ok_or(StoredError::Damaged)
}

fn parsed(rest: &[u8]) -> Option<Specimen> {
    let (length, rest) = rest.split_first_chunk::<4>()?;
    let (head, mut rest) = rest.split_at_checked(u32::from_le_bytes(*length) as usize)?;
    let head: Head = postcard::from_bytes(head).ok()?;
    let vertices = taken(&mut rest, head.vertices)?;
    let triangles = taken(&mut rest, head.triangles)?;
    let mut pictures = Vec::new();
    for size in head.pictures {
        pictures.push(Picture { size, texels: taken(&mut rest, u64::from(size[0]) * u64::from(size[1]))? });
    }
    let finishes = head.finishes.into_iter().map(|(wood, colour, picture, cutoff, two_sided, name)| {
        let kind = if wood { Kind::Wood } else { Kind::Leaf };
        Finish { kind, colour, picture: picture.map(|picture| picture as usize), cutoff, two_sided, name }
    });
    let parts = head.parts.into_iter().map(|(start, end, finish)| Part { triangles: start..end, finish: finish as usize }).collect();
    let whole = Specimen {
        vertices,
        triangles,
        parts,
        finishes: finishes.collect(),
        pictures,
        leaves: head.leaves,
        low: head.low,
        high: head.high,
    };
    rest.is_empty().then_some(whole)
}

/// Whether all indices point at something.
fn sound(specimen: &Specimen) -> bool {
    let vertices = specimen.vertices.len();
    let (mut end, mut wood) = (0, false);
    for part in &specimen.parts {
        let Some(finish) = specimen.finishes.get(part.finish) else { return false };
        if part.triangles.start != end || part.triangles.end < end || wood && finish.kind == Kind::Leaf {
            return false;
        }
        (end, wood) = (part.triangles.end, finish.kind == Kind::Wood);
    }
    end as usize == specimen.triangles.len()
        && specimen.triangles.iter().flatten().all(|corner| (*corner as usize) < vertices)
        && specimen.finishes.iter().all(|finish| finish.picture.is_none_or(|picture| picture < specimen.pictures.len()))
}
