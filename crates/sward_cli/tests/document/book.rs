//! What a page of the book names, beyond what every document does: parts of other files, links to headings, scenes of each kind.

/// A fenced block: what stands behind its first fence, and its lines.
pub(crate) type Block = (String, String);

/// All fenced blocks of a text, in order.
pub(crate) fn fenced(text: &str) -> Vec<Block> {
    let mut found = Vec::new();
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        if let Some(kind) = line.trim_start().strip_prefix("```") {
            let inside: Vec<&str> = lines.by_ref().take_while(|line| !line.trim_start().starts_with("```")).collect();
            found.push((kind.trim().to_owned(), inside.join("\n")));
        }
    }
    found
}

/// Targets of all links and pictures outside of fenced blocks.
pub(crate) fn targets(text: &str) -> Vec<String> {
    let prose = super::prose(text);
    prose.split("](").skip(1).filter_map(|rest| rest.split(')').next()).map(str::to_owned).collect()
}

/// Path and anchor of a line that includes a part of a file: `{{#include path:anchor}}`.
pub(crate) fn include(line: &str) -> Option<(String, Option<String>)> {
    let inside = line.trim().strip_prefix("{{#include ")?.strip_suffix("}}")?;
    let (path, anchor) = inside.split_once(':').map_or((inside, None), |(path, anchor)| (path, Some(anchor.to_owned())));
    Some((path.to_owned(), anchor))
}

/// The lines of a source file between the marks of an anchor, if it has both.
pub(crate) fn anchored(source: &str, anchor: &str) -> Option<String> {
    let is = |line: &&str, mark: &str| line.trim() == format!("// {mark}: {anchor}");
    let mut lines = source.lines().skip_while(|line| !is(line, "ANCHOR")).skip(1).peekable();
    lines.peek()?;
    let mut inside = Vec::new();
    for line in lines {
        if is(&line, "ANCHOR_END") {
            return (!inside.is_empty()).then(|| inside.join("\n"));
        }
        inside.push(line);
    }
    None
}

/// Names by which links reach the headings of a text.
pub(crate) fn headings(text: &str) -> Vec<String> {
    let prose = super::prose(text);
    let lines = prose.lines().filter(|line| line.starts_with('#'));
    let named = lines.map(|line| line.trim_start_matches('#').trim().to_lowercase());
    let kept = |c: &char| c.is_alphanumeric() || "-_ ".contains(*c);
    named.map(|name| name.chars().filter(kept).map(|c| if c == ' ' { '-' } else { c }).collect()).collect()
}
