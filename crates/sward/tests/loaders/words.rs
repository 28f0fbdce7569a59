//! Changes to texts of names, numbers and brackets: scenes and the words beside a terrain.

use crate::chance::Chance;

const NUMBERS: &[&str] = &[
    "0",
    "1",
    "-1",
    "2",
    "3",
    "8",
    "16",
    "64",
    "100",
    "256",
    "512",
    "4096",
    "1000000",
    "2147483647",
    "2147483648",
    "4294967295",
    "4294967296",
    "18446744073709551615",
    "99999999999999999999999",
    "-2147483649",
    "0.0",
    "-0.0",
    "0.5",
    "1.5",
    "0.01",
    "1e-9",
    "1e-45",
    "1e9",
    "-1e9",
    "1e30",
    "1e39",
    "1e308",
    "1e999",
    "NaN",
    "inf",
    "-inf",
    "0x10",
    "1_000",
    "0.0001",
    "30",
    "1000",
    "119.9",
];
const BRACKETS: &[&str] =
    &["(", ")", "[", "]", "{", "}", ",", ":", "()", "(,)", "[]", "\"", "\"\"", "//", "/*", "*/", "Some(", "r#\"", "#", "=", "\n"];

/// A text in pieces: names, numbers, quoted texts, signs, and the space between.
pub(crate) fn pieces(text: &str) -> Vec<String> {
    let mut list: Vec<String> = Vec::new();
    let mut quoted = false;
    let kind = |letter: char| match letter {
        letter if letter.is_alphanumeric() || "_.+-".contains(letter) => 0,
        letter if letter.is_whitespace() => 1,
        _ => 2,
    };
    for letter in text.chars() {
        let last = list.last().and_then(|piece| piece.chars().last());
        let joins = quoted || last.is_some_and(|last| kind(last) == kind(letter) && kind(letter) < 2);
        match list.last_mut().filter(|_| joins) {
            Some(piece) => piece.push(letter),
            None => list.push(letter.to_string()),
        }
        quoted ^= letter == '"';
    }
    list
}

fn is_number(piece: &str) -> bool {
    piece.starts_with(|letter: char| letter.is_ascii_digit() || letter == '-' || letter == '.')
}

/// One to five changes; names are taken from `known`, pieces from `others`.
pub(crate) fn mutate(list: &mut Vec<String>, known: &[String], others: &[Vec<String>], chance: &mut Chance) {
    for _ in 0..1 + chance.below(5) {
        if list.is_empty() {
            return;
        }
        once(list, known, others, chance);
    }
}

fn once(list: &mut Vec<String>, known: &[String], others: &[Vec<String>], chance: &mut Chance) {
    let at = chance.index(list.len());
    let of =
        |list: &[String], fits: fn(&str) -> bool, from: usize| (from..list.len()).chain(0..from).find(|k| fits(&list[*k])).unwrap_or(from);
    match chance.below(14) {
        // Numbers most of all: they leave the text a scene.
        0..=4 => {
            let place = of(list, is_number, at);
            list[place] = (*chance.pick(NUMBERS)).to_owned();
        }
        5 => {
            let place = of(list, is_number, at);
            let number = list[place].parse::<f64>().unwrap_or(1.0) * [0.1, 0.5, 0.999, 1.001, 2.0, -1.0, 10.0][chance.index(7)];
            list[place] = number.to_string();
        }
        6 | 7 => {
            let place = of(list, |piece| piece.starts_with(char::is_alphabetic), at);
            list[place] = chance.pick(known).clone();
        }
        8 => {
            let other = chance.index(list.len());
            list.swap(at, other);
        }
        9 => drop(list.drain(chance.stretch(list.len()))),
        10 => {
            let piece = list[chance.stretch(list.len())].to_vec();
            list.splice(at..at, piece);
        }
        11 => {
            let other = chance.pick(others);
            let piece = other[chance.stretch(other.len())].to_vec();
            let end = if chance.one_in(2) { at } else { (at + piece.len()).min(list.len()) };
            list.splice(at..end, piece);
        }
        12 => list[at] = (*chance.pick(BRACKETS)).to_owned(),
        _ => odd(list, at, chance),
    }
}

/// What people hardly type: depth, length, letters of all kinds.
fn odd(list: &mut Vec<String>, at: usize, chance: &mut Chance) {
    match chance.below(4) {
        0 => {
            let piece = list[chance.stretch(list.len())].concat();
            let times = (20_000 / piece.len().max(1)).min(1 + chance.index(2000));
            list[at] = piece.repeat(times);
        }
        1 => list[at] = (*chance.pick(BRACKETS)).repeat(1 + chance.index(3000)),
        2 => list[at].insert_str(0, ["\u{0}", "ä", "🌾", "\u{feff}", "\\", "\u{202e}", "é"][chance.index(7)]),
        _ => list.truncate(at),
    }
}
