//! What games ask of plants: how high what grows at a place stands now, and which plants stand in a region. Reads cells, growth and wind; where a GPU
//! steps, the same questions go to the device (`GpuStep::ask`), or its cells are downloaded first.
//!
//! The plant of the nearest cell says how what grows there is bent (of one drawn as blades the first of them); its height is that of the four
//! nearest plants, so the answer is smooth where plants are alike. Of shrubs and trees the round of the crown counts. Twin: `ask.wgsl` in `sward_wgpu`.

use std::collections::BTreeMap;

use bytemuck::{Pod, Zeroable};

use super::plan::{PatchDraw, Seen, draw};
use super::prepare::{PrepareUniform, Preparing, Who};
use crate::geometry::billboard::{leaning, segment};
use crate::growth::PatchGrowth;
use crate::math;
use crate::placement::{self, Clumps, Plant};
use crate::response::continuum::NODE_CELLS;
use crate::response::harmonic::LayeredStand;
use crate::shading::clump::Kind;
use crate::shading::look::Look;
use crate::state::{PatchKey, in_field};
use crate::view::View;
use crate::wind::{Phases, WindField};
use crate::world::World;

/// What is asked of one stand at one place. The same bytes in WGSL.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Asked {
    /// Root of the plant that says how it is bent, m from the patch's corner.
    pub local: [f32; 2],
    /// How that plant leans by itself, rad.
    pub lean: [f32; 2],
    /// Its height, m.
    pub tall: f32,
    /// Height of what is bent so, m; 0 where nothing grows.
    pub height: f32,
    /// The plant's cell.
    pub index: u32,
    /// The patch, among those that the asker knows.
    pub which: u32,
    /// Where it heads by itself, rad from +x towards +z.
    pub yaw: f32,
    /// How far it leans so at the root, rad; of blades the first one's, with how the plant leans.
    pub stance: f32,
    /// How much more at the tip, rad.
    pub curl: f32,
    /// 0.
    pub unused: f32,
}

/// How what grows at a place stands.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Standing {
    /// How far it leans from root to tip, rad along x and z from upright.
    pub bend: [f32; 2],
    /// Its height above the ground as it is bent, m.
    pub height: f32,
}

/// A plant that stands in a region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoundPlant {
    /// Number of its stand in the scene.
    pub stand: usize,
    /// Its patch, and its number there: the cell, or the place in the stand's list.
    pub key: (PatchKey, u32),
    /// Where it stands, m; y is absolute.
    pub root: [f64; 3],
    /// Its length as it has grown, m.
    pub length: f32,
    /// How it stands.
    pub standing: Standing,
}

/// A patch that somebody asks about.
struct Known<'a> {
    phases: Phases,
    growth: Option<PatchGrowth<'a>>,
    clumps: Clumps,
}

/// Asks about one stand of grass. Patches once asked about are known.
pub struct Asker<'a> {
    world: &'a World,
    index: usize,
    /// What says how plants are bent.
    pub uniform: PrepareUniform,
    /// The wind on the nodes of the stand.
    pub wind: WindField,
    /// The patches asked about.
    pub draws: Vec<PatchDraw>,
    known: BTreeMap<PatchKey, usize>,
    patches: Vec<Known<'a>>,
    /// Plants of cells looked at, and those cells: whoever asks about many places asks about neighbours.
    plants: Vec<([i64; 2], Option<Plant>)>,
    /// The patch looked at last.
    last: (PatchKey, usize),
}

/// Cells whose plants are remembered, along either axis.
const REMEMBERED: i64 = 64;

impl<'a> Asker<'a> {
    /// Of stand of grass number `index`.
    pub fn new(world: &'a World, index: usize) -> Self {
        let stand = &world.model.stands[index];
        // Nothing of the picture counts.
        let view = View { eye: [0.0; 3], target: [0.0, 0.0, 1.0], field_of_view: 1.0 };
        let seen = Seen { view: &view, origin: [0; 2], fullness: 1.0, near: 1.0, behind: 0.0 };
        let uniform = PrepareUniform::new(world, stand, false, &seen, &Look::of(Kind::Meadow));
        let (draws, known, patches) = (Vec::new(), BTreeMap::new(), Vec::new());
        let plants = vec![([i64::MAX; 2], None); (REMEMBERED * REMEMBERED) as usize];
        Self { world, index, uniform, wind: world.wind(stand), draws, known, patches, plants, last: ([0; 2], usize::MAX) }
    }

