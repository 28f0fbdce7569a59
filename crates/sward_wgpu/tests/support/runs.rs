//! Whole runs of one scene on the CPU and on the GPU.

use libtest_mimic::Failed;
use sward::model::Folder;
use sward::response::chain::{ChainModel, loaded};
use sward::response::springs::pool;
use sward::scene::Scene;
use sward::state::{Awake, NONE, StandState};
use sward::world::World;
use sward_wgpu::compare::{Deviation, Tolerance};
use sward_wgpu::compute::GpuStep;
use sward_wgpu::gpu::Gpu;

use crate::adapter::{Verdict, ensure};
use crate::kernels::line;

/// Steps of a run: four seconds.
const STEPS: u64 = 240;

/// Agreement of bends, rad. The backends differ by rounding of each step, which the wave damps; a cell at a threshold (one push or
/// another, limited or not) may go its own way for a while, with its neighbours.
const BEND: Tolerance = Tolerance { p999: 2e-5, rms: 5e-6, outlier: 1e-3, share: 1e-4 };
/// Agreement of plants that swing by themselves, rad. Whether a body holds one in a step is a comparison: what it is let go with then differs by
/// the body's motion in a step.
const SWING: Tolerance = Tolerance { p999: 2e-5, rms: 1e-4, outlier: 5e-3, share: 1e-4 };
/// Agreement of their rates, rad/s: sixty times a difference of tilts.
const SWING_RATE: Tolerance = Tolerance { p999: 1e-3, rms: 5e-3, outlier: 0.2, share: 1e-4 };
/// Agreement of vertices of deformed billboards, m. By which of two ways that are as short a vertex leaves a body, rounding decides, and
/// what is above follows; after one step, see `sheets.rs`.
const SHEET: Tolerance = Tolerance { p999: 6e-3, rms: 1e-3, outlier: 1e-4, share: 6e-3 };
/// Agreement of steps since their last contact: half a millimetre deep or not is rounding, too.
const SHEET_STEPS: Tolerance = Tolerance { p999: 8.0, rms: 0.5, outlier: 0.5, share: 5e-3 };
/// Agreement of bending velocities, rad/s: sixty times a difference of bends.
const RATE: Tolerance = Tolerance { p999: 1e-3, rms: 3e-4, outlier: 5e-2, share: 1e-4 };
/// Agreement of upper segments, rad. Whether a segment bends or recovers is a comparison of two lengths, which are almost equal wherever
/// a plant turns round; the delay of the one is half the other's, so `history` shows another moment there, tenths of a radian away.
const UPPER: Tolerance = Tolerance { rms: 3e-3, share: 3e-4, ..BEND };

/// Agreement of blades with a state, rad. A joint is turned out of a body if it is half a millimetre too deep, and then by a millimetre more: of a
/// segment of ten centimetres that is 0.015 rad, which rounding decides.
const HELD: Tolerance = Tolerance { p999: 1e-3, rms: 1e-3, outlier: 2e-2, share: 1e-3 };

/// A run and what it is about.
pub(crate) struct Run<'a> {
    /// What the lines printed begin with.
    pub(crate) name: &'a str,
    /// The scene; its files are those of the repository.
    pub(crate) scene: &'a str,
    /// Whether the run showed what it is about; looked at on the CPU, at the end.
    pub(crate) shows: fn(&World) -> bool,
}

/// A world on either backend.
pub(crate) enum Backend {
    /// The CPU kernels.
    Cpu,
    /// The compute passes.
    Gpu(Box<GpuStep>),
}

impl Backend {
    /// The GPU, with the cells the world holds now.
    pub(crate) fn on(gpu: &Gpu, world: &World) -> Result<Self, Failed> {
        Ok(Self::Gpu(Box::new(GpuStep::new(gpu, world)?)))
    }

