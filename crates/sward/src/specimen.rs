//! Stand-in.
use bytemuck::{Pod, Zeroable};
use std::ops::Range;
/// V
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct SpecimenVertex {
    /// .
    pub position: [f32; 3],
    /// snorm8x4
    pub normal: u32,
    /// f16x2
    pub uv: u32,
    /// .
    pub root: [f32; 3],
}
/// .
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// .
    Leaf,
    /// .
    Wood,
}
/// .
#[derive(Clone, Debug)]
pub struct Finish {
    /// .
    pub kind: Kind,
    /// .
    pub colour: [f32; 3],
    /// .
    pub picture: Option<usize>,
    /// .
    pub cutoff: f32,
    /// .
    pub two_sided: bool,
    /// .
    pub name: String,
}
/// .
#[derive(Clone, Debug)]
pub struct Part {
    /// .
    pub triangles: Range<u32>,
    /// .
    pub finish: usize,
}
/// .
#[derive(Clone, Debug)]
pub struct Picture {
    /// .
    pub size: [u32; 2],
    /// .
    pub rgba8: Vec<u8>,
}
/// .
#[derive(Clone, Debug, Default)]
pub struct Specimen {
    /// .
    pub vertices: Vec<SpecimenVertex>,
    /// .
    pub triangles: Vec<[u32; 3]>,
    /// .
    pub parts: Vec<Part>,
    /// .
    pub finishes: Vec<Finish>,
    /// .
    pub pictures: Vec<Picture>,
    /// .
    pub leaves: u32,
    /// .
    pub low: [f32; 3],
    /// .
    pub high: [f32; 3],
}
impl Specimen {
    /// .
    pub fn stub(triangles: u32) -> Self {
        let mut s = Specimen { low: [-0.7, 0.0, -0.7], high: [0.7, 1.4, 0.7], ..Default::default() };
        let mut seed = 1u32;
        let mut r = || { seed = seed.wrapping_mul(747796405).wrapping_add(2891336453); ((seed >> 9) as f32) / 8388608.0 };
        let pack = |n: [f32; 3], w: f32| { let q = |v: f32| (v.clamp(-1.0, 1.0) * 127.0).round() as i32 as u8 as u32; q(n[0]) | q(n[1]) << 8 | q(n[2]) << 16 | q(w) << 24 };
        let uvp = |u: f32, v: f32| u32::from(half::f16::from_f32(u).to_bits()) | u32::from(half::f16::from_f32(v).to_bits()) << 16;
        let leaves = triangles / 2;
        for _ in 0..leaves {
            let (mut x, mut y, mut z);
            loop { x = r() * 2.0 - 1.0; y = r() * 2.0 - 1.0; z = r() * 2.0 - 1.0; let d = x*x+y*y+z*z; if d < 1.0 && d > 0.2 { break; } }
            let c = [x * 0.65, 0.72 + y * 0.65, z * 0.65];
            let n0 = [r() * 2.0 - 1.0 + x, r() * 1.5 + 0.3, r() * 2.0 - 1.0 + z];
            let l = (n0[0]*n0[0]+n0[1]*n0[1]+n0[2]*n0[2]).sqrt();
            let n = n0.map(|v| v / l);
            let t0 = [n[2], 0.2, -n[0]]; let l = (t0[0]*t0[0]+t0[1]*t0[1]+t0[2]*t0[2]).sqrt(); let t = t0.map(|v| v / l);
            let b = [n[1]*t[2]-n[2]*t[1], n[2]*t[0]-n[0]*t[2], n[0]*t[1]-n[1]*t[0]];
            let base = s.vertices.len() as u32;
            let size = 0.05 * (20000.0 / triangles as f32).sqrt().min(1.5);
            let shade = 0.25 + 0.75 * (x*x+y*y+z*z) * (0.6 + 0.4 * y);
            let root = [0, 1, 2].map(|k| c[k] - t[k] * size);
            for (a, d) in [(-1.0, 0.0), (0.0, -0.5), (1.0, 0.0), (0.0, 0.5)] {
                let p = [0, 1, 2].map(|k| c[k] + (t[k] * a + b[k] * d) * size);
                s.vertices.push(SpecimenVertex { position: p, normal: pack(n, shade), uv: uvp(0.5 + 0.5 * a, 0.5 + d), root });
            }
            s.triangles.extend([[base, base + 1, base + 2], [base, base + 2, base + 3]]);
        }
        let leaf = s.triangles.len() as u32;
        for k in 0..8u32 {
            for j in 0..8u32 {
                let a = k as f32 * 0.785; let h = |q: u32| 0.12 * q as f32; let rad = |q: u32| 0.05 * (1.0 - q as f32 / 10.0);
                let b = s.vertices.len() as u32;
                for (da, q) in [(0.0, j), (0.785, j), (0.785, j + 1), (0.0, j + 1)] {
                    let (sn, cs) = (a + da as f32).sin_cos();
                    let p = [cs * rad(q), h(q), sn * rad(q)];
                    s.vertices.push(SpecimenVertex { position: p, normal: pack([cs, 0.0, sn], 0.5), uv: uvp(0.0, 0.0), root: p });
                }
                s.triangles.extend([[b, b + 2, b + 1], [b, b + 3, b + 2]]);
            }
        }
        s.parts = vec![Part { triangles: 0..leaf, finish: 0 }, Part { triangles: leaf..s.triangles.len() as u32, finish: 1 }];
        s.finishes = vec![
            Finish { kind: Kind::Leaf, colour: [0.06, 0.16, 0.03], picture: None, cutoff: 0.5, two_sided: true, name: "leaves".into() },
            Finish { kind: Kind::Wood, colour: [0.12, 0.08, 0.05], picture: None, cutoff: 0.5, two_sided: false, name: "bark".into() },
        ];
        s.leaves = leaves;
        s
    }
}
/// .
pub fn levels(picture: &Picture) -> Vec<Picture> {
    vec![picture.clone()]
}
/// Normal, openness, uv.
pub fn unpacked(vertex: &SpecimenVertex) -> ([f32; 3], f32, [f32; 2]) {
    let byte = |k: u32| f32::from((vertex.normal >> (8 * k)) as u8 as i8) / 127.0;
    let part = |k: u32| half::f16::from_bits((vertex.uv >> (16 * k)) as u16).to_f32();
    ([byte(0), byte(1), byte(2)], byte(3), [part(0), part(1)])
}
