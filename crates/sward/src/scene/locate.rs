//! Finds the place of a value in the text of a scene, for problems noticed after reading.
//!
//! The text has been read without error, so brackets match; any other text still gives an answer, only a less exact one.

use super::error::{Step, Trail};

/// Byte offset of the value at the end of `trail`, or of the innermost value on the way that the text contains.
pub(super) fn locate(text: &str, trail: &Trail) -> usize {
    let masked = mask(text);
    let mut at = open(&masked, after_attributes(&masked, 0));
    for step in &trail.0 {
        let entry = match step {
            Step::Key(name) => field(&masked, at, name),
            Step::Index(index) => element(&masked, at, *index),
        };
        match entry {
            Some(found) => at = open(&masked, found),
            None => break,
        }
    }
    at
}

/// Line and column of a byte offset, both from 1; columns count characters.
pub(super) fn line_and_column(text: &str, offset: usize) -> (u32, u32) {
    let before = text.get(..offset).unwrap_or(text);
    let line = before.matches('\n').count() + 1;
    let column = before.chars().rev().take_while(|&letter| letter != '\n').count() + 1;
    (u32::try_from(line).unwrap_or(u32::MAX), u32::try_from(column).unwrap_or(u32::MAX))
}

/// Byte offset of a line and column, both from 1; the end of the line or the text if there is no such place.
pub(super) fn offset(text: &str, line: usize, column: usize) -> usize {
    let before = text.split_inclusive('\n').take(line.saturating_sub(1));
    let line_start: usize = before.map(str::len).sum();
    let letters = text[line_start..].lines().next().unwrap_or("");
    let skipped = letters.char_indices().nth(column.saturating_sub(1));
    line_start + skipped.map_or(letters.len(), |(at, _)| at)
}

/// The text with comments blanked and strings filled with `"`, so that brackets and colons are what they seem.
fn mask(text: &str) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    let mut at = 0;
    while at < bytes.len() {
        let rest = &text.as_bytes()[at..];
        let (length, filler) = if rest.starts_with(b"//") {
            (rest.iter().position(|&byte| byte == b'\n').unwrap_or(rest.len()), b' ')
        } else if rest.starts_with(b"/*") {
            (block_comment(rest), b' ')
        } else if rest[0] == b'"' {
            (quoted(rest), b'"')
        } else if let Some(length) = raw_quoted(rest) {
            (length, b'"')
        } else {
            (1, rest[0])
        };
        bytes[at..at + length].fill(filler);
        at += length;
    }
    bytes
}

/// Length of the (nesting) block comment at the start.
fn block_comment(rest: &[u8]) -> usize {
    let (mut at, mut depth) = (0, 0_usize);
    while at < rest.len() {
        if rest[at..].starts_with(b"/*") {
            (at, depth) = (at + 2, depth + 1);
        } else if rest[at..].starts_with(b"*/") {
            (at, depth) = (at + 2, depth - 1);
            if depth == 0 {
                break;
            }
        } else {
            at += 1;
        }
    }
    at
}

/// Length of the quoted string at the start, both quotes included.
fn quoted(rest: &[u8]) -> usize {
    let mut at = 1;
    while at < rest.len() && rest[at] != b'"' {
        at += if rest[at] == b'\\' { 2 } else { 1 };
    }
    rest.len().min(at + 1)
}

/// Length of the raw string at the start, if there is one (`r#name` is none).
fn raw_quoted(rest: &[u8]) -> Option<usize> {
    let marked = rest.strip_prefix(b"r")?;
    let hashes = marked.iter().take_while(|&&byte| byte == b'#').count();
    let body = marked[hashes..].strip_prefix(b"\"")?;
    let mut end = vec![b'"'];
    end.resize(1 + hashes, b'#');
    let found = body.windows(end.len()).position(|window| window == end);
    Some(found.map_or(rest.len(), |length| 2 + hashes + length + end.len()))
}

fn after_space(masked: &[u8], at: usize) -> usize {
    at + masked[at..].iter().take_while(|byte| byte.is_ascii_whitespace()).count()
}

fn after_word(masked: &[u8], at: usize) -> usize {
    let in_word = |byte: &&u8| byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'#');
    at + masked[at..].iter().take_while(in_word).count()
}

/// Skips `#![enable(…)]`.
fn after_attributes(masked: &[u8], at: usize) -> usize {
    let at = after_space(masked, at);
    if masked.get(at) != Some(&b'#') {
        return at;
    }
    let end = masked[at..].iter().position(|&byte| byte == b']');
    end.map_or(at, |length| after_attributes(masked, at + length + 1))
}

/// Start of the value at or after `at`; `Some(` is looked through.
fn open(masked: &[u8], at: usize) -> usize {
    let at = after_space(masked, at);
    if !masked[at..].starts_with(b"Some") {
        return at;
    }
    let bracket = after_space(masked, at + 4);
    let inner = after_space(masked, bracket + usize::from(bracket < masked.len()));
    match (masked.get(bracket), masked.get(inner)) {
        (Some(b'('), Some(b'(' | b'[')) => inner,
        _ => at,
    }
}

/// Start of the value of field `name` in the group that starts at `at`.
fn field(masked: &[u8], at: usize, name: &str) -> Option<usize> {
    let mut at = after_space(masked, after_word(masked, at));
    at = (masked.get(at) == Some(&b'(')).then_some(at + 1)?;
    loop {
        let start = after_space(masked, at);
        let end = after_word(masked, start);
        let colon = after_space(masked, end);
        if end == start || masked.get(colon) != Some(&b':') {
            return None;
        }
        let key = &masked[start..end];
        if key.strip_prefix(b"r#").unwrap_or(key) == name.as_bytes() {
            return Some(colon + 1);
        }
        at = next_entry(masked, colon + 1)?;
    }
}

/// Start of element `index` of the list that starts at `at`.
fn element(masked: &[u8], at: usize, index: usize) -> Option<usize> {
    let first = (masked.get(at) == Some(&b'[')).then_some(at + 1)?;
    (0..index).try_fold(first, |entry, _| next_entry(masked, entry))
}

/// What follows the comma that ends the value at `at`; none at a closing bracket.
fn next_entry(masked: &[u8], at: usize) -> Option<usize> {
    let mut depth = 0_usize;
    for (offset, byte) in masked[at..].iter().enumerate() {
        match byte {
            b'(' | b'[' | b'{' => depth += 1,
            b')' | b']' | b'}' => depth = depth.checked_sub(1)?,
            b',' if depth == 0 => return Some(at + offset + 1),
            _ => {}
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_is_found_among_comments_strings_and_options() {
        let text = "#![enable(implicit_some)]\n( // a: 1\n a: \"b: ( \\\" \", /* b: /* [ */ */ r#b: X(c: [ (d: 1),\n (e: Some((f: r#\"\"[\"#, g: 7))) ]) )";
        let trail = Trail::default().key("b").key("c").index(1).key("e").key("g");
        let offset = locate(text, &trail);
        assert_eq!(&text[offset..=offset], "7");
        assert_eq!(line_and_column(text, offset).0, 4);
        let missing = Trail::default().key("b").key("z");
        assert!(text[locate(text, &missing)..].starts_with("X(c"));
    }

    #[test]
    fn any_text_gives_an_answer() {
        let trail = Trail::default().key("a").index(3).key("b");
        for text in ["", "(", "(a", "(a:", "(a: [,,,", "/*", "\"", "\"\\", "r#\"", "#", "Some", "Some(", "(a: Some", "ä("] {
            assert!(locate(text, &trail) <= text.len());
        }
    }
}
