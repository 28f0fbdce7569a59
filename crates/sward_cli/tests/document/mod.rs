//! What a Markdown text names.

pub(crate) mod book;
pub(crate) mod guide;

/// Contents of the fenced blocks in a language.
pub(crate) fn blocks(text: &str, language: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        if let Some(kind) = line.trim_start().strip_prefix("```") {
            let inside: Vec<&str> = lines.by_ref().take_while(|line| !line.trim_start().starts_with("```")).collect();
            if kind.trim() == language {
                found.push(inside.join("\n"));
            }
        }
    }
    found
}

/// The text without its fenced blocks.
fn prose(text: &str) -> String {
    let mut fenced = false;
    let outside = |line: &&str| {
        let fence = line.trim_start().starts_with("```");
        fenced ^= fence;
        !fenced && !fence
    };
    text.lines().filter(outside).collect::<Vec<_>>().join("\n")
}

/// What stands between single backticks.
fn spans(prose: &str) -> Vec<&str> {
    prose.split('`').skip(1).step_by(2).collect()
}

/// Words of a command line: without a comment, leading variables, and anything after a redirection.
fn words(line: &str) -> Vec<String> {
    let line = line.split(" #").next().unwrap_or_default();
    let words = line.split_whitespace().take_while(|word| !["|", ">", "&&", ";"].contains(word));
    let words = words.skip_while(|word| word.contains('=') && !word.starts_with('-'));
    words.map(|word| word.trim_end_matches('…').to_owned()).filter(|word| !word.is_empty()).collect()
}

/// Command lines for `cargo` and `sward`, in blocks of shell and between backticks.
pub(crate) fn commands(text: &str) -> Vec<Vec<String>> {
    let prose = prose(text);
    let blocks = blocks(text, "sh");
    let lines = blocks.iter().flat_map(|block| block.lines()).chain(spans(&prose).into_iter().filter(|span| span.contains(' ')));
    let starts = |words: &Vec<String>| matches!(words.first().map(String::as_str), Some("cargo" | "sward"));
    // Not a command: `sward ← sward_wgpu`.
    lines.map(words).filter(|words| starts(words) && words.get(1).is_none_or(|word| word.is_ascii())).collect()
}

/// Names of files and folders of the project: targets of links, and what looks like a path between backticks.
pub(crate) fn paths(text: &str) -> Vec<String> {
    let prose = prose(text);
    let targets = prose.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    let targets = targets.map(|target| target.split('#').next().unwrap_or_default()).filter(|target| !target.contains("://"));
    let looks_like_path = |span: &&str| {
        let plain = span.chars().all(|c| c.is_ascii_alphanumeric() || "_-./".contains(c));
        let root = ["crates/", "docs/", "scenes/", "assets/", "golden/", "bench/", ".ci/"].iter().any(|folder| span.starts_with(folder));
        plain && (root || span.strip_suffix(".md").is_some_and(|name| !name.contains('/')))
    };
    let named = spans(&prose).into_iter().filter(looks_like_path);
    targets.chain(named).filter(|path| !path.is_empty()).map(str::to_owned).collect()
}

/// Environment variables of ours.
pub(crate) fn variables(text: &str) -> Vec<String> {
    let part = |c: char| c.is_ascii_uppercase() || c == '_';
    text.split(|c: char| !part(c)).filter(|word| word.starts_with("SWARD_") && word.len() > 6).map(str::to_owned).collect()
}

/// `file.rs::name` between backticks.
pub(crate) fn functions(text: &str) -> Vec<(String, String)> {
    let prose = prose(text);
    let split = |span: &&str| span.split_once("::").map(|(file, name)| (file.to_owned(), name.to_owned()));
    spans(&prose).iter().filter_map(split).filter(|(file, _)| file.ends_with(".rs")).collect()
}

/// Folders of one machine that a text names.
pub(crate) fn machine_paths(text: &str) -> Vec<String> {
    let folders = ["work", "tmp", "root", "home", "Users"].map(|folder| format!("/{folder}/"));
    let mut found = Vec::new();
    for folder in folders {
        for (at, _) in text.match_indices(&folder) {
            let before = text[..at].chars().next_back();
            let inside = before.is_some_and(|before| before.is_alphanumeric() || "._-~}".contains(before));
            if !inside {
                found.push(text[at..].chars().take_while(|next| !next.is_whitespace()).collect());
            }
        }
    }
    found
}