    /// Some steps; afterwards the world holds its cells.
    pub(crate) fn run(&mut self, gpu: &Gpu, world: &mut World, steps: u64) -> Verdict {
        for _ in 0..steps {
            match self {
                Self::Cpu => world.step(),
                Self::Gpu(step) => step.step(gpu, world)?,
            }
        }
        match self {
            Self::Cpu => Ok(()),
            Self::Gpu(step) => Ok(step.download(gpu, world)?),
        }
    }
}

/// The world of a scene at time 0.
pub(crate) fn world(scene: &str) -> Result<World, Failed> {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
    Ok(World::new(Scene::parse(scene, "twins.ron")?, &Folder(root.into()))?)
}

impl Run<'_> {
    /// Compares at a third, two thirds and the end.
    pub(crate) fn check(&self, gpu: &Gpu) -> Verdict {
        self.check_for(gpu, STEPS)
    }

    /// The same in a run of some steps.
    pub(crate) fn check_for(&self, gpu: &Gpu, steps: u64) -> Verdict {
        let (mut cpu, mut other) = (world(self.scene)?, world(self.scene)?);
        let mut backend = Backend::on(gpu, &other)?;
        let mut patches = 0;
        for _ in 0..3 {
            Backend::Cpu.run(gpu, &mut cpu, steps / 3)?;
            backend.run(gpu, &mut other, steps / 3)?;
            patches += cpu.state.stands.iter().map(|stand| stand.awake.len()).sum::<usize>();
            agree(self.name, &cpu, &other, true)?;
        }
        ensure(patches > 0, || format!("{}: nothing was awake", self.name))?;
        ensure((self.shows)(&cpu), || format!("{}: the run does not show what it is about: {}", self.name, counters(&cpu)))
    }
}

/// The counters of all stands, for messages.
pub(crate) fn counters(world: &World) -> String {
    world.state.stands.iter().map(|stand| format!("{:?}", stand.counters)).collect::<Vec<_>>().join(" ")
}

/// β, ω and upper segments of all awake patches of a stand.
pub(crate) fn cells(world: &World, stand: usize) -> [Vec<f32>; 3] {
    let half = 2 * (world.model.stands[stand].cells * world.model.stands[stand].cells) as usize;
    let state = &world.state.stands[stand];
    let mut found = [Vec::new(), Vec::new(), Vec::new()];
    if world.model.stands[stand].springs.is_some() {
        sheets(world, stand, &mut found);
        return found;
    }
    for awake in state.awake.values() {
        if let Some(chain) = &world.model.stands[stand].chain {
            blades(state, chain, awake, &mut found);
            continue;
        }
        let cells = &state.cells.now[awake.slot as usize];
        if world.model.stands[stand].oscillator.is_some() {
            // Deviations, a rate of two seconds, and the tilt in the wind.
            let area = half / 2;
            found[0].extend_from_slice(&cells[..half]);
            found[1].extend(cells[half..half + area].iter().map(|rate| 0.5 * rate));
            found[2].extend_from_slice(&state.cells.old[awake.slot as usize]);
            continue;
        }
        found[0].extend_from_slice(&cells[..half]);
        found[1].extend_from_slice(&cells[half..]);
        if awake.lag != NONE && world.model.stands[stand].lag.segments > 1 {
            found[2].extend_from_slice(&state.cells.lag[awake.lag as usize]);
        }
    }
    found
}

/// Of a stand whose billboards bodies deform: vertices \[m\], and steps since the last contact.
fn sheets(world: &World, stand: usize, found: &mut [Vec<f32>; 3]) {
    let (model, state) = (&world.model.stands[stand], &world.state.stands[stand]);
    let Some(springs) = &model.springs else { return };
    let words = pool::words(&springs.coefficients);
    let (columns, rows) = springs.coefficients.sides();
    for (_, place) in state.sheets.pool.taken() {
        let sheet = state.cells.sheets.get(place as usize * words..).and_then(|sheet| sheet.get(..words)).unwrap_or_default();
        found[0].extend(sheet.iter().take(3 * columns * (rows - 1)).map(|word| f32::from_bits(*word)));
        found[1].extend(sheet.last().map(|steps| *steps as f32));
    }
}

