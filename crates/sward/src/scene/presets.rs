//! What each species is by itself, and what a stand makes of it.

use super::billboard::Billboard;
use super::blade::Blade;
use super::chain::{BladeByBlade, Chain, DragPower};
use super::continuum::{Continuum, Lag};
use super::error::{Problem, SceneError, Trail};
use super::harmonic::{Harmonic, HarmonicOverrides};
use super::layers::{Form, Grown, Layers, LayersOverrides, PlantMesh};
use super::oscillator::{Oscillator, Swinging};
use super::sheet::{Sheet, SheetOverrides};
use super::springs::Springs;
use super::stand::{Representation, Response, Species, Stand};

/// A stand with every default filled in: what the simulation and the picture work with.
#[derive(Clone, Debug, PartialEq)]
pub struct SpeciesModel {
    /// The stand's name, unique in the scene.
    pub name: String,
    /// Least and greatest plant height in metres.
    pub height: [f32; 2],
    /// How the plants move, unless blade by blade.
    pub continuum: Continuum,
    /// How they move where every blade does by itself.
    pub chain: Option<BladeByBlade>,
    /// How they swing where every plant does by itself.
    pub oscillator: Option<Swinging>,
    /// How they are deformed where bodies deform billboards.
    pub springs: Option<Springs>,
    /// How the plants look as billboards.
    pub billboard: Billboard,
    /// How they look as blades, where that is what they are drawn as.
    pub blade: Option<Blade>,
    /// How they look as sheets, where that is what they are drawn as.
    pub sheet: Option<Sheet>,
    /// How they sway and look, where they are meshes in layers.
    pub layered: Option<Layered>,
    /// Cells along a patch side.
    pub cells: u32,
    /// Mass of a plant of mean height, kg.
    pub mass: f32,
}

/// How meshes sway, and how they are drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Layered {
    /// How they sway.
    pub harmonic: Harmonic,
    /// How they are cut and drawn.
    pub layers: Layers,
}

impl SpeciesModel {
    /// Segments from root to tip that move.
    #[must_use]
    pub fn segments(&self) -> u32 {
        self.blade.as_ref().map_or(self.billboard.segments, |blade| blade.segments)
    }

    /// Crossed cards of a plant; 0 where it is a sheet.
    #[must_use]
    pub fn cards(&self) -> u32 {
        if self.sheet.is_some() { 0 } else { self.billboard.cards }
    }

    /// Segments of a card, or pieces along each side of a sheet, near the camera; one is drawn beyond [`Self::plain_distance`].
    #[must_use]
    pub fn pieces(&self) -> u32 {
        self.sheet.as_ref().map_or(self.billboard.segments, |sheet| sheet.points.saturating_sub(1).max(1))
    }

    /// Distance from the camera beyond which a plant is drawn with one segment or piece, m.
    #[must_use]
    pub fn plain_distance(&self) -> f32 {
        self.sheet.as_ref().map_or(self.billboard.plain_distance, |sheet| sheet.plain_distance)
    }

    /// Width of a card or sheet, m.
    #[must_use]
    pub fn width(&self) -> f32 {
        self.sheet.as_ref().map_or(self.billboard.width, |sheet| sheet.width)
    }
}

impl Stand {
    /// Fills the species' values into what the author left out.
    ///
    /// # Errors
    /// Values that contradict each other. Never after [`super::Scene::parse`] or [`super::Scene::validate`] succeeded.
    pub fn resolve(&self) -> Result<SpeciesModel, SceneError> {
        self.resolve_at(&Trail::default()).map_err(SceneError::from)
    }

