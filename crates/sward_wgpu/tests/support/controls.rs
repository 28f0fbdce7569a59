//! Comparisons that must fail, and runs that change backends midway.

use sward::world::World;
use sward_wgpu::gpu::Gpu;

use crate::adapter::{Verdict, ensure};
use crate::runs::{Backend, agree, world};
use crate::scenes::{STIFF, TRUCK};

/// Half of these runs, steps: by then the pickup has bent some grass and left some.
const HALF: u64 = 80;

/// A way to be a little wrong.
type Spoil = fn(&mut World);

/// One number of the GPU's world 1 % off is found, whichever it is.
pub(crate) fn one_percent_is_found(gpu: &Gpu) -> Verdict {
    let spoils: [(&str, Spoil); 6] = [
        ("wave speed", |world| world.model.stands[0].coefficients.base_speed *= 1.01),
        ("restoring", |world| world.model.stands[0].coefficients.restoring *= 1.01),
        ("damping", |world| world.model.stands[0].coefficients.damping *= 1.01),
        ("rate damping", |world| world.model.stands[0].coefficients.rate_damping *= 1.01),
        ("wind", |world| world.model.stands[0].species.continuum.wind *= 1.01),
        ("lag", |world| world.model.stands[0].lag.gain_top *= 1.01),
    ];
    let mut cpu = world(TRUCK)?;
    Backend::Cpu.run(gpu, &mut cpu, HALF)?;
    for (name, spoil) in spoils {
        let mut other = world(TRUCK)?;
        spoil(&mut other);
        Backend::on(gpu, &other)?.run(gpu, &mut other, HALF)?;
        let verdict = agree(name, &cpu, &other, false);
        ensure(verdict.is_err(), || format!("1 % of {name} is not found"))?;
    }
    Ok(())
}

/// β where ω should be is found; so is x where z should be.
pub(crate) fn swapped_planes_are_found(gpu: &Gpu) -> Verdict {
    let mut cpu = world(TRUCK)?;
    Backend::Cpu.run(gpu, &mut cpu, HALF)?;
    let mut other = world(TRUCK)?;
    Backend::on(gpu, &other)?.run(gpu, &mut other, HALF)?;
    agree("unspoilt", &cpu, &other, true)?;
    let area = (other.model.stands[0].cells * other.model.stands[0].cells) as usize;
    for distance in [2 * area, area] {
        let mut wrong = other.clone();
        for cells in &mut wrong.state.stands[0].cells.now {
            let (low, high) = cells.split_at_mut(distance);
            low[..distance].swap_with_slice(&mut high[..distance]);
        }
        ensure(agree("swapped", &cpu, &wrong, false).is_err(), || format!("planes {distance} apart may be swapped unseen"))?;
    }
    Ok(())
}

/// Half on the GPU and half on the CPU, either way round, is the same run.
pub(crate) fn hand_over(gpu: &Gpu) -> Verdict {
    let history = TRUCK.replace("species: Meadow", "species: Reed, response: Continuum(lag: History)");
    for (name, scene) in [("truck", TRUCK), ("history", &history), ("stiff", STIFF)] {
        let (mut whole, mut first_gpu, mut first_cpu) = (world(scene)?, world(scene)?, world(scene)?);
        Backend::Cpu.run(gpu, &mut whole, 2 * HALF)?;
        Backend::on(gpu, &first_gpu)?.run(gpu, &mut first_gpu, HALF)?;
        Backend::Cpu.run(gpu, &mut first_gpu, HALF)?;
        agree(&format!("{name}, GPU then CPU"), &whole, &first_gpu, true)?;
        Backend::Cpu.run(gpu, &mut first_cpu, HALF)?;
        Backend::on(gpu, &first_cpu)?.run(gpu, &mut first_cpu, HALF)?;
        agree(&format!("{name}, CPU then GPU"), &whole, &first_cpu, true)?;
    }
    Ok(())
}
