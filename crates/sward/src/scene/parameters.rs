//! The macros that declare the groups and choices of the scene format.
//!
//! One declaration gives the Rust type, its default, reading with checked ranges, writing, and the
//! table that sliders and the reference page are made from, so that these cannot disagree.

/// Declares a group of named fields.
///
/// `name: Type = default, "unit" in low..=high, required;` — the range and `required` may be left out.
/// Numbers without a range must still be finite. Writing leaves out what equals the default.
macro_rules! parameters {
    (
        $(#[doc = $about:literal])+
        pub struct $Group:ident {
            $(
                $(#[doc = $doc:literal])+
                $field:ident: $type:ty = $default:expr, $unit:literal
                    $(in $low:literal..=$high:literal)? $(, $required:ident)?;
            )*
        }
    ) => {
        $(#[doc = $about])+
        #[derive(Clone, Debug, PartialEq)]
        pub struct $Group {
            $(
                $(#[doc = $doc])+
                #[doc = ""]
                #[doc = concat!(
                    $("Allowed `", stringify!($low), "` to `", stringify!($high), "`; ",)?
                    "default `", stringify!($default), "` ", $unit
                )]
                pub $field: $type,
            )*
        }

        impl $Group {
            /// What is known about each field, in the order of declaration.
            pub const FIELDS: &'static [$crate::scene::FieldInfo] = &[$(
                $crate::scene::FieldInfo {
                    name: stringify!($field),
                    unit: $unit,
                    doc: concat!($($doc),+).trim_ascii(),
                    range: parameters!(@range $($low, $high)?),
                    required: parameters!(@required $($required)?),
                    kind: <$type as $crate::scene::Value>::kind,
                    default: || {
                        let default: $type = $default;
                        $crate::scene::text_of(&default)
                    },
                },
            )*];

            /// Each field with its value as it would be written in a scene.
            #[must_use]
            pub fn written(&self) -> Vec<(&'static $crate::scene::FieldInfo, String)> {
                let values = [$($crate::scene::text_of(&self.$field)),*];
                Self::FIELDS.iter().zip(values).collect()
            }
        }

        impl Default for $Group {
            fn default() -> Self {
                Self { $($field: $default),* }
            }
        }

        impl serde::Serialize for $Group {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                use serde::ser::SerializeStruct;
                let usual = Self::default();
                let mut written = 0;
                $(
                    let $field = parameters!(@required $($required)?) || self.$field != usual.$field;
                    written += usize::from($field);
                )*
                let mut group = serializer.serialize_struct(stringify!($Group), written)?;
                $(
                    if $field {
                        group.serialize_field(stringify!($field), &self.$field)?;
                    } else {
                        group.skip_field(stringify!($field))?;
                    }
                )*
                group.end()
            }
        }

        impl<'de> serde::Deserialize<'de> for $Group {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                struct Reader;
                impl<'de> serde::de::Visitor<'de> for Reader {
                    type Value = $Group;

                    fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
                        f.write_str(concat!("(…) of `", stringify!($Group), "`"))
                    }

                    fn visit_map<A: serde::de::MapAccess<'de>>(self, mut map: A) -> Result<$Group, A::Error> {
                        use serde::de::Error;
                        $(let mut $field: Option<$type> = None;)*
                        while let Some(key) = map.next_key::<$crate::scene::value::Key>()? {
                            let known = $Group::FIELDS.iter().find(|info| info.name == key.0);
                            let Some(info) = known else {
                                return Err(A::Error::unknown_field(&key.0, NAMES));
                            };
                            $(if info.name == stringify!($field) {
                                if $field.is_some() {
                                    return Err(A::Error::duplicate_field(stringify!($field)));
                                }
                                $field = Some(map.next_value_seed($crate::scene::value::Checked::new(info))?);
                            })*
                        }
                        Ok($Group {$(
                            $field: match $field {
                                Some(given) => given,
                                None if parameters!(@required $($required)?) => {
                                    return Err(A::Error::missing_field(stringify!($field)));
                                }
                                None => $default,
                            },
                        )*})
                    }
                }
                const NAMES: &[&str] = &[$(stringify!($field)),*];
                deserializer.deserialize_struct(stringify!($Group), NAMES, Reader)
            }
        }

        impl $crate::scene::inspect::Group for $Group {
            fn name(&self) -> &'static str {
                stringify!($Group)
            }

            fn doc(&self) -> &'static str {
                concat!($($about),+).trim_ascii()
            }

            fn fields(&self) -> &'static [$crate::scene::FieldInfo] {
                Self::FIELDS
            }

            fn inspect_fields(&mut self, inspector: &mut dyn $crate::scene::Inspector) -> bool {
                let (mut fields, mut changed) = (Self::FIELDS.iter(), false);
                $(
                    if let Some(info) = fields.next() {
                        changed |= <$type as $crate::scene::Value>::inspect(&mut self.$field, info, inspector);
                    }
                )*
                changed
            }

            fn inspect_field(&mut self, name: &str, inspector: &mut dyn $crate::scene::Inspector) -> bool {
                let Some(info) = Self::FIELDS.iter().find(|info| info.name == name) else { return false };
                $(if name == stringify!($field) {
                    return <$type as $crate::scene::Value>::inspect(&mut self.$field, info, inspector);
                })*
                false
            }
        }

        impl $crate::scene::Value for $Group {
            fn kind() -> String {
                $crate::scene::reference::link(stringify!($Group))
            }

            fn describe(reference: &mut $crate::scene::Reference) {
                if reference.group(stringify!($Group), concat!($($about),+), Self::FIELDS) {
                    $(<$type as $crate::scene::Value>::describe(reference);)*
                }
            }

            fn check(&self, trail: &$crate::scene::error::Trail) -> Result<(), $crate::scene::error::Problem> {
                let mut fields = Self::FIELDS.iter();
                $(
                    if let Some(info) = fields.next() {
                        $crate::scene::value::check_field(&self.$field, info, trail)?;
                    }
                )*
                Ok(())
            }

            fn towards(&self, other: &Self, share: f64) -> Self {
                Self { $($field: <$type as $crate::scene::Value>::towards(&self.$field, &other.$field, share)),* }
            }

            fn inspect(&mut self, info: &$crate::scene::FieldInfo, inspector: &mut dyn $crate::scene::Inspector) -> bool {
                inspector.group(info, self)
            }

            fn initial(_: Option<(f64, f64)>) -> Self {
                Self::default()
            }

            #[cfg(test)]
            fn arbitrary(_: Option<(f64, f64)>, source: &mut $crate::scene::tests::Source) -> Self {
                let mut fields = Self::FIELDS.iter();
                Self {$(
                    $field: <$type as $crate::scene::Value>::arbitrary(
                        fields.next().and_then(|info| info.range),
                        source,
                    ),
                )*}
            }
        }
    };
    (@range) => { None };
    (@range $low:literal, $high:literal) => { Some(($low as f64, $high as f64)) };
    (@required) => { false };
    (@required required) => { true };
}