    /// Which of the patches asked about this one is.
    fn know(&mut self, patch: PatchKey) -> usize {
        if self.last.0 == patch && self.last.1 != usize::MAX {
            return self.last.1;
        }
        let which = match self.known.get(&patch) {
            Some(which) => *which,
            None => {
                let (stand, state) = (&self.world.model.stands[self.index], &self.world.state.stands[self.index]);
                let growth = stand.growth.in_patch(patch, stand.patch_side);
                let phases = self.wind.patch_phases(patch, stand.cells / NODE_CELLS);
                self.draws.push(draw(self.world, state, patch, patch, 0, 0));
                self.patches.push(Known { phases, growth, clumps: Clumps::of(&stand.placement, patch) });
                self.known.insert(patch, self.draws.len() - 1);
                self.draws.len() - 1
            }
        };
        self.last = (patch, which);
        which
    }

    /// The plant of a cell of the field as it has grown.
    fn plant(&mut self, cell: [i64; 2]) -> Option<Plant> {
        let place = (cell[1].rem_euclid(REMEMBERED) * REMEMBERED + cell[0].rem_euclid(REMEMBERED)) as usize;
        if self.plants[place].0 != cell {
            self.plants[place] = (cell, self.grown_plant(cell));
        }
        self.plants[place].1
    }

    fn grown_plant(&mut self, cell: [i64; 2]) -> Option<Plant> {
        let placement = &self.world.model.stands[self.index].placement;
        let side = i64::from(placement.cells);
        let patch = cell.map(|along| along.div_euclid(side) as i32);
        if !in_field(self.world.model.field, patch) {
            return None;
        }
        let at = cell.map(|along| along.rem_euclid(side) as u32);
        let known = self.know(patch);
        let known = &self.patches[known];
        let plant = known.clumps.plant(placement, patch, at)?;
        match &known.growth {
            None => Some(plant),
            Some(growth) => placement::grown(plant, growth.cell(placement, &self.world.model.terrain, at[1] * placement.cells + at[0])),
        }
    }

    /// What is asked about a plant of a cell of a patch, with a height that is bent as it is.
    fn about(&mut self, patch: PatchKey, cell: [u32; 2], plant: &Plant, height: f32) -> Asked {
        let stand = &self.world.model.stands[self.index];
        let (mut local, index, which) = (plant.root, cell[1] * stand.cells + cell[0], self.know(patch) as u32);
        let (mut yaw, mut stance) = placement::combed(0.0, 0.0, plant.lean);
        let mut curl = 0.0;
        if let Some(blade) = &stand.species.blade {
            let random = |question: u32| placement::of_blade(&stand.placement, patch, cell, 0, question);
            for axis in 0..2 {
                let anywhere = (cell[axis] as f32 + random(axis as u32)) * stand.placement.spacing;
                local[axis] = anywhere + (plant.root[axis] - anywhere) * blade.tuft;
            }
            (yaw, stance) = placement::combed(random(4) * std::f32::consts::TAU, blade.lean * random(7), plant.lean);
            curl = blade.curl * random(8);
        }
        Asked { local, lean: plant.lean, tall: plant.height, height, index, which, yaw, stance, curl, unused: 0.0 }
    }

