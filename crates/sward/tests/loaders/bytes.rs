//! Changes to bytes, and checksums set right again, so that damage lies deeper.

use crate::chance::Chance;

const BYTES: &[u8] = &[0, 1, 2, 4, 8, 0x0f, 0x10, 0x20, 0x3f, 0x40, 0x7f, 0x80, 0xc0, 0xfe, 0xff];
const WORDS: &[u32] = &[
    0,
    1,
    2,
    3,
    4,
    7,
    8,
    16,
    255,
    256,
    1024,
    65535,
    65536,
    0x00ff_ffff,
    0x3f80_0000, // 1
    0x7f80_0000, // Infinity
    0x7fc0_0000, // NaN
    0x7f7f_ffff,
    0x0000_0001,
    0x4b18_967f,
    0x7fff_ffff,
    0x8000_0000,
    0xbf80_0000,
    0xffff_fffe,
    0xffff_ffff,
];

/// One to six changes to some bytes; `others` are files to take pieces from.
pub(crate) fn mutate(bytes: &mut Vec<u8>, others: &[Vec<u8>], chance: &mut Chance) {
    for _ in 0..1 + chance.below(6) {
        once(bytes, others, chance);
    }
}

fn once(bytes: &mut Vec<u8>, others: &[Vec<u8>], chance: &mut Chance) {
    if bytes.is_empty() {
        return bytes.push(chance.below(256) as u8);
    }
    // Headers decide most.
    let reach = if chance.one_in(2) { bytes.len().min(200) } else { bytes.len() };
    let at = chance.index(reach);
    match chance.below(12) {
        0 => bytes[at] ^= 1 << chance.below(8),
        1 => bytes[at] = *chance.pick(BYTES),
        2 => bytes[at] = chance.below(256) as u8,
        3..=6 => word(bytes, at, chance),
        7 => bytes.truncate(at),
        8 => drop(bytes.drain(chance.stretch(bytes.len()))),
        9 => {
            let piece = bytes[chance.stretch(bytes.len())].to_vec();
            bytes.splice(at..at, piece);
        }
        10 => {
            let other = chance.pick(others);
            let piece = other[chance.stretch(other.len())].to_vec();
            let end = (at + piece.len()).min(bytes.len());
            bytes.splice(at..end, piece);
        }
        _ => bytes.extend(vec![*chance.pick(BYTES); 1 + chance.index(64)]),
    }
}

/// A number of two or four bytes, either way round: another one, or a little more or less.
fn word(bytes: &mut [u8], at: usize, chance: &mut Chance) {
    let at = if chance.one_in(2) { at & !3 } else { at };
    let size = if chance.one_in(3) { 2 } else { 4 };
    let (Some(place), swap) = (bytes.get_mut(at..at + size), chance.one_in(2)) else { return };
    let mut old = [0; 4];
    old[..size].copy_from_slice(place);
    let near = u32::from_le_bytes(old).wrapping_add(chance.below(9) as u32).wrapping_sub(4);
    let new = if chance.one_in(3) { near } else { *chance.pick(WORDS) };
    let mut new = if swap { new.to_be_bytes() } else { new.to_le_bytes() };
    if swap && size == 2 {
        new.rotate_left(2);
    }
    place.copy_from_slice(&new[..size]);
}

fn crc(bytes: &[u8]) -> u32 {
    let bit = |crc: u32| if crc & 1 == 1 { crc >> 1 ^ 0xEDB8_8320 } else { crc >> 1 };
    !bytes.iter().fold(u32::MAX, |crc, byte| (0..8).fold(crc ^ u32::from(*byte), |crc, _| bit(crc)))
}

/// Sets the checksums of a PNG's chunks right, as far as their lengths lead.
pub(crate) fn seal_png(bytes: &mut [u8]) {
    let mut at = 8;
    while let Some(length) = bytes.get(at..at + 4).and_then(|four| four.try_into().ok()).map(u32::from_be_bytes) {
        let end = at.saturating_add(8).saturating_add(length as usize);
        if end.saturating_add(4) > bytes.len() {
            return;
        }
        let sum = crc(&bytes[at + 4..end]);
        bytes[end..end + 4].copy_from_slice(&sum.to_be_bytes());
        at = end + 4;
    }
}

/// Sets the lengths in the header and the chunks of a `.glb` right: the first chunk ends where it says, the second takes the rest.
pub(crate) fn seal_glb(bytes: &mut [u8]) {
    let whole = bytes.len();
    if whole < 20 {
        return;
    }
    bytes[8..12].copy_from_slice(&(whole as u32).to_le_bytes());
    let first = u32::from_le_bytes([bytes[12], bytes[13], bytes[14], bytes[15]]) as usize;
    let second = first.saturating_add(20);
    if second.saturating_add(8) <= whole {
        bytes[second..second + 4].copy_from_slice(&((whole - second - 8) as u32).to_le_bytes());
    }
}
