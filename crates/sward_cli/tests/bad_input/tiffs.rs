//! TIFF files that cannot be terrains.

use crate::support::Place;
use crate::{refuses, takes};

const TERRAIN: &str = "(version: 1, terrain: Image(path: \"dem.tif\"))";
const SHORT: u16 = 3;
const LONG: u16 = 4;
const DOUBLE: u16 = 12;
/// Where the samples begin: behind the header.
const DATA: u32 = 8;

/// An entry of the directory: tag, type, count, value or place.
type Entry = (u16, u16, u32, u32);

/// 4 × 4 samples of 16 bits in one strip, a pixel of 30 m.
fn strip() -> (Vec<Entry>, Vec<u8>) {
    let entries = vec![
        (256, SHORT, 1, 4),
        (257, SHORT, 1, 4),
        (258, SHORT, 1, 16),
        (259, SHORT, 1, 1),
        (262, SHORT, 1, 1),
        (273, LONG, 1, DATA),
        (277, SHORT, 1, 1),
        (278, SHORT, 1, 4),
        (279, LONG, 1, 32),
        (33550, DOUBLE, 3, DATA + 32),
    ];
    let scale = [30.0_f64, 30.0, 0.0].into_iter().flat_map(f64::to_le_bytes);
    (entries, (0..32).chain(scale).collect())
}

/// The same in one tile of 16 × 16 samples.
fn tile() -> (Vec<Entry>, Vec<u8>) {
    let (mut entries, _) = strip();
    entries.retain(|(tag, ..)| ![273, 278, 279, 33550].contains(tag));
    entries.extend([(322, SHORT, 1, 16), (323, SHORT, 1, 16), (324, LONG, 1, DATA), (325, LONG, 1, 512), (33550, DOUBLE, 3, DATA + 512)]);
    let scale = [30.0_f64, 30.0, 0.0].into_iter().flat_map(f64::to_le_bytes);
    (entries, [7; 512].into_iter().chain(scale).collect())
}

fn tiff((entries, data): (Vec<Entry>, Vec<u8>)) -> Vec<u8> {
    let mut bytes = b"II*\0".to_vec();
    bytes.extend((DATA + data.len() as u32).to_le_bytes());
    bytes.extend(data);
    bytes.extend((entries.len() as u16).to_le_bytes());
    for (tag, kind, count, value) in entries {
        bytes.extend(tag.to_le_bytes().into_iter().chain(kind.to_le_bytes()).chain(count.to_le_bytes()).chain(value.to_le_bytes()));
    }
    bytes.extend([0; 4]);
    bytes
}

/// The file with one entry of its directory changed, or left out.
fn with((mut entries, data): (Vec<Entry>, Vec<u8>), tag: u16, change: Option<Entry>) -> Vec<u8> {
    let at = entries.iter().position(|entry| entry.0 == tag).expect("it has that entry");
    entries.splice(at..=at, change);
    tiff((entries, data))
}

#[test]
fn terrains_that_are_no_tiff_are_refused() {
    let place = Place::new("bad_tiff");
    for whole in [tiff(strip()), tiff(tile())] {
        place.write("dem.tif", whole);
        takes(&place, TERRAIN);
    }
    let refuse = |bytes: Vec<u8>, words: &[&str]| {
        place.write("dem.tif", bytes);
        refuses(&place, TERRAIN, "", &[&["test.ron:1:35: ", "dem.tif"], words].concat());
    };
    let unreadable: &[&str] = &["is not a readable TIFF", "copy or export it again"];
    let whole = tiff(strip());
    for end in [4, 7, 8, 20, 40, 70, whole.len() - 60, whole.len() - 5] {
        refuse(whole[..end].to_vec(), unreadable);
    }
    for directory in [0, 1, 7, 65, 1 << 20, u32::MAX] {
        let mut bytes = whole.clone();
        bytes[4..8].copy_from_slice(&directory.to_le_bytes());
        refuse(bytes, unreadable);
    }
    for (tag, change) in [
        (273, Some((273, LONG, 1, u32::MAX))),
        (273, Some((273, LONG, u32::MAX, DATA))),
        (273, Some((273, LONG, 0, 0))),
        (273, None),
        (279, Some((279, LONG, 1 << 30, 8))),
        (279, None),
        (258, Some((258, SHORT, 1, 4096))),
        (258, Some((258, SHORT, 1, 0))),
        (259, Some((259, SHORT, 1, 34712))),
        (277, Some((277, SHORT, 1, 0))),
        (262, Some((262, SHORT, 1, 77))),
        (257, None),
    ] {
        refuse(with(strip(), tag, change), &["test.ron:1:35: dem.tif: the terrain's image "]);
    }
    for (tag, change) in
        [(322, Some((322, LONG, 1, u32::MAX))), (322, Some((322, SHORT, 1, 0))), (324, Some((324, LONG, 1, 1 << 31))), (324, None)]
    {
        refuse(with(tile(), tag, change), unreadable);
    }
}

#[test]
fn tiffs_too_large_are_refused_by_their_header() {
    let place = Place::new("huge_tiff");
    let refuse = |bytes: Vec<u8>, words: &[&str]| {
        place.write("dem.tif", bytes);
        refuses(&place, TERRAIN, "", &[&["test.ron:1:35: ", "dem.tif"], words].concat());
    };
    let sized = |(mut entries, data): (Vec<Entry>, Vec<u8>), columns: u32, rows: u32, compression: u32| {
        for entry in &mut entries {
            match entry.0 {
                256 => *entry = (256, LONG, 1, columns),
                257 | 278 => *entry = (entry.0, LONG, 1, rows),
                259 => *entry = (259, SHORT, 1, compression),
                _ => {}
            }
        }
        tiff((entries, data))
    };
    // Nothing, LZW, deflate, PackBits.
    for compression in [1, 5, 8, 32773] {
        refuse(sized(strip(), u32::MAX, u32::MAX, compression), &["at most 16384 a side", "make it smaller (gdal_translate"]);
        refuse(sized(strip(), 16384, 4096, compression), &["33554432 in all are read", "make it smaller (gdal_translate"]);
        refuse(sized(strip(), 16384, 2048, compression), &["bytes cannot hold", "copy or export it again"]);
        for (columns, rows) in [(u32::MAX, u32::MAX), (16384, 2048), (0, 4)] {
            refuse(sized(tile(), columns, rows, compression), &["is not a readable TIFF", "copy or export it again"]);
        }
    }
    // A stream of deflate that never is what it should be.
    refuse(sized(strip(), 4, 4, 8), &["is not a readable TIFF", "copy or export it again"]);
}
