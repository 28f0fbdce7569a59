//! `sward show`: what a scene contains and what it costs, without running it. What a plant's file holds is in `plant.rs`.

use std::fmt::Write;

use sward::response::StandModel;
use sward::response::chain::ChainModel;
use sward::response::harmonic::LayeredStand;
use sward::response::oscillator::{self, OscillatorModel};
use sward::response::springs::{SpringsModel, pool};
use sward::scene::{Flow, Interactor, Path, Precision, Scene, Shape, Terrain, WindSource};
use sward::state::Root;
use sward::world::World;

use super::plant;
use crate::arguments;
use crate::arguments::Caching;
use crate::cache::Cache;
use crate::console::Console;
use crate::failure::Failure;
use crate::scenes::{self, Opened};

/// Bytes of one number.
const NUMBER: u64 = 4;
/// Bytes of a megabyte, as printed.
const MEGABYTE: f64 = 1e6;

/// Prints the page.
pub(crate) fn run(arguments: &arguments::Show, console: &Console) -> Result<(), Failure> {
    if let Some(page) = plant::page(&arguments.scene, console)? {
        return console.answer(&page);
    }
    let opened = scenes::open(&arguments.scene)?;
    let world = opened.world(&Cache::new(&Caching::default()), console)?;
    console.answer(&page(&opened, &world))
}

fn page(opened: &Opened, world: &World) -> String {
    let mut text = String::new();
    let scene = &opened.scene;
    let title = if scene.title.is_empty() { &opened.name } else { &scene.title };
    line(&mut text, "scene", &format!("{title}, seed {}, {} steps per second", scene.seed, scene.steps_per_second));
    line(&mut text, "field", &field(world));
    line(&mut text, "terrain", &terrain(opened, world));
    if let Some(limits) = limits(&opened.scene) {
        line(&mut text, "", &limits);
    }
    for (index, stand) in world.model.stands.iter().enumerate() {
        let species = format!("{:?}", scene.stands[stand.index].species).to_lowercase();
        text += &show_stand(world, index, stand, &species);
    }
    for stand in &world.model.layered {
        text += &show_meshes(stand, &format!("{:?}", scene.stands[stand.index].species).to_lowercase());
    }
    if world.model.stands.is_empty() && world.model.layered.is_empty() {
        line(&mut text, "stands", "none: nothing grows");
    }
    text.push('\n');
    for source in &scene.wind {
        line(&mut text, "wind", &wind(source));
    }
    if scene.wind.is_empty() {
        line(&mut text, "wind", "none: calm air");
    }
    for body in &scene.interactors {
        let name = if body.name.is_empty() { "unnamed" } else { &body.name };
        line(&mut text, "body", &format!("{name}: {}, {}{}", shape(&body.shape), path(&body.path), presence(body)));
    }
    if scene.interactors.is_empty() {
        line(&mut text, "body", "none: nothing pushes the plants");
    }
    text.push('\n');
    if !world.model.stands.is_empty() {
        show_grass_budget(&mut text, world);
    }
    if !world.model.layered.is_empty() {
        let label = if world.model.stands.is_empty() { "budget" } else { "" };
        let budget = &world.scene.budget;
        let bytes: usize = world.state.layered.iter().flat_map(|state| &state.notes).map(|note| size_of_val(&note[..])).sum();
        let (touched, cuts) = (budget.touched_plants, budget.cuts);
        let waves = bytes as f64 / MEGABYTE;
        line(&mut text, label, &format!("{waves:.1} MB of waves; at most {touched} plants touched at once, {cuts} cut in a step"));
    }
    text
}

/// What stands of grass may take.
fn show_grass_budget(text: &mut String, world: &World) {
    let budget = &world.scene.budget;
    let total = |precision: &Precision| {
        let bytes = (0..world.model.stands.len()).map(|index| budget_bytes(world, index, precision) as f64);
        format!("{:.1} MB", bytes.sum::<f64>() / MEGABYTE)
    };
    let full = total(&Precision::Full);
    let most = match &budget.precision {
        Precision::Full => format!("{full} of cells at most"),
        half => format!("{} of cells at most on a GPU, {full} on the CPU", total(half)),
    };
    line(text, "budget", &format!("{most}, in {} patches per stand", budget.patches));
    let (focus, lag) = (budget.focus_distance, budget.lag_distance);
    let blades = world.model.stands.iter().filter(|stand| stand.species.blade.is_some()).count();
    let drawn = match (blades, world.model.stands.len() - blades) {
        (0, _) => format!("{} plants", grouped(budget.visible_plants.into())),
        (_, 0) => format!("{} blades", grouped(budget.visible_blades.into())),
        _ => format!("{} plants and {} blades", grouped(budget.visible_plants.into()), grouped(budget.visible_blades.into())),
    };
    line(text, "", &format!("{drawn} drawn at once; gusts stir patches within {focus} m, tips trail within {lag} m"));
}

