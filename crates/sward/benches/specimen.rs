//! How long it takes to make a plant ready, and how much memory: `cargo bench -p sward --bench specimen`, with `-- 50000000` for another
//! number of triangles. Each plant is read, and a world with it is made and stepped, in a process of its own, so that the peak is its own. It only
//! prints what it finds.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use sward::model::NoAssets;
use sward::scene::Scene;
use sward::specimen::grow::{Form, Grow};
use sward::specimen::{Order, Specimen};
use sward::world::World;

/// What tells a process that it is to read a file.
const READ: &str = "--read";
/// What tells a process that it is to step a world with a plant of so many triangles.
const STEP: &str = "--step";
/// Steps that are taken: a second.
const STEPS: u32 = 60;
/// Bytes a vertex and a triangle that are documented, besides the file.
const CLAIMED: [u64; 2] = [32 + 22, 12];

/// The most memory that this process ever had, bytes; `None` where the system does not say.
fn peak() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix(" kB")?.trim().parse::<u64>().ok().map(|kilobytes| 1024 * kilobytes)
}

fn read(path: &Path) {
    let bytes = std::fs::read(path).expect("written before");
    let before = peak().unwrap_or(0);
    let begin = Instant::now();
    let none = |name: &str| Err(format!("{name} is missing"));
    let plant = Specimen::read(&bytes, &none, &Order::default(), &mut |_| ()).expect("a plant");
    let seconds = begin.elapsed().as_secs_f64();
    let (vertices, triangles) = (plant.vertices.len() as u64, plant.triangles.len() as u64);
    let taken = peak().unwrap_or(0).saturating_sub(before);
    // Some for the program itself and the allocator.
    let claimed = CLAIMED[0] * vertices + CLAIMED[1] * triangles + (8 << 20);
    let verdict = if taken <= claimed { "holds" } else { "does not hold here" };
    let megabytes = |bytes: u64| bytes as f64 / 1e6;
    println!(
        "{triangles} triangles, {vertices} vertices, {} leaves: {seconds:.2} s; {:.0} MB beside the file of {:.0} MB, {:.0} bytes a triangle; claimed at most {:.0} MB: {verdict}",
        plant.leaves,
        megabytes(taken),
        megabytes(bytes.len() as u64),
        taken as f64 / triangles as f64,
        megabytes(claimed),
    );
}

fn step(triangles: &str) {
    let text = format!(
        "(version: 1, stands: [(species: Tree, places: [(at: (0, 9), height: 7)], representation: Layers(mesh: Grown(form: Tree, triangles: {triangles})))],
        wind: [Fluid()], camera: (eye: (0, 2, 0), target: (0, 3.2, 9)))"
    );
    let begin = Instant::now();
    let mut world = World::new(Scene::parse(&text, "specimen.ron").expect("valid"), &NoAssets).expect("it compiles");
    let made = begin.elapsed().as_secs_f64();
    let begin = Instant::now();
    (0..STEPS).for_each(|_| world.step());
    let each = 1e3 * begin.elapsed().as_secs_f64() / f64::from(STEPS);
    let peak = peak().unwrap_or(0) as f64 / 1e9;
    println!(
        "a world with it: grown and made ready in {made:.2} s, {each:.2} ms a step over {STEPS} steps; peak of the process {peak:.2} GB"
    );
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    if let [flag, path] = &arguments[..]
        && flag == READ
    {
        return read(Path::new(path));
    }
    if let [flag, triangles] = &arguments[..]
        && flag == STEP
    {
        return step(triangles);
    }
    let asked: Vec<u32> = arguments.iter().filter_map(|argument| argument.parse().ok()).collect();
    for triangles in if asked.is_empty() { vec![80_000, 5_000_000] } else { asked } {
        let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("specimen_{triangles}.glb"));
        let begin = Instant::now();
        let grown = Grow { triangles, ..Grow::new(Form::Tree) }.mesh().expect("in range");
        println!("a tree of {triangles} triangles, grown in {:.2} s", begin.elapsed().as_secs_f64());
        let mut file = std::io::BufWriter::new(std::fs::File::create(&path).expect("writable"));
        grown.write(&mut file).expect("room on the disk");
        drop((grown, file));
        let program = std::env::current_exe().expect("it runs");
        Command::new(&program).arg(READ).arg(&path).status().expect("it runs again");
        std::fs::remove_file(&path).expect("written before");
        Command::new(program).arg(STEP).arg(triangles.to_string()).status().expect("it runs again");
    }
}
