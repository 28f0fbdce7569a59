//! What plants do to the bodies that bend them: forces and turning moments, and the energy of plants that are crushed.
//!
//! Not in the papers. A plant that is held touches its body at one point, without friction: there the body feels the force that its moment needs. Sums are whole
//! parts of a newton, so neither the order of plants nor that of threads matters. Twins: `reaction.wgsl`, `reaction_sums.wgsl`.

use crate::math;

/// What a body feels of one plant in WGSL; needs `math` before it.
pub const WGSL: &str = include_str!("reaction.wgsl");
/// Sums of that, after [`WGSL`]; needs `reaction_add(word: u32, parts: i32)` from the host.
pub const SUMS_WGSL: &str = include_str!("reaction_sums.wgsl");

/// Words of a sum: force x, y, z, moment x, y, z, energy of crushed plants, plants held, plants crushed.
pub const WORDS: usize = 9;
/// Parts of a newton, and of a newton metre.
pub const FORCE_PARTS: f32 = 16384.0;
/// Parts of a joule.
pub const ENERGY_PARTS: f32 = 262_144.0;
/// Most parts of a word that one plant adds: 4 kN, 256 J.
const MOST: f32 = 67_108_864.0;
/// A plant is crushed when it comes to lean farther than this, rad.
pub const CRUSHED: f32 = 1.0;
/// A body touches a plant no nearer to its root than this, m.
pub const NEAREST: f32 = 0.02;

/// What a body feels of one plant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Felt {
    /// Force on the body, N.
    pub force: [f32; 3],
    /// Its moment about a point of the body, N·m.
    pub moment: [f32; 3],
    /// Energy that the plant holds, J, if it has just been crushed; else 0.
    pub crushed: f32,
}

/// A plant that a body holds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Leaning {
    /// From upright, rad.
    pub tilt: f32,
    /// Where to, unit ground vector.
    pub towards: [f32; 2],
    /// With which moment it would turn back, N·m, 0 or more.
    pub moment: f32,
    /// How far along it the body touches it, m; where the body moves over its tip, how far it would be on a longer one.
    pub lever: f32,
    /// Its length, m.
    pub length: f32,
    /// Share of the push that turns it aside, 0 to 1; of the rest it lies under the body and bears it.
    pub aside: f32,
    /// Energy that it holds, J, if it has just been crushed; else 0.
    pub crushed: f32,
}

impl Leaning {
    /// What the body feels about a point from which the root is `root` m away. Aside a touch along the ground turns the plant by cos θ over its lever; what is left
    /// of the moment bears the body.
    #[inline(always)]
    pub fn felt(&self, root: [f32; 3]) -> Felt {
        let (sine, cosine) = math::sin_cos(self.tilt);
        let aside = math::upper(self.lever, NEAREST);
        let lever = math::lower(aside, math::upper(self.length, NEAREST));
        let level = self.aside * self.moment * cosine / aside;
        let borne = self.moment * (1.0 - self.aside * cosine * cosine) / (lever * math::upper(sine, 0.1));
        let [x, z] = self.towards;
        let force = [-level * x, borne, -level * z];
        let arm = [root[0] + lever * sine * x, root[1] + lever * cosine, root[2] + lever * sine * z];
        Felt { force, moment: cross(arm, force), crushed: self.crushed }
    }
}

impl Felt {
    /// What one plant adds to a sum: see [`WORDS`].
    #[inline(always)]
    pub fn words(&self) -> [i32; WORDS] {
        let [x, y, z] = self.force.map(|newtons| parts(newtons, FORCE_PARTS));
        let [about_x, about_y, about_z] = self.moment.map(|moment| parts(moment, FORCE_PARTS));
        [x, y, z, about_x, about_y, about_z, parts(self.crushed, ENERGY_PARTS), 1, i32::from(self.crushed > 0.0)]
    }
}

/// a × b.
#[inline(always)]
pub fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Whole parts of a value, 4 kN or 256 J at most.
#[inline(always)]
fn parts(value: f32, of_one: f32) -> i32 {
    math::floored(math::clamped(value * of_one, -MOST, MOST) + 0.5)
}

/// What a body feels of many plants, in whole parts: see [`WORDS`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sums(pub [i64; WORDS]);

impl Sums {
    /// Adds one plant.
    #[inline(always)]
    pub fn add(&mut self, felt: &Felt) {
        self.add_words(felt.words());
    }

    /// Adds one plant's [`Felt::words`].
    #[inline(always)]
    pub fn add_words(&mut self, words: [i32; WORDS]) {
        self.0.iter_mut().zip(words).for_each(|(sum, word)| *sum += i64::from(word));
    }

    /// Of the words that a GPU has added up, each a whole number with a sign.
    pub fn of_words(words: &[u32]) -> Self {
        let mut sums = Self::default();
        sums.0.iter_mut().zip(words).for_each(|(sum, word)| *sum = i64::from(word.cast_signed()));
        sums
    }

    /// Adds other plants.
    pub fn merge(&mut self, other: &Self) {
        self.0.iter_mut().zip(other.0).for_each(|(sum, more)| *sum += more);
    }

    /// Force \[N\].
    pub fn force(&self) -> [f64; 3] {
        [0, 1, 2].map(|axis: usize| self.0[axis] as f64 / f64::from(FORCE_PARTS))
    }

    /// Moment about the point that it was counted from \[N·m\].
    pub fn moment(&self) -> [f64; 3] {
        [3, 4, 5].map(|word: usize| self.0[word] as f64 / f64::from(FORCE_PARTS))
    }

    /// Energy of plants that have just been crushed \[J\].
    pub fn crushed_energy(&self) -> f64 {
        self.0[6] as f64 / f64::from(ENERGY_PARTS)
    }

    /// Plants held.
    pub fn plants(&self) -> u32 {
        self.0[7].clamp(0, i64::from(u32::MAX)) as u32
    }

    /// Plants that have just been crushed.
    pub fn crushed(&self) -> u32 {
        self.0[8].clamp(0, i64::from(u32::MAX)) as u32
    }
}