pub(super) fn line(text: &mut String, label: &str, value: &str) {
    // Writing to a String does not fail.
    let _ = writeln!(text, "{label:<10}{value}");
}

fn field(world: &World) -> String {
    let side = world.model.patch_side;
    match world.scene.field.patches {
        Some([x, z]) => {
            let [width, length] = [x, z].map(|patches| metres(f64::from(patches) * side));
            format!("{x} x {z} patches of {} a side: {width} x {length}", metres(side))
        }
        None => format!("patches of {} a side, without end", metres(side)),
    }
}

fn terrain(opened: &Opened, world: &World) -> String {
    let ground = match &opened.scene.terrain {
        Terrain::Flat(flat) => format!("flat, at {} m", flat.height),
        Terrain::Image(image) => format!("{}, scaled by {}", image.path, image.scale),
    };
    let filled = match world.model.terrain.filled() {
        0 => String::new(),
        filled => format!("; {filled} of {} samples had no data and took their neighbours'", world.model.terrain.heights().len()),
    };
    let detail = match &opened.scene.detail {
        None => String::new(),
        Some(detail) => format!("; bumps {} m high, {} m apart", detail.amplitude, detail.wavelength),
    };
    ground + &filled + &detail
}

/// What keeps plants away, and what changes the ground.
fn limits(scene: &Scene) -> Option<String> {
    let counts = [(scene.exclusions.len(), "exclusion"), (scene.masks.len(), "mask"), (scene.edits.len(), "edit")];
    let named = counts.iter().filter(|(count, _)| *count > 0);
    let named: Vec<String> = named.map(|(count, name)| format!("{count} {name}{}", plural(*count as u32))).collect();
    (!named.is_empty()).then(|| format!("with {}", named.join(", ")))
}

/// A stand of meshes.
fn show_meshes(stand: &LayeredStand, species: &str) -> String {
    let mut text = String::new();
    let (specimen, layers, model) = (&stand.specimen, stand.layers(), &stand.harmonic);
    let chance = stand.placement.height;
    let [low, high] = match stand.places.iter().map(|place| place.height.map_or(chance, |own| [own; 2])).reduce(join) {
        Some(placed) => placed,
        None => chance,
    };
    let plants = match stand.places.len() {
        0 => format!("{} cells a patch side, cover {}", stand.placement.cells, stand.placement.cover),
        count => format!("{count} plant{}", plural(count as u32)),
    };
    line(&mut text, "stand", &format!("{} ({species}): {plants}, {} m high", stand.name, span(low, high)));
    let triangles = grouped(specimen.triangles.len() as u64);
    line(
        &mut text,
        "",
        &format!(
            "meshes of {triangles} triangles, {} leaves, in {}-{}-{} layers",
            grouped(specimen.leaves.into()),
            layers.near,
            layers.mid,
            layers.far
        ),
    );
    let harmonic = &stand.layered.harmonic;
    line(&mut text, "", &format!("swing at {} Hz, damping ratio {}, after a body or a gust", harmonic.frequency, harmonic.damping));
    let (side, cells) = (harmonic.side, model.cells);
    line(
        &mut text,
        "",
        &format!("in waves of {} m/s on a plane of {side} m, {cells} x {cells} cells; 1.5 s of them are kept", harmonic.speed),
    );
    text
}

/// The range that holds two.
fn join(a: [f32; 2], b: [f32; 2]) -> [f32; 2] {
    [a[0].min(b[0]), a[1].max(b[1])]
}

fn span(low: f32, high: f32) -> String {
    if low == high { low.to_string() } else { format!("{low} to {high}") }
}

