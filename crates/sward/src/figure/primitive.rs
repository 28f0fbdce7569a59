//! Triangles of a primitive, whatever it stores them as.

use super::container::Opened;
use super::error::{FigureError, data};
use super::json::Primitive;

impl Opened<'_> {
    /// Corners of the triangles of a primitive of `count` vertices: strips and fans are opened, points and lines left out. At most `most`
    /// indices are read.
    pub(crate) fn corners(&self, primitive: &Primitive, count: usize, most: u64, place: &str) -> Result<Vec<[u32; 3]>, FigureError> {
        let list: Vec<u32> = match primitive.indices {
            Some(indices) => self.integers::<1>(indices, most, place)?.into_flattened(),
            None => (0..count as u32).collect(),
        };
        if let Some(index) = list.iter().find(|index| **index as usize >= count) {
            return Err(data(place, format!("has an index {index}, but {count} vertices")));
        }
        Ok(match primitive.mode.unwrap_or(4) {
            4 => list.as_chunks::<3>().0.to_vec(),
            5 => list.windows(3).enumerate().map(|(k, t)| if k % 2 == 0 { [t[0], t[1], t[2]] } else { [t[1], t[0], t[2]] }).collect(),
            6 => list.windows(2).skip(1).map(|pair| [list[0], pair[0], pair[1]]).collect(),
            _ => Vec::new(),
        })
    }
}

pub(crate) fn same_length(found: usize, expected: usize, what: &str, place: &str) -> Result<(), FigureError> {
    if found == expected { Ok(()) } else { Err(data(format!("{place}.{what}"), format!("has {found} elements for {expected} vertices"))) }
}
