//! A walk over every parameter of a scene, which may change each: for sliders in a window, and for tests.
//!
//! A host implements [`Inspector`] and hands it to [`Group::inspect_fields`] of a scene. It hears of every field in the order of declaration, with
//! what is known about it. Whatever has something inside is handed over whole, so the host decides whether and when to go in: it folds a group by
//! not going in, and inside a closure it may go in with another inspector than itself. Nothing is allocated on the way.
//!
//! ```
//! use sward::scene::{FieldInfo, Scene, inspect::{Choice, Group, Inspector, List, NumberKind, Optional}};
//!
//! /// Doubles every speed.
//! struct Faster;
//!
//! impl Inspector for Faster {
//!     fn number(&mut self, info: &FieldInfo, _: NumberKind, number: &mut f64) -> bool {
//!         let speed = info.name == "speed";
//!         *number *= if speed { 2.0 } else { 1.0 };
//!         speed
//!     }
//!     fn vector(&mut self, _: &FieldInfo, _: NumberKind, _: &mut [f64]) -> bool { false }
//!     fn flag(&mut self, _: &FieldInfo, _: &mut bool) -> bool { false }
//!     fn text(&mut self, _: &FieldInfo, _: &mut String) -> bool { false }
//!     fn list(&mut self, info: &FieldInfo, list: &mut dyn List) -> bool {
//!         (0..list.length()).fold(false, |changed, index| list.inspect_element(index, info, self) | changed)
//!     }
//!     fn optional(&mut self, info: &FieldInfo, optional: &mut dyn Optional) -> bool { optional.inspect_inside(info, self) }
//!     fn group(&mut self, _: &FieldInfo, group: &mut dyn Group) -> bool { group.inspect_fields(self) }
//!     fn choice(&mut self, info: &FieldInfo, choice: &mut dyn Choice) -> bool { choice.inspect_inside(info, self) }
//! }
//!
//! let text = "(version: 1, interactors: [(shape: Truck, path: Circle(speed: 4))])";
//! let mut scene = Scene::parse(text, "round.ron")?;
//! assert!(scene.inspect_fields(&mut Faster));
//! assert!(scene.to_ron().contains("speed: 8.0"));
//! # Ok::<(), sward::scene::SceneError>(())
//! ```

mod stored;

pub use stored::Number;
pub(super) use stored::{least, number, vector};

use super::value::FieldInfo;

/// What a host does with the values of a scene. Every method returns whether it has changed something.
///
/// `info` is that of the field in which the value stands: elements of lists, present optional values and the groups behind choices get that of
/// their field. Ranges are for the host to keep to: what is set is not checked before [`super::Scene::validate`].
pub trait Inspector {
    /// A number. What is set counts only where the answer is `true`.
    fn number(&mut self, info: &FieldInfo, kind: NumberKind, number: &mut f64) -> bool;

    /// Two or three numbers, to each of which the range applies. What is set counts only where the answer is `true`.
    fn vector(&mut self, info: &FieldInfo, kind: NumberKind, parts: &mut [f64]) -> bool;

    /// Yes or no.
    fn flag(&mut self, info: &FieldInfo, flag: &mut bool) -> bool;

    /// Text.
    fn text(&mut self, info: &FieldInfo, text: &mut String) -> bool;

    /// A list.
    fn list(&mut self, info: &FieldInfo, list: &mut dyn List) -> bool;

    /// A value that may be absent.
    fn optional(&mut self, info: &FieldInfo, optional: &mut dyn Optional) -> bool;

    /// A group of fields.
    fn group(&mut self, info: &FieldInfo, group: &mut dyn Group) -> bool;

    /// A choice between names, some with a group behind them.
    fn choice(&mut self, info: &FieldInfo, choice: &mut dyn Choice) -> bool;
}

/// What a number is stored as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NumberKind {
    /// `f32`.
    Single,
    /// `f64`.
    Double,
    /// `u32`.
    Natural,
    /// `i32`.
    Integer,
}