    /// What is asked at a ground position, m.
    pub fn question(&mut self, ground: [f64; 2]) -> Asked {
        let stand = &self.world.model.stands[self.index];
        let (spacing, side) = (stand.spacing, i64::from(stand.cells));
        let at = ground.map(|metres| if metres.is_finite() { metres.clamp(-FARTHEST, FARTHEST) / spacing } else { 0.0 });
        let cell = at.map(|along| along.floor() as i64);
        let corner = at.map(|along| (along - 0.5).floor());
        let share = [0, 1].map(|axis: usize| (at[axis] - 0.5 - corner[axis]) as f32);
        let (mut height, mut nearest) = (0.0, None);
        for (dx, dz) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let here = [corner[0] as i64 + dx, corner[1] as i64 + dz];
            let plant = self.plant(here);
            let weight = [dx, dz].into_iter().zip(share).map(|(over, share)| if over == 1 { share } else { 1.0 - share }).product::<f32>();
            height += weight * plant.map_or(0.0, |plant| plant.height);
            if here == cell {
                nearest = plant;
            }
        }
        let patch = cell.map(|along| along.div_euclid(side) as i32);
        let within = cell.map(|along| along.rem_euclid(side) as u32);
        let middle = within.map(|along| (along as f32 + 0.5) * stand.placement.spacing);
        let usual = 0.5 * (stand.species.height[0] + stand.species.height[1]);
        let plant = nearest.unwrap_or(Plant { root: middle, height: usual, yaw: 0.0, tint: 0.0, lean: stand.placement.lean });
        self.about(patch, within, &plant, height)
    }

    /// The answer, from the cells that the CPU holds.
    pub fn answer(&self, asked: &Asked) -> Standing {
        let (stand, state) = (&self.world.model.stands[self.index], &self.world.state.stands[self.index]);
        let which = asked.which as usize;
        let Some((draw, known)) = self.draws.get(which).zip(self.patches.get(which)) else { return Standing::default() };
        let preparing = Preparing {
            uniform: self.uniform,
            cells: &state.cells,
            terrain: &self.world.model.terrain,
            stand,
            wind: &self.wind,
            intervals: stand.cells / NODE_CELLS,
        };
        let (sine, cosine) = math::sin_cos(asked.yaw);
        let who = Who {
            local: asked.local,
            tall: asked.tall,
            index: asked.index,
            heading: [cosine, sine],
            yaw: asked.yaw,
            lean: asked.stance,
            curl: asked.curl,
            plant: asked.lean,
        };
        let mut bends = [[0.0; 2]; 8];
        let bends = &mut bends[..(self.uniform.segments as usize).clamp(1, 8)];
        preparing.bends(draw, &known.phases, &who, bends);
        standing(bends, [cosine, sine], asked)
    }
}

/// Farther from the origin patch, m, nobody asks: cell numbers would run out.
const FARTHEST: f64 = 1e8;

/// Most cells of a stand that a region is looked through.
const MOST_LOOKED_AT: usize = 1 << 24;

/// Numbers of places block by block of cells, so that what an [`Asker`] remembers of one place answers the next.
fn side_by_side(places: &[[f64; 2]], spacing: f64) -> impl Iterator<Item = usize> {
    let block = |metres: f64| (metres / (spacing * (REMEMBERED / 2) as f64)).floor() as i32;
    let mut order: Vec<([i32; 2], usize)> = places.iter().map(|place| place.map(block)).zip(0..).collect();
    order.sort_by_key(|(block, _)| *block);
    order.into_iter().map(|(_, at)| at)
}

/// How a plant of some segments stands that are bent so. Twin: `asked_standing` in `ask.wgsl`.
fn standing(bends: &[[f32; 2]], [cosine, sine]: [f32; 2], asked: &Asked) -> Standing {
    let (mut tip, length) = ([0.0; 3], 1.0 / bends.len() as f32);
    for (at, bend) in bends.iter().enumerate() {
        let along = (at as f32 + 0.5) * length;
        let own = asked.stance + asked.curl * along * along;
        let way = segment(leaning(*bend, [own * cosine, own * sine]), length);
        tip = [tip[0] + way[0], tip[1] + way[1], tip[2] + way[2]];
    }
    let level = (tip[0] * tip[0] + tip[2] * tip[2]).sqrt();
    let share = math::atan2(level, tip[1]) / math::upper(level, 1e-9);
    Standing { bend: [tip[0] * share, tip[2] * share], height: asked.height * math::upper(tip[1], 0.0) }
}

impl World {
    /// How high above the ground what grows at a place reaches now, bent as it is, m: of all stands the tallest; 0 on bare ground. [`asked`](self) says how
    /// that is meant.
    pub fn cover_height_at(&self, ground: [f64; 2]) -> f32 {
        self.cover_heights_at(&[ground]).pop().unwrap_or_default()
    }