/// Declares a group whose defaults come from the species, and a second one in which each field may be left out.
///
/// `extra` fields exist only in the overrides: other ways of saying the same thing.
macro_rules! parameters_with_overrides {
    (
        $(#[doc = $about:literal])+
        pub struct $Group:ident, $Overrides:ident {
            $(
                $(#[doc = $doc:literal])+
                $field:ident: $type:ty = $default:expr, $unit:literal $(in $low:literal..=$high:literal)?;
            )*
        }
        extra {
            $(
                $(#[doc = $extra_doc:literal])+
                $extra:ident: $extra_type:ty, $extra_unit:literal $(in $extra_low:literal..=$extra_high:literal)?;
            )*
        }
    ) => {
        parameters! {
            $(#[doc = $about])+
            pub struct $Group {
                $(
                    $(#[doc = $doc])+
                    $field: $type = $default, $unit $(in $low..=$high)?;
                )*
            }
        }

        parameters! {
            $(#[doc = $about])+
            #[doc = " What is left out comes from the species."]
            pub struct $Overrides {
                $(
                    $(#[doc = $doc])+
                    $field: Option<$type> = None, $unit $(in $low..=$high)?;
                )*
                $(
                    $(#[doc = $extra_doc])+
                    $extra: Option<$extra_type> = None, $extra_unit $(in $extra_low..=$extra_high)?;
                )*
            }
        }

        impl $Group {
            /// These values, except where `overrides` gives another.
            #[must_use]
            pub fn with(&self, overrides: &$Overrides) -> Self {
                Self {$(
                    $field: overrides.$field.clone().unwrap_or_else(|| self.$field.clone()),
                )*}
            }

            /// Overrides that say all of it.
            #[must_use]
            pub fn said(&self) -> $Overrides {
                $Overrides { $($field: Some(self.$field.clone()),)* $($extra: None,)* }
            }
        }
    };
}

/// Declares a choice between names (`Direct`) and groups (`Image(path: "x.png")`).
macro_rules! choices {
    (
        $(#[doc = $about:literal])+
        pub enum $Choice:ident {
            $(
                $(#[doc = $doc:literal])+
                $variant:ident $(($inner:ident))?,
            )+
        }
    ) => {
        $(#[doc = $about])+
        #[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
        pub enum $Choice {
            $(
                $(#[doc = $doc])+
                $variant $(($inner))?,
            )+
        }

        impl $Choice {
            /// The names an author can choose from.
            pub const NAMES: &'static [&'static str] = &[$(stringify!($variant)),+];

            /// What is known about each of them.
            pub const VARIANTS: &'static [$crate::scene::inspect::VariantInfo] = &[$(
                $crate::scene::inspect::VariantInfo {
                    name: stringify!($variant),
                    doc: concat!($($doc),+).trim_ascii(),
                    group: concat!("" $(, stringify!($inner))?),
                },
            )+];

            /// Each of them with the defaults of the group behind it.
            const FRESH: &'static [fn() -> Self] = &[$(|| Self::$variant $((<$inner as Default>::default()))?,)+];
        }

        impl $crate::scene::inspect::Choice for $Choice {
            fn name(&self) -> &'static str {
                stringify!($Choice)
            }

            fn doc(&self) -> &'static str {
                concat!($($about),+).trim_ascii()
            }

            fn variants(&self) -> &'static [$crate::scene::inspect::VariantInfo] {
                Self::VARIANTS
            }

            fn chosen(&self) -> usize {
                let chosen = [$(matches!(self, Self::$variant { .. })),+];
                chosen.iter().position(|chosen| *chosen).unwrap_or(0)
            }

            fn choose(&mut self, index: usize) -> bool {
                match Self::FRESH.get(index) {
                    Some(fresh) if index != self.chosen() => *self = fresh(),
                    _ => return false,
                }
                true
            }

            fn inspect_inside(&mut self, info: &$crate::scene::FieldInfo, inspector: &mut dyn $crate::scene::Inspector) -> bool {
                let _ = (info, &inspector);
                match self {
                    $(Self::$variant $((inner @ $inner { .. }))? => {
                        [$(<$inner as $crate::scene::Value>::inspect(inner, info, inspector))?].into_iter().any(|changed: bool| changed)
                    })+
                }
            }
        }

        impl $crate::scene::Value for $Choice {
            fn kind() -> String {
                $crate::scene::reference::link(stringify!($Choice))
            }

            fn describe(reference: &mut $crate::scene::Reference) {
                let variants = [$(
                    (stringify!($variant), concat!($($doc),+), concat!("" $(, stringify!($inner))?)),
                )+];
                if reference.choice(stringify!($Choice), concat!($($about),+), &variants) {
                    $($(<$inner as $crate::scene::Value>::describe(reference);)?)+
                }
            }

            fn check(&self, trail: &$crate::scene::error::Trail) -> Result<(), $crate::scene::error::Problem> {
                let _ = trail;
                match self {
                    $(Self::$variant $((inner @ $inner { .. }))? => {
                        $(<$inner as $crate::scene::Value>::check(inner, trail)?;)?
                    })+
                }
                Ok(())
            }

            fn towards(&self, other: &Self, share: f64) -> Self {
                let _ = share;
                match (self, other) {
                    $($((Self::$variant(own @ $inner { .. }), Self::$variant(other)) => {
                        Self::$variant(<$inner as $crate::scene::Value>::towards(own, other, share))
                    })?)+
                    _ => self.clone(),
                }
            }

            fn inspect(&mut self, info: &$crate::scene::FieldInfo, inspector: &mut dyn $crate::scene::Inspector) -> bool {
                inspector.choice(info, self)
            }

            fn initial(_: Option<(f64, f64)>) -> Self {
                Self::FRESH[0]()
            }

            #[cfg(test)]
            fn arbitrary(_: Option<(f64, f64)>, source: &mut $crate::scene::tests::Source) -> Self {
                let variants: &[fn(&mut $crate::scene::tests::Source) -> Self] = &[$(
                    |_source| Self::$variant $((<$inner as $crate::scene::Value>::arbitrary(None, _source)))?,
                )+];
                variants[source.below(variants.len() as u64) as usize](source)
            }
        }
    };
}

pub(super) use {choices, parameters, parameters_with_overrides};
