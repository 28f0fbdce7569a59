//! Wind of a place: what a helicopter, a fan or a whirl blows over the ground around it.
//!
//! Chen & Johan 2010, §5.3: an animator's image of directions and strengths, moved along a path; methods §1.7a. Two are shipped:
//! `W = S · max(0, 1 − r/R) · e` with e outward or across. Twin: `footprint.wgsl`.
//! The centre is a whole number of 1/256 node, so patches agree bit for bit on the nodes they share.

/// Parts of a node interval in which centres are counted.
const PARTS: i32 = 256;
/// Farther off than this, in patches, no footprint reaches.
const FARTHEST: i32 = 1024;
/// Place, in parts, of what is out of reach.
const AWAY: i32 = i32::MAX / 2;

/// How the air moves under a footprint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Flow {
    /// Away from the centre, as under a helicopter.
    Outward,
    /// Round the centre, from +x towards +z.
    Swirl,
    /// An image: number that [`Images::add`] gave it.
    Image(u32),
}

/// A footprint at one moment, as the GPU reads it: the same layout as `WindFootprint` in WGSL.
#[derive(Debug, Clone, Copy, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Footprint {
    /// Patch of the centre.
    pub patch: [i32; 2],
    /// Centre in that patch, 1/256 node.
    pub centre: [i32; 2],
    /// cos and sin of the yaw (images turn with their path).
    pub turn: [f32; 2],
    /// Where it ends, m from the centre (images: half their side).
    pub radius: f32,
    /// Strength S, m/s.
    pub speed: f32,
    /// Metres in 1/256 node.
    pub part: f32,
    /// 0 outward, 1 swirl, 2 image.
    pub kind: u32,
    /// First texel of the image.
    pub first: u32,
    /// Texels along a side of the image.
    pub side: u32,
}

/// Direction times strength, 0 to 1, of the images of all sources, one after the other.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Images {
    texels: Vec<[f32; 2]>,
    /// First texel and side of each.
    places: Vec<[u32; 2]>,
}

impl Images {
    /// Adds a square image of `side`² texels, row-major, x along a row and z from row to row; its number is the answer.
    pub fn add(&mut self, side: u32, texels: &[[f32; 2]]) -> u32 {
        self.places.push([self.texels.len() as u32, side]);
        self.texels.extend_from_slice(texels);
        self.places.len() as u32 - 1
    }

    /// All texels.
    pub fn texels(&self) -> &[[f32; 2]] {
        &self.texels
    }

    /// Bilinear value at (u, v) of an image \[texels; centres at whole numbers\], fading to 0 beyond its edge.
    fn sample(&self, first: u32, side: u32, [u, v]: [f32; 2]) -> [f32; 2] {
        let floor = [crate::math::floored(u), crate::math::floored(v)];
        let [s, t] = [u - floor[0] as f32, v - floor[1] as f32];
        let texel = |dx: i32, dz: i32| {
            let [x, z] = [floor[0] + dx, floor[1] + dz];
            let inside = x >= 0 && z >= 0 && x < side as i32 && z < side as i32;
            let index = first as usize + (z.wrapping_mul(side as i32).wrapping_add(x)) as usize;
            if inside { self.texels.get(index).copied().unwrap_or_default() } else { [0.0; 2] }
        };
        let [a, b, c, d] = [texel(0, 0), texel(1, 0), texel(0, 1), texel(1, 1)];
        [0, 1].map(|k| {
            let (near, far) = (a[k] + (b[k] - a[k]) * s, c[k] + (d[k] - c[k]) * s);
            near + (far - near) * t
        })
    }
}

impl Footprint {
    /// A footprint whose centre lies at `centre` \[m from the corner of patch (0, 0)\], for stands of `intervals` nodes of
    /// `node_spacing` \[m\] a patch side. `turn` is cos and sin of its yaw; `radius` in m, `speed` in m/s. `None` out of bounds.
    pub fn new(
        flow: Flow,
        images: &Images,
        centre: [f64; 2],
        turn: [f32; 2],
        radius: f32,
        speed: f32,
        intervals: u32,
        node_spacing: f64,
    ) -> Option<Self> {
        let side = node_spacing * f64::from(intervals);
        let patch = centre.map(|metres| (metres / side).floor());
        if !patch.iter().all(|k| k.abs() < 2e9) || speed == 0.0 {
            return None;
        }
        let parts = |axis: usize| ((centre[axis] - patch[axis] * side) / node_spacing * f64::from(PARTS)).round() as i32;
        let (kind, [first, side]) = match flow {
            Flow::Outward => (0, [0, 0]),
            Flow::Swirl => (1, [0, 0]),
            Flow::Image(number) => (2, *images.places.get(number as usize)?),
        };
        let part = (node_spacing / f64::from(PARTS)) as f32;
        Some(Self { patch: patch.map(|k| k as i32), centre: [parts(0), parts(1)], turn, radius, speed, part, kind, first, side })
    }

    /// Node (0, 0) of a patch seen from the centre, 1/256 node.
    #[inline(always)]
    pub fn base(&self, patch: [i32; 2], intervals: u32) -> [i32; 2] {
        let apart = [patch[0].wrapping_sub(self.patch[0]), patch[1].wrapping_sub(self.patch[1])];
        let near = |k: i32| k > -FARTHEST && k < FARTHEST;
        if !(near(apart[0]) && near(apart[1])) {
            return [AWAY; 2];
        }
        [0, 1].map(|axis| apart[axis] * intervals as i32 * PARTS - self.centre[axis])
    }

    /// From the centre to a node, m.
    #[inline(always)]
    pub fn to_node(&self, base: [i32; 2], node: [i32; 2]) -> [f32; 2] {
        [0, 1].map(|axis| base[axis].saturating_add(node[axis] * PARTS) as f32 * self.part)
    }

    /// From the centre to `local` metres from where `base` belongs, m.
    #[inline(always)]
    pub fn to_local(&self, base: [i32; 2], local: [f32; 2]) -> [f32; 2] {
        [0, 1].map(|axis| base[axis] as f32 * self.part + local[axis])
    }

    /// Velocity of the air \[m/s\] at a place \[m from the centre\].
    #[inline(always)]
    pub fn velocity(&self, images: &Images, at: [f32; 2]) -> [f32; 2] {
        let [cosine, sine] = self.turn;
        if self.kind == 2 {
            // Into the image's own frame (yaw turns +z towards +x), and the velocity back out of it.
            let own = [cosine * at[0] - sine * at[1], sine * at[0] + cosine * at[1]];
            let texels = self.side as f32 / (2.0 * self.radius);
            let [u, v] = own.map(|metres| (metres + self.radius) * texels - 0.5);
            let inside = u > -1.0 && v > -1.0 && u < self.side as f32 && v < self.side as f32;
            let [x, z] = if inside { images.sample(self.first, self.side, [u, v]) } else { [0.0; 2] };
            return [self.speed * (cosine * x + sine * z), self.speed * (cosine * z - sine * x)];
        }
        let distance = (at[0] * at[0] + at[1] * at[1]).sqrt();
        let share = 1.0 - distance / self.radius;
        if share <= 0.0 || distance < 1e-6 {
            return [0.0; 2];
        }
        let speed = self.speed * share / distance;
        if self.kind == 0 { [speed * at[0], speed * at[1]] } else { [-speed * at[1], speed * at[0]] }
    }
}
