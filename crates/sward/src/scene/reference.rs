//! The reference page of the scene format, made from the declarations themselves.

use std::collections::HashSet;
use std::fmt::Write;

use super::{FieldInfo, Scene, Species, Value};

/// A page that collects the groups and choices of the format, each once.
#[derive(Debug, Default)]
pub struct Reference {
    page: String,
    seen: HashSet<&'static str>,
}

impl Reference {
    /// Adds a group of fields; false if it was there already.
    pub(super) fn group(&mut self, name: &'static str, about: &str, fields: &[FieldInfo]) -> bool {
        if !self.begin(name, about) {
            return false;
        }
        if fields.is_empty() {
            self.line(&format!("No fields: `{name}()`.\n"));
            return true;
        }
        self.line("| field | value | default | unit | range | meaning |\n|---|---|---|---|---|---|");
        for field in fields {
            let kind = (field.kind)();
            let default = match (field.required, (field.default)().as_str()) {
                (true, _) => "required".to_owned(),
                (false, "None") => "–".to_owned(),
                (false, text) => format!("`{text}`"),
            };
            let range = field.range.map_or_else(String::new, |(low, high)| format!("{low} to {high}"));
            let (name, unit, doc) = (field.name, field.unit, field.doc);
            self.line(&format!("| `{name}` | {kind} | {default} | {unit} | {range} | {doc} |"));
        }
        self.line("");
        true
    }

    /// Adds a choice of (name, meaning, group behind the name or ""); false if it was there already.
    pub(super) fn choice(&mut self, name: &'static str, about: &str, variants: &[(&str, &str, &str)]) -> bool {
        if !self.begin(name, about) {
            return false;
        }
        self.line("| choice | fields | meaning |\n|---|---|---|");
        for (variant, doc, inner) in variants {
            let fields = if inner.is_empty() { "–".to_owned() } else { link(inner) };
            let call = if inner.is_empty() { "" } else { "(…)" };
            self.line(&format!("| `{variant}{call}` | {fields} | {} |", doc.trim()));
        }
        self.line("");
        true
    }

    fn begin(&mut self, name: &'static str, about: &str) -> bool {
        let new = self.seen.insert(name);
        if new {
            self.line(&format!("## {name}\n\n{}\n", about.trim()));
        }
        new
    }

    fn line(&mut self, text: &str) {
        self.page.push_str(text);
        self.page.push('\n');
    }

    /// Adds the values each species gives, one column per species.
    fn species(&mut self) {
        let all = [Species::Lawn, Species::Meadow, Species::Reed, Species::Tussock];
        let names: Vec<String> = all.iter().map(|species| format!("{species:?}")).collect();
        self.line("## What each species gives\n");
        self.line(&format!("| | {} |\n|---|{}", names.join(" | "), "---|".repeat(all.len())));
        self.row("height [m]", &all.each_ref().map(|species| super::text_of(&species.height())));
        self.columns(&all.each_ref().map(|species| species.continuum().written()));
        self.columns(&all.each_ref().map(|species| species.billboard().written()));
    }

    fn columns<const COUNT: usize>(&mut self, columns: &[Vec<(&'static FieldInfo, String)>; COUNT]) {
        for (index, (info, _)) in columns.iter().flatten().take(columns[0].len()).enumerate() {
            let unit = if info.unit.is_empty() { String::new() } else { format!(" [{}]", info.unit) };
            let cells = columns.each_ref().map(|column| column[index].1.clone());
            self.row(&format!("`{}`{unit}", info.name), &cells);
        }
    }

    fn row(&mut self, name: &str, cells: &[String]) {
        self.line(&format!("| {name} | {} |", cells.join(" | ")));
    }
}

/// A link to a section of the page.
pub(super) fn link(name: &str) -> String {
    format!("[{name}](#{})", name.to_lowercase())
}

/// The reference page of the scene format in Markdown: every group and choice with defaults, units and ranges.
#[must_use]
pub fn reference() -> String {
    let mut reference = Reference::default();
    reference.line("# Scene format, version 1\n");
    reference.line("Generated from the declarations in `crates/sward/src/scene`; a test keeps it so.");
    reference.line("Groups stand in round brackets, `(name: value)`, lists in square ones. A dash means that nothing is given.");
    reference.line("Lengths are metres, times seconds, angles radians; +y is up, ground positions are (x, z).\n");
    Scene::describe(&mut reference);
    reference.species();
    let mut page = reference.page;
    // One newline at the end, whatever came last.
    page.truncate(page.trim_end().len());
    let _ = writeln!(page);
    page
}
