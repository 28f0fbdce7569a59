//! Planes of numbers in a saved state: little-endian bytes, which on almost every machine are those in memory, so that nothing is copied on the way.

use std::borrow::Cow;
use std::fmt;

use serde::de::{Deserialize, Deserializer, Error, Visitor};
use serde::ser::{Serialize, Serializer};

/// Words of 32 bits, one after another.
pub(super) struct Words<'a>(Cow<'a, [u8]>);

impl<'a> Words<'a> {
    pub(super) fn of_numbers(numbers: &'a [f32]) -> Self {
        Self(little_endian(numbers, |number| number.to_le_bytes()))
    }

    pub(super) fn of_words(words: &'a [u32]) -> Self {
        Self(little_endian(words, |word| word.to_le_bytes()))
    }

    pub(super) fn len(&self) -> usize {
        self.0.len() / 4
    }

    pub(super) fn numbers(&self) -> impl ExactSizeIterator<Item = f32> {
        self.words().map(f32::from_bits)
    }

    pub(super) fn words(&self) -> impl ExactSizeIterator<Item = u32> {
        self.0.as_chunks().0.iter().map(|word| u32::from_le_bytes(*word))
    }
}

fn little_endian<T: bytemuck::Pod>(values: &[T], bytes: impl Fn(&T) -> [u8; 4]) -> Cow<'_, [u8]> {
    if cfg!(target_endian = "little") { bytemuck::cast_slice(values).into() } else { values.iter().flat_map(bytes).collect() }
}

impl Serialize for Words<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_bytes(&self.0)
    }
}

impl<'de: 'a, 'a> Deserialize<'de> for Words<'a> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Bytes;
        impl<'de> Visitor<'de> for Bytes {
            type Value = Words<'de>;

            fn expecting(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
                formatter.write_str("words of four bytes")
            }

            fn visit_borrowed_bytes<E: Error>(self, bytes: &'de [u8]) -> Result<Self::Value, E> {
                if bytes.len().is_multiple_of(4) { Ok(Words(bytes.into())) } else { Err(E::invalid_length(bytes.len(), &self)) }
            }
        }
        deserializer.deserialize_bytes(Bytes)
    }
}
