//! What every value in a scene can do: name its kind, check its numbers, describe itself.
//!
//! The two macros in `parameters.rs` implement [`Value`] for groups and choices; this file does it
//! for numbers, text, vectors, lists and optional values. How a host sees and changes them: [`super::inspect`].

use serde::Serialize;
use serde::de::{Deserialize, DeserializeSeed, Deserializer, Error, Visitor};
use std::fmt;
use std::marker::PhantomData;

use super::error::{Problem, Trail};
use super::inspect::{self, Inspector, Number};
use super::reference::Reference;

/// What is known about one field of a group: enough for an error message, a slider or a page of documentation.
#[derive(Clone, Copy, Debug)]
pub struct FieldInfo {
    /// Name as written in a scene.
    pub name: &'static str,
    /// Unit as printed after a number; empty for pure numbers and for what is not a number.
    pub unit: &'static str,
    /// What the field means.
    pub doc: &'static str,
    /// Least and greatest allowed number, both included, for the number itself or for each component.
    pub range: Option<(f64, f64)>,
    /// Whether a scene must give it.
    pub required: bool,
    /// The kind of value, in words (Markdown).
    pub kind: fn() -> String,
    /// The default as it would be written in a scene.
    pub default: fn() -> String,
}

/// A value that can stand behind a field of a scene.
pub trait Value: Clone + Serialize + for<'de> Deserialize<'de> {
    /// The kind of value, in words (Markdown).
    fn kind() -> String;

    /// Adds this type, and every type inside it, to the reference page.
    fn describe(_reference: &mut Reference) {}

    /// The first of the value's own numbers that is not finite or lies outside `range`, as text.
    fn outside(&self, _range: Option<(f64, f64)>) -> Option<String> {
        None
    }

    /// Checks the numbers of the groups inside this value. `trail` leads to this value.
    ///
    /// # Errors
    /// The first number found outside its range.
    fn check(&self, _trail: &Trail) -> Result<(), Problem> {
        Ok(())
    }

    /// This value a `share` (0 to 1) of the way to another: its numbers with a fraction are in between, all else is as here.
    #[must_use]
    fn towards(&self, _other: &Self, _share: f64) -> Self {
        self.clone()
    }

    /// Hands this value to an inspector, as the field that `info` describes. Returns whether something has changed.
    fn inspect(&mut self, info: &FieldInfo, inspector: &mut dyn Inspector) -> bool;

    /// A value to begin with, its own numbers within `range`.
    fn initial(range: Option<(f64, f64)>) -> Self;

    /// Some value within `range`, for the round-trip test.
    #[cfg(test)]
    fn arbitrary(range: Option<(f64, f64)>, source: &mut super::tests::Source) -> Self;
}

/// Checks one field of a group: its own numbers, then the groups inside.
pub(super) fn check_field<T: Value>(value: &T, info: &FieldInfo, trail: &Trail) -> Result<(), Problem> {
    let trail = trail.clone().key(info.name);
    if let Some(number) = value.outside(info.range) {
        return Err(Problem::at(trail, out_of_range(info, &number)));
    }
    value.check(&trail)
}

/// "`speed` is 900 m/s, allowed 0 to 120".
fn out_of_range(info: &FieldInfo, number: &str) -> String {
    let space = if info.unit.is_empty() { "" } else { " " };
    let (name, unit) = (info.name, info.unit);
    match info.range {
        Some((low, high)) => {
            format!("`{name}` is {number}{space}{unit}, allowed {low} to {high}")
        }
        None => format!("`{name}` is {number}{space}{unit}, which is not a finite number"),
    }
}

/// Reads a value and checks its range before the reader moves on, so that the error points at the number.
pub(super) struct Checked<'a, T> {
    info: &'a FieldInfo,
    kind: PhantomData<T>,
}

impl<'a, T> Checked<'a, T> {
    pub(super) fn new(info: &'a FieldInfo) -> Self {
        Self { info, kind: PhantomData }
    }
}

impl<'de, T: Value> DeserializeSeed<'de> for Checked<'_, T> {
    type Value = T;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<T, D::Error> {
        let value = T::deserialize(deserializer)?;
        match value.outside(self.info.range) {
            Some(number) => Err(D::Error::custom(out_of_range(self.info, &number))),
            None => Ok(value),
        }
    }
}

/// A field's name as it stands in the text.
pub(super) struct Key(pub(super) String);

impl<'de> Deserialize<'de> for Key {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Name;
        impl Visitor<'_> for Name {
            type Value = Key;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a field name")
            }
            fn visit_str<E: Error>(self, name: &str) -> Result<Key, E> {
                Ok(Key(name.to_owned()))
            }
        }
        deserializer.deserialize_identifier(Name)
    }
}

macro_rules! number {
    ($($type:ty, $kind:literal $(, $towards:item)?;)*) => {$(
        impl Value for $type {
            fn kind() -> String {
                $kind.to_owned()
            }
            fn outside(&self, range: Option<(f64, f64)>) -> Option<String> {
                // The bounds are rounded to the field's own precision, so that a bound itself is always allowed.
                let (low, high) = range.unwrap_or((f64::MIN, f64::MAX));
                let (low, high) = (low as $type, high as $type);
                (!(*self >= low && *self <= high)).then(|| self.to_string())
            }
            $($towards)?
            fn inspect(&mut self, info: &FieldInfo, inspector: &mut dyn Inspector) -> bool {
                inspect::number(self, info, inspector)
            }
            fn initial(range: Option<(f64, f64)>) -> Self {
                Self::narrowed(inspect::least(range))
            }
            #[cfg(test)]
            fn arbitrary(range: Option<(f64, f64)>, source: &mut super::tests::Source) -> Self {
                let (low, high) = range.unwrap_or((-1e9, 1e9));
                match source.below(8) {
                    0 => low as $type,
                    1 => high as $type,
                    _ => (low + source.unit() * (high - low)) as $type,
                }
            }
        }
    )*};
}

