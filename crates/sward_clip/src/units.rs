//! What an encoder of AV1 gives out, cut into its units (OBUs).
//!
//! AV1 Bitstream & Decoding Process Specification, §5.3: a byte of header, one more if an extension is announced, the size in the LEB128
//! of §4.10.5, the contents. A file of the kind MP4 holds neither delimiters nor padding between them (AV1 Codec ISO Media File Format
//! Binding, §2.4), and wants the sequence header once more among its settings (§2.3).

/// Type of the unit that says what all frames have in common.
pub(crate) const SEQUENCE_HEADER: u8 = 1;
/// Type of the unit that begins the data of a moment.
const TEMPORAL_DELIMITER: u8 = 2;

/// A unit with its header.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Unit<'a> {
    /// Its type.
    pub(crate) kind: u8,
    /// All its bytes.
    pub(crate) bytes: &'a [u8],
}

/// The units of `data`; nothing if these are not whole units with sizes.
pub(crate) fn units(mut data: &[u8]) -> Option<Vec<Unit<'_>>> {
    let mut found = Vec::new();
    while let Some(first) = data.first() {
        let (extended, sized) = (first & 4 != 0, first & 2 != 0);
        let start = 1 + usize::from(extended);
        let (contents, length) = sized.then(|| leb128(data.get(start..)?)).flatten()?;
        let end = start.checked_add(length)?.checked_add(contents)?;
        found.push(Unit { kind: first >> 3 & 15, bytes: data.get(..end)? });
        data = &data[end..];
    }
    Some(found)
}

/// The data of a moment without its delimiter, as a file holds it.
pub(crate) fn without_delimiter(data: &[u8]) -> Option<Vec<u8>> {
    let kept: Vec<&[u8]> = units(data)?.iter().filter(|unit| unit.kind != TEMPORAL_DELIMITER).map(|unit| unit.bytes).collect();
    Some(kept.concat())
}

/// A size, and how many bytes it takes.
fn leb128(data: &[u8]) -> Option<(usize, usize)> {
    let mut value = 0_u64;
    for (index, byte) in data.iter().take(8).enumerate() {
        value |= u64::from(byte & 0x7f) << (7 * index);
        if byte & 0x80 == 0 {
            return Some((usize::try_from(value).ok()?, index + 1));
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A delimiter, a sequence header of three bytes, a frame of 130.
    fn moment() -> Vec<u8> {
        let mut data = vec![0x12, 0x00, 0x0a, 0x03, 7, 8, 9, 0x32, 0x82, 0x01];
        data.extend([5; 130]);
        data
    }

    #[test]
    fn units_are_cut_apart() {
        let data = moment();
        let found = units(&data).expect("they are whole");
        assert_eq!(found.iter().map(|unit| (unit.kind, unit.bytes.len())).collect::<Vec<_>>(), [(2, 2), (SEQUENCE_HEADER, 5), (6, 133)]);
        assert_eq!(without_delimiter(&data).as_deref(), Some(&data[2..]));
        assert_eq!(units(&[0x36, 0x08, 0x01, 9]).map(|units| units.len()), Some(1), "with an extension");
    }

    #[test]
    fn what_is_cut_short_is_refused() {
        let data = moment();
        for length in 1..data.len() {
            let whole = [2, 7].contains(&length);
            assert_eq!(units(&data[..length]).is_some(), whole, "{length}");
        }
        assert_eq!(units(&[0x30, 1]), None, "no size");
        assert_eq!(units(&[0x32, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff]), None);
        assert_eq!(units(&[0x32, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x7f]), None);
    }
}
