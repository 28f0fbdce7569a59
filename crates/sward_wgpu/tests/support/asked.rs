//! Questions about plants: the device answers as the CPU does from the cells that were downloaded.

use sward::picture::asked::Standing;
use sward_wgpu::compute::GpuStep;
use sward_wgpu::gpu::Gpu;

use crate::adapter::{Verdict, ensure};
use crate::runs::world;

pub(crate) fn answers(gpu: &Gpu) -> Verdict {
    let stand = "cells: 32, lean: (0.1, 0.05)";
    let stands = [
        format!("species: Meadow, {stand}"),
        format!("name: \"swinging\", species: Meadow, {stand}, response: Oscillator()"),
        "name: \"blades\", species: Reed, cells: 8, response: VirtualInertia(), representation: Blade(blades: 3)".to_owned(),
        "name: \"sheets\", species: Tussock, cells: 16, response: Springs()".to_owned(),
    ];
    let all: Vec<String> = stands.iter().map(|stand| format!("({stand})")).collect();
    let text = format!(
        "(version: 1, field: (patch_side: 8), terrain: Image(path: \"assets/jacksboro.png\", scale: 0.03125), stands: [{}], wind: [Natural()],
          interactors: [(shape: Box(size: (1.6, 1, 1.6)), path: Circle(centre: (2, 2), radius: 1, speed: 1))],
          camera: (eye: (0, 2, 0), target: (1, 1, 4)), budget: (patches: 12, focus_distance: 10))",
        all.join(", ")
    );
    let mut other = world(&text)?;
    let mut step = GpuStep::new(gpu, &other)?;
    let places: Vec<[f64; 2]> = (0..900).map(|k| [f64::from(k % 30) * 0.4 - 4.0, f64::from(k / 30) * 0.4 - 4.0]).collect();
    ensure(step.answer(gpu)?.is_none() && step.wait_for_answer(gpu)?.is_none(), || "nobody has asked".to_owned())?;
    for _ in 0..40 {
        step.step(gpu, &mut other)?;
    }
    let ticket = step.ask(gpu, &other, &places)?;
    let later = step.ask(gpu, &other, &places[..3])?;
    step.download(gpu, &mut other)?;
    // All that was handed over before is done.
    let answers = step.answer(gpu)?.ok_or("the answer has not come after a download")?;
    ensure((answers.ticket, answers.step) == (ticket, 40), || format!("{} {}", answers.ticket, answers.step))?;
    ensure(step.wait_for_answer(gpu)?.is_some_and(|answers| answers.ticket == later && answers.cover.len() == 3), || {
        "in order".to_owned()
    })?;
    let expected = other.cover_heights_at(&places);
    let apart = expected.iter().zip(&answers.cover).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    println!("cover at {} places: {apart:.2e} m apart", places.len());
    ensure(apart < 1e-4 && answers.cover.len() == places.len(), || format!("{apart} m apart"))?;
    for (index, standing) in answers.stands.iter().enumerate() {
        let mut asker = sward::picture::asked::Asker::new(&other, index);
        let own: Vec<Standing> =
            places.iter().map(|place| asker.question(*place)).collect::<Vec<_>>().iter().map(|asked| asker.answer(asked)).collect();
        let apart = |others: &[Standing]| {
            let differ = |(a, b): (&Standing, &Standing)| (a.bend[0] - b.bend[0]).abs().max((a.bend[1] - b.bend[1]).abs());
            own.iter().zip(others).map(differ).fold(0.0, f32::max)
        };
        println!("stand {index}: {:.2e} rad apart", apart(standing));
        ensure(apart(standing) < 2e-4, || format!("stand {index}: {} rad apart", apart(standing)))?;
        let bent = own.iter().map(|one| one.bend[0].hypot(one.bend[1])).fold(0.0, f32::max);
        ensure(bent > 0.6, || format!("stand {index}: nothing is bent: {bent}"))?;
        // Control: a step earlier they stood otherwise.
        let mut before = world(&text)?;
        (0..39).for_each(|_| before.step());
        let mut asker = sward::picture::asked::Asker::new(&before, index);
        let then: Vec<Standing> =
            places.iter().map(|place| asker.question(*place)).collect::<Vec<_>>().iter().map(|asked| asker.answer(asked)).collect();
        ensure(apart(&then) > 1e-3, || format!("stand {index}: a step changes nothing"))?;
    }
    Ok(())
}
