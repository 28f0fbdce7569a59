//! A long while in a window: memory stays flat, and nobody complains.

use std::time::{Duration, Instant};

use libtest_mimic::Failed;

use crate::desk::Desk;
use crate::slope::slope;
use crate::tales::scenes;

/// Most that memory may seem to grow over a run once everything is there, bytes, whether it takes a minute or ten.
const GROWTH: f64 = 2_400_000.0;

/// The driver of Debian 12 that draws Vulkan pictures on the processor keeps some 2 MB of every shadow map for itself until it ends, in any program; its OpenGL
/// and other drivers keep nothing. So memory is watched there.
const FLAT: (&str, &str) = ("WGPU_BACKEND", "gl");

/// Memory is flat if it was so for the last third of the time (of ten minutes: the last eight). While it is not, the drive goes on, up to three times as long: on
/// a slow machine the field takes longer to be seen from everywhere, and buffers grow until it has been. A leak never becomes flat.
pub(crate) fn soak() -> Result<(), Failed> {
    let seconds: u64 = std::env::var("SWARD_SOAK").ok().and_then(|text| text.parse().ok()).unwrap_or(60);
    let watched = (seconds as f64 / 3.0).max(seconds as f64 - 120.0);
    let most = GROWTH / seconds as f64;
    let last = |samples: &[(f64, f64)]| -> Vec<(f64, f64)> {
        let end = samples.last().map_or(0.0, |(passed, _)| *passed);
        samples.iter().copied().filter(|(passed, _)| *passed > end - watched).collect()
    };
    let flat = |samples: &[(f64, f64)]| slope(&last(samples)) < most;
    let samples = last(&play("soak", seconds, 3 * seconds, &flat, &[FLAT])?);
    let slope = slope(&samples);
    println!("soak: memory grows by {slope:.0} bytes a second over {} samples", samples.len());
    assert!(samples.len() > 20, "control: memory was not looked at");
    let with = |more: &dyn Fn(f64) -> f64| -> Vec<_> { samples.iter().map(|(passed, memory)| (*passed, memory + more(*passed))).collect() };
    assert!(!flat(&with(&|passed| 2.0 * most * passed)), "control: a leak is not seen");
    // Wherever the drive would have ended.
    for late in 0..8 {
        let stairs = with(&|passed| 16.0 * most * ((passed + f64::from(late)) / 8.0).floor());
        assert!(!flat(&stairs), "control: what grows every eight seconds is not seen, {late} s late");
    }
    assert!(slope < most, "memory grows by {slope:.0} bytes a second");
    // The layer that checks every call belongs to Vulkan.
    play("checked", seconds / 2, seconds / 2, &|_| true, &[("SWARD_VALIDATION", "1")]).map(|_| ())
}

/// When memory was looked at, in seconds, and how much it was, in bytes.
type Samples = Vec<(f64, f64)>;
/// Whether memory has come to rest.
type Flat<'a> = &'a dyn Fn(&[(f64, f64)]) -> bool;

/// Drives around, changes cameras, looks inside; nobody may complain. It takes so many seconds at least, and at most, until memory is `flat`.
fn play(name: &str, seconds: u64, most: u64, flat: Flat<'_>, environment: &[(&str, &str)]) -> Result<Samples, Failed> {
    let environment = [&[("RUST_LOG", "warn,sward_viewer=info")], environment].concat();
    let mut desk = Desk::open(name, &[&*scenes("hello")?, "--steps", "20", "--pixels", "0.25", "--cpu"], &environment)?;
    desk.key("e")?;
    // In circles, twenty steps a picture: the same ground again and again, all of it before memory is looked at.
    desk.hold("w", true)?;
    desk.hold("a", true)?;
    let begun = Instant::now();
    let (mut samples, mut turn) = (Samples::new(), 0);
    while begun.elapsed() < Duration::from_secs(seconds) || (begun.elapsed() < Duration::from_secs(most) && !flat(&samples)) {
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
    println!("{name}: {:.0} s, {} pictures, {} steps", begun.elapsed().as_secs_f64(), now["pictures"], now["step"]);
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
