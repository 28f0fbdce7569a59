//! A stand whose billboards are deformed, compiled.

use super::sheet::{SheetRoot, SpringsCoefficients};
use crate::placement::Plant;
use crate::scene::{Recovery, SpeciesModel};

/// What deforms the billboards of a stand.
#[derive(Clone, Debug, PartialEq)]
pub struct SpringsModel {
    /// Kernel numbers.
    pub coefficients: SpringsCoefficients,
    /// k_w: the tilt in the wind is atan of it times speed^(4/3).
    pub wind: f32,
    /// Width of a billboard, m.
    pub width: f32,
    /// Texels along a side of the pictures of bodies.
    pub texels: u32,
    /// Most sheets.
    pub capacity: u32,
    /// Steps after which a sheet that no body is near has recovered.
    pub settle: u32,
}

impl SpringsModel {
    /// Of a species; `None` if its billboards are not deformed. `dt` s a step; at most `capacity` sheets.
    pub fn of(species: &SpeciesModel, dt: f64, capacity: u32) -> Option<Self> {
        let given = species.springs.as_ref()?;
        let mut coefficients =
            SpringsCoefficients::new([given.columns, given.rows], given.iterations, given.stiffness, given.recover, dt as f32);
        coefficients.cubic = u32::from(given.recovery == Recovery::Cubic);
        Some(Self {
            coefficients,
            wind: given.wind,
            width: species.width(),
            texels: given.texels,
            capacity,
            settle: (f64::from(given.recover) / dt).ceil() as u32 + 2,
        })
    }

    /// Where the billboard of a plant stands: its root on `ground` m, where it rises along x and z by `slope`.
    pub fn root(&self, plant: &Plant, ground: f32, slope: [f32; 2]) -> SheetRoot {
        let (sine, cosine) = crate::math::sin_cos(plant.yaw);
        let half = 0.5 * self.width;
        SheetRoot {
            at: [plant.root[0], ground, plant.root[1]],
            length: plant.height,
            half_width: [half * cosine, half * sine],
            slope,
            lean: plant.lean,
            ..SheetRoot::default()
        }
    }
}
