//! A corner in 32 bytes.

use bytemuck::{Pod, Zeroable};
use half::f16;

/// A corner of a plant's triangles, 32 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct SpecimenVertex {
    /// Where it is, m.
    pub position: [f32; 3],
    /// x, y, z of the unit normal and how open to the sky it is there, 0..=1, as signed bytes from the lowest on, 127 being 1
    /// (`unpack4x8snorm` in WGSL).
    pub normal: u32,
    /// Texture coordinates as half-precision numbers, u in the lower half (`unpack2x16float` in WGSL). Those beyond ±65504 are cut.
    pub uv: u32,
    /// Where the root vertex of its leaf is, m; its own place for wood.
    pub root: [f32; 3],
}

fn byte(value: f32) -> u32 {
    let scaled = if value > 1.0 { 127.0 } else { value * 127.0 };
    let scaled = if scaled >= -127.0 { scaled } else { -127.0 };
    // Half away from zero, as WGSL's pack does but for exact halves.
    let rounded = (if scaled < 0.0 { scaled - 0.5 } else { scaled + 0.5 }) as i32;
    rounded as u32 & 0xff
}

/// A unit normal in the lower three bytes; upwards for a vector without a length.
pub(super) fn packed_normal(normal: [f32; 3]) -> u32 {
    let length = (normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]).sqrt();
    let unit = if length > 1e-18 && length.is_finite() { normal.map(|part| part / length) } else { [0.0, 1.0, 0.0] };
    byte(unit[0]) | byte(unit[1]) << 8 | byte(unit[2]) << 16
}

/// Texture coordinates as two half-precision numbers.
pub(super) fn packed_uv(uv: [f32; 2]) -> u32 {
    let half = |value: f32| {
        let value = if value > 65504.0 { 65504.0 } else { value };
        u32::from(f16::from_f32(if value > -65504.0 { value } else { -65504.0 }).to_bits())
    };
    half(uv[0]) | half(uv[1]) << 16
}

impl SpecimenVertex {
    /// The normal, of length 1 but for rounding.
    pub fn normal(&self) -> [f32; 3] {
        [0, 8, 16].map(|shift| f32::from((self.normal >> shift) as u8 as i8) / 127.0)
    }

    /// How open to the sky it is there, 0 to 1.
    pub fn shade(&self) -> f32 {
        f32::from((self.normal >> 24) as u8 as i8) / 127.0
    }

    /// Texture coordinates.
    pub fn uv(&self) -> [f32; 2] {
        [0, 16].map(|shift| f16::from_bits((self.uv >> shift) as u16).to_f32())
    }

    pub(super) fn set_shade(&mut self, shade: f32) {
        self.normal = self.normal & 0x00ff_ffff | byte(if shade > 0.0 { shade } else { 0.0 }) << 24;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_are_packed_and_unpacked() {
        assert_eq!(size_of::<SpecimenVertex>(), 32);
        let normal = packed_normal([0.0, -3.0, 4.0]);
        let mut vertex = SpecimenVertex { normal, uv: packed_uv([0.25, -3.5]), ..SpecimenVertex::default() };
        vertex.set_shade(0.5);
        let near = |a: f32, b: f32| (a - b).abs() < 0.005;
        assert!(near(vertex.normal()[1], -0.6) && near(vertex.normal()[2], 0.8) && near(vertex.shade(), 0.5), "{vertex:?}");
        assert_eq!(vertex.uv(), [0.25, -3.5]);
        vertex.set_shade(9.0);
        assert_eq!(vertex.shade(), 1.0);
        for odd in [[0.0; 3], [f32::NAN; 3], [f32::MAX; 3]] {
            assert_eq!(packed_normal(odd), 127 << 8, "{odd:?} points upwards");
        }
        assert_eq!(SpecimenVertex { uv: packed_uv([1e9, f32::NEG_INFINITY]), ..vertex }.uv(), [65504.0, -65504.0]);
    }
}