number! {
    f32, "number", fn towards(&self, other: &Self, share: f64) -> Self {
        f64::from(*self).towards(&f64::from(*other), share) as f32
    };
    f64, "number", fn towards(&self, other: &Self, share: f64) -> Self {
        // So that the whole way leads to the other number, to the bit.
        if share < 1.0 { *self + (*other - *self) * share } else { *other }
    };
    u32, "whole number";
    i32, "whole number";
}

impl Value for bool {
    fn kind() -> String {
        "`true` or `false`".to_owned()
    }
    fn inspect(&mut self, info: &FieldInfo, inspector: &mut dyn Inspector) -> bool {
        inspector.flag(info, self)
    }
    fn initial(_: Option<(f64, f64)>) -> Self {
        false
    }
    #[cfg(test)]
    fn arbitrary(_: Option<(f64, f64)>, source: &mut super::tests::Source) -> Self {
        source.below(2) == 0
    }
}

impl Value for String {
    fn kind() -> String {
        "text".to_owned()
    }
    fn inspect(&mut self, info: &FieldInfo, inspector: &mut dyn Inspector) -> bool {
        inspector.text(info, self)
    }
    fn initial(_: Option<(f64, f64)>) -> Self {
        Self::new()
    }
    #[cfg(test)]
    fn arbitrary(_: Option<(f64, f64)>, source: &mut super::tests::Source) -> Self {
        let words = ["", "Weide", "a \"b\"\n", "\\#'\u{1f33e}", "// ) ]", "x: (", "\0"];
        words[source.below(words.len() as u64) as usize].to_owned()
    }
}

macro_rules! vector {
    ($($length:literal)*) => {$(
        impl<T: Number> Value for [T; $length]
        where
            Self: Serialize + for<'de> Deserialize<'de>,
        {
            fn kind() -> String {
                format!("({})", vec![T::kind(); $length].join(", "))
            }
            fn outside(&self, range: Option<(f64, f64)>) -> Option<String> {
                self.iter().find_map(|part| part.outside(range))
            }
            fn towards(&self, other: &Self, share: f64) -> Self {
                std::array::from_fn(|axis| self[axis].towards(&other[axis], share))
            }
            fn inspect(&mut self, info: &FieldInfo, inspector: &mut dyn Inspector) -> bool {
                inspect::vector(self, info, inspector)
            }
            fn initial(range: Option<(f64, f64)>) -> Self {
                [T::initial(range); $length]
            }
            #[cfg(test)]
            fn arbitrary(range: Option<(f64, f64)>, source: &mut super::tests::Source) -> Self {
                std::array::from_fn(|_| T::arbitrary(range, source))
            }
        }
    )*};
}

vector! { 2 3 }

impl<T: Value> Value for Vec<T> {
    fn kind() -> String {
        format!("list of {}", T::kind())
    }
    fn describe(reference: &mut Reference) {
        T::describe(reference);
    }
    fn outside(&self, range: Option<(f64, f64)>) -> Option<String> {
        self.iter().find_map(|element| element.outside(range))
    }
    fn check(&self, trail: &Trail) -> Result<(), Problem> {
        let mut elements = self.iter().enumerate();
        elements.try_for_each(|(index, element)| element.check(&trail.clone().index(index)))
    }
    fn inspect(&mut self, info: &FieldInfo, inspector: &mut dyn Inspector) -> bool {
        inspector.list(info, self)
    }
    fn initial(_: Option<(f64, f64)>) -> Self {
        Self::new()
    }
    #[cfg(test)]
    fn arbitrary(range: Option<(f64, f64)>, source: &mut super::tests::Source) -> Self {
        source.nested(|source, room| (0..room).map(|_| T::arbitrary(range, source)).collect())
    }
}

impl<T: Value> Value for Option<T> {
    fn kind() -> String {
        format!("{}, optional", T::kind())
    }
    fn describe(reference: &mut Reference) {
        T::describe(reference);
    }
    fn outside(&self, range: Option<(f64, f64)>) -> Option<String> {
        self.as_ref().and_then(|inner| inner.outside(range))
    }
    fn check(&self, trail: &Trail) -> Result<(), Problem> {
        self.as_ref().map_or(Ok(()), |inner| inner.check(trail))
    }
    fn towards(&self, other: &Self, share: f64) -> Self {
        match (self, other) {
            (Some(own), Some(other)) => Some(own.towards(other, share)),
            _ => self.clone(),
        }
    }
    fn inspect(&mut self, info: &FieldInfo, inspector: &mut dyn Inspector) -> bool {
        inspector.optional(info, self)
    }
    fn initial(_: Option<(f64, f64)>) -> Self {
        None
    }
    #[cfg(test)]
    fn arbitrary(range: Option<(f64, f64)>, source: &mut super::tests::Source) -> Self {
        (source.below(2) == 0).then(|| T::arbitrary(range, source))
    }
}
