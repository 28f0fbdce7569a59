//! No input may panic, hang or take all memory: files that are nearly right, changed at random, through every loader and what follows it.
//!
//! Case n of a loader is a function of (seed, loader, n). `SWARD_CASES` is the number of cases of all loaders together, `SWARD_SEED` the seed,
//! `SWARD_FIRST` the first case to run. CONTRIBUTING.md says how a million are run.

mod bytes;
mod chance;
mod glue;
mod meshes;
mod scenes;
mod states;
mod terrains;
mod tree;
mod words;

#[path = "../terrains/files.rs"]
#[allow(dead_code)] // The tests of terrains use more of it.
mod files;
#[path = "../figures/glb.rs"]
#[allow(dead_code)] // The tests of bodies use more of it.
mod glb;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use chance::Chance;

/// Cases of all loaders together where `SWARD_CASES` does not say.
const CASES: u64 = 4000;
/// A case that works longer is a fault.
const SLOW: Duration = Duration::from_secs(10);
/// Then nobody waits for its end.
const HUNG: Duration = Duration::from_secs(120);
/// Largest memory of the whole program at any time, bytes.
const MEMORY: u64 = 3 << 30;

fn variable(name: &str) -> Option<u64> {
    std::env::var(name).ok().map(|text| text.parse().unwrap_or_else(|_| panic!("{name} is a whole number, not {text}")))
}

/// How many inputs of a loader were taken, and how many refused.
#[derive(Debug, Default)]
struct Tally {
    taken: u64,
    refused: u64,
}

impl Tally {
    /// Both happened: at least this share of many inputs was taken, and some were refused.
    fn is_mixed(&self, least: f64) {
        let all = self.taken + self.refused;
        assert!(all < 100 || (self.taken as f64 >= least * all as f64 && self.refused > 0), "{self:?}");
    }
}

/// Runs a loader's share (of 1) of all cases; `attempt` says whether the input was taken.
///
/// # Panics
/// A case panicked or took too long.
fn run(loader: &'static str, share: f64, attempt: impl Fn(&mut Chance) -> bool) -> Tally {
    let cases = (variable("SWARD_CASES").unwrap_or(CASES) as f64 * share).ceil() as u64;
    run_cases(loader, cases, SLOW, attempt)
}

fn run_cases(loader: &'static str, cases: u64, slow: Duration, attempt: impl Fn(&mut Chance) -> bool) -> Tally {
    let (seed, first) = (variable("SWARD_SEED").unwrap_or(1), variable("SWARD_FIRST").unwrap_or(0));
    let now = Arc::new(AtomicU64::new(first));
    watch(&now, HUNG, move |case| {
        eprintln!("{loader}: case {case} of seed {seed} hangs");
        std::process::exit(101);
    });
    let (mut tally, mut faults, mut slowest) = (Tally::default(), Vec::new(), (Duration::ZERO, 0));
    let started = Instant::now();
    for case in first..first + cases {
        now.store(case, Ordering::Relaxed);
        let begun = worked(started);
        let mut chance = Chance::new(seed, loader, case);
        match catch_unwind(AssertUnwindSafe(|| attempt(&mut chance))) {
            Ok(true) => tally.taken += 1,
            Ok(false) => tally.refused += 1,
            Err(_) => faults.push(format!("case {case} panicked")),
        }
        let took = worked(started).saturating_sub(begun);
        slowest = slowest.max((took, case));
        if took > slow {
            faults.push(format!("case {case} took {took:?}"));
        }
        if faults.len() >= 10 {
            break;
        }
    }
    now.store(u64::MAX, Ordering::Relaxed);
    let (took, at) = slowest;
    println!("{loader}: {cases} cases of seed {seed}: {} taken, {} refused; slowest: case {at}, {took:?}", tally.taken, tally.refused);
    assert!(faults.is_empty(), "{loader}, seed {seed}: {faults:#?}");
    assert!(memory().is_none_or(|bytes| bytes < MEMORY), "{loader}: the program took {:?} bytes", memory());
    tally
}

/// Time that this thread has worked, where the system says; other machines count the time that went by, busy or not.
fn worked(started: Instant) -> Duration {
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = told.and_then(|text| text.split_whitespace().next()?.parse().ok());
    nanoseconds.map_or_else(|| started.elapsed(), Duration::from_nanos)
}

/// Calls `hung` if one case takes longer than `limit` on the clock.
fn watch(now: &Arc<AtomicU64>, limit: Duration, hung: impl Fn(u64) + Send + 'static) {
    let now = Arc::clone(now);
    std::thread::spawn(move || {
        let (mut last, mut since) = (now.load(Ordering::Relaxed), Instant::now());
        while last != u64::MAX {
            std::thread::sleep(Duration::from_millis(200));
            let case = now.load(Ordering::Relaxed);
            if case != last {
                (last, since) = (case, Instant::now());
            } else if since.elapsed() > limit {
                return hung(case);
            }
        }
    });
}

/// The most memory this program has had, where the system says.
fn memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    line.split_whitespace().nth(1)?.parse::<u64>().ok().map(|kilobytes| kilobytes << 10)
}

/// The harness finds what it is for.
#[test]
fn planted_faults_are_found() {
    let planted = |chance: &mut Chance| {
        assert!(chance.below(50) > 0, "planted");
        true
    };
    let found = catch_unwind(|| run_cases("planted", 500, SLOW, planted)).expect_err("control: a panic was not found");
    let text = found.downcast_ref::<String>().expect("words");
    assert!(text.contains("panicked") && text.contains("case "), "{text}");
}

/// A case that works too long is a fault, and so is one that never ends.
#[test]
fn planted_delays_are_found() {
    let started = Instant::now();
    let delayed = |chance: &mut Chance| {
        let (long, begun) = (chance.below(50) == 0, worked(started));
        while long && worked(started).saturating_sub(begun) < Duration::from_millis(60) {
            std::hint::black_box(begun);
        }
        true
    };
    let found =
        catch_unwind(|| run_cases("delayed", 200, Duration::from_millis(50), delayed)).expect_err("control: a slow case was not found");
    let text = found.downcast_ref::<String>().expect("words");
    assert!(text.contains(" took ") && !text.contains("panicked"), "{text}");
    assert_eq!(run_cases("delayed", 200, SLOW, delayed).taken, 200, "control: within the limit");
    let (told, heard) = std::sync::mpsc::channel();
    let now = Arc::new(AtomicU64::new(7));
    watch(&now, Duration::from_millis(300), move |case| told.send(case).expect("somebody listens"));
    assert_eq!(heard.recv_timeout(Duration::from_secs(60)), Ok(7), "control: a hung case was not found");
}

/// The same number gives the same case.
#[test]
fn cases_can_be_repeated() {
    let draws = |seed, case| {
        let mut chance = Chance::new(seed, "any", case);
        [0; 8].map(|_| chance.below(1 << 40))
    };
    assert_eq!(draws(1, 7), draws(1, 7));
    assert_ne!(draws(1, 7), draws(1, 8));
    assert_ne!(draws(1, 7), draws(2, 7));
}
