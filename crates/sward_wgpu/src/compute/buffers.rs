//! The cells of one stand on the GPU. Buffers grow with the number of slots in use, never with the terrain.

use sward::response::StandModel;
use sward::response::continuum::half;
use sward::response::springs::pool;
use sward::response::{chain, continuum, oscillator};
use sward::scene::Precision;
use sward::state::{Awake, Cells, NONE, Root, StandState};

use super::blades::ChainUniform;
use super::download::Arriving;
use super::sheets::SheetUniform;
use super::swings::SwingUniform;
use crate::gpu::{Gpu, GpuError};

/// Two time levels, upper segments, ground and wind nodes of one stand.
pub struct CellBuffers {
    /// How cells are stored.
    pub precision: Precision,
    cells: u32,
    /// Words of a slot and of a lag slot.
    sizes: Sizes,
    /// Slots there is room for.
    slots: u32,
    lag_slots: u32,
    /// Slots there is ground for.
    ground_slots: u32,
    /// Steepest slope under the cells of each slot: 0 on level ground, and without end where it is not known.
    pub steepest: Vec<f32>,
    /// Time level n; 4·cells² words a slot, or 2·cells² at half precision.
    pub now: wgpu::Buffer,
    /// Time level n−1. Where plants swing by themselves `now` holds records, and this one their tilt in the wind.
    pub old: wgpu::Buffer,
    /// Slope x, slope z, height; 3·cells² values a slot.
    pub ground: wgpu::Buffer,
    /// β_eq at wind nodes; (cells/2 + 3)² vectors a slot.
    pub nodes: wgpu::Buffer,
    /// Upper segments; 2(n−1)·cells² values a lag slot.
    pub upper: wgpu::Buffer,
    /// Ring of past β for the `history` lag.
    pub past: wgpu::Buffer,
    /// States of virtual blades, where a stand moves blade by blade; then `now` and `old` are their moments, `upper` blades with a state.
    pub states: wgpu::Buffer,
    /// Where those stand.
    pub roots: wgpu::Buffer,
    /// How far the plant of each cell has grown, four to a word; of stands of plants that swing by themselves.
    pub grown: wgpu::Buffer,
    /// Whether that is known of all slots in use: not before something limits the stand.
    pub knows_growth: bool,
    /// Sheets of deformed billboards, place by place; `now` says whose is where.
    pub sheets: wgpu::Buffer,
    /// What pictures read of the response, but for the continuum.
    pub numbers: Option<Numbers>,
}

/// What pictures read of a response.
pub enum Numbers {
    /// `ChainStand` of `chain_stand.wgsl`.
    Chain(wgpu::Buffer),
    /// `SwingStand` of `swing_bends.wgsl`.
    Swing(wgpu::Buffer),
    /// `SheetStand` of `sheet_bends.wgsl`.
    Sheet(wgpu::Buffer),
}

impl Numbers {
    fn of(gpu: &Gpu, stand: &StandModel) -> Option<Self> {
        let made = |bytes: &[u8]| gpu.filled("numbers of the response", bytes, wgpu::BufferUsages::UNIFORM);
        if let Some(chain) = &stand.chain {
            return Some(Self::Chain(made(bytemuck::bytes_of(&ChainUniform::new(stand, chain, 0.0, [0, 0])))));
        }
        if let Some(springs) = &stand.springs {
            return Some(Self::Sheet(made(bytemuck::bytes_of(&SheetUniform::new(springs)))));
        }
        let oscillator = stand.oscillator.as_ref()?;
        Some(Self::Swing(made(bytemuck::bytes_of(&SwingUniform::new(stand, oscillator)))))
    }

    /// The uniform.
    pub fn buffer(&self) -> &wgpu::Buffer {
        match self {
            Self::Chain(buffer) | Self::Swing(buffer) | Self::Sheet(buffer) => buffer,
        }
    }
}

/// Words of 32 bits that each buffer takes: of a slot, or of a lag slot.
#[derive(Clone, Copy)]
struct Sizes {
    /// One time level at full precision.
    level: u64,
    /// The level before.
    before: u64,
    nodes: u64,
    states: u64,
    /// Ground; 0 where none is ever stored.
    ground: u64,
    grown: u64,
    /// Of a sheet.
    sheet: u64,
    /// Of a lag slot from here on.
    upper: u64,
    ring: u64,
    roots: u64,
}

