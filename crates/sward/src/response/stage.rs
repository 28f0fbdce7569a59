//! What a step of a stand consists of, for whoever has a clock.

/// A part of a step that has an end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// β_eq in the wind of the step.
    Rest,
    /// Patches that wake, and cells under bodies.
    Contact,
    /// Propagation, limits and fading.
    Wave,
    /// Upper segments.
    Lags,
    /// Virtual blades.
    Virtual,
    /// Blades with a state of their own, and bodies that push them.
    Blades,
    /// Waves of stands of meshes.
    Layers,
    /// Air that flows.
    Air,
}
