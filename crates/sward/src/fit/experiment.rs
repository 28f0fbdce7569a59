//! The measurement on plants of a scene: pulled, let go, and watched, with the kernels that a step runs.

use super::curve::{Point, Shape, refined, solved};
use super::swing::Swing;
use super::window::{thinned, tone};
use crate::interaction::solid::Solids;
use crate::lanes::Lanes;
use crate::math::sin_cos;
use crate::model::{Model, NoAssets, StandModel};
use crate::plan::{PatchPlan, SheetPlan, StandPlan};
use crate::response::chain::{Blade, ChainState, UPRIGHT, first_mode, joints};
use crate::response::harmonic::HarmonicCoefficients;
use crate::response::oscillator::{Own, Record};
use crate::response::{chain, continuum};
use crate::scene::{Field, Scene, SceneError, SpeciesModel, Stand};
use crate::state::{Cells, Ground, Waves};
use crate::wind::WindField;

/// How far a plant is pulled, rad.
const PULL: f32 = 0.2;
/// Steps a second, as scenes have them by themselves.
const RATE: u32 = 60;
/// Share of the pull below which nothing moves any more.
const STILL: f64 = 0.01;
/// Longest watch, s.
const LONGEST: u32 = 1200;
/// Steps that are watched in any case, and share of the time until then that is watched after the last motion.
const LEAST: [usize; 2] = [120, 4];
/// Samples kept of a swing where the curve is fitted.
const SAMPLES: f64 = 60.0;
/// Side of the patch and of the plane on which all swing alike.
const SIDE: u32 = 8;
/// Which of all plants: the average one.
const AVERAGE: u32 = 0x8000_8000;

/// Why a stand cannot be pulled.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ExperimentError {
    /// The stand is none.
    #[error(transparent)]
    Stand(#[from] SceneError),
    /// The response has no swing.
    #[error("plants with response `{response}` do not swing: they go back in a time of their own")]
    NoSwing {
        /// Which.
        response: &'static str,
    },
    /// A blade that cannot be.
    #[error(transparent)]
    Blade(#[from] chain::ChainError),
}

/// A motion after the release.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// Time between samples, s.
    pub dt: f64,
    /// How far the plant leans, over how far it was pulled: 1 at first, 0 at rest.
    pub lean: Vec<f64>,
}

impl Motion {
    /// Steps that `next` makes, until nothing moves.
    fn watched(mut next: impl FnMut(usize) -> f64) -> Self {
        let mut lean = vec![1.0];
        let first = next(0);
        let mut moved = 0;
        let enough = |moved: usize| moved + moved / LEAST[1] + LEAST[0];
        while lean.len() <= enough(moved) && lean.len() < (LONGEST * RATE) as usize {
            let now = next(lean.len()) / first;
            if now.abs() >= STILL {
                moved = lean.len();
            }
            lean.push(now);
        }
        Self { dt: 1.0 / f64::from(RATE), lean }
    }

    /// The one damped swing about rest that comes nearest to it; of plants that creep back too, as far as their motion tells.
    #[must_use]
    pub fn swing(&self) -> Swing {
        let points: Vec<Point> = self.lean.iter().enumerate().map(|(k, lean)| [k as f64 * self.dt, *lean]).collect();
        let span = points[points.len() - 1][0];
        let about = tone(&points).unwrap_or(1.0 / span);
        let points = thinned(&points, 1.0 / (SAMPLES * about));
        let starts = [(about, 0.1), (about, 0.5), (about, 1.5), (4.0 / span, 1.5)];
        let shape = |(frequency, zeta): (f64, f64)| Shape { omega: std::f64::consts::TAU * frequency, zeta };
        let fitted = starts.map(|start| refined(&points, shape(start), 4.0, false));
        let best = fitted.iter().fold(&fitted[0], |best, one| if one.1.squares < best.1.squares { one } else { best });
        let whole: f64 = points.iter().map(|[_, lean]| lean * lean).sum();
        let squares = solved(&points, &best.0, false).squares;
        Swing {
            frequency: best.0.omega / std::f64::consts::TAU,
            damping_ratio: best.0.zeta,
            amplitude: best.1.parts[0].abs(),
            drift: 0.0,
            r_squared: 1.0 - squares / whole,
            window: [0.0, span],
        }
    }

    /// R² of another motion as a picture of this one: 1 minus the squares of their differences over its own.
    #[must_use]
    pub fn explained_by(&self, other: &Self) -> f64 {
        let at = |motion: &Self, k: usize| motion.lean.get(k).copied().unwrap_or(0.0);
        let count = self.lean.len().max(other.lean.len());
        let apart: f64 = (0..count).map(|k| (at(self, k) - at(other, k)) * (at(self, k) - at(other, k))).sum();
        1.0 - apart / self.lean.iter().map(|lean| lean * lean).sum::<f64>()
    }
}

/// A scene of this stand alone, on a patch on which every plant is like every other.
fn alone(stand: &Stand) -> Result<Scene, SceneError> {
    let stand = Stand { cells: Some(SIDE), name: String::new(), ..stand.clone() };
    let field = Field { patch_side: SIDE as f32, ..Field::default() };
    let scene = Scene { steps_per_second: RATE, field, stands: vec![stand], ..Scene::default() };
    scene.validate().map(|()| scene)
}