impl Sizes {
    fn of(stand: &StandModel) -> Self {
        let area = u64::from(stand.cells) * u64::from(stand.cells);
        if let Some(chain) = &stand.chain {
            let [level, states, upper] = chain::sizes(chain, stand.cells).map(|words| words as u64);
            let roots = u64::from(chain.blades_of_patch(stand.cells)) * (size_of::<Root>() / 4) as u64;
            return Self { level, before: level, nodes: 0, states, ground: 0, grown: 0, sheet: 0, upper, ring: 0, roots };
        }
        if let Some(springs) = &stand.springs {
            let sheet = pool::words(&springs.coefficients) as u64;
            return Self { level: area, before: 0, nodes: 0, states: 0, ground: 0, grown: 0, sheet, upper: 0, ring: 0, roots: 0 };
        }
        if let Some(oscillator) = &stand.oscillator {
            let [level, before] = oscillator::sizes(oscillator, stand.cells).map(|words| words as u64);
            return Self { level, before, nodes: 0, states: 0, ground: 3 * area, grown: area / 4, sheet: 0, upper: 0, ring: 0, roots: 0 };
        }
        let nodes = u64::from(stand.cells / 2 + 3) * u64::from(stand.cells / 2 + 3) * 2;
        let [upper, ring] = continuum::lag_planes(&stand.lag).map(|planes| planes as u64 * area);
        Self { level: 4 * area, before: 4 * area, nodes, states: 0, ground: 3 * area, grown: 0, sheet: 0, upper, ring, roots: 0 }
    }
}

/// Slots of `each` words that fit `limit` words.
fn fitting(limit: u64, each: u64) -> u32 {
    limit.checked_div(each).map_or(u32::MAX, |slots| slots.min(u64::from(u32::MAX)) as u32)
}

fn storage(gpu: &Gpu, label: &str, floats: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size: floats.max(4) * 4,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    })
}

impl CellBuffers {
    /// Empty buffers for a stand.
    pub fn new(gpu: &Gpu, stand: &StandModel, precision: Precision) -> Self {
        let empty = || storage(gpu, "empty", 0);
        Self {
            // Moments and records are never halved.
            precision: if stand.chain.is_some() || stand.settle().is_some() { Precision::Full } else { precision },
            cells: stand.cells,
            sizes: Sizes::of(stand),
            slots: 0,
            lag_slots: 0,
            ground_slots: 0,
            steepest: Vec::new(),
            now: empty(),
            old: empty(),
            ground: empty(),
            nodes: empty(),
            upper: empty(),
            past: empty(),
            states: empty(),
            roots: empty(),
            grown: empty(),
            knows_growth: false,
            sheets: empty(),
            numbers: Numbers::of(gpu, stand),
        }
    }

    /// Follows a stand whose response has other numbers, or whose wind varies now.
    pub fn follow(&mut self, gpu: &Gpu, stand: &StandModel) {
        self.numbers = Numbers::of(gpu, stand);
        let sizes = Sizes::of(stand);
        if sizes.before != self.sizes.before {
            self.sizes = sizes;
            self.old = storage(gpu, "cells before", u64::from(self.slots) * self.level_before());
        }
    }

    fn area(&self) -> u64 {
        u64::from(self.cells) * u64::from(self.cells)
    }

    /// Whether the ground under cells is stored.
    pub fn has_ground(&self) -> bool {
        self.ground_slots > 0
    }

    /// Bytes of β and ω at two times, as allocated.
    pub fn state_bytes(&self) -> u64 {
        self.now.size() + self.old.size()
    }

    /// Bytes of a cell in one time level.
    pub fn cell_bytes(&self) -> u64 {
        4 * self.level() / self.area()
    }

    /// Words of a time level of a slot.
    fn level(&self) -> u64 {
        if self.precision == Precision::Half { self.sizes.level / 2 } else { self.sizes.level }
    }

    /// Words of the time level before.
    fn level_before(&self) -> u64 {
        if self.precision == Precision::Half { self.sizes.before / 2 } else { self.sizes.before }
    }

    /// Zeroes the cells of a slot.
    pub fn clear(&self, encoder: &mut wgpu::CommandEncoder, slot: u32) {
        let bytes = 4 * self.level();
        encoder.clear_buffer(&self.now, u64::from(slot) * bytes, Some(bytes));
    }