    /// The same, with errors that know the way to this stand.
    pub(super) fn resolve_at(&self, trail: &Trail) -> Result<SpeciesModel, Problem> {
        let (continuum, billboard) = (self.species.continuum(), self.species.billboard());
        let springs = match &self.response {
            Some(Response::Springs(overrides)) => Some(self.species.springs().with(overrides)),
            _ => None,
        };
        let sheet = match (&self.representation, &springs) {
            (Some(Representation::Sheet(overrides)), None) => Some(self.species.sheet().with(overrides)),
            (Some(Representation::Sheet(overrides)), Some(springs)) => {
                Some(self.species.sheet().of_springs(springs, overrides, &trail.clone().key("representation"))?)
            }
            // What bodies deform is drawn as they leave it.
            (None, Some(springs)) => Some(self.species.sheet().of_springs(springs, &SheetOverrides::default(), trail)?),
            _ => None,
        };
        Ok(SpeciesModel {
            name: self.label(),
            height: self.height.unwrap_or_else(|| self.species.height()),
            continuum: match &self.response {
                Some(Response::Continuum(overrides)) => continuum.tuned(overrides, &trail.clone().key("response"))?,
                _ => continuum,
            },
            chain: match &self.response {
                Some(response @ (Response::Chain(overrides) | Response::VirtualInertia(overrides))) => Some(BladeByBlade {
                    chain: self.species.chain().with(overrides),
                    frequency: overrides.frequency,
                    all: matches!(response, Response::Chain(_)),
                }),
                _ => None,
            },
            oscillator: match &self.response {
                Some(Response::Oscillator(overrides)) => Some(self.species.oscillator().tuned(overrides, &trail.clone().key("response"))?),
                _ => None,
            },
            springs,
            billboard: match &self.representation {
                Some(Representation::Billboard(overrides)) => billboard.with(overrides),
                _ => billboard,
            },
            blade: match &self.representation {
                Some(Representation::Blade(overrides)) => Some(self.species.blade().with(overrides)),
                _ => None,
            },
            sheet,
            layered: self.layered(trail)?,
            cells: self.cells(),
            mass: self.mass.map_or_else(|| self.species.mass(), |grams| 1e-3 * grams),
        })
    }

    /// Whether its plants are meshes that sway in layers.
    #[must_use]
    pub fn is_layered(&self) -> bool {
        self.species.is_mesh()
            || matches!(self.response, Some(Response::Harmonic(_)))
            || matches!(self.representation, Some(Representation::Layers(_)))
    }

    /// How its meshes sway and look; `None` for stands of grass.
    fn layered(&self, trail: &Trail) -> Result<Option<Layered>, Problem> {
        if !self.is_layered() {
            return match self.places.is_empty() {
                true => Ok(None),
                false => {
                    let message = "`places` are for shrubs, trees and water plants: grass grows everywhere";
                    Err(Problem::at(trail.clone().key("places"), message).help("limit it with a mask or exclusions"))
                }
            };
        }
        let harmonic = match &self.response {
            None => HarmonicOverrides::default(),
            Some(Response::Harmonic(overrides)) => overrides.clone(),
            Some(_) => {
                let message = "plants in layers sway as a whole";
                return Err(Problem::at(trail.clone().key("response"), message).help("write `Harmonic(…)`, or leave it out"));
            }
        };
        let layers = match &self.representation {
            None => LayersOverrides::default(),
            Some(Representation::Layers(overrides)) => overrides.clone(),
            Some(_) => {
                let message = "plants that sway as a whole are meshes in layers";
                return Err(Problem::at(trail.clone().key("representation"), message).help("write `Layers(…)`, or leave it out"));
            }
        };
        let layered = Layered { harmonic: self.species.harmonic().with(&harmonic), layers: self.species.layers().with(&layers) };
        Ok(Some(layered))
    }
}

impl Species {
    /// Least and greatest plant height in metres: a quarter below and above the typical one.
    #[must_use]
    pub fn height(&self) -> [f32; 2] {
        match self {
            Self::Lawn => [0.0375, 0.0625],
            Self::Meadow => [0.3, 0.5],
            Self::Reed => [0.9, 1.5],
            Self::Tussock => [0.225, 0.375],
            Self::Shrub => [1.1, 1.7],
            Self::Tree => [5.5, 8.5],
            Self::WaterPlant => [0.35, 0.6],
        }
    }

