//! A paper's printed figures, and ours below them: as a table, and as CSV.

use std::fmt::Write;

use serde::Serialize;

use super::super::measure::Interval;
use super::super::quoted;

/// What is measured in a case.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Column {
    pub(super) what: String,
    pub(super) unit: &'static str,
}

/// Figures of one machine.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Line {
    /// The paper's hardware, or ours.
    pub(super) on: String,
    pub(super) ours: bool,
    /// One for each column; none where the paper prints none, or it could not be run here.
    pub(super) values: Vec<Option<f64>>,
    /// Ours only, one for each ratio: from pairs in ABBA order; none where nothing was measured so.
    pub(super) intervals: Vec<Option<Interval>>,
}

/// The figures of one column over those of another.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Ratio {
    pub(super) what: &'static str,
    /// Columns: the one below, and the one above the line.
    pub(super) of: [usize; 2],
}

/// A table of a paper.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Table {
    pub(super) paper: &'static str,
    /// Where in it.
    pub(super) place: &'static str,
    /// What was run.
    pub(super) scene: String,
    pub(super) columns: Vec<Column>,
    pub(super) ratios: Vec<Ratio>,
    pub(super) lines: Vec<Line>,
    pub(super) notes: Vec<String>,
}

impl Column {
    pub(super) fn new(what: impl Into<String>, unit: &'static str) -> Self {
        Self { what: what.into(), unit }
    }
}

impl Line {
    /// As a paper prints it.
    pub(super) fn printed<const N: usize>(on: &str, values: [Option<f64>; N]) -> Self {
        Self { on: on.to_owned(), ours: false, values: values.into(), intervals: Vec::new() }
    }

    /// As it was measured here.
    pub(super) fn ours(on: String, values: Vec<Option<f64>>, intervals: Vec<Option<Interval>>) -> Self {
        Self { on, ours: true, values, intervals }
    }

    /// One column over another, and how sure that is.
    fn ratio(&self, at: usize, ratio: &Ratio) -> Option<(f64, Option<Interval>)> {
        if let Some(interval) = self.intervals.get(at).copied().flatten() {
            return Some((interval.median, Some(interval)));
        }
        let value = |column: usize| self.values.get(column).copied().flatten();
        value(ratio.of[0]).zip(value(ratio.of[1])).map(|(below, above)| (above / below, None))
    }
}

/// A number with three digits that count.
fn number(value: f64) -> String {
    let whole = value.abs();
    match whole {
        _ if whole >= 99.95 => format!("{value:.0}"),
        _ if whole >= 9.995 => format!("{value:.1}"),
        _ if whole >= 0.9995 || whole == 0.0 => format!("{value:.2}"),
        _ => format!("{value:.3}"),
    }
}

impl Table {
    /// For a reader: a column for each machine.
    pub(super) fn text(&self) -> String {
        let mut text = format!("{}, {}\n{}\n\n", self.paper, self.place, self.scene);
        let heads = self.heads();
        // Writing to a string cannot fail.
        for (line, head) in self.lines.iter().zip(&heads) {
            let _ = writeln!(text, "  {head}: {}", line.on);
        }
        let mut rows = vec![std::iter::once(String::new()).chain(heads).collect::<Vec<String>>()];
        for (at, column) in self.columns.iter().enumerate() {
            let unit = if column.unit.is_empty() { "" } else { ", " };
            let values = self.lines.iter().map(|line| line.values.get(at).copied().flatten().map_or_else(|| "–".to_owned(), number));
            rows.push(std::iter::once(format!("{}{unit}{}", column.what, column.unit)).chain(values).collect());
        }
        for (at, ratio) in self.ratios.iter().enumerate() {
            let values = self.lines.iter().map(|line| match line.ratio(at, ratio) {
                Some((median, Some(Interval { low, high, .. }))) => format!("{median:.2} ({low:.2} to {high:.2})"),
                Some((ratio, None)) => format!("{ratio:.2}"),
                None => "–".to_owned(),
            });
            rows.push(std::iter::once(ratio.what.to_owned()).chain(values).collect());
        }
        text.push('\n');
        let width = |column: usize| rows.iter().filter_map(|row| row.get(column)).map(|cell| cell.chars().count()).max().unwrap_or(0);
        let widths: Vec<usize> = (0..=self.lines.len()).map(width).collect();
        for row in &rows {
            for (at, (cell, width)) in row.iter().zip(&widths).enumerate() {
                let _ = if at == 0 { write!(text, "  {cell:width$}") } else { write!(text, "  {cell:>width$}") };
            }
            text.push('\n');
        }
        self.notes.iter().for_each(|note| writeln!(text, "  * {note}").unwrap_or_default());
        text
    }