fn show_stand(world: &World, index: usize, stand: &StandModel, species: &str) -> String {
    let mut text = String::from("\n");
    let [low, high] = stand.species.height;
    let continuum = &stand.species.continuum;
    let kind = if stand.name == species { String::new() } else { format!(" ({species})") };
    line(&mut text, "stand", &format!("{}{kind}: plants {low} to {high} m high", stand.name));
    let cell = stand.spacing;
    line(&mut text, "", &format!("{0} x {0} cells of {cell:.3} m a patch, {1}", stand.cells, plants(world, stand)));
    if let Some(chain) = &stand.chain {
        return text + &show_blades(world, stand, chain);
    }
    if let Some(springs) = &stand.springs {
        return text + &show_springs(world, stand, springs);
    }
    if let Some(oscillator) = &stand.oscillator {
        return text + &show_swings(world, index, stand, oscillator);
    }
    // λ = 1 − e^(−ζ√κ/30), solved for ζ.
    let damping = -30.0 * (1.0 - continuum.lambda_theta).ln() / continuum.kappa.sqrt();
    let frequency = continuum.frequency();
    let sways = match frequency > 0.0 {
        true => format!("sways at {frequency:.2} Hz, damping ratio {damping:.2}{}", if damping < 1.0 { "" } else { " (creeps back)" }),
        false => "never stands up again (kappa is 0)".to_owned(),
    };
    line(&mut text, "", &sways);
    let (speed, cap) = (continuum.c0, stand.coefficients.speed_cap);
    let slowed = if speed > cap { format!(", held to {cap:.2} m/s by the step and cell size") } else { String::new() };
    line(&mut text, "", &format!("pushes spread at {speed} m/s{slowed}; {} substep{} a step", stand.substeps, plural(stand.substeps)));
    let segments = stand.lag.segments;
    let trail = format!("the tip trails by {} s bending, {} s standing up", continuum.gamma_top, continuum.gamma_recover);
    line(&mut text, "", &format!("{segments} segment{} a plant; {trail}", plural(segments)));
    show_strips(&mut text, stand);
    let precision = &world.scene.budget.precision;
    let (patch, upper) = (patch_bytes(world, stand, precision), lag_bytes(stand));
    let total = budget_bytes(world, index, precision) as f64 / MEGABYTE;
    let backend = if *precision == Precision::Half { " on a GPU" } else { "" };
    let cost = format!("{} bytes a patch and {} for its upper segments; {total:.1} MB at most{backend}", grouped(patch), grouped(upper));
    line(&mut text, "", &cost);
    text
}

/// How many blades its plants have, where they are drawn as blades.
fn show_strips(text: &mut String, stand: &StandModel) {
    if let Some(blade) = &stand.species.blade {
        let [near, middle, far] = blade.pieces;
        let more = format!("{near}, {middle}, {far} pieces from near to far");
        line(text, "", &format!("{} blade{} a plant, strips of {more}", blade.blades, plural(blade.blades)));
    }
}

/// How bodies deform the billboards of a stand.
fn show_springs(world: &World, stand: &StandModel, springs: &SpringsModel) -> String {
    let mut text = String::new();
    let co = &springs.coefficients;
    let (columns, rows) = co.sides();
    let size =
        format!("bodies deform sheets of {columns} x {rows} vertices, springs of stiffness {} in {} sweeps", co.stiffness, co.iterations);
    line(&mut text, "", &size);
    let lean = sward::wind::equilibrium([4.0, 0.0], springs.wind)[0].to_degrees();
    let segments = stand.species.segments();
    let shape = format!("{segments} segment{} a plant", plural(segments));
    line(&mut text, "", &format!("{shape}; back {} s after a body; tips lean by {lean:.0} degrees in wind of 4 m/s", co.recover));
    let area = u64::from(stand.cells) * u64::from(stand.cells);
    let words = pool::words(co) as u64;
    let total = NUMBER * (words * u64::from(springs.capacity) + area * u64::from(world.scene.budget.patches));
    let cost = format!("{} bytes a patch and {} a sheet", grouped(NUMBER * area), NUMBER * words);
    line(&mut text, "", &format!("{cost}; {:.1} MB at most, {} sheets", total as f64 / MEGABYTE, springs.capacity));
    text
}

/// How a stand moves in which every plant swings by itself.
fn show_swings(world: &World, index: usize, stand: &StandModel, oscillator: &OscillatorModel) -> String {
    let mut text = String::new();
    let co = &oscillator.coefficients;
    let creeps = if oscillator.damping_ratio < 1.0 { "" } else { " (creeps back)" };
    line(&mut text, "", &format!("swings at {:.2} Hz, damping ratio {:.2}{creeps}", oscillator.frequency, oscillator.damping_ratio));
    let [stiffness, damping] = co.spreads.map(|share| 100.0 * share);
    let (k, b) = (co.stiffness, co.damping);
    let spread = format!("k {k:.1} m/s²/rad, {stiffness:.0} % more or less from plant to plant, b {b:.2} m/s, {damping:.0} %");
    line(&mut text, "", &spread);
    let rest = f64::from(co.settle) * world.model.dt;
    let lean = sward::wind::equilibrium([4.0, 0.0], co.wind)[0].to_degrees();
    let segments = stand.species.segments();
    let shape = format!("{segments} segment{} a plant", plural(segments));
    line(&mut text, "", &format!("{shape}; at rest {rest:.1} s after a body; leans by {lean:.0} degrees in wind of 4 m/s"));
    show_strips(&mut text, stand);
    let [records, air] = oscillator::sizes(oscillator, stand.cells).map(|numbers| NUMBER * numbers as u64);
    let total = budget_bytes(world, index, &Precision::Full) as f64 / MEGABYTE;
    let wind = if air > 0 { format!(" and {} for the wind", grouped(air)) } else { String::new() };
    line(&mut text, "", &format!("{} bytes a patch{wind}; {total:.1} MB at most", grouped(records)));
    text
}

