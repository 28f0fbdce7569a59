//! Reads the boxes of an MP4 file, by a path of their kinds.

/// Boxes that hold others, and after how many bytes of their own.
const HOLD: [(&[u8; 4], usize); 8] =
    [(b"moov", 0), (b"trak", 0), (b"mdia", 0), (b"minf", 0), (b"stbl", 0), (b"dinf", 0), (b"stsd", 8), (b"av01", 78)];

/// Kind and contents of each box in `bytes`, which must be filled by them.
pub(crate) fn boxes(mut bytes: &[u8]) -> Vec<(String, &[u8])> {
    let mut found = Vec::new();
    while !bytes.is_empty() {
        let size = number(bytes, 0) as usize;
        assert!((8..=bytes.len()).contains(&size), "a box of {size} bytes in {}", bytes.len());
        found.push((String::from_utf8_lossy(&bytes[4..8]).into_owned(), &bytes[8..size]));
        bytes = &bytes[size..];
    }
    found
}

/// The contents of the only box at a path like `moov/trak/tkhd`.
pub(crate) fn inside<'a>(bytes: &'a [u8], path: &str) -> &'a [u8] {
    path.split('/').fold(bytes, |bytes, kind| {
        let mut these = boxes(bytes).into_iter().filter(|(found, _)| found == kind);
        let (_, contents) = these.next().unwrap_or_else(|| panic!("no {kind} of {path}"));
        assert!(these.next().is_none(), "two of {path}");
        let own = HOLD.iter().find(|(hold, _)| *hold == kind.as_bytes()).map_or(0, |(_, own)| *own);
        &contents[own..]
    })
}

/// The number of 32 bits at a place.
pub(crate) fn number(bytes: &[u8], at: usize) -> u32 {
    u32::from_be_bytes([0, 1, 2, 3].map(|byte| bytes[at + byte]))
}

/// All numbers of 32 bits in a table behind its first `head` bytes.
pub(crate) fn numbers(bytes: &[u8], head: usize) -> Vec<u32> {
    bytes[head..].chunks_exact(4).map(|four| number(four, 0)).collect()
}
