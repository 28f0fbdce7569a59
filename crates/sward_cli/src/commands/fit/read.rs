//! Recordings from a text file of columns: `recording,time,value` or `time,value`, with a first row of names or without.

use std::collections::HashMap;
use std::path::Path;

use csv::{ReaderBuilder, StringRecord, Trim};
use sward::fit::{Recording, RecordingError};

use crate::failure::Failure;

/// A larger file is read by no one, bytes.
const LARGEST: u64 = 512 << 20;
/// What a file holds.
const EXPECTED: &str = "expected are columns recording,time,value or time,value, the time in seconds; a first row of names may be there";

/// A recording and its name.
pub(super) struct Named {
    pub(super) name: String,
    pub(super) recording: Recording,
}

/// Samples of one name, and the lines that they stand on.
#[derive(Default)]
struct Rows {
    times: Vec<f64>,
    values: Vec<f64>,
    lines: Vec<u64>,
}

/// A row that cannot be read.
fn bad(path: &Path, line: u64, what: &str, help: &str) -> Failure {
    Failure::input(format!("{}:{line}: {what}", path.display()), help)
}

/// The recordings of a file in their order, or the one that is `wanted`.
pub(super) fn recordings(path: &Path, wanted: Option<&str>) -> Result<Vec<Named>, Failure> {
    let bytes = bytes_of(path)?;
    let (names, mut rows) = rows(path, bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes))?;
    if let Some(wanted) = wanted.filter(|wanted| !rows.contains_key(*wanted)) {
        let nearest = names.iter().max_by(|a, b| strsim::jaro_winkler(a, wanted).total_cmp(&strsim::jaro_winkler(b, wanted)));
        let guess = nearest.map_or_else(String::new, |name| format!("did you mean `{name}`? "));
        let help = format!("{guess}without --recording all {} are fitted", names.len());
        return Err(Failure::input(format!("{} has no recording called `{wanted}`", path.display()), help));
    }
    let chosen = names.into_iter().filter(|name| wanted.is_none_or(|wanted| wanted == name));
    chosen
        .map(|name| {
            let Rows { times, values, lines } = rows.remove(&name).unwrap_or_default();
            match Recording::new(times, values) {
                Ok(recording) => Ok(Named { name, recording }),
                Err(error) => Err(refused(path, &name, &lines, &error)),
            }
        })
        .collect()
}

/// Why samples are no recording, with their place.
fn refused(path: &Path, name: &str, lines: &[u64], error: &RecordingError) -> Failure {
    let help = match error {
        RecordingError::NotLater { .. } => "sort the rows of each recording by time, and keep one of each time",
        RecordingError::NoNumber { .. } => "leave the row out: samples need not be evenly spaced",
        _ => EXPECTED,
    };
    match error.sample().and_then(|sample| lines.get(sample)) {
        Some(line) => bad(path, *line, &format!("recording {name}: {error}"), help),
        None => Failure::input(format!("{}: recording {name}: {error}", path.display()), help),
    }
}

fn bytes_of(path: &Path) -> Result<Vec<u8>, Failure> {
    let shown = path.display();
    let unread = |error: std::io::Error| Failure::input(format!("the recording {shown} cannot be read: {error}"), "check the path");
    let about = std::fs::metadata(path).map_err(unread)?;
    if !about.is_file() || about.len() > LARGEST {
        let why = if about.is_dir() {
            "is a folder"
        } else if about.is_file() {
            "is larger than 512 MB"
        } else {
            "is no file"
        };
        return Err(Failure::input(
            format!("{shown} {why}, not a recording"),
            "type the path of a text file, like pull.csv; of a long one keep the swing",
        ));
    }
    std::fs::read(path).map_err(unread)
}

/// What stands between two columns: what the first line has most of.
fn delimiter(text: &[u8]) -> u8 {
    let first = text.split(|byte| *byte == b'\n').next().unwrap_or_default();
    let count = |sign: u8| first.iter().filter(|byte| **byte == sign).count();
    // A comma may be that of a number where there is another sign.
    [b';', b'\t', b','].into_iter().find(|sign| count(*sign) > 0).unwrap_or(b',')
}

/// A number; where columns are not parted by commas it may have a comma instead of a point.
fn number(text: &str, delimiter: u8) -> Option<f64> {
    if delimiter == b',' { text.parse().ok() } else { text.replace(',', ".").parse().ok() }
}

/// The names of a file in their order, and the rows of each.
fn rows(path: &Path, text: &[u8]) -> Result<(Vec<String>, HashMap<String, Rows>), Failure> {
    let delimiter = delimiter(text);
    let mut reader = ReaderBuilder::new().has_headers(false).flexible(true).trim(Trim::All).delimiter(delimiter).from_reader(text);
    let own_name = path.file_stem().map_or_else(|| "recording".to_owned(), |stem| stem.to_string_lossy().into_owned());
    let (mut names, mut found, mut columns) = (Vec::new(), HashMap::<String, Rows>::new(), None);
    let mut record = StringRecord::new();
    loop {
        match reader.read_record(&mut record) {
            Ok(false) => break,
            Ok(true) => {}
            Err(error) => {
                let line = error.position().map_or(1, csv::Position::line);
                return Err(bad(path, line, "this is not UTF-8 text", "save the file as UTF-8, or export it as CSV"));
            }
        }
        let line = record.position().map_or(0, csv::Position::line);
        let first = columns.is_none();
        let count = *columns.get_or_insert(record.len());
        if !(2..=3).contains(&count) || record.len() != count {
            let before = if first { String::new() } else { format!(", the first row has {count}") };
            let many = if record.len() == 1 { "1 column".to_owned() } else { format!("{} columns", record.len()) };
            return Err(bad(path, line, &format!("{many}{before}"), EXPECTED));
        }
        let cell = |column: usize| number(&record[column], delimiter);
        let (time, value) = (cell(count - 2), cell(count - 1));
        if first && time.is_none() && value.is_none() {
            continue;
        }
        let (Some(time), Some(value)) = (time, value) else {
            let text = &record[if time.is_none() { count - 2 } else { count - 1 }];
            let what = if text.is_empty() { "a number is missing".to_owned() } else { format!("`{text}` is no number") };
            return Err(bad(path, line, &what, "leave the row out, or correct it; samples need not be evenly spaced"));
        };
        let name = if count == 3 { record[0].to_owned() } else { own_name.clone() };
        let rows = found.entry(name).or_insert_with_key(|name| {
            names.push(name.clone());
            Rows::default()
        });
        rows.times.push(time);
        rows.values.push(value);
        rows.lines.push(line);
    }
    if names.is_empty() {
        return Err(Failure::input(format!("{} has no samples", path.display()), EXPECTED));
    }
    Ok((names, found))
}
