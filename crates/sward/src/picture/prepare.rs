//! Prepare: each visible plant is solved once, into joints that the shadow and the main pass share.
//!
//! The CPU side of `prepare.wgsl`, function by function: same names, same arithmetic. Reads cells and wind, writes plants and joints.

use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3};

use super::identity;
use super::plan::{FULL_CELLS, PatchDraw, Seen, THINNING, bits};
use super::plants::Plant;
use super::sheets::Rooted;
use crate::geometry::billboard::{CLEARANCE, earlier, leaning, segment};
use crate::math;
use crate::placement::{self, Growing, PlacementParameters, Plant as Placed};
use crate::response::StandModel;
use crate::response::chain::{self, ChainModel, HeldBlade, Standing};
use crate::response::oscillator::{self, Air, OscillatorCoefficients, Own, Record};
use crate::response::springs::{self, SpringsModel};
use crate::shading::clump::{VARIANTS, first_layer};
use crate::shading::look::Look;
use crate::state::{Cells, NONE};
use crate::terrain::{Terrain, TerrainGrid};
use crate::wind::{self, Phases, WindField};
use crate::world::World;

/// `Prepare` of `prepare.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct PrepareUniform {
    /// Where plants stand.
    pub placement: PlacementParameters,
    /// The terrain's samples.
    pub grid: TerrainGrid,
    /// Eye, m from the frame origin; the fourth is not used.
    pub camera: [f32; 4],
    /// Segments of the simulation.
    pub segments: u32,
    /// Segments of the cards, or pieces along each side of the sheets.
    pub drawn: u32,
    /// The drawing order covers 2^bits cells a side.
    pub bits: u32,
    /// First clump picture.
    pub layer: u32,
    /// Distance beyond which plants are straight, m; 0 where all are plain anyway.
    pub plain: f32,
    /// Distance up to which every plant is drawn, m.
    pub full: f32,
    /// Distance beyond which none is, m.
    pub gone: f32,
    /// Width of a card or sheet, m.
    pub width: f32,
    /// k_w.
    pub wind_response: f32,
    /// Share of plants drawn up to `full`.
    pub fullness: f32,
    /// Steps, 0 to 1, that the picture lies before the state.
    pub behind: f32,
    /// Substeps of the wave: the time level before is one of them ago.
    pub substeps: f32,
    /// Gains of `billboard_earlier`.
    pub lag: [f32; 4],
    /// Steps done when the state was so; wraps.
    pub step: u32,
    /// Keeps the next at a multiple of 16 bytes.
    pub unused: [u32; 3],
    /// Of the picture before, for the plants of this one: [`super::identity::Identity::of_stand`]; all 0 in a picture's own preparing.
    pub identity: [u32; 4],
    /// Columns and rows of the sheets, the rest unused; all 0 for cards.
    pub sheet: [u32; 4],
}

impl PrepareUniform {
    /// What a stand's batch is prepared with; `plain` batches have one segment.
    pub fn new(world: &World, stand: &StandModel, plain: bool, seen: &Seen, look: &Look) -> Self {
        let Seen { fullness, near, behind, .. } = *seen;
        let [x, y, z] = seen.eye(world.model.patch_side);
        let species = &stand.species;
        Self {
            placement: stand.placement,
            grid: world.model.terrain.grid(),
            camera: [x, y, z, 0.0],
            segments: species.segments(),
            drawn: if plain { 1 } else { species.pieces() },
            bits: bits(stand.cells),
            layer: first_layer(look.kind),
            plain: if plain { 0.0 } else { species.plain_distance() },
            full: FULL_CELLS * stand.spacing as f32 * near as f32,
            gone: look.fade[1],
            width: species.width(),
            wind_response: species.continuum.wind,
            fullness: fullness as f32,
            behind: behind as f32,
            substeps: stand.substeps as f32,
            lag: stand.lag.past(),
            step: world.state.step as u32,
            unused: [0; 3],
            identity: [0; 4],
            sheet: species.sheet.as_ref().map_or([0; 4], |sheet| [sheet.columns, sheet.rows, 0, 0]),
        }
    }

    /// Whether plants are sheets.
    pub fn is_sheet(&self) -> bool {
        self.sheet[0] > 0
    }

