//! One plant as the drawing side takes it.

/// Plants drawn by one instance. Buffers are filled up to a multiple of this with plants of height 0.
pub const PLANTS_PER_INSTANCE: u32 = 64;
/// Most segments of a card.
pub const MOST_SEGMENTS: u32 = 8;
/// Most crossed cards of a plant.
pub const MOST_CARDS: u32 = 3;

/// One plant as the drawing side reads it (`Plant` of `plants.wgsl`), 32 bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Plant {
    /// Metres relative to the frame origin.
    pub root: [f32; 3],
    /// Metres; 0 = no plant.
    pub height: f32,
    /// Radians.
    pub yaw: f32,
    /// Width of a card or sheet, metres.
    pub width: f32,
    /// Chance number in 0..1 for colour and variety.
    pub tint: f32,
    /// Layer of the clump pictures; of a plant in the picture before, its number ([`super::identity`]).
    pub layer: u32,
}
