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

/// Memory is looked at once two thirds of the time have passed (at most two minutes): the field must have been seen from everywhere.
pub(crate) fn soak() -> Result<(), Failed> {
    let seconds: u64 = std::env::var("SWARD_SOAK").ok().and_then(|text| text.parse().ok()).unwrap_or(60);
    let samples = play("soak", seconds, &[FLAT])?;
    let settled = (seconds as f64 / 1.5).min(120.0);
    let samples: Vec<_> = samples.into_iter().filter(|(passed, _)| *passed > settled).collect();
    let slope = slope(&samples);
    println!("soak: memory grows by {slope:.0} bytes a second over {} samples", samples.len());
    assert!(samples.len() > 20, "control: memory was not looked at");
    let most = GROWTH / seconds as f64;
    let leaking: Vec<_> = samples.iter().map(|(passed, memory)| (*passed, memory + 2.0 * most * passed)).collect();
    assert!(self::slope(&leaking) > most, "control: a leak is not seen");
    let stairs: Vec<_> = samples.iter().map(|(passed, memory)| (*passed, memory + 16.0 * most * (passed / 8.0).floor())).collect();
    assert!(self::slope(&stairs) > most, "control: what grows every eight seconds is not seen");
    assert!(slope < most, "memory grows by {slope:.0} bytes a second");
    // The layer that checks every call belongs to Vulkan.
    play("checked", seconds / 2, &[("SWARD_VALIDATION", "1")]).map(|_| ())
}

/// Drives around, changes cameras, looks inside; nobody may complain. Returns when memory was looked at, and how much it was.
fn play(name: &str, seconds: u64, environment: &[(&str, &str)]) -> Result<Vec<(f64, f64)>, Failed> {
    let environment = [&[("RUST_LOG", "warn,sward_viewer=info")], environment].concat();
    let mut desk = Desk::open(name, &[&*scenes("hello")?, "--steps", "20", "--pixels", "0.25", "--cpu"], &environment)?;
    desk.key("e")?;
    // In circles, twenty steps a picture: the same ground again and again, all of it before memory is looked at.
    desk.hold("w", true)?;
    desk.hold("a", true)?;
    let begun = Instant::now();
    let (mut samples, mut turn) = (Vec::new(), 0);
    while begun.elapsed() < Duration::from_secs(seconds) {
        std::thread::sleep(Duration::from_millis(500));
        turn += 1;
        // Every camera, too, is used before that.
        match turn % 8 {
            3 => desk.key("c")?,
            6 => desk.key("space")?,
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

/// How steeply samples rise: the median over all pairs. What grows once, when a buffer is made larger for a part of the field that was not seen before,
/// does not count; what grows again and again does.
fn slope(samples: &[(f64, f64)]) -> f64 {
    let pairs = samples.iter().enumerate().flat_map(|(index, one)| samples[..index].iter().map(move |other| (one, other)));
    let mut slopes: Vec<f64> =
        pairs.filter(|(one, other)| one.0 > other.0).map(|(one, other)| (one.1 - other.1) / (one.0 - other.0)).collect();
    slopes.sort_by(f64::total_cmp);
    slopes.get(slopes.len() / 2).copied().unwrap_or(f64::NAN)
}