    /// Joints of a plant: of a sheet, points of its grid.
    pub fn joints(&self) -> u32 {
        let side = self.drawn + 1;
        if self.is_sheet() { side * side } else { side }
    }
}

/// What the preparing of one stand reads.
pub struct Preparing<'a> {
    /// Numbers of the batch.
    pub uniform: PrepareUniform,
    /// The stand's cells.
    pub cells: &'a Cells,
    /// Ground.
    pub terrain: &'a Terrain,
    /// Where the stand grows.
    pub stand: &'a StandModel,
    /// The wind on the nodes of the stand.
    pub wind: &'a WindField,
    /// Node intervals along a patch side.
    pub intervals: u32,
}

/// A plant or a blade, as far as its bends ask.
#[derive(Clone, Copy, Debug)]
pub(super) struct Who {
    /// Its root, m from the corner of its patch.
    pub(super) local: [f32; 2],
    /// Height of its plant as it stands there, whole, m.
    pub(super) tall: f32,
    /// Its place among the blades of the patch: see [`crate::response::chain::planting::roots`].
    pub(super) index: u32,
    /// Unit ground vector along which it leans by itself.
    pub(super) heading: [f32; 2],
    /// The same as an angle, rad.
    pub(super) yaw: f32,
    /// By how much at the root, rad.
    pub(super) lean: f32,
    /// How much more at the tip, rad.
    pub(super) curl: f32,
    /// How its plant leans by itself, rad along x and z.
    pub(super) plant: [f32; 2],
}

/// Cell at a place of the drawing order: bit-reversed Morton, so that any first part of the order is spread evenly.
pub(super) fn ordered_cell(rank: u32, bits: u32) -> [u32; 2] {
    let mut cell = [0; 2];
    for b in 0..bits {
        let high = bits - 1 - b;
        cell[0] |= ((rank >> (2 * b)) & 1) << high;
        cell[1] |= (((rank >> (2 * b + 1)) ^ (rank >> (2 * b))) & 1) << high;
    }
    cell
}

/// Which of the nine patches around (and including) this one holds a cell, and the cell in it.
fn owner_of(cell: [i32; 2], side: i32) -> (usize, [usize; 2]) {
    let over = cell.map(|at| i32::from(at >= side) - i32::from(at < 0));
    let at = [0, 1].map(|axis| (cell[axis] - over[axis] * side) as usize);
    (((over[1] + 1) * 3 + over[0] + 1) as usize, at)
}

/// Segment number that asks for the lowest one at the moment of the picture.
const SHOWN: usize = usize::MAX;

/// A vector of a cell: its x in `plane`, its z in the next one.
fn vector(store: &[Box<[f32]>], slot: u32, area: usize, plane: usize, index: usize) -> Option<Vec2> {
    let planes = store.get(slot as usize)?;
    Some(Vec2::new(*planes.get(plane * area + index)?, *planes.get((plane + 1) * area + index)?))
}

