//! The boxes of a clip's file: what players read before the frames.
//!
//! ISO/IEC 14496-12 (ISO base media file format) and AV1 Codec ISO Media File Format Binding, §2. One track, all samples in one chunk, in
//! the order they are shown. Dates are zero, so that two runs write the same bytes.

use crate::colour;

/// Units of time in a frame.
const FRAME: u32 = 1000;

/// What the boxes tell.
pub(crate) struct Film<'a> {
    /// Pixels.
    pub(crate) width: u16,
    /// Pixels.
    pub(crate) height: u16,
    /// Frames a second.
    pub(crate) rate: u32,
    /// The encoder's settings as `av1C` begins with them.
    pub(crate) configuration: &'a [u8],
    /// The unit of the sequence header.
    pub(crate) sequence_header: &'a [u8],
    /// Bytes of every frame.
    pub(crate) sizes: &'a [u32],
    /// Frames that can be shown without others, counted from 1.
    pub(crate) keys: &'a [u32],
}

/// Everything before the bytes of the frames: the file's type, the film, and the head of the box that they fill.
pub(crate) fn before_frames(film: &Film<'_>) -> Vec<u8> {
    let frames: u64 = film.sizes.iter().map(|size| u64::from(*size)).sum();
    let head = match u32::try_from(frames + 8) {
        Ok(size) => [&size.to_be_bytes()[..], b"mdat"].concat(),
        Err(_) => [&1_u32.to_be_bytes()[..], b"mdat", &(frames + 16).to_be_bytes()].concat(),
    };
    let kind = boxed(b"ftyp", &[b"isom", &[0, 0, 2, 0], b"isom", b"iso6", b"av01", b"mp41"]);
    // Where the frames begin depends on the length of the box that says so, which does not depend on what it says.
    let begin = kind.len() + movie(film, 0).len() + head.len();
    let begin = u32::try_from(begin).unwrap_or(u32::MAX);
    [kind, movie(film, begin), head].concat()
}

fn movie(film: &Film<'_>, begin: u32) -> Vec<u8> {
    let (scale, duration) = (film.rate * FRAME, film.sizes.len() as u32 * FRAME);
    let header = [
        dates(),
        word(scale),
        word(duration), // time
        word(1 << 16),
        vec![1, 0],
        vec![0; 10],
        matrix(),
        vec![0; 24], // speed, loudness
        word(2),     // the next track's number
    ];
    boxed(b"moov", &[&full(b"mvhd", 0, &header.concat()), &track(film, scale, duration, begin)])
}

fn track(film: &Film<'_>, scale: u32, duration: u32, begin: u32) -> Vec<u8> {
    let size = [film.width, film.height].map(|side| word(u32::from(side) << 16)).concat();
    let header = [dates(), word(1), word(0), word(duration), vec![0; 16], matrix(), size];
    // Flags: enabled, in the movie, in the preview.
    let header = full(b"tkhd", 7, &header.concat());
    let undetermined = [0x55, 0xc4, 0, 0];
    let time = full(b"mdhd", 0, &[dates(), word(scale), word(duration), undetermined.into()].concat());
    let handler = full(b"hdlr", 0, &[&[0; 4][..], b"vide", &[0; 12], b"sward\0"].concat());
    let here = full(b"url ", 1, &[]);
    let data = boxed(b"dinf", &[&full(b"dref", 0, &[word(1), here].concat())]);
    let media = boxed(b"minf", &[&full(b"vmhd", 1, &[0; 8]), &data, &table(film, begin)]);
    boxed(b"trak", &[&header, &boxed(b"mdia", &[&time, &handler, &media])])
}