    /// Makes room for the slots that `state` uses, keeping what is stored: doubled as they grow, but never more than the budget allows.
    /// True if buffers were replaced; where that fails, all of them are as before.
    ///
    /// # Errors
    /// More cells than one buffer of this device can bind, or what the device reports.
    pub fn reserve(&mut self, gpu: &Gpu, state: &StandState, level: bool) -> Result<bool, GpuError> {
        let most = |pick: fn(&Awake) -> u32| state.awake.values().map(pick).filter(|slot| *slot != NONE).max().map_or(0, |slot| slot + 1);
        let (slots, lag_slots) = (most(|awake| awake.slot), most(|awake| awake.lag));
        let grounded = level || slots <= self.ground_slots;
        if slots <= self.slots && lag_slots <= self.lag_slots && grounded {
            return Ok(false);
        }
        let limit = gpu.device.limits().max_storage_buffer_binding_size / 4;
        let [slots, lag_slots] = self.room(state, limit, slots, lag_slots)?;
        self.grow(gpu, slots, lag_slots, level)?;
        self.steepest.resize(slots as usize, if level { 0.0 } else { f32::MAX });
        Ok(true)
    }

    /// Slots and lag slots to make room for, in buffers of at most `limit` words.
    fn room(&self, state: &StandState, limit: u64, slots: u32, lag_slots: u32) -> Result<[u32; 2], GpuError> {
        let lag_budget = state.awake.values().filter(|awake| awake.lag != NONE).count() + state.lag_free.len();
        // The ground under a cell takes three words. Level ground may be edited, so it counts there, too: no world that runs stops then.
        let widest = self.level().max(self.sizes.ground).max(self.sizes.states);
        let lag_widest = self.sizes.upper.max(self.sizes.ring).max(self.sizes.roots);
        let (fits, lag_fits) = (fitting(limit, widest), fitting(limit, lag_widest));
        if slots > fits {
            return Err(GpuError::TooManyCells { slots, cells: self.cells, most: fits });
        }
        if lag_slots > lag_fits {
            return Err(GpuError::TooManyLagCells { slots: lag_slots, cells: self.cells, most: lag_fits });
        }
        let room = |wanted: u32, have: u32, budget: usize, fits: u32| {
            wanted.next_power_of_two().max(have).min(fits.min((budget as u32).max(wanted)))
        };
        let budget = state.awake.len() + state.free.len();
        Ok([room(slots, self.slots, budget, fits), room(lag_slots, self.lag_slots, lag_budget, lag_fits)])
    }

    /// Makes room for the sheets of a state, keeping what is stored.
    ///
    /// # Errors
    /// More sheets than one buffer of this device can bind, or what the device reports.
    pub fn reserve_sheets(&mut self, gpu: &Gpu, state: &StandState) -> Result<(), GpuError> {
        let wanted = u64::from(state.sheets.pool.used()) * self.sizes.sheet;
        if wanted * 4 <= self.sheets.size() {
            return Ok(());
        }
        let limit = gpu.device.limits().max_storage_buffer_binding_size / 4;
        if wanted > limit {
            return Err(GpuError::TooManySheets { sheets: state.sheets.pool.used(), most: fitting(limit, self.sizes.sheet) });
        }
        let larger = storage(gpu, "sheets", wanted.next_power_of_two().min(limit));
        gpu.check()?;
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        encoder.copy_buffer_to_buffer(&self.sheets, 0, &larger, 0, Some(self.sheets.size()));
        gpu.queue.submit([encoder.finish()]);
        self.sheets = larger;
        Ok(())
    }

    /// Writes the sheets that the CPU holds; returns their bytes.
    pub fn upload_sheets(&self, gpu: &Gpu, cells: &Cells) -> u64 {
        let words = if self.sizes.sheet > 0 { (self.sheets.size() / 4).min(cells.sheets.len() as u64) as usize } else { 0 };
        if words > 0 {
            gpu.queue.write_buffer(&self.sheets, 0, bytemuck::cast_slice(&cells.sheets[..words]));
        }
        4 * words as u64
    }

    /// What is copied to read the sheets back: those of all places a state has ever used.
    pub(crate) fn copied_sheets(&self, state: &StandState) -> Vec<(&wgpu::Buffer, u64)> {
        let bytes = 4 * u64::from(state.sheets.pool.used()) * self.sizes.sheet;
        vec![(&self.sheets, bytes.min(self.sheets.size()))]
    }

