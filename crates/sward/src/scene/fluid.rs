//! Air that flows: a source of wind with eddies, gusts that are pushed in, and wakes.

use super::parameters::{choices, parameters};

/// Most planes of air of one scene: the kernels have room for no more.
pub const MAX_FLUIDS: usize = 2;
/// Most gusts of one plane.
pub const MAX_GUSTS: usize = 16;

parameters! {
    /// Air that flows over a square of ground, which repeats without a seam from the corner of the scene's origin patch on. Gusts push it, eddies drift with
    /// its mean velocity, bodies drag it along. It begins evenly, with its mean velocity.
    pub struct Fluid {
        /// Side of the square.
        side: f32 = 32.0, "m" in 4.0..=512.0;
        /// Cells along a side: a power of two. Eddies of less than three cells fade at once; time grows with the square.
        cells: u32 = 64, "" in 16..=512;
        /// Mean velocity of the air in x and z.
        velocity: [f32; 2] = [4.0, 0.0], "m/s" in -60.0..=60.0;
        /// How it thickens: eddies spread and fade the sooner. Air itself has 0.000015.
        viscosity: f32 = 0.0, "m²/s" in 0.0..=10.0;
        /// Time in which what differs from the mean velocity falls to 37 %.
        fade: f32 = 1.5, "s" in 0.05..=60.0;
        /// What pushes the air, in pulses; at most 16.
        gusts: Vec<Gust> = usual_gusts(), "";
        /// Whether bodies drag the air along: what drives by leaves a wake.
        bodies: bool = true, "";
    }
}

choices! {
    /// Where a gust comes from. North is -z, as in maps.
    pub enum GustFrom {
        /// The border of the square along -x; air goes towards +x.
        West,
        /// The border along +x; air goes towards -x.
        East,
        /// The border along -z; air goes towards +z.
        North,
        /// The border along +z; air goes towards -z.
        South,
        /// A place; air goes towards +x.
        Place(GustPlace),
    }
}

parameters! {
    /// Where a gust begins, and at the same place of every square.
    pub struct GustPlace {
        /// Its middle.
        at: [f64; 2] = [0.0, 0.0], "m" in -1000000.0..=1000000.0, required;
    }
}

parameters! {
    /// Air that is pushed again and again.
    pub struct Gust {
        /// Where from.
        from: GustFrom = GustFrom::West, "";
        /// How far along its border, from -x or -z: 0 and 1 are the ends.
        along: f32 = 0.5, "" in 0.0..=1.0;
        /// How far its direction is turned, from +x towards +z.
        turn: f32 = 0.0, "rad" in -6.3..=6.3;
        /// Radius of what it pushes, at most half the side of the square.
        radius: f32 = 4.0, "m" in 0.1..=256.0;
        /// How fast air in the middle gains speed at the height of a pulse.
        strength: f32 = 20.0, "m/s per s" in -100.0..=100.0;
        /// Pulses a second; 0: it pushes evenly, with all its strength.
        frequency: f32 = 0.4, "Hz" in 0.0..=10.0;
        /// Where in a pulse it begins: 0 and 1 are its lull, 0.5 its height.
        phase: f32 = 0.0, "" in 0.0..=1.0;
    }
}

/// Six gusts from all sides that share no rhythm.
fn usual_gusts() -> Vec<Gust> {
    let of = |from, along, turn, frequency, phase| Gust { from, along, turn, frequency, phase, ..Gust::default() };
    let place = |x, z| GustFrom::Place(GustPlace { at: [x, z] });
    vec![
        of(GustFrom::West, 0.25, 0.4, 0.4, 0.0),
        of(GustFrom::West, 0.75, -0.5, 0.31, 0.5),
        of(GustFrom::North, 0.4, 0.3, 0.37, 0.25),
        of(place(12.0, 11.0), 0.5, -0.9, 0.43, 0.7),
        of(place(20.0, 22.0), 0.5, 2.2, 0.29, 0.4),
        of(place(24.0, 6.0), 0.5, 0.8, 0.35, 0.9),
    ]
}
