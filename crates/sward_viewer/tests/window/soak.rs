//! A long while in a window: memory stays flat, and nobody complains.

use std::time::{Duration, Instant};

use libtest_mimic::Failed;

use crate::desk::Desk;
use crate::tales::scenes;

/// Most that memory may seem to grow over a run once everything is there, bytes, whether it takes a minute or ten.
const GROWTH: f64 = 2_400_000.0;

/// The driver of Debian 12 that draws Vulkan pictures on the processor keeps some 2 MB of every shadow map for itself until it ends, in any program; its OpenGL
/// and other drivers keep nothing. So memory is watched there.
const FLAT: (&str, &str) = ("WGPU_BACKEND", "gl");

/// Memory is fitted with a line once a third of the time has passed (at most two minutes).
pub(crate) fn soak() -> Result<(), Failed> {
    let seconds: u64 = std::env::var("SWARD_SOAK").ok().and_then(|text| text.parse().ok()).unwrap_or(60);
    let samples = play("soak", seconds, &[FLAT])?;
    let settled = (seconds as f64 / 3.0).min(120.0);
    let samples: Vec<_> = samples.into_iter().filter(|(passed, _)| *passed > settled).collect();
    let slope = slope(&samples);
    println!("soak: memory grows by {slope:.0} bytes a second over {} samples", samples.len());
    assert!(samples.len() > 20, "control: memory was not looked at");
    let most = GROWTH / seconds as f64;
    let leaking: Vec<_> = samples.iter().map(|(passed, memory)| (*passed, memory + 2.0 * most * passed)).collect();
    assert!(self::slope(&leaking) > most, "control: a leak is not seen");
    assert!(slope < most, "memory grows by {slope:.0} bytes a second");
    // The layer that checks every call belongs to Vulkan.
    play("checked", seconds / 2, &[("SWARD_VALIDATION", "1")]).map(|_| ())
}

/// Drives around, changes cameras, looks inside; nobody may complain. Returns when memory was looked at, and how much it was.
fn play(name: &str, seconds: u64, environment: &[(&str, &str)]) -> Result<Vec<(f64, f64)>, Failed> {
    let environment = [&[("RUST_LOG", "warn,sward_viewer=info")], environment].concat();
    let mut desk = Desk::open(name, &[&*scenes("hello")?, "--steps", "2", "--pixels", "0.25", "--cpu"], &environment)?;
    desk.key("e")?;
    // In circles: the same ground again and again.
    desk.hold("w", true)?;
    desk.hold("a", true)?;
    let begun = Instant::now();
    let (mut samples, mut turn) = (Vec::new(), 0);
    while begun.elapsed() < Duration::from_secs(seconds) {
        std::thread::sleep(Duration::from_millis(500));
        turn += 1;
        match turn % 24 {
            8 => desk.key("c")?,
            16 => desk.key("space")?,
            _ => {}
        }
        samples.extend(desk.memory().map(|memory| (begun.elapsed().as_secs_f64(), memory as f64)));
    }
    desk.hold("w", false)?;
    desk.hold("a", false)?;
    desk.shot(name)?;
    let now = desk.pictures(2)?;
    println!("{name}: {seconds} s, {} pictures, {} steps", now["pictures"], now["step"]);
    let log = desk.log();
    assert!(log.contains("drawn by"), "control: nothing is logged");
    assert!(!log.contains("no graphics device"), "control: no device draws");
    let complaints: Vec<&str> =
        log.lines().filter(|line| ["alidation", "VUID", "ERROR", "panicked"].iter().any(|word| line.contains(word))).collect();
    assert!(complaints.is_empty(), "{complaints:?}");
    assert!(now["problem"].is_null(), "{}", now["problem"]);
    assert!(now["step"].as_u64() > Some(2 * seconds), "it stood still");
    Ok(samples)
}

/// Of the line through all samples, least squares.
fn slope(samples: &[(f64, f64)]) -> f64 {
    let count = samples.len().max(1) as f64;
    let mean = |pick: fn(&(f64, f64)) -> f64| samples.iter().map(pick).sum::<f64>() / count;
    let (time, value) = (mean(|sample| sample.0), mean(|sample| sample.1));
    let above: f64 = samples.iter().map(|sample| (sample.0 - time) * (sample.1 - value)).sum();
    let below: f64 = samples.iter().map(|sample| (sample.0 - time).powi(2)).sum();
    above / below.max(1e-9)
}