    /// Whether its plants are meshes.
    #[must_use]
    pub fn is_mesh(&self) -> bool {
        matches!(self, Self::Shrub | Self::Tree | Self::WaterPlant)
    }

    /// How meshes of the species sway.
    #[must_use]
    pub fn harmonic(&self) -> Harmonic {
        // Side of the plane [m], speed [m/s], frequency [Hz], damping ratio, gain
        let (side, speed, frequency, damping, gain) = match self {
            Self::Tree => (16.0, 3.0, 0.5, 0.15, 0.6),
            Self::WaterPlant => (2.0, 0.25, 0.35, 0.5, 1.0),
            _ => (8.0, 1.5, 0.9, 0.18, 0.6),
        };
        Harmonic { side, speed, frequency, damping, gain, ..Harmonic::default() }
    }

    /// How meshes of the species are drawn.
    #[must_use]
    pub fn layers(&self) -> Layers {
        let (form, triangles, scale, rigidity) = match self {
            Self::Tree => (Form::Tree, 40000, [3.5, 2.0, 1.2], 0.8),
            Self::WaterPlant => (Form::WaterPlant, 12000, [3.0, 1.5, 1.0], 1.2),
            _ => (Form::Bush, 20000, [2.0, 1.2, 0.8], 1.0),
        };
        Layers { mesh: PlantMesh::Grown(Grown { form, triangles, ..Grown::default() }), scale, rigidity, ..Layers::default() }
    }

    /// Mass of a plant of mean height, kg: of all its blades, or of the leaves and twigs of a mesh.
    #[must_use]
    pub fn mass(&self) -> f32 {
        let [low, high] = self.height();
        match self {
            Self::Shrub => 3.0,
            Self::Tree => 40.0,
            Self::WaterPlant => 0.03,
            _ => self.blade().blades as f32 * self.chain().mass * 0.5 * (low + high),
        }
    }

    /// How the species moves. Plants in a stand damp each other, so the ratios are higher than for a single blade.
    #[must_use]
    pub fn continuum(&self) -> Continuum {
        // c0 [m/s], mu, lambda_theta, lambda_omega, kappa [1/s²], wind, gamma_top and gamma_recover [s]
        let [c0, mu, lambda_theta, lambda_omega, kappa, wind, gamma_top, gamma_recover] = match self {
            Self::Lawn => [1.0, 0.02, 0.50, 0.50, 70.0, 0.0159, 0.0, 0.0],
            Self::Meadow | Self::Shrub | Self::Tree | Self::WaterPlant => [2.0, 0.06, 0.12, 0.20, 114.0, 0.0356, 0.12, 0.06],
            Self::Reed => [2.5, 0.10, 0.09, 0.15, 43.0, 0.0385, 0.30, 0.15],
            // methods' λ_θ 0.30 and c₀ 3 let 28 blades flip behind a turning car; these let none.
            Self::Tussock => [2.5, 0.03, 0.36, 0.35, 400.0, 0.0142, 0.05, 0.03],
        };
        let (c_omega, kappa_omega, lag) = (c0, kappa, Lag::Cascade);
        Continuum { c0, mu, c_omega, lambda_theta, lambda_omega, kappa, kappa_omega, wind, lag, gamma_top, gamma_recover }
    }

    /// A typical blade of the species, by itself: stands damp each other, so the continuum's ratios are higher.
    #[must_use]
    pub fn chain(&self) -> Chain {
        // Stiffness at root and tip [N·m²], mass [kg/m], damping ratio, drag [N/m at 1 m/s]
        let (rigidity_root, rigidity_tip, mass, damping, drag) = match self {
            Self::Lawn => (1.1e-6, 7.75e-7, 5e-4, 0.25, 6e-4),
            Self::Meadow | Self::Shrub | Self::Tree | Self::WaterPlant => (6e-4, 3.3e-4, 1.12e-3, 0.15, 1.6e-3),
            Self::Reed => (3.428e-2, 1.697e-2, 2.509e-3, 0.10, 5.251e-3),
            Self::Tussock => (1.6e-3, 9.6e-4, 2e-3, 0.20, 5e-3),
        };
        Chain { rigidity_root, rigidity_tip, mass, damping, drag, drag_power: DragPower::FourThirds, virtual_spacing: 0.7 }
    }

