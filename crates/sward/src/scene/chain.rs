//! Settings of the responses that move every blade by itself: a chain of segments on springs.
//!
//! Belyaev et al. 2011, §3; methods §3.1 and §3.4. People give what a blade is made of, or its frequency and damping ratio.

use super::parameters::{choices, parameters, parameters_with_overrides};

choices! {
    /// The power p by which drag grows with the speed of the air.
    pub enum DragPower {
        /// 1: slow, thick air.
        Linear,
        /// 4/3: sedge, and leaves that fold with the wind.
        FourThirds,
        /// 5/3.
        FiveThirds,
        /// 2: stiff plates.
        Square,
    }
}

parameters_with_overrides! {
    /// What a blade as long as the stand is high on average is made of, and how air and bodies move it.
    pub struct Chain, ChainOverrides {
        /// Stiffness at the root: bending moment times radius of curvature.
        rigidity_root: f32 = 6e-4, "N·m²" in 1e-9..=1000.0;
        /// Stiffness at the tip; between them it changes evenly.
        rigidity_tip: f32 = 3.3e-4, "N·m²" in 1e-9..=1000.0;
        /// Mass of a metre.
        mass: f32 = 1.12e-3, "kg/m" in 1e-6..=10.0;
        /// Damping ratio of its swaying: below 1 sways, above 1 creeps back.
        damping: f32 = 0.15, "" in 0.0..=10.0;
        /// Drag on a metre in air of 1 m/s: how far wind bends it.
        drag: f32 = 1.6e-3, "N/m" in 0.0..=10.0;
        /// How drag grows with the speed of the air.
        drag_power: DragPower = DragPower::FourThirds, "";
        /// Distance, about, between the virtual blades that feel the wind for all blades around them.
        virtual_spacing: f32 = 0.7, "m" in 0.1..=8.0;
    }
    extra {
        /// First frequency of swaying; without it that of the masses and stiffness above.
        frequency: f32, "Hz" in 0.01..=1000.0;
    }
}

/// How a stand moves blade by blade, with every default filled in.
#[derive(Clone, Debug, PartialEq)]
pub struct BladeByBlade {
    /// What a blade is made of.
    pub chain: Chain,
    /// Its first frequency, Hz; that of its mass and stiffness if not given.
    pub frequency: Option<f32>,
    /// All blades near a focus have a state of their own, not only those that bodies touch.
    pub all: bool,
}