/// Where each frame lies, and how long it is shown.
fn table(film: &Film<'_>, begin: u32) -> Vec<u8> {
    let count = film.sizes.len() as u32;
    let words = |words: &[u32]| -> Vec<u8> { words.iter().flat_map(|number| number.to_be_bytes()).collect() };
    let description = full(b"stsd", 0, &[word(1), entry(film)].concat());
    let times = full(b"stts", 0, &words(&[1, count, FRAME]));
    let keys = full(b"stss", 0, &[word(film.keys.len() as u32), words(film.keys)].concat());
    let chunks = full(b"stsc", 0, &words(&[1, 1, count, 1]));
    let sizes = full(b"stsz", 0, &[words(&[0, count]), words(film.sizes)].concat());
    let places = full(b"stco", 0, &words(&[1, begin]));
    boxed(b"stbl", &[&description, &times, &keys, &chunks, &sizes, &places])
}

/// How the frames are encoded, and what their numbers mean as colour.
fn entry(film: &Film<'_>) -> Vec<u8> {
    let size = [film.width.to_be_bytes(), film.height.to_be_bytes()].concat();
    let resolution = [word(72 << 16), word(72 << 16)].concat();
    let mut name = [0; 32];
    name[..6].copy_from_slice(b"\x05sward");
    let configuration = boxed(b"av1C", &[film.configuration, film.sequence_header]);
    let [primaries, transfer, matrix] = colour::CODES;
    // The last byte: not the full range.
    let colour = boxed(b"colr", &[b"nclx", &[0, primaries, 0, transfer, 0, matrix, 0]]);
    let head: [&[u8]; 8] = [&[0, 0, 0, 0, 0, 0, 0, 1], &[0; 16], &size, &resolution, &[0; 4], &[0, 1], &name, &[0, 24, 0xff, 0xff]];
    boxed(b"av01", &[&head.concat(), &configuration, &colour])
}

/// When something was made and changed: never.
fn dates() -> Vec<u8> {
    vec![0; 8]
}

/// Neither turned nor scaled.
fn matrix() -> Vec<u8> {
    [1 << 16, 0, 0, 0, 1 << 16, 0, 0, 0, 1 << 30].iter().flat_map(|number: &u32| number.to_be_bytes()).collect()
}

fn word(number: u32) -> Vec<u8> {
    number.to_be_bytes().into()
}

/// A box of version 0.
fn full(kind: &[u8; 4], flags: u8, contents: &[u8]) -> Vec<u8> {
    boxed(kind, &[&[0, 0, 0, flags], contents])
}

/// A box, which begins with its size and its kind.
fn boxed(kind: &[u8; 4], contents: &[&[u8]]) -> Vec<u8> {
    let contents = contents.concat();
    let size = (contents.len() + 8) as u32;
    [&size.to_be_bytes()[..], kind, &contents].concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn film<'a>(sizes: &'a [u32]) -> Film<'a> {
        Film { width: 160, height: 90, rate: 24, configuration: &[0x81, 0, 12, 0], sequence_header: &[10, 1, 7], sizes, keys: &[1] }
    }

    /// Where the one chunk begins, as its box says.
    fn begin(bytes: &[u8]) -> usize {
        let place = bytes.windows(4).position(|kind| kind == b"stco").expect("there is one") + 12;
        u32::from_be_bytes([0, 1, 2, 3].map(|byte| bytes[place + byte])) as usize
    }

    #[test]
    fn the_frames_begin_where_the_box_says() {
        let bytes = before_frames(&film(&[5, 6, 7]));
        assert_eq!(begin(&bytes), bytes.len());
        assert_eq!(bytes[bytes.len() - 8..], [0, 0, 0, 26, b'm', b'd', b'a', b't']);
    }

    #[test]
    fn a_film_of_more_than_4_gigabytes_says_its_size_in_64_bits() {
        let sizes = [3_000_000_000_u32; 3];
        let bytes = before_frames(&film(&sizes));
        assert_eq!(begin(&bytes), bytes.len());
        assert_eq!(bytes[bytes.len() - 16..bytes.len() - 8], [0, 0, 0, 1, b'm', b'd', b'a', b't']);
        assert_eq!(bytes[bytes.len() - 8..], 9_000_000_016_u64.to_be_bytes());
    }
}