    /// Says whose sheet is where in the cells of a slot.
    pub fn place_sheets(&self, gpu: &Gpu, slot: u32, places: &[f32]) {
        gpu.queue.write_buffer(&self.now, u64::from(slot) * places.len() as u64 * 4, bytemuck::cast_slice(places));
    }

    fn grow(&mut self, gpu: &Gpu, slots: u32, lag_slots: u32, level: bool) -> Result<(), GpuError> {
        let (sizes, stored, stored_before) = (self.sizes, self.level(), self.level_before());
        let ground_slots = if level { self.ground_slots } else { slots };
        let (both, ground, lags) = ([self.slots, slots], [self.ground_slots, ground_slots], [self.lag_slots, lag_slots]);
        let mut growing = vec![
            (&mut self.now, "cells now", both, stored),
            (&mut self.old, "cells before", both, stored_before),
            (&mut self.grown, "growth", both, sizes.grown),
            (&mut self.nodes, "rest at wind nodes", both, sizes.nodes),
            (&mut self.states, "virtual blades", both, sizes.states),
            (&mut self.ground, "ground under cells", ground, sizes.ground),
            (&mut self.upper, "upper segments", lags, sizes.upper),
            (&mut self.past, "past bend", lags, sizes.ring),
            (&mut self.roots, "where blades stand", lags, sizes.roots),
        ];
        growing.retain(|(_, _, [have, want], each)| want > have && *each > 0);
        let larger: Vec<wgpu::Buffer> =
            growing.iter().map(|(_, label, [_, want], each)| storage(gpu, label, u64::from(*want) * each)).collect();
        // Nothing is replaced before there is room for all.
        gpu.check()?;
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        for ((buffer, _, [have, _], each), larger) in growing.into_iter().zip(larger) {
            if have > 0 {
                encoder.copy_buffer_to_buffer(buffer, 0, &larger, 0, Some(u64::from(have) * each * 4));
            }
            *buffer = larger;
        }
        gpu.queue.submit([encoder.finish()]);
        (self.slots, self.lag_slots, self.ground_slots) = (slots, lag_slots, ground_slots);
        Ok(())
    }

    /// Becomes a copy of what a picture reads of `other`, stored as it is there: both time levels and the upper segments. There is room
    /// for nothing else then: [`CellBuffers::reserve`] begins anew.
    pub fn copy_from(&mut self, gpu: &Gpu, other: &Self) {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let pairs =
            [(&mut self.now, &other.now), (&mut self.old, &other.old), (&mut self.upper, &other.upper), (&mut self.sheets, &other.sheets)];
        for (own, from) in pairs {
            if own.size() != from.size() {
                *own = storage(gpu, "cells of the picture before", from.size() / 4);
            }
            encoder.copy_buffer_to_buffer(from, 0, own, 0, Some(from.size()));
        }
        self.precision = other.precision.clone();
        (self.slots, self.lag_slots, self.ground_slots) = (0, 0, 0);
        gpu.queue.submit([encoder.finish()]);
    }

    /// The two time levels change roles.
    pub fn swap(&mut self) {
        std::mem::swap(&mut self.now, &mut self.old);
    }