/// Of a stand that moves blade by blade: ψ and ω of virtual blades; ψ, and ω a hundredth, and hold of blades with a state.
fn blades(state: &StandState, chain: &ChainModel, awake: &Awake, found: &mut [Vec<f32>; 3]) {
    let area = (chain.virtual_side * chain.virtual_side) as usize;
    for (plane, values) in state.cells.virtual_states[awake.slot as usize].chunks_exact(area).enumerate() {
        found[plane % 4 / 2].extend_from_slice(values);
    }
    let Some(values) = state.cells.blades(awake.lag) else { return };
    let (total, n) = (state.cells.roots[awake.lag as usize].len(), chain.coefficients.segments as usize);
    for index in 0..total {
        let blade = loaded(values, total, index, n);
        if blade.hold > 0.0 {
            let joints = blade.state.joints[..n].iter();
            found[2].extend(joints.flat_map(|[x, y, wx, wy]| [*x, *y, 0.01 * wx, 0.01 * wy]));
        }
        found[2].push(blade.hold);
    }
}

/// Agreement of air that flows, m/s: rounding that eddies carry on.
const AIR: Tolerance = Tolerance { p999: 1e-3, rms: 2e-4, outlier: 1e-2, share: 1e-4 };

/// Whether two worlds have the same patches awake for the same reasons, equal counters, and cells that agree. Prints if `loud`.
pub(crate) fn agree(name: &str, a: &World, b: &World, loud: bool) -> Verdict {
    for (index, (left, right)) in a.state.stands.iter().zip(&b.state.stands).enumerate() {
        let name = format!("{name}, {} at step {}", a.model.stands[index].name, a.state.step);
        // How many blades are held may differ by those that just touch a body; whether any are may not.
        let reasons = |state: &StandState| -> Vec<_> {
            state.awake.iter().map(|(patch, awake)| (*patch, Awake { held: awake.held.min(1), ..*awake })).collect()
        };
        ensure(reasons(left) == reasons(right), || format!("{name}: awake {:?} and {:?}", left.awake, right.awake))?;
        let upper = if a.model.stands[index].chain.is_some() { HELD } else { UPPER };
        let [bend, rate] = match &a.model.stands[index] {
            stand if stand.oscillator.is_some() => [SWING, SWING_RATE],
            stand if stand.springs.is_some() => [SHEET, SHEET_STEPS],
            _ => [BEND, RATE],
        };
        ensure(left.sheets == right.sheets, || format!("{name}: sheets {:?} and {:?}", left.sheets, right.sheets))?;
        ensure(left.counters == right.counters, || format!("{name}: {:?} and {:?}", left.counters, right.counters))?;
        let parts = cells(a, index).into_iter().zip(cells(b, index)).zip([("bend", bend), ("rate", rate), ("upper", upper)]);
        for ((left, right), (part, tolerance)) in parts {
            // No patch awake, or none near a focus.
            if left.is_empty() && right.is_empty() {
                continue;
            }
            let deviation = Deviation::of(&left, &right, tolerance.outlier);
            let line = line(&format!("{name}, {part}"), &deviation);
            if loud {
                println!("{line}");
            }
            ensure(deviation.within(&tolerance), || format!("{line} beyond {tolerance:?}"))?;
        }
    }
    for (index, (left, right)) in a.state.fluids.iter().zip(&b.state.fluids).enumerate() {
        let numbers = |flow: &[[f32; 2]]| -> Vec<f32> { flow.iter().flatten().copied().collect() };
        let deviation = Deviation::of(&numbers(&left.now), &numbers(&right.now), AIR.outlier);
        let line = line(&format!("{name}, air {index} at step {}", a.state.step), &deviation);
        if loud {
            println!("{line}");
        }
        ensure(deviation.within(&AIR), || format!("{line} beyond {AIR:?}"))?;
    }
    Ok(())
}
