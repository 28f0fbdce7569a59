//! Numbers of plants: which plant a pixel shows. A plant has the same number in every picture of a scene.
//!
//! A plant is (stand, patch, cell), and its number holds all three, the patch as far as bits reach:
//!
//! `cell | (x mod 2^p) << c | (z mod 2^p) << (c + p) | (stand + 1) << (c + 2p)`
//!
//! with `cell` = j · cells + i, `c` = [`Identity::cell_bits`], `p` = [`Identity::patch_bits`]. Numbers repeat every 2^p patches, which is
//! farther than plants are seen ([`Identity::is_unique`]). Numbers without a stand are no plants: 0 is ground and sky, k is body k of the
//! scene, counted from 1. Twin: `prepare_number` in `prepare.wgsl`.

use crate::state::PatchKey;
use crate::world::World;

use super::subject;

/// How the numbers of a world's plants are put together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Identity {
    /// Bits of the cell in its patch.
    pub cell_bits: u32,
    /// Bits of each coordinate of the patch.
    pub patch_bits: u32,
    /// Cells along a patch side, of each stand: those of grass, then those of meshes.
    pub cells: Vec<u32>,
    /// Patches, along x and z, that plants are seen across at most.
    seen: u32,
}

/// A plant's place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// Number of the stand, from 0.
    pub stand: usize,
    /// Its patch, counted from the scene's origin patch.
    pub patch: PatchKey,
    /// Its cell (i, j) in that patch.
    pub cell: [u32; 2],
}

/// Bits that numbers below `count` take.
fn bits(count: u64) -> u32 {
    u64::BITS - count.saturating_sub(1).leading_zeros()
}

impl Identity {
    /// Of a world: as many bits for stands and cells as they take, the rest for patches.
    pub fn of(world: &World) -> Self {
        let meshes = world.model.layered.iter().map(|stand| {
            // Places are counted through, not cell by cell.
            let places = (stand.places.len() as f64).sqrt().ceil() as u32;
            stand.placement.cells.max(places)
        });
        let cells: Vec<u32> = world.model.stands.iter().map(|stand| stand.cells).chain(meshes).collect();
        let most = cells.iter().copied().max().unwrap_or(1);
        let cell_bits = bits(u64::from(most) * u64::from(most));
        let patch_bits = 32_u32.saturating_sub(cell_bits + bits(cells.len() as u64 + 1).max(1)) / 2;
        let farthest = subject::looks(world).iter().map(|look| look.fade[1]).fold(0.0, f32::max);
        let farthest = world.model.layered.iter().map(|stand| stand.layers().distance).fold(farthest, f32::max);
        let seen = (2.0 * f64::from(farthest) / world.model.patch_side).ceil() as u32 + 2;
        Self { cell_bits, patch_bits, cells, seen }
    }

    /// Whether no two plants of one picture share a number: always, but for dozens of stands of small patches with many cells.
    pub fn is_unique(&self) -> bool {
        u64::from(self.seen) <= 1 << self.patch_bits
    }

    /// What preparing needs to number the plants of a stand: the bits of cells and of patches, and the stand counted from 1.
    pub fn of_stand(&self, stand: usize) -> [u32; 4] {
        [self.cell_bits, self.patch_bits, stand as u32 + 1, 0]
    }

    /// The number of a plant.
    pub fn number(&self, place: &Place) -> u32 {
        let across = self.cells.get(place.stand).copied().unwrap_or(1);
        number(self.of_stand(place.stand), place.patch, place.cell[1] * across + place.cell[0])
    }

    /// The plant of a number, in the patch nearest to `near` that has it (the camera's will do); `None` for what is no plant.
    pub fn place(&self, number: u32, near: PatchKey) -> Option<Place> {
        let part = |shift: u32, bits: u32| ((u64::from(number) >> shift) & ((1 << bits) - 1)) as u32;
        let stand = part(self.cell_bits + 2 * self.patch_bits, 32).checked_sub(1)? as usize;
        let across = *self.cells.get(stand)?;
        let cell = part(0, self.cell_bits);
        let period = 1_i64 << self.patch_bits;
        let patch = [0, 1].map(|axis| {
            let low = i64::from(part(self.cell_bits + self.patch_bits * axis as u32, self.patch_bits));
            let near = i64::from(near[axis]);
            // Of the patches that differ by whole periods, the one within half a period.
            (near + (low - near + period / 2).rem_euclid(period) - period / 2) as i32
        });
        Some(Place { stand, patch, cell: [cell % across, cell / across] })
    }
}

/// The number of the plant in cell `index` (j · cells + i); `identity` as of [`Identity::of_stand`].
pub fn number([cell_bits, patch_bits, stand, _]: [u32; 4], patch: PatchKey, index: u32) -> u32 {
    let mask = (1_u32 << patch_bits) - 1;
    let [x, z] = patch.map(|along| along as u32 & mask);
    index | x << cell_bits | z << (cell_bits + patch_bits) | stand << (cell_bits + 2 * patch_bits)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::NoAssets;
    use crate::scene::Scene;

    fn identity(text: &str) -> Identity {
        Identity::of(&World::new(Scene::parse(text, "identity.ron").expect("valid"), &NoAssets).expect("it compiles"))
    }

    #[test]
    fn numbers_can_be_taken_apart() {
        let identity = identity("(version: 1, stands: [(species: Meadow, cells: 40), (species: Reed, cells: 128), (species: Lawn)])");
        assert_eq!((identity.cell_bits, identity.patch_bits), (14, 8));
        assert!(identity.is_unique());
        for (stand, cell) in [(0, [39, 39]), (1, [127, 0]), (2, [0, 127]), (0, [0, 0])] {
            for patch in [[0, 0], [-1, 300], [8000, -8000], [i32::MAX, i32::MIN + 200]] {
                let place = Place { stand, patch, cell };
                let number = identity.number(&place);
                let aside = |by: i32| patch.map(|along: i32| along.saturating_add(by));
                assert_eq!([identity.place(number, patch), identity.place(number, aside(-100))], [Some(place); 2]);
                // Control: from too far away another patch is taken for it.
                assert_ne!(identity.place(number, [patch[0] ^ 256, patch[1]]), Some(place));
            }
        }
        assert_eq!([0, 1, 1024].map(|number| identity.place(number, [0, 0])), [None; 3]);
    }

    #[test]
    fn many_stands_of_many_cells_do_not_fit() {
        let text = |count: usize| {
            let stand = |index| format!("(species: Reed, cells: 256, name: \"{index}\"),");
            format!("(version: 1, field: (patch_side: 8), stands: [{}])", (0..count).map(stand).collect::<String>())
        };
        assert_eq!([1, 63, 64].map(|count| identity(&text(count)).is_unique()), [true, true, false]);
        assert!(identity("(version: 1)").is_unique(), "no stands at all");
    }
}