    /// Writes the cells of awake patches that the CPU holds. What was stored at half precision once is stored as the same bits again.
    pub fn upload(&mut self, gpu: &Gpu, state: &StandState) {
        let write = |buffer: &wgpu::Buffer, values: Option<&Box<[f32]>>, slot: u32| {
            if let Some(values) = values.filter(|values| !values.is_empty()) {
                gpu.queue.write_buffer(buffer, u64::from(slot) * values.len() as u64 * 4, bytemuck::cast_slice(values));
            }
        };
        let write_level = |buffer: &wgpu::Buffer, values: Option<&Box<[f32]>>, slot: u32, dither: u32| match values {
            Some(values) if self.precision == Precision::Half => {
                let packed = half::pack_patch(values, dither);
                gpu.queue.write_buffer(buffer, u64::from(slot) * packed.len() as u64 * 4, bytemuck::cast_slice(&packed));
            }
            _ => write(buffer, values, slot),
        };
        self.upload_sheets(gpu, &state.cells);
        for (patch, awake) in &state.awake {
            let dither = half::patch_dither(*patch, 0);
            let (slot, lag) = (awake.slot as usize, awake.lag as usize);
            write_level(&self.now, state.cells.now.get(slot), awake.slot, dither);
            write_level(&self.old, state.cells.old.get(slot), awake.slot, dither);
            if let Some(ground) = state.cells.ground.get(slot).filter(|_| self.ground_slots > awake.slot) {
                let planes = ground.planes(self.area() as usize);
                let bytes = bytemuck::cast_slice(&planes);
                gpu.queue.write_buffer(&self.ground, u64::from(awake.slot) * bytes.len() as u64, bytes);
            }
            if let Some(ground) = state.cells.ground.get(slot) {
                self.grow_plants(gpu, awake.slot, &ground.grown);
            }
            write(&self.states, state.cells.virtual_states.get(slot), awake.slot);
            write(&self.upper, state.cells.lag.get(lag), awake.lag);
            if let Some(roots) = state.cells.roots.get(lag).filter(|roots| awake.lag != NONE && !roots.is_empty()) {
                self.plant(gpu, awake.lag, roots);
            }
            write(&self.past, state.cells.history.get(lag), awake.lag);
            if let (Some(steepest), Some(ground)) = (self.steepest.get_mut(slot), state.cells.ground.get(slot)) {
                *steepest = ground.steepest;
            }
        }
    }

    /// Says how far the plants of a slot have grown; all of them where `grown` is empty.
    pub fn grow_plants(&self, gpu: &Gpu, slot: u32, grown: &[u8]) {
        if self.sizes.grown == 0 {
            return;
        }
        let whole = vec![u8::MAX; self.area() as usize];
        gpu.queue.write_buffer(&self.grown, u64::from(slot) * 4 * self.sizes.grown, if grown.is_empty() { &whole } else { grown });
    }

    /// Says where the blades of a lag slot stand.
    pub fn plant(&self, gpu: &Gpu, lag: u32, roots: &[Root]) {
        let bytes = bytemuck::cast_slice(roots);
        gpu.queue.write_buffer(&self.roots, u64::from(lag) * bytes.len() as u64, bytes);
    }

    /// What is copied to read all slots back, in the order in which [`CellBuffers::arrive`] takes it.
    pub(crate) fn copied(&self) -> Vec<(&wgpu::Buffer, u64)> {
        let Sizes { upper, ring, states, level, before, .. } = self.sizes;
        let packed = 2 * self.area();
        let [level, before] = if self.precision == Precision::Full { [level, before] } else { [packed; 2] };
        let (slots, lags) = (u64::from(self.slots), u64::from(self.lag_slots));
        vec![
            (&self.now, 4 * slots * level),
            (&self.old, 4 * slots * before),
            (&self.upper, 4 * lags * upper),
            (&self.past, 4 * lags * ring),
            (&self.states, 4 * slots * states),
        ]
    }

    /// Takes all slots over into `cells`.
    ///
    /// # Errors
    /// What the device reports.
    pub(crate) fn arrive(&self, gpu: &Gpu, arriving: &mut Arriving, cells: &mut Cells) -> Result<(), GpuError> {
        let split = |values: Vec<f32>, floats: u64| -> Vec<Box<[f32]>> {
            if floats == 0 { Vec::new() } else { values.chunks_exact(floats as usize).map(Into::into).collect() }
        };
        let area = self.area();
        let Sizes { upper, ring, states, .. } = self.sizes;
        let levels = |arriving: &mut Arriving, level: u64| -> Result<Vec<Box<[f32]>>, GpuError> {
            if self.precision == Precision::Full {
                return Ok(split(arriving.next(gpu)?, level));
            }
            let packed: Vec<u32> = arriving.next(gpu)?;
            Ok(packed.chunks_exact(2 * area as usize).map(|words| half::unpack_patch(words).into()).collect())
        };
        cells.now = levels(arriving, self.sizes.level)?;
        cells.old = levels(arriving, self.sizes.before)?;
        cells.old.resize(cells.now.len(), Box::default());
        cells.lag = split(arriving.next(gpu)?, upper);
        cells.history = split(arriving.next(gpu)?, ring);
        cells.history.resize(cells.lag.len(), Box::default());
        cells.virtual_states = split(arriving.next(gpu)?, states);
        cells.ground.resize(cells.now.len(), Default::default());
        Ok(())
    }
}
