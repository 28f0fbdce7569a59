//! Growth maps of the patches in sight: squares of a texture, a byte a cell, or four where pictures say how plants lie. Patches that nothing limits
//! have none.

use std::collections::{BTreeMap, BTreeSet};

use sward::picture::plan::PatchDraw;
use sward::placement::Growing;
use sward::response::StandModel;
use sward::state::{NONE, PatchKey};
use sward::world::World;

use crate::gpu::Gpu;

/// The maps of one stand, kept from picture to picture while their patches are in sight.
pub struct GrowthMaps {
    texture: wgpu::Texture,
    /// What `prepare.wgsl` reads.
    pub view: wgpu::TextureView,
    side: u32,
    combed: bool,
    /// Place of each patch; `NONE` for those without a map.
    places: BTreeMap<PatchKey, u32>,
    free: BTreeSet<u32>,
    room: u32,
    /// Changes of the ground, and of what grows on it, that the maps know of.
    edits: [u64; 2],
    /// Maps made since the start.
    pub made: u64,
}

fn texture(gpu: &Gpu, side: u32, combed: bool, room: u32) -> wgpu::Texture {
    let columns = columns(gpu, side).min(room.max(1));
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("growth maps"),
        size: wgpu::Extent3d { width: columns * side, height: room.max(1).div_ceil(columns) * side, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        // What the narrow one lacks is 0 but for the last, which then says nothing.
        format: if combed { wgpu::TextureFormat::Rgba8Uint } else { wgpu::TextureFormat::R8Uint },
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    })
}

/// Maps that fit beside each other.
fn columns(gpu: &Gpu, side: u32) -> u32 {
    (gpu.device.limits().max_texture_dimension_2d / side).clamp(1, 32)
}

impl GrowthMaps {
    /// No maps yet.
    pub fn new(gpu: &Gpu, stand: &StandModel) -> Self {
        let combed = !stand.growth.combs.is_empty();
        let texture = texture(gpu, stand.cells, combed, 1);
        let view = texture.create_view(&Default::default());
        let (places, free) = (BTreeMap::new(), BTreeSet::new());
        Self { texture, view, side: stand.cells, combed, places, free, room: 0, edits: [0; 2], made: 0 }
    }

    /// Makes the maps that the patches of a picture still lack, and tells each patch where its own is.
    pub fn place(&mut self, gpu: &Gpu, world: &World, stand: &StandModel, draws: &mut [&mut PatchDraw]) {
        if stand.growth.is_free() {
            return;
        }
        self.forget(world, stand, draws);
        let mut fresh = Vec::new();
        for draw in draws {
            if !self.places.contains_key(&draw.patch) {
                let map = stand.growth_map(&world.model.terrain, draw.patch);
                let place = if map.is_some() { self.free.pop_first().unwrap_or_else(|| self.next()) } else { NONE };
                self.places.insert(draw.patch, place);
                fresh.extend(map.map(|map| (place, map)));
            }
            draw.growth = self.places.get(&draw.patch).copied().unwrap_or(NONE);
        }
        self.made += fresh.len() as u64;
        if self.grow(gpu) {
            // The texture is a new one: all maps go there again.
            let kept = self.places.iter().filter(|(_, place)| **place != NONE);
            fresh = kept.filter_map(|(patch, place)| Some((*place, stand.growth_map(&world.model.terrain, *patch)?))).collect();
        }
        fresh.iter().for_each(|(place, map)| self.write(gpu, *place, map));
    }

    fn next(&mut self) -> u32 {
        let used = self.places.values().filter(|place| **place != NONE).max();
        used.map_or(0, |place| place + 1)
    }

    /// Drops maps of patches out of sight, and all of them when the ground or what grows on it has changed.
    fn forget(&mut self, world: &World, stand: &StandModel, draws: &[&mut PatchDraw]) {
        let seen: BTreeSet<PatchKey> = draws.iter().map(|draw| draw.patch).collect();
        let edits = [world.model.terrain.changes(), stand.growth.tended.changes()];
        let changed = self.edits != edits;
        self.edits = edits;
        let gone: Vec<PatchKey> = self.places.keys().filter(|patch| changed || !seen.contains(*patch)).copied().collect();
        for patch in gone {
            if let Some(place) = self.places.remove(&patch).filter(|place| *place != NONE) {
                self.free.insert(place);
            }
        }
    }

    fn grow(&mut self, gpu: &Gpu) -> bool {
        let wanted = self.places.values().filter(|place| **place != NONE).max().map_or(0, |place| place + 1);
        let grows = wanted > self.room;
        if grows {
            self.room = wanted.next_power_of_two();
            self.texture = texture(gpu, self.side, self.combed, self.room);
            self.view = self.texture.create_view(&Default::default());
        }
        grows
    }

    fn write(&self, gpu: &Gpu, place: u32, map: &[Growing]) {
        let columns = self.texture.width() / self.side;
        let origin = wgpu::Origin3d { x: place % columns * self.side, y: place / columns * self.side, z: 0 };
        let shares: Vec<u8> = if self.combed { Vec::new() } else { map.iter().map(|growing| growing.share).collect() };
        let (bytes, row) = if self.combed { (bytemuck::cast_slice(map), 4 * self.side) } else { (&shares[..], self.side) };
        gpu.queue.write_texture(
            wgpu::TexelCopyTextureInfo { texture: &self.texture, mip_level: 0, origin, aspect: wgpu::TextureAspect::All },
            bytes,
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None },
            wgpu::Extent3d { width: self.side, height: self.side, depth_or_array_layers: 1 },
        );
    }
}
