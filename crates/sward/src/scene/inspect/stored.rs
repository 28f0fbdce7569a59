//! How lists, optional values, numbers and vectors are handed to an inspector.

use super::{Inspector, List, NumberKind, Optional};
use crate::scene::{FieldInfo, Value};

impl<T: Value> List for Vec<T> {
    fn length(&self) -> usize {
        self.len()
    }

    fn add(&mut self, info: &FieldInfo) {
        self.push(T::initial(info.range));
    }

    fn remove(&mut self, index: usize) -> bool {
        let there = index < self.len();
        if there {
            Self::remove(self, index);
        }
        there
    }

    fn swap(&mut self, one: usize, other: usize) -> bool {
        let there = one < self.len() && other < self.len();
        if there {
            self.as_mut_slice().swap(one, other);
        }
        there
    }

    fn inspect_element(&mut self, index: usize, info: &FieldInfo, inspector: &mut dyn Inspector) -> bool {
        self.get_mut(index).is_some_and(|element| element.inspect(info, inspector))
    }
}

impl<T: Value> Optional for Option<T> {
    fn is_present(&self) -> bool {
        self.is_some()
    }

    fn set_present(&mut self, present: bool, info: &FieldInfo) -> bool {
        let changed = present != self.is_some();
        if changed {
            *self = present.then(|| T::initial(info.range));
        }
        changed
    }

    fn write(&mut self, text: &str) -> bool {
        let read = crate::scene::options().from_str(text).ok();
        let sound = read.is_some();
        if sound {
            *self = read;
        }
        sound
    }

    fn inspect_inside(&mut self, info: &FieldInfo, inspector: &mut dyn Inspector) -> bool {
        self.as_mut().is_some_and(|value| value.inspect(info, inspector))
    }
}

/// A number that can stand in a scene.
pub trait Number: Value + Copy {
    /// What it is.
    const KIND: NumberKind;

    /// As the widest of them; exact.
    fn widened(self) -> f64;

    /// The nearest number of this kind.
    fn narrowed(number: f64) -> Self;
}

macro_rules! numbers {
    ($($type:ty, $kind:ident, $nearest:expr;)*) => {$(
        impl Number for $type {
            const KIND: NumberKind = NumberKind::$kind;

            fn widened(self) -> f64 {
                f64::from(self)
            }

            fn narrowed(number: f64) -> Self {
                let nearest: fn(f64) -> f64 = $nearest;
                nearest(number) as $type
            }
        }
    )*};
}

numbers! {
    f32, Single, |number| number;
    f64, Double, |number| number;
    u32, Natural, f64::round;
    i32, Integer, f64::round;
}

/// The number within a range that is nearest to 0.
pub(in crate::scene) fn least(range: Option<(f64, f64)>) -> f64 {
    match range {
        Some((low, _)) if low > 0.0 => low,
        Some((_, high)) if high < 0.0 => high,
        _ => 0.0,
    }
}

/// Hands a number to an inspector.
pub(in crate::scene) fn number<T: Number>(value: &mut T, info: &FieldInfo, inspector: &mut dyn Inspector) -> bool {
    let mut wide = value.widened();
    let changed = inspector.number(info, T::KIND, &mut wide);
    if changed {
        *value = T::narrowed(wide);
    }
    changed
}

/// Hands a vector to an inspector.
pub(in crate::scene) fn vector<T: Number, const LENGTH: usize>(
    value: &mut [T; LENGTH],
    info: &FieldInfo,
    inspector: &mut dyn Inspector,
) -> bool {
    let mut wide = value.map(T::widened);
    let changed = inspector.vector(info, T::KIND, &mut wide);
    if changed {
        *value = wide.map(T::narrowed);
    }
    changed
}