/// How a stand moves that moves blade by blade.
fn show_blades(world: &World, stand: &StandModel, chain: &ChainModel) -> String {
    let mut text = String::new();
    let (co, length) = (&chain.coefficients, 0.5 * (stand.species.height[0] + stand.species.height[1]));
    let first = &co.joints[0];
    let frequency = (f64::from(first.stiffness - co.weight * co.half_length) / f64::from(first.inertia)).sqrt() / std::f64::consts::TAU;
    let damping = stand.species.chain.as_ref().map_or(0.0, |by_blade| by_blade.chain.damping);
    let segments = co.segments;
    let sways = format!("sways at {frequency:.2} Hz, damping ratio {damping:.2}");
    line(&mut text, "", &format!("a blade {length:.2} m long, of {segments} segment{}, {sways}", plural(segments)));
    line(&mut text, "", &format!("in wind of 4 m/s its tip leans by {:.0} degrees", chain.steady.lean(4.0).to_degrees()));
    let side = chain.virtual_side;
    let blades = chain.blades_of_patch(stand.cells);
    let who = if chain.all {
        "blades near the camera, and where bodies pass, have a state"
    } else {
        "blades that bodies have touched have a state"
    };
    line(&mut text, "", &format!("{side} x {side} virtual blades a patch; {who}"));
    let patches = world.scene.budget.stateful_blades / blades.max(1);
    let bytes = (4 * chain.planes() + size_of::<Root>()) as u64 * u64::from(blades);
    let total = bytes as f64 * f64::from(patches) / MEGABYTE;
    let cost = format!("{} bytes a patch for the states of {blades} blades; {total:.1} MB at most, {patches} patches", grouped(bytes));
    line(&mut text, "", &cost);
    text
}

fn plants(world: &World, stand: &StandModel) -> String {
    let patch = f64::from(stand.cells) * f64::from(stand.cells) * f64::from(stand.placement.cover);
    // Where the ground has a say, only looking at all of it would tell how many grow.
    let most = if stand.growth.is_free() { "" } else { "at most " };
    let square = world.model.patch_side * world.model.patch_side;
    match world.scene.field.patches {
        Some([x, z]) => format!("{most}about {} plants in all", grouped((patch * f64::from(x) * f64::from(z)).round() as u64)),
        None => {
            let hectare = grouped((patch * 1e4 / square).round() as u64);
            format!("{most}about {} plants a patch, {hectare} a hectare", grouped(patch.round() as u64))
        }
    }
}

/// Two time levels of β and ω, and slopes and height of the ground where it is not level.
fn patch_bytes(world: &World, stand: &StandModel, precision: &Precision) -> u64 {
    if let Some(springs) = &stand.springs {
        // And its share of the sheets.
        let sheets = NUMBER * pool::words(&springs.coefficients) as u64 * u64::from(springs.capacity);
        return NUMBER * u64::from(stand.cells) * u64::from(stand.cells) + sheets / u64::from(world.scene.budget.patches);
    }
    if let Some(oscillator) = &stand.oscillator {
        let ground = if stand.stores_ground(&world.model.terrain) { 3 } else { 0 };
        let area = stand.cells as usize * stand.cells as usize;
        return NUMBER * (oscillator::sizes(oscillator, stand.cells).iter().sum::<usize>() + ground * area) as u64;
    }
    let level = match precision {
        Precision::Full => 4,
        Precision::Half => 2,
    };
    let ground = if stand.is_level(&world.model.terrain) { 0 } else { 3 };
    NUMBER * (2 * level + ground) * u64::from(stand.cells) * u64::from(stand.cells)
}