/// Pulls a plant of mean height by 0.2 rad, lets it go in still air, and watches until it rests, sixty times a second.
///
/// Of the continuum all plants together, so that no wave comes in from the side; of a chain in the shape of its first mode; of meshes the
/// plane all alike, where the velocity that leaves show is what leans.
///
/// # Errors
/// A stand that no scene can have, or plants that do not swing.
pub fn let_go(stand: &Stand) -> Result<Motion, ExperimentError> {
    let scene = alone(stand)?;
    if let Some(layered) = stand.resolve()?.layered {
        let harmonic = &layered.harmonic;
        let cell = harmonic.side / harmonic.cells as f32;
        return Ok(meshes(&HarmonicCoefficients::new(
            harmonic.speed,
            harmonic.frequency,
            harmonic.damping,
            harmonic.gain,
            cell,
            1.0 / RATE as f32,
        )));
    }
    let model = Model::compile(&scene, &NoAssets)?;
    let stand = &model.stands[0];
    match &stand.species {
        _ if stand.springs.is_some() => Err(ExperimentError::NoSwing { response: "Springs" }),
        species if species.chain.is_some() => blade(stand),
        species if species.oscillator.is_some() => Ok(rod(stand)),
        _ => Ok(canopy(&model, stand)),
    }
}

/// Mean height of a stand, m.
fn height(stand: &StandModel) -> f32 {
    0.5 * (stand.species.height[0] + stand.species.height[1])
}

fn meshes(co: &HarmonicCoefficients) -> Motion {
    let mut waves = Waves::new(SIDE as usize);
    let (pulled, still) = (vec![[1.0, 0.0]; waves.now.len()], vec![[0.0; 2]; waves.now.len()]);
    (waves.now, waves.old) = (pulled.clone(), pulled);
    Motion::watched(|step| {
        if step > 0 {
            waves.step(co, &still);
        }
        f64::from(waves.now[0][0])
    })
}

fn rod(stand: &StandModel) -> Motion {
    let Some(model) = &stand.oscillator else { return Motion { dt: 1.0, lean: vec![0.0] } };
    let own = Own::of(&model.coefficients, AVERAGE, height(stand));
    let record = Record::let_go([PULL, 0.0], 0);
    Motion::watched(|step| f64::from(sin_cos(record.at(&model.coefficients, &own, step as u32, 0.0)[0]).0))
}

/// The blade of mean length of a stand that moves blade by blade.
pub(super) fn blade_of(species: &SpeciesModel) -> Option<Blade> {
    let by_blade = species.chain.as_ref()?;
    let length = 0.5 * f64::from(species.height[0] + species.height[1]);
    Some(Blade::built(&by_blade.chain, by_blade.frequency, length, species.segments()))
}

fn blade(stand: &StandModel) -> Result<Motion, ExperimentError> {
    let (Some(model), Some(blade)) = (&stand.chain, blade_of(&stand.species)) else {
        return Err(ExperimentError::Blade(chain::ChainError::Buckles));
    };
    let mode = first_mode(&blade).ok_or(chain::ChainError::Buckles)?;
    let (mut state, mut below) = (ChainState::default(), 0.0);
    for (joint, tilt) in state.joints.iter_mut().zip(mode.shape).take(blade.segments as usize) {
        joint[1] = PULL * (tilt - below) as f32;
        below = tilt;
    }
    Ok(Motion::watched(|step| {
        if step > 0 {
            state = chain::step(&model.coefficients, &UPRIGHT, 0.0, [0.0; 3], 1.0 / RATE as f32, &state);
        }
        f64::from(joints(&UPRIGHT, 0.0, &model.coefficients, &state.bends())[blade.segments as usize][0])
    }))
}

/// A patch that is its own neighbour on all sides, and calm air over it.
fn plan(model: &Model, stand: &StandModel) -> StandPlan {
    let patch = PatchPlan {
        patch: [0, 0],
        slot: 0,
        lag: 0,
        neighbours: [0; 4],
        keep: 1.0,
        aired: false,
        woken: false,
        edited: false,
        lag_woken: true,
        pairs: 0..0,
        around: [0; 9],
        weights: [1.0; 4],
        solids: 0..0,
        pixels: 0.0,
        handing: false,
    };
    let wind = WindField::before(&model.sources, 0, 0.0, model.dt, stand.spacing * f64::from(continuum::NODE_CELLS));
    StandPlan {
        rebase: false,
        tile_wind: wind.clone(),
        wind,
        patches: vec![patch],
        contacts: Vec::new(),
        edges: Vec::new(),
        pairs: Vec::new(),
        solids: Solids::default(),
        touchers: Vec::new(),
        sheets: SheetPlan::default(),
    }
}

fn canopy(model: &Model, stand: &StandModel) -> Motion {
    let area = (stand.cells * stand.cells) as usize;
    let pulled = || vec![[vec![PULL; area], vec![0.0; 3 * area]].concat().into_boxed_slice()];
    let mut cells = Cells { now: pulled(), old: pulled(), ground: vec![Ground::default()], ..Cells::default() };
    let (mut plan, lanes) = (plan(model, stand), Lanes::default());
    Motion::watched(|step| {
        if step > 0 {
            continuum::step(&model.terrain, stand, &plan, &mut cells, lanes, &mut |_| ());
        }
        continuum::lags(stand, &plan, &mut cells, step as u64, lanes);
        plan.patches[0].lag_woken = false;
        let upper = cells.lag.first().map_or(&[][..], |upper| upper);
        let bends = [cells.now[0][0]].into_iter().chain(upper.iter().step_by(2 * area).copied());
        let (count, sum) = bends.fold((0, 0.0), |(count, sum), bend| (count + 1, sum + sin_cos(bend).0));
        f64::from(sum) / f64::from(count)
    })
}