    /// A typical plant of the species, by itself: stands damp each other, so the continuum's ratios are higher; trampled turf creeps.
    #[must_use]
    pub fn oscillator(&self) -> Oscillator {
        // Frequency [Hz], damping ratio, wind [m/s² at 1 m/s]
        let (frequency, damping, wind) = match self {
            Self::Lawn => (5.0, 5.0, 0.78),
            Self::Meadow | Self::Shrub | Self::Tree | Self::WaterPlant => (1.7, 0.18, 1.61),
            Self::Reed => (1.05, 0.12, 2.01),
            Self::Tussock => (3.5, 0.30, 2.06),
        };
        Oscillator { frequency, damping, wind, ..Oscillator::default() }
    }

    /// How billboards of the species are deformed.
    #[must_use]
    pub fn springs(&self) -> Springs {
        let (stiffness, recover) = match self {
            Self::Lawn => (1.0, 1.5),
            Self::Meadow | Self::Shrub | Self::Tree | Self::WaterPlant => (1.0, 2.5),
            Self::Reed => (0.9, 4.0),
            Self::Tussock => (1.0, 1.0),
        };
        Springs { stiffness, recover, wind: self.continuum().wind, ..Springs::default() }
    }

    /// How the species looks as blades: the billboards' colours, a little lighter, since light and shade are not painted on.
    #[must_use]
    pub fn blade(&self) -> Blade {
        let Billboard { segments, colour_root, colour_tip, dryness, .. } = self.billboard();
        let (blades, tuft, width, lean, curl) = match self {
            Self::Lawn => (64, 0.0, 0.006, 0.5, 0.7),
            Self::Meadow | Self::Shrub | Self::Tree | Self::WaterPlant => (32, 0.25, 0.009, 0.35, 1.0),
            Self::Reed => (14, 0.2, 0.020, 0.14, 0.9),
            Self::Tussock => (40, 0.75, 0.006, 0.65, 0.9),
        };
        // Short plants are lost in the turf sooner.
        let distance = if matches!(self, Self::Lawn) { 40.0 } else { 110.0 };
        let segments = segments.max(2);
        Blade { segments, distance, blades, tuft, width, lean, curl, colour_root, colour_tip, dryness, ..Blade::default() }
    }

    /// How the species looks as sheets: the billboards' colours, and wider, since one sheet stands for two crossed cards.
    #[must_use]
    pub fn sheet(&self) -> Sheet {
        let Billboard { width, plain_distance, colour_root, colour_tip, dryness, .. } = self.billboard();
        Sheet { width: 1.4 * width, plain_distance, colour_root, colour_tip, dryness, ..Sheet::default() }
    }

    /// How the species looks.
    #[must_use]
    pub fn billboard(&self) -> Billboard {
        let (segments, width, colour_root, colour_tip, dryness) = match self {
            Self::Lawn => (1, 0.16, [0.026, 0.075, 0.012], [0.075, 0.205, 0.028], 0.0),
            Self::Meadow | Self::Shrub | Self::Tree | Self::WaterPlant => (4, 0.55, [0.024, 0.066, 0.011], [0.085, 0.200, 0.030], 0.05),
            Self::Reed => (7, 0.60, [0.030, 0.060, 0.014], [0.080, 0.165, 0.038], 0.06),
            Self::Tussock => (2, 0.50, [0.045, 0.060, 0.016], [0.140, 0.170, 0.048], 0.24),
        };
        let (cards, plain_distance) = (2, 40.0);
        Billboard { segments, width, cards, plain_distance, colour_root, colour_tip, dryness }
    }
}
