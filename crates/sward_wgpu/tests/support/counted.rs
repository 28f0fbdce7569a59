//! What is counted from a plan is what the device is given to do.

use sward::scene::Precision;
use sward::world::World;
use sward_wgpu::compute::counted::{PASSES, PassWork, passes};
use sward_wgpu::compute::{GpuStep, Work};
use sward_wgpu::gpu::Gpu;

use crate::adapter::{Verdict, ensure};
use crate::runs::world;
use crate::scenes::{CHAINS, STIFF, TOUCHED, TRUCK};

const SWINGS: &str =
    "(version: 1, field: (patch_side: 16), stands: [(species: Meadow, cells: 64, response: Oscillator())], wind: [Natural()],
    interactors: [(shape: Sphere(radius: 1), path: Circle(radius: 3, speed: 4))], budget: (focus_distance: 14))";

const SHEETS: &str = r#"(version: 1, field: (patch_side: 10), stands: [(species: Meadow, cells: 64, response: Springs(columns: 2, rows: 2))], wind: [Natural()],
    interactors: [(shape: Mesh(file: "assets/walker.glb", clip: "Walk"), path: Circle(centre: (2, 2), radius: 1, speed: 1))])"#;

const SHRUBS: &str =
    "(version: 1, stands: [(species: Shrub, places: [(at: (0, 3), height: 1.5), (at: (2, 5), height: 1.5)])], wind: [Fluid(cells: 32)],
    interactors: [(shape: Sphere(radius: 1), path: Circle(centre: (1, 4), radius: 1.4, speed: 3))])";

/// Steps of a run, and the number of the first one: plants that swing drop old records every 2²¹ steps.
const STEPS: u32 = 10;
const FIRST: u64 = (1 << 21) - 5;

/// The counts of passes but for `blades_pass`, whose groups the device counts itself.
fn summed(passes: &[PassWork]) -> [u64; 3] {
    let known = |pass: &&PassWork| pass.pass != "blades_pass";
    let sum = |of: fn(&PassWork) -> u64| passes.iter().filter(known).map(of).sum();
    [passes.iter().map(|pass| pass.dispatches).sum(), sum(|pass| pass.invocations), sum(|pass| pass.bytes)]
}

/// The passes of the coming step, which is then taken on the CPU, and how many blades it leaves held.
fn counted(world: &mut World) -> (Vec<PassWork>, u64) {
    let plan = world.plan();
    let found = passes(world, &plan);
    let reports = world.respond(&plan);
    let held = reports.iter().flat_map(|report| &report.summaries).map(|(_, summary)| u64::from(summary.held)).sum();
    world.finish(reports);
    (found, held)
}

pub(crate) fn passes_of_all_responses(gpu: &Gpu) -> Verdict {
    let mut seen = std::collections::BTreeSet::new();
    for (name, scene, precision) in [
        ("truck", TRUCK, Precision::Full),
        ("truck at half precision", TRUCK, Precision::Half),
        ("stiff", STIFF, Precision::Full),
        ("touched", TOUCHED, Precision::Full),
        ("chains", CHAINS, Precision::Full),
        ("sheets", SHEETS, Precision::Full),
        ("swings", SWINGS, Precision::Full),
        ("shrubs", SHRUBS, Precision::Full),
    ] {
        let mut on_cpu = world(scene)?;
        (on_cpu.scene.budget.precision, on_cpu.state.step) = (precision, FIRST);
        let mut on_gpu = on_cpu.clone();
        let mut step = GpuStep::new(gpu, &on_gpu)?;
        let mut total = [0; 3];
        for number in 0..STEPS {
            let before = step.work;
            step.step(gpu, &mut on_gpu)?;
            let Work { dispatches, invocations, traffic, upper_traffic, .. } = step.work;
            let bytes = traffic + upper_traffic - before.traffic - before.upper_traffic;
            let did = [dispatches - before.dispatches, invocations - before.invocations, bytes];
            let (found, held) = counted(&mut on_cpu);
            seen.extend(found.iter().map(|pass| pass.pass));
            let expected = summed(&found);
            ensure(did == expected, || format!("{name}, step {number}: the device did {did:?}, counted were {expected:?}: {found:#?}"))?;
            let busy: u64 = found.iter().filter(|pass| pass.pass == "blades_pass").map(|pass| pass.invocations).sum();
            ensure(busy >= held && busy.is_multiple_of(64), || format!("{name}, step {number}: {busy} of {held} held blades"))?;
            total = [0, 1, 2].map(|k| total[k] + did[k]);
        }
        step.wait(gpu, &mut on_gpu)?;
        println!("{name}: {total:?}");
        ensure(total.iter().all(|count| *count > 0), || format!("{name}: nothing was counted"))?;
    }
    // All there are: a pass that no scene here asks for is not checked.
    ensure(seen.iter().eq(&PASSES), || format!("passes seen: {seen:?}"))?;
    // Control: the count of other cells is another.
    let bytes = |precision: Precision| -> Result<[u64; 3], libtest_mimic::Failed> {
        let mut world = world(TRUCK)?;
        world.scene.budget.precision = precision;
        Ok(summed(&counted(&mut world).0))
    };
    let [full, half] = [bytes(Precision::Full)?, bytes(Precision::Half)?];
    ensure(full[..2] == half[..2] && full[2] > half[2], || format!("{full:?} {half:?}"))
}