impl Preparing<'_> {
    fn rest_at_plant(&self, phases: &Phases, local: [f32; 2]) -> Vec2 {
        wind::equilibrium(self.wind.velocity_local(phases, local), self.uniform.wind_response).into()
    }

    /// Bend of segment `segment` in one cell; β_eq where the patch sleeps, β where it keeps no upper segments.
    /// Segment [`SHOWN`] asks for the lowest one at the moment of the picture.
    fn cell_bend(&self, draw: &PatchDraw, cell: [i32; 2], segment: usize, rest: Vec2) -> Vec2 {
        let side = self.uniform.placement.cells as usize;
        let (owner, [i, j]) = owner_of(cell, side as i32);
        let (slot, lag) = (draw.slots[owner], draw.lags[owner]);
        if slot == NONE {
            return rest;
        }
        let (area, index) = (side * side, j * side + i);
        let (store, place, plane) = if segment > 0 && segment != SHOWN && lag != NONE {
            (&self.cells.lag, lag, 2 * (segment - 1))
        } else {
            (&self.cells.now, slot, 0)
        };
        // Cells that a GPU holds and that were not brought here: at rest.
        let bend = vector(store, place, area, plane, index).unwrap_or(rest);
        if segment != SHOWN || self.uniform.behind == 0.0 {
            return bend;
        }
        let before = vector(&self.cells.old, slot, area, 0, index).unwrap_or(rest);
        bend.lerp(before, self.uniform.behind * self.uniform.substeps)
    }

    /// Bend between the four cells around a plant.
    fn plant_bend(&self, draw: &PatchDraw, local: [f32; 2], segment: usize, rest: Vec2) -> Vec2 {
        let placement = &self.uniform.placement;
        let at = local.map(|metres| metres / placement.spacing - 0.5);
        let corner = at.map(f32::floor);
        let f = [at[0] - corner[0], at[1] - corner[1]];
        let cell = corner.map(|k| k as i32);
        let bend = |x: i32, z: i32| self.cell_bend(draw, [cell[0] + x, cell[1] + z], segment, rest);
        let low = bend(0, 0).lerp(bend(1, 0), f[0]);
        let high = bend(0, 1).lerp(bend(1, 1), f[0]);
        let bend = low.lerp(high, f[1]);
        let side = placement.spacing * placement.cells as f32;
        let [a, b, c, d] = draw.weights;
        let (x, z) = (local[0] / side, local[1] / side);
        let (low, high) = (a + (b - a) * x, c + (d - c) * x);
        rest.lerp(bend, low + (high - low) * z)
    }

    /// Where the gusts are over a patch.
    pub fn phases(&self, draw: &PatchDraw) -> Phases {
        self.wind.patch_phases(draw.patch, self.intervals)
    }

    /// The growth map of a patch, if it needs one.
    pub fn growth(&self, draw: &PatchDraw) -> Option<Box<[Growing]>> {
        self.stand.growth_map(self.terrain, draw.patch)
    }

    /// Bends of all segments of a plant or blade of a patch, at the moment of the picture, beyond what it bends by itself, lowest first.
    pub(super) fn bends(&self, draw: &PatchDraw, phases: &Phases, who: &Who, bends: &mut [[f32; 2]]) {
        if let Some(chain) = &self.stand.chain {
            return self.chain_bends(chain, draw, phases, who, bends);
        }
        if let Some(springs) = &self.stand.springs {
            return self.sheet_bends(springs, draw, phases, who, bends);
        }
        if let Some(oscillator) = &self.stand.oscillator {
            return self.swings(&oscillator.coefficients, draw, phases, who, bends);
        }
        let (prepare, root) = (&self.uniform, who.local);
        // Where cells rule alone, the wind is not asked.
        let alone = draw.weights == [1.0; 4] && !draw.slots.contains(&NONE);
        let rest = if alone { Vec2::ZERO } else { self.rest_at_plant(phases, root) };
        // Where no upper segments are kept, all show what the lowest does.
        let gains = if draw.lags[4] == NONE { [0.0, 0.0, 1.0, 1.0] } else { prepare.lag };
        let mut below = self.plant_bend(draw, root, 0, rest);
        let mut shown = self.plant_bend(draw, root, SHOWN, rest);
        for (at, bend) in bends.iter_mut().enumerate() {
            if at > 0 {
                let here = self.plant_bend(draw, root, at, rest);
                let moved = prepare.behind > 0.0;
                shown = if moved { earlier(here.into(), [below.into(), shown.into()], gains, prepare.behind).into() } else { here };
                below = here;
            }
            *bend = shown.into();
        }
    }

    /// The same where a stand moves blade by blade: by its own state if it has one, else by the virtual blades around it.
    fn chain_bends(&self, chain: &ChainModel, draw: &PatchDraw, phases: &Phases, who: &Who, bends: &mut [[f32; 2]]) {
        let (behind, patch_side) = (self.uniform.behind, self.uniform.placement.spacing * self.uniform.placement.cells as f32);
        let base = chain::planted(who.yaw, who.lean);
        let standing = Standing { chain, around: draw.slots, weights: draw.weights, patch_side };
        let held = self.held(chain, draw.lags[4], who.index);
        let hold = held.map_or(0.0, |held| held.hold + (held.hold_before - held.hold) * behind);
        let own = held.map(|held| {
            let own = held.state.bends();
            chain::mixed(&own, &held.before, behind)
        });
        let stands = || {
            let air = || self.wind.velocity_local(phases, who.local);
            let mut moments = standing.moments(&self.cells.now, who.local, air);
            if behind > 0.0 {
                moments = chain::mixed(&moments, &standing.moments(&self.cells.old, who.local, air), behind);
            }
            standing.pose(&base, who.curl, &moments)
        };
        let shown = match own {
            Some(own) if hold >= 1.0 => own,
            Some(own) if hold > 0.0 => chain::mixed(&stands(), &own, hold),
            _ => stands(),
        };
        chain::leans(chain, &base, who.heading, [who.lean, who.curl], &shown, bends);
    }

    /// The same where every plant swings by itself: a function of how bodies left it, and of time.
    fn swings(&self, co: &OscillatorCoefficients, draw: &PatchDraw, phases: &Phases, who: &Who, bends: &mut [[f32; 2]]) {
        let (prepare, placement) = (&self.uniform, &self.uniform.placement);
        let (area, patch_side) = (placement.cells * placement.cells, placement.spacing * placement.cells as f32);
        let air = Air { co, levels: &self.cells.old, around: draw.slots, weights: draw.weights, patch_side };
        let [x, z] = air.at(who.local, prepare.behind, || self.wind.velocity_local(phases, who.local));
        let cell = who.index % area;
        // Cells that a GPU holds and that were not brought here: at rest.
        let planes = self.cells.now.get(draw.slots[4] as usize).filter(|planes| planes.len() == 4 * area as usize);
        let [dx, dz] = planes.map_or([0.0; 2], |planes| {
            let own = Own::of(co, placement::variety(placement, draw.patch, cell), who.tall);
            Record::load(planes, area as usize, cell as usize).at(co, &own, prepare.step, prepare.behind)
        });
        let bend = oscillator::limited([x + dx, z + dz]);
        let segments = bends.len() as u32;
        for (segment, out) in bends.iter_mut().enumerate() {
            *out = oscillator::curved(co.curve, bend, segment as u32, segments);
        }
    }

    /// The same where bodies deform billboards: as the middle of the billboard's sheet bends.
    fn sheet_bends(&self, springs: &SpringsModel, draw: &PatchDraw, phases: &Phases, who: &Who, bends: &mut [[f32; 2]]) {
        let (height, slope) = self.terrain.height_and_gradient(draw.anchor, who.local);
        let plant = Placed { root: who.local, height: who.tall, yaw: who.yaw, tint: 0.0, lean: who.plant };
        let root = springs.root(&plant, height, slope);
        let target = springs::target_of(springs, &root, self.wind, phases);
        let (co, area) = (&springs.coefficients, self.uniform.placement.cells * self.uniform.placement.cells);
        let stored = springs::pool::stored(co, self.cells, draw.slots[4], who.index % area);
        let sheet = stored.map_or(target, |stored| springs::pool::load(co, &root, stored).shown(co, &root, &target));
        let (rows, count) = (co.sides().1, bends.len());
        for (segment, bend) in bends.iter_mut().enumerate() {
            let row = (segment * (rows - 1) + (rows - 1) / 2) / count.max(1);
            let [x, z] = sheet.tilt(co, [row, row + 1]);
            *bend = [x - who.plant[0], z - who.plant[1]];
        }
    }

    /// The state of a blade of a lag slot, if it has one.
    fn held(&self, chain: &ChainModel, lag: u32, index: u32) -> Option<HeldBlade> {
        let values = self.cells.lag.get(lag as usize).filter(|values| lag != NONE && !values.is_empty())?;
        let total = chain.blades_of_patch(self.uniform.placement.cells) as usize;
        (values.len() == chain.planes() * total).then(|| chain::loaded(values, total, index as usize, chain.coefficients.segments as usize))
    }

    /// Solves the plants of one patch: `draw.count` plants, and the joints of each. Places without a plant get height 0.
    pub fn prepare_patch(&self, draw: &PatchDraw, plants: &mut [Plant], joints: &mut [[f32; 4]]) {
        let (phases, growth) = (self.phases(draw), self.growth(draw));
        let per_plant = self.uniform.joints() as usize;
        for (rank, (plant, joints)) in plants.iter_mut().zip(joints.chunks_exact_mut(per_plant)).enumerate() {
            *plant = self.prepare_plant(draw, &phases, growth.as_deref(), rank as u32, joints).unwrap_or_default();
        }
    }

    fn prepare_plant(
        &self,
        draw: &PatchDraw,
        phases: &Phases,
        growth: Option<&[Growing]>,
        rank: u32,
        joints: &mut [[f32; 4]],
    ) -> Option<Plant> {
        let prepare = &self.uniform;
        let cell = ordered_cell(rank, prepare.bits);
        if cell.iter().any(|at| *at >= prepare.placement.cells) {
            return None;
        }
        let mut placed = placement::plant(&prepare.placement, draw.patch, cell)?;
        if let Some(growth) = growth {
            placed = placement::grown(placed, growth[(cell[1] * prepare.placement.cells + cell[0]) as usize])?;
        }
        let ground = self.terrain.height(draw.anchor, placed.root);
        let root = Vec3::new(draw.offset[0] + placed.root[0], ground, draw.offset[1] + placed.root[1]);
        let away = root.distance(Vec3::new(prepare.camera[0], prepare.camera[1], prepare.camera[2]));
        // Farther off fewer plants stand for more: each grows wider, and the last ones shrink before they go.
        let thin = (prepare.full / away.max(1e-3)).powf(THINNING).min(1.0) * prepare.fullness;
        let place = (rank as f32 + 0.5) / (1_u32 << (2 * prepare.bits)) as f32;
        let stay = ((thin - place) / (0.12 * thin)).clamp(0.0, 1.0);
        let then = prepare.identity[2] > 0;
        // The picture before may have left out what this one shows: its smallest form then.
        if !then && (stay <= 0.0 || away >= prepare.gone) {
            return None;
        }
        let height = placed.height * (0.35 + (1.0 - 0.35) * stay);
        let straight = if prepare.plain > 0.0 { math::smoothstep(0.75 * prepare.plain, 0.97 * prepare.plain, away) } else { 0.0 };
        let index = cell[1] * prepare.placement.cells + cell[0];
        let (yaw, lean) = placement::combed(0.0, 0.0, placed.lean);
        let (sine, cosine) = math::sin_cos(yaw);
        let who = Who { local: placed.root, tall: placed.height, index, heading: [cosine, sine], yaw, lean, curl: 0.0, plant: placed.lean };
        let width = prepare.width * (0.8 + 0.4 * (placed.tint * 17.3).fract()) * (1.0 / thin.sqrt()).min(2.2) * (0.5 + 0.5 * stay);
        if prepare.is_sheet() {
            self.sheet(draw, phases, &Rooted { who, ground, height, straight, yaw: placed.yaw, width }, joints);
        } else {
            self.spine(draw, phases, &who, [ground, height, straight], joints);
        }
        let chance = (placed.tint * 61.7).fract();
        let picture = prepare.layer + ((chance * VARIANTS as f32) as u32).min(VARIANTS - 1);
        Some(Plant {
            root: root.to_array(),
            height,
            yaw: placed.yaw,
            width,
            tint: placed.tint,
            layer: if then { identity::number(prepare.identity, draw.patch, cell[1] * prepare.placement.cells + cell[0]) } else { picture },
        })
    }

    /// Joints of a plant that stands on `ground`, bent segment by segment.
    fn spine(&self, draw: &PatchDraw, phases: &Phases, who: &Who, [ground, height, straight]: [f32; 3], joints: &mut [[f32; 4]]) {
        let prepare = &self.uniform;
        let mut bends = [[0.0; 2]; 8];
        let floor = |at: Vec3| self.terrain.height(draw.anchor, [at.x, at.z]) + CLEARANCE;
        let (segments, drawn) = (prepare.segments as usize, prepare.drawn as usize);
        let length = height / prepare.segments as f32;
        let start = Vec3::new(who.local[0], ground, who.local[1]);
        let mut spine = [start; 9];
        let mut local = start;
        let bends = &mut bends[..segments.min(8)];
        self.bends(draw, phases, who, bends);
        for (at, bend) in bends.iter().enumerate() {
            local += Vec3::from(segment(leaning(*bend, who.plant), length));
            local.y = math::upper(local.y, floor(local));
            spine[at + 1] = local;
        }
        let shift = Vec3::new(draw.offset[0], 0.0, draw.offset[1]);
        for (k, joint) in joints.iter_mut().enumerate() {
            let mut at = start.lerp(local, k as f32 / drawn as f32);
            if drawn == segments {
                at = spine[k].lerp(at, straight);
            }
            if k > 0 {
                at.y = math::upper(at.y, floor(at));
            }
            *joint = (at + shift).extend(0.0).to_array();
        }
    }
}
