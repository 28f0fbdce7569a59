//! What the RON reader complains about, in the words of somebody who writes scenes.

use ron::error::Error;

/// Message and advice for a reader's error.
pub(super) fn explain(error: &Error) -> (String, Option<String>) {
    match error {
        Error::NoSuchStructField { expected, found, outer } => {
            let whose = outer.as_deref().map_or_else(String::new, |name| format!("`{name}` has "));
            (format!("{whose}no field `{found}`"), Some(suggest(found, expected)))
        }
        Error::NoSuchEnumVariant { expected, found, outer } => {
            let what = outer.as_deref().map_or_else(String::new, |name| format!(" as `{name}`"));
            (format!("`{found}` is not known{what}"), Some(suggest(found, expected)))
        }
        Error::MissingStructField { field, outer } => {
            let place = outer.as_deref().map_or_else(String::new, |name| format!(" in `{name}`"));
            (format!("`{field}` is missing{place}"), Some(missing(field)))
        }
        Error::DuplicateStructField { field, .. } => (format!("`{field}` is given twice"), Some("keep one of the two".to_owned())),
        other => (sentence(other), advice(other).map(str::to_owned)),
    }
}

/// "did you mean `frequency`? known: …"; only the list where nothing is near.
pub(super) fn suggest(found: &str, known: &[&str]) -> String {
    let list = match known {
        [] => return "nothing can stand here".to_owned(),
        known => known.join(", "),
    };
    nearest(found, known).map_or_else(|| format!("known: {list}"), |name| format!("did you mean `{name}`? known: {list}"))
}

/// The known name most like `found`, if any is like it at all.
fn nearest<'a>(found: &str, known: &[&'a str]) -> Option<&'a str> {
    let found = found.to_lowercase();
    let likeness = |name: &str| {
        let name = name.to_lowercase();
        let shorter = found.len().min(name.len());
        let abbreviated = shorter >= 3 && (name.starts_with(&found) || found.starts_with(&name));
        strsim::normalized_damerau_levenshtein(&found, &name) + if abbreviated { 0.5 } else { 0.0 }
    };
    let rated = known.iter().map(|name| (likeness(name), *name));
    let best = rated.max_by(|a, b| a.0.total_cmp(&b.0));
    best.filter(|(rating, _)| *rating >= 0.5).map(|(_, name)| name)
}

fn missing(field: &str) -> String {
    match field {
        "version" => "begin the scene with `version: 1`".to_owned(),
        _ => format!("add `{field}: …`"),
    }
}

/// The reader's own words, begun like all our messages.
fn sentence(error: &Error) -> String {
    if let Error::Message(message) = error {
        return message.clone();
    }
    let text = error.to_string();
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_lowercase().chain(letters).collect())
}

fn advice(error: &Error) -> Option<&'static str> {
    Some(match error {
        Error::ExpectedStructLike | Error::ExpectedNamedStructLike(_) => {
            "groups and vectors stand in round brackets: (name: value) or (1.0, 2.0); `()` takes every default"
        }
        Error::ExpectedArray | Error::ExpectedArrayEnd => "lists stand in square brackets: [first, second]",
        Error::ExpectedStructLikeEnd | Error::ExpectedComma => "a comma or `)` is missing before this",
        Error::ExpectedMapColon => "write `name: value`",
        Error::ExpectedString => "text stands in double quotes",
        Error::IntegerOutOfBounds => "the number is too large, or negative where only 0 and above is allowed",
        Error::ExpectedInteger => "a whole number without a point stands here",
        Error::ExpectedFloat => "a number stands here",
        Error::ExpectedBoolean => "`true` or `false` stands here",
        Error::Eof => "a bracket or quote is still open",
        Error::TrailingCharacters => "the scene ended with the last `)`; remove what follows",
        Error::ExpectedDifferentLength { .. } => "give exactly that many numbers",
        Error::ExceededRecursionLimit => "nest fewer groups",
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn the_nearest_name_is_found() {
        let known = ["frequency", "damping", "kappa", "Meadow"];
        assert_eq!(nearest("freqency", &known), Some("frequency"));
        assert_eq!(nearest("meadow", &known), Some("Meadow"));
        assert_eq!(nearest("freq", &known), Some("frequency"));
        assert_eq!(nearest("xyz", &known), None);
        assert_eq!(nearest("", &known), None);
        assert_eq!(nearest("kappa", &[]), None);
    }
}