impl NumberKind {
    /// Whether it has no fraction.
    #[must_use]
    pub fn is_whole(self) -> bool {
        matches!(self, Self::Natural | Self::Integer)
    }

    /// Significant decimal digits that it keeps.
    #[must_use]
    pub fn digits(self) -> u32 {
        match self {
            Self::Single => f32::DIGITS,
            Self::Double => f64::DIGITS,
            Self::Natural | Self::Integer => 10,
        }
    }

    /// Least and greatest number that it can be.
    #[must_use]
    pub fn bounds(self) -> (f64, f64) {
        match self {
            Self::Single => (f64::from(f32::MIN), f64::from(f32::MAX)),
            Self::Double => (f64::MIN, f64::MAX),
            Self::Natural => (0.0, f64::from(u32::MAX)),
            Self::Integer => (f64::from(i32::MIN), f64::from(i32::MAX)),
        }
    }
}

/// A group of fields, as an [`Inspector`] sees it.
pub trait Group {
    /// Its name in the reference of the format.
    fn name(&self) -> &'static str;

    /// What it is.
    fn doc(&self) -> &'static str;

    /// What is known about its fields, in the order of declaration.
    fn fields(&self) -> &'static [FieldInfo];

    /// Hands every field to an inspector, in order. Returns whether one of them has changed.
    fn inspect_fields(&mut self, inspector: &mut dyn Inspector) -> bool;

    /// Hands one field to an inspector, by its name; nothing if it has none of that name.
    fn inspect_field(&mut self, name: &str, inspector: &mut dyn Inspector) -> bool;
}

/// What is known about a name an author can choose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VariantInfo {
    /// As written in a scene.
    pub name: &'static str,
    /// What it means.
    pub doc: &'static str,
    /// Name of the group behind it; empty where there is none.
    pub group: &'static str,
}

/// A choice, as an [`Inspector`] sees it.
pub trait Choice {
    /// Its name in the reference of the format.
    fn name(&self) -> &'static str;

    /// What is chosen between.
    fn doc(&self) -> &'static str;

    /// What there is to choose from.
    fn variants(&self) -> &'static [VariantInfo];

    /// Which of them is chosen.
    fn chosen(&self) -> usize;

    /// Chooses another one, with the defaults of the group behind it. What is chosen already stays as it is, and so it does if there is no such
    /// variant. Returns whether something has changed.
    fn choose(&mut self, index: usize) -> bool;

    /// Hands the group behind the chosen name to an inspector, if there is one.
    fn inspect_inside(&mut self, info: &FieldInfo, inspector: &mut dyn Inspector) -> bool;
}

/// A list, as an [`Inspector`] sees it.
pub trait List {
    /// Elements.
    fn length(&self) -> usize;

    /// Adds an element at the end: a default one, its numbers within the range of the field.
    fn add(&mut self, info: &FieldInfo);

    /// Removes an element. Returns whether there was one.
    fn remove(&mut self, index: usize) -> bool;

    /// Two elements change places. Returns whether there are both.
    fn swap(&mut self, one: usize, other: usize) -> bool;

    /// Hands an element to an inspector, if there is one.
    fn inspect_element(&mut self, index: usize, info: &FieldInfo, inspector: &mut dyn Inspector) -> bool;
}

/// A value that may be absent, as an [`Inspector`] sees it. What holds while it is absent is said in the doc of its field: in most cases the
/// species' own, as [`super::Stand::resolve`] works it out.
pub trait Optional {
    /// Whether it is there.
    fn is_present(&self) -> bool;

    /// Takes it away, or puts a default one there, its numbers within the range of the field. Returns whether something has changed.
    fn set_present(&mut self, present: bool, info: &FieldInfo) -> bool;

    /// Puts a value there that is written as in a scene, such as one of `written()` of the species' values. Returns whether it could be read.
    fn write(&mut self, text: &str) -> bool;

    /// Hands the value to an inspector, if it is there.
    fn inspect_inside(&mut self, info: &FieldInfo, inspector: &mut dyn Inspector) -> bool;
}