    /// [`World::cover_height_at`] of many places.
    pub fn cover_heights_at(&self, places: &[[f64; 2]]) -> Vec<f32> {
        let mut heights: Vec<f32> = places.iter().map(|place| self.crown_height(*place)).collect();
        for index in 0..self.model.stands.len() {
            let mut asker = Asker::new(self, index);
            for at in side_by_side(places, self.model.stands[index].spacing) {
                let (asked, height) = (asker.question(places[at]), &mut heights[at]);
                // What is lower upright is lower bent.
                if asked.height > *height {
                    *height = math::upper(*height, asker.answer(&asked).height);
                }
            }
        }
        heights
    }

    /// Plants of all stands that stand between two corners of a rectangle \[m\], stand by stand; of shrubs and trees those near a focus. At most `most`, from
    /// the first 16 million cells of each stand.
    pub fn plants_in(&self, [low, high]: [[f64; 2]; 2], most: usize) -> Vec<FoundPlant> {
        let mut found = Vec::new();
        let inside = |root: [f64; 2]| (0..2).all(|axis| root[axis] >= low[axis] && root[axis] <= high[axis]);
        for (index, stand) in self.model.stands.iter().enumerate() {
            let mut asker = Asker::new(self, index);
            let span = |axis: usize| [low, high].map(|corner| (corner[axis].clamp(-FARTHEST, FARTHEST) / stand.spacing).floor() as i64);
            let ([left, right], [near, far]) = (span(0), span(1));
            let cells = (near..=far).flat_map(|z| (left..=right).map(move |x| [x, z]));
            for cell in cells.take(MOST_LOOKED_AT) {
                if found.len() >= most {
                    return found;
                }
                let Some(plant) = asker.plant(cell) else { continue };
                let side = i64::from(stand.cells);
                let patch = cell.map(|along| along.div_euclid(side) as i32);
                let root = [0, 1].map(|axis| f64::from(patch[axis]) * stand.patch_side + f64::from(plant.root[axis]));
                if !inside(root) {
                    continue;
                }
                let within = cell.map(|along| along.rem_euclid(side) as u32);
                let number = within[1] * stand.cells + within[0];
                let asked = asker.about(patch, within, &plant, plant.height);
                let ground = self.model.terrain.height_at(root[0], root[1]);
                let (key, root) = ((patch, number), [root[0], ground, root[1]]);
                found.push(FoundPlant { stand: stand.index, key, root, length: plant.height, standing: asker.answer(&asked) });
            }
        }
        for (stand, state) in self.model.layered.iter().zip(&self.state.layered) {
            for plant in state.near.values().flatten().filter(|plant| inside([plant.root[0], plant.root[2]])) {
                if found.len() >= most {
                    return found;
                }
                let standing = Standing { bend: [0.0; 2], height: plant.height };
                found.push(FoundPlant { stand: stand.index, key: plant.key, root: plant.root, length: plant.height, standing });
            }
        }
        found
    }

    /// The round of the crowns over a place, m above the ground; 0 where there is none.
    pub fn crown_height(&self, ground: [f64; 2]) -> f32 {
        let mut height = 0.0;
        for (stand, state) in self.model.layered.iter().zip(&self.state.layered) {
            let reach = f64::from(crown(stand, stand.harmonic.deep) + 1.0);
            let patch = |axis: usize, away: f64| ((ground[axis] + away) / stand.patch_side).floor() as i32;
            for z in patch(1, -reach)..=patch(1, reach) {
                for x in patch(0, -reach)..=patch(0, reach) {
                    for plant in state.near.get(&[x, z]).into_iter().flatten() {
                        let radius = crown(stand, plant.height / stand.specimen.high[1].max(1e-3));
                        let away = [(ground[0] - plant.root[0]) as f32, (ground[1] - plant.root[2]) as f32];
                        let share = (away[0] * away[0] + away[1] * away[1]) / (radius * radius);
                        if share < 1.0 {
                            height = math::upper(height, plant.height * (0.5 + 0.5 * (1.0 - share).sqrt()));
                        }
                    }
                }
            }
        }
        height
    }
}

/// Radius of the crown of a plant that is so many times as large as its mesh, m.
fn crown(stand: &LayeredStand, scale: f32) -> f32 {
    let half = |axis: usize| 0.5 * (stand.specimen.high[axis] - stand.specimen.low[axis]);
    math::upper(scale * math::upper(half(0), half(2)), 1e-3)
}
