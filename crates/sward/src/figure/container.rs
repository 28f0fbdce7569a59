//! From bytes to JSON and buffers: `.glb`, and `.gltf` with embedded or neighbouring buffers.

use std::borrow::Cow;

use super::error::{FigureError, data};
use super::json::Root;

/// Reads a file beside the glTF file.
pub(crate) type Neighbour<'a> = &'a dyn Fn(&str) -> Result<Vec<u8>, String>;

/// A file, taken apart: its JSON and the bytes of its buffers.
pub(crate) struct Opened<'a> {
    pub(crate) root: Root,
    pub(crate) buffers: Vec<Cow<'a, [u8]>>,
    pub(crate) neighbour: Neighbour<'a>,
}

fn word(bytes: &[u8], at: usize) -> Option<usize> {
    let four = bytes.get(at..at.checked_add(4)?)?;
    Some(u32::from_le_bytes([four[0], four[1], four[2], four[3]]) as usize)
}

/// The JSON and the binary chunk of a `.glb` (glTF 2.0, §4.4). Lengths are compared with what is there before anything is read.
fn chunks(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), FigureError> {
    let wrong = |what: String| FigureError::Container(what);
    let cut = || wrong("it ends within its header; copy or export it again".to_owned());
    let version = word(bytes, 4).ok_or_else(cut)?;
    if version != 2 {
        return Err(wrong(format!("it has version {version} of the binary format, needed is 2; export it as glTF 2.0")));
    }
    let announced = word(bytes, 8).ok_or_else(cut)?;
    if announced > bytes.len() {
        return Err(wrong(format!("its header announces {announced} bytes, but there are {}; copy or export it again", bytes.len())));
    }
    let (mut at, mut json, mut binary) = (12, None, None);
    while let (Some(length), Some(kind)) = (word(bytes, at), word(bytes, at + 4)) {
        let rest = &bytes[at + 8..];
        let Some(chunk) = rest.get(..length) else {
            return Err(wrong(format!("a chunk announces {length} bytes, but {} are left; copy or export it again", rest.len())));
        };
        match kind {
            0x4E4F_534A if json.is_none() => json = Some(chunk),
            0x004E_4942 if binary.is_none() => binary = Some(chunk),
            _ => {}
        }
        at += 8 + length;
    }
    json.map(|json| (json, binary)).ok_or_else(|| wrong("it has no JSON chunk".to_owned()))
}

/// The value of a base64 digit.
fn digit(byte: u8) -> Option<u32> {
    Some(u32::from(match byte {
        b'A'..=b'Z' => byte - b'A',
        b'a'..=b'z' => byte - b'a' + 26,
        b'0'..=b'9' => byte - b'0' + 52,
        b'+' | b'-' => 62,
        b'/' | b'_' => 63,
        _ => return None,
    }))
}

fn base64(text: &str) -> Option<Vec<u8>> {
    let digits = text.trim_end_matches('=').as_bytes();
    let mut bytes = Vec::with_capacity(digits.len() / 4 * 3 + 3);
    for four in digits.chunks(4) {
        let mut word = 0;
        for &byte in four {
            word = word << 6 | digit(byte)?;
        }
        word <<= 6 * (4 - four.len());
        bytes.extend_from_slice(&word.to_be_bytes()[1..four.len()]);
    }
    Some(bytes)
}

/// `%20` and the like, undone.
fn unescaped(uri: &str) -> Option<String> {
    let (bytes, mut plain, mut at) = (uri.as_bytes(), Vec::new(), 0);
    while at < bytes.len() {
        if bytes[at] == b'%' {
            plain.push(u8::from_str_radix(uri.get(at + 1..at + 3)?, 16).ok()?);
            at += 3;
        } else {
            plain.push(bytes[at]);
            at += 1;
        }
    }
    String::from_utf8(plain).ok()
}

/// The bytes behind a URI: embedded as base64, or a file beside the glTF file.
pub(crate) fn resolve(uri: &str, neighbour: Neighbour<'_>, place: &str) -> Result<Vec<u8>, FigureError> {
    if let Some(embedded) = uri.strip_prefix("data:") {
        let (kind, text) = embedded.split_once(',').unwrap_or((embedded, ""));
        let bytes = if kind.ends_with(";base64") { base64(text) } else { None };
        return bytes.ok_or_else(|| data(place, "has a `data:` URI that is not base64"));
    }
    let name = unescaped(uri).filter(|name| !name.contains(':') && !name.starts_with(['/', '\\']) && !name.contains(".."));
    let name = name.ok_or_else(|| data(place, format!("names `{uri}`; a file beside the glTF file or below it is needed")))?;
    neighbour(&name).map_err(|why| data(place, format!("names a file that cannot be read: {why}; or export it as .glb, in one file")))
}

/// Takes a file apart.
pub(crate) fn open<'a>(bytes: &'a [u8], neighbour: Neighbour<'a>) -> Result<Opened<'a>, FigureError> {
    let (json, binary) = if bytes.starts_with(b"glTF") { chunks(bytes)? } else { (bytes, None) };
    if !bytes.starts_with(b"glTF") && !bytes.iter().take(64).any(|byte| *byte == b'{') {
        let start = String::from_utf8_lossy(&bytes[..bytes.len().min(4)]).escape_debug().to_string();
        return Err(FigureError::Container(format!("it begins with \"{start}\", not with \"glTF\" (.glb) or \"{{\" (.gltf)")));
    }
    let root = Root::parse(json)?;
    let mut buffers = Vec::new();
    for (index, buffer) in root.buffers.iter().enumerate() {
        let place = format!("buffers[{index}]");
        let bytes = match &buffer.uri {
            Some(uri) => Cow::Owned(resolve(uri, neighbour, &place)?),
            None if index == 0 => Cow::Borrowed(binary.ok_or_else(|| data(&place, "has no `uri`, and the file has no binary chunk"))?),
            None => return Err(data(place, "has no `uri`; only the first may be the binary chunk")),
        };
        if (bytes.len() as u64) < buffer.byte_length {
            return Err(data(place, format!("announces {} bytes, but there are {}", buffer.byte_length, bytes.len())));
        }
        buffers.push(bytes);
    }
    Ok(Opened { root, buffers, neighbour })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn embedded_bytes_and_names_are_decoded() {
        assert_eq!(base64("aGVsbG8=").as_deref(), Some(&b"hello"[..]));
        assert_eq!(base64("aGVsbG8").as_deref(), Some(&b"hello"[..]));
        assert_eq!(base64("").as_deref(), Some(&[][..]));
        assert_eq!(base64("a$=="), None);
        assert_eq!(unescaped("my%20car.bin").as_deref(), Some("my car.bin"));
        assert_eq!(unescaped("50%"), None);
        assert_eq!(unescaped("%ü"), None);
        let none: Neighbour = &|name| Err(format!("{name} is missing"));
        for uri in ["../secret", "/etc/passwd", "https://a.b/c", "data:text/plain,abc", "gone.bin"] {
            assert!(resolve(uri, none, "buffers[0]").is_err(), "{uri}");
        }
    }
}