/// Upper segments of one patch, and the past that `History` keeps.
fn lag_bytes(stand: &StandModel) -> u64 {
    let planes = if stand.lag.segments < 2 { 0 } else { 2 * (u64::from(stand.lag.segments) - 1) };
    let past = if stand.lag.kind == 1 && planes > 0 { 2 * u64::from(stand.lag.ring) } else { 0 };
    NUMBER * (planes + past) * u64::from(stand.cells) * u64::from(stand.cells)
}

fn budget_bytes(world: &World, index: usize, precision: &Precision) -> u64 {
    let (stand, slots) = (&world.model.stands[index], &world.state.stands[index]);
    slots.free.len() as u64 * patch_bytes(world, stand, precision) + slots.lag_free.len() as u64 * lag_bytes(stand)
}

fn wind(source: &WindSource) -> String {
    let speed = |[x, z]: [f32; 2]| format!("{:.1} m/s ({x} along x, {z} along z)", (x * x + z * z).sqrt());
    match source {
        WindSource::Uniform(wind) => format!("steady, {}", speed(wind.velocity)),
        WindSource::Footprint(wind) => {
            let flow = match &wind.flow {
                Flow::Outward => "outward".to_owned(),
                Flow::Swirl => "round a centre".to_owned(),
                Flow::Image(image) => format!("as in {}", image.path),
            };
            let place = wind.follow.as_ref().map_or(String::new(), |name| format!(" with `{name}`"));
            format!("{flow}{place}, {} m/s within {} m, gone from {} m up", wind.speed, wind.radius, wind.ceiling)
        }
        WindSource::Fluid(wind) => {
            let (gusts, cell) = (wind.gusts.len(), 1e2 * wind.side / wind.cells as f32);
            let bodies = if wind.bodies { ", wakes of bodies" } else { "" };
            format!(
                "flowing, {}, {gusts} gusts{bodies}; {} m wide, {} x {} cells of {cell:.0} cm",
                speed(wind.velocity),
                wind.side,
                wind.cells,
                wind.cells
            )
        }
        WindSource::Natural(wind) => format!("gusty, {} and {:.0} % turbulence", speed(wind.velocity), 100.0 * wind.turbulence),
    }
}

fn shape(shape: &Shape) -> String {
    match shape {
        Shape::Box(of) => format!("box of {} x {} x {} m", of.size[0], of.size[1], of.size[2]),
        Shape::Polygon(of) => format!("prism of {} corners, {} m high", of.points.len(), of.height),
        Shape::Sphere(of) => format!("sphere of radius {} m", of.radius),
        Shape::Ellipsoid(of) => format!("ellipsoid of {} x {} x {} m", 2.0 * of.radii[0], 2.0 * of.radii[1], 2.0 * of.radii[2]),
        Shape::Truck => "truck".to_owned(),
        Shape::Compound(of) => format!("compound of {} parts", of.parts.len()),
        Shape::Mesh(of) => match &of.clip {
            Some(clip) => format!("mesh {}, clip {clip}", of.file),
            None => format!("mesh {}", of.file),
        },
    }
}

fn path(path: &Path) -> String {
    match path {
        Path::Still(_) => "stands still".to_owned(),
        Path::Keyframes(of) => {
            let end = of.keys.last().map_or(0.0, |key| key.time);
            format!("passes {} places in {end} s{}", of.keys.len(), if of.repeat { ", again and again" } else { "" })
        }
        Path::Circle(of) => format!("circles at {} m/s, radius {} m", of.speed, of.radius),
        Path::Driven(_) => "moved by a program".to_owned(),
    }
}

fn presence(body: &Interactor) -> String {
    match (body.from > 0.0, body.until < 1e9) {
        (false, false) => String::new(),
        (true, false) => format!(", from {} s", body.from),
        (false, true) => format!(", until {} s", body.until),
        (true, true) => format!(", from {} to {} s", body.from, body.until),
    }
}

fn plural(count: u32) -> &'static str {
    if count == 1 { "" } else { "s" }
}

fn metres(length: f64) -> String {
    if length < 1e4 { format!("{length:.3} m").replace(".000", "") } else { format!("{:.1} km", length / 1e3) }
}

/// Digits in groups of three.
pub(super) fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let first = digits.len() % 3;
    let groups = std::iter::once(&digits[..first]).chain((first..digits.len()).step_by(3).map(|at| &digits[at..at + 3]));
    groups.filter(|group| !group.is_empty()).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::{grouped, metres};

    #[test]
    fn long_numbers_are_readable() {
        assert_eq!([0, 12, 123, 1234, 1_234_567].map(grouped), ["0", "12", "123", "1 234", "1 234 567"]);
        assert_eq!([32.0, 54.864, 482_803.2].map(metres), ["32 m", "54.864 m", "482.8 km"]);
    }
}
