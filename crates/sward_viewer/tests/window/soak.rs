//! A long while in a window: memory stays flat, and nobody complains.

use std::time::{Duration, Instant};

use libtest_mimic::Failed;

use crate::desk::Desk;
use crate::tales::scenes;

/// Most that memory may grow once everything is there, bytes a second: 2 MB an hour would be 600.
const GROWTH: f64 = 40_000.0;

/// Drives around, changes cameras, looks inside; memory is fitted with a line once a third of the time has passed (at most two minutes).
pub(crate) fn soak() -> Result<(), Failed> {
    let seconds: u64 = std::env::var("SWARD_SOAK").ok().and_then(|text| text.parse().ok()).unwrap_or(60);
    let mut desk = Desk::open("soak", &[&*scenes("hello")?, "--steps", "2", "--pixels", "0.25", "--cpu"], &[("RUST_LOG", "warn")])?;
    desk.key("e")?;
    desk.hold("w", true)?;
    let begun = Instant::now();
    let mut samples = Vec::new();
    let (settled, mut turn) = ((seconds / 3).min(120), 0);
    while begun.elapsed() < Duration::from_secs(seconds) {
        std::thread::sleep(Duration::from_millis(500));
        turn += 1;
        match turn % 24 {
            4 => desk.hold("a", true)?,
            8 => desk.hold("a", false)?,
            12 => desk.key("c")?,
            16 => desk.hold("d", true)?,
            20 => desk.hold("d", false)?,
            _ => {}
        }
        let passed = begun.elapsed().as_secs_f64();
        if passed > settled as f64
            && let Some(memory) = desk.memory()
        {
            samples.push((passed, memory as f64));
        }
    }
    desk.hold("w", false)?;
    desk.shot("soak")?;
    let now = desk.pictures(2)?;
    let slope = slope(&samples);
    println!("soak: {seconds} s, {} pictures, {} steps, {:.0} bytes/s over {} samples", now["pictures"], now["step"], slope, samples.len());
    let log = desk.log();
    let complaints: Vec<&str> =
        log.lines().filter(|line| ["alidation", "VUID", "ERROR", "panicked"].iter().any(|word| line.contains(word))).collect();
    assert!(complaints.is_empty(), "{complaints:?}");
    assert!(now["problem"].is_null(), "{}", now["problem"]);
    assert!(now["step"].as_u64() > Some(100), "it stood still");
    assert!(slope < GROWTH, "memory grows by {slope:.0} bytes a second");
    Ok(())
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