    /// Short names of the machines: numbered where there are several of a kind.
    fn heads(&self) -> Vec<String> {
        let head = |(at, line): (usize, &Line)| {
            let alike = |other: &&Line| other.ours == line.ours;
            let (before, all) = (self.lines[..at].iter().filter(alike).count(), self.lines.iter().filter(alike).count());
            let name = if line.ours { "here" } else { "paper" };
            if all > 1 { format!("{name} {}", before + 1) } else { name.to_owned() }
        };
        self.lines.iter().enumerate().map(head).collect()
    }

    /// For a spreadsheet, without a head.
    pub(super) fn csv(&self) -> String {
        let mut text = String::new();
        for line in &self.lines {
            let fields = [self.paper, &line.on].map(quoted).join(",");
            let empty = String::new;
            for (column, value) in self.columns.iter().zip(&line.values) {
                let value = value.map_or_else(empty, |value| format!("{value:.6}"));
                let _ = writeln!(text, "{fields},{},{},{},{value},,", line.ours, quoted(&column.what), quoted(column.unit));
            }
            for (at, ratio) in self.ratios.iter().enumerate() {
                let Some((value, interval)) = line.ratio(at, ratio) else { continue };
                let [low, high] = [interval.map(|found| found.low), interval.map(|found| found.high)];
                let [low, high] = [low, high].map(|end| end.map_or_else(empty, |end| format!("{end:.6}")));
                let _ = writeln!(text, "{fields},{},{},\"ratio\",{value:.6},{low},{high}", line.ours, quoted(ratio.what));
            }
        }
        text
    }
}

/// First line of the CSV.
pub(super) const CSV_HEAD: &str = "paper,on,ours,what,unit,value,low,high\n";

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> Table {
        let interval = Interval { median: 0.9, low: 0.8, high: 1.0, pairs: 4 };
        Table {
            paper: "A paper",
            place: "§1",
            scene: "one plant".to_owned(),
            columns: vec![Column::new("without", "fps"), Column::new("with", "fps")],
            ratios: vec![Ratio { what: "with/without", of: [0, 1] }],
            lines: vec![
                Line::printed("a card", [Some(60.0), Some(45.0)]),
                Line::printed("another card", [Some(180.0), None]),
                Line::ours("this one".to_owned(), vec![Some(0.5), Some(0.123_456)], vec![Some(interval)]),
            ],
            notes: vec!["a note".to_owned()],
        }
    }

    #[test]
    fn figures_stand_beside_each_other_and_ratios_below() {
        let text = table().text();
        let lines: Vec<&str> = text.lines().collect();
        let words = |line: &str| line.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
        assert_eq!(lines[..3], ["A paper, §1", "one plant", ""]);
        assert_eq!(lines[3..6], ["  paper 1: a card", "  paper 2: another card", "  here: this one"]);
        assert_eq!(words(lines[7]), ["paper", "1", "paper", "2", "here"]);
        assert_eq!(words(lines[8]), ["without,", "fps", "60.0", "180", "0.500"]);
        assert_eq!(words(lines[9]), ["with,", "fps", "45.0", "–", "0.123"]);
        // A ratio of one figure is none.
        assert_eq!(words(lines[10]), ["with/without", "0.75", "–", "0.90", "(0.80", "to", "1.00)"]);
        assert_eq!(lines[11], "  * a note");
        let length = |line: &str| line.chars().count();
        assert!(lines[7..11].iter().all(|line| length(line) == length(lines[7])), "columns line up: {text}");
    }

    #[test]
    fn csv_has_a_line_for_each_figure_and_ratio() {
        let csv = table().csv();
        let fields = CSV_HEAD.matches(',').count();
        assert_eq!(csv.lines().count(), 3 * 2 + 2);
        assert!(csv.lines().all(|line| line.matches(',').count() == fields), "{csv}");
        assert!(csv.contains("\"A paper\",\"this one\",true,\"with/without\",\"ratio\",0.900000,0.800000,1.000000\n"), "{csv}");
        assert!(csv.contains("\"another card\",false,\"with\",\"fps\",,,\n"), "{csv}");
    }
}
