//! Assets that code makes: each file is what its code says, bit for bit. `SWARD_ACCEPT=1` writes them.

#[path = "../figures/glb.rs"]
#[allow(dead_code)] // Only the file in the making is used.
mod glb;

mod clump;
mod gait;
mod helicopter;
mod lay_figure;
mod torus;

use std::path::Path;

use sward::figure::Figure;

/// A file of the repository is as made; with `SWARD_ACCEPT` set it is made so.
fn check(name: &str, made: &[u8]) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets").join(name);
    if std::env::var_os("SWARD_ACCEPT").is_some() {
        std::fs::write(&path, made).expect("the folder can be written to");
    }
    let found = std::fs::read(&path).unwrap_or_default();
    assert!(found == made, "assets/{name} ({} bytes) is not as made ({} bytes): accept it with SWARD_ACCEPT=1", found.len(), made.len());
}

fn figure(bytes: &[u8]) -> Figure {
    Figure::read(bytes, &|_| Err("it has no neighbours".to_owned()), 8).expect("it is a body")
}

/// What the sides of a figure enclose, m³: negative where they face inwards.
fn volume(figure: &Figure) -> f64 {
    figure
        .triangles
        .iter()
        .map(|corners| {
            let [a, b, c] = corners.map(|corner| glam::Vec3::from(figure.vertices[corner as usize].position).as_dvec3());
            a.dot(b.cross(c)) / 6.0
        })
        .sum()
}

#[test]
fn the_walker_is_as_made() {
    let made = lay_figure::walker().bytes();
    check("walker.glb", &made);
    let figure = figure(&made);
    let triangles = figure.triangles.len();
    println!("walker: {} bytes, {triangles} triangles, {} joints", made.len(), figure.frames.len());
    assert!(made.len() < 128 << 10 && triangles > 2000 && figure.frames.len() == lay_figure::JOINTS.len());
    assert!(figure.frames.iter().all(|frame| frame.joint));
}

#[test]
fn the_torus_is_as_made() {
    let made = torus::torus().bytes();
    check("torus.glb", &made);
    let figure = figure(&made);
    println!("torus: {} bytes, {} triangles", made.len(), figure.triangles.len());
    // All sides face outwards: the volume that they enclose is the torus's, a little less since they are flat.
    let volume = volume(&figure);
    let [ring, section] = torus::RADII;
    let whole = 2.0 * std::f64::consts::PI.powi(2) * ring * section * section;
    assert!((0.97..1.0).contains(&(volume / whole)), "{volume} of {whole}");
}

#[test]
fn the_helicopter_is_as_made_and_its_rotors_turn() {
    let made = helicopter::helicopter().bytes();
    check("helicopter.glb", &made);
    let figure = figure(&made);
    println!("helicopter: {} bytes, {} triangles", made.len(), figure.triangles.len());
    assert!(made.len() < 128 << 10 && figure.triangles.len() > 1000);
    let fly = figure.clip("Fly").expect("it flies");
    // The tip of a blade ahead at first, a quarter turn later beside; the nose, which the same times leave in place, is the control.
    let at = |time: f64, high: f64| {
        let pose = figure.pose(Some(fly), time);
        let placed = figure.vertices.iter().map(|vertex| {
            let place = glam::DVec3::from(vertex.position.map(f64::from));
            pose[usize::from(vertex.frames[0])].transform_point3(place)
        });
        placed.filter(|place| place.y > high).fold(0.0_f64, |reach, place| reach.max(place.z))
    };
    let tips = [0.0, 0.25, 0.5, 1.0].map(|turn| at(turn * helicopter::TURN, 2.6));
    assert!((tips[0] - helicopter::REACH - 0.1).abs() < 0.01 && (tips[3] - tips[0]).abs() < 1e-3, "{tips:?}");
    assert!(tips[1] < 0.95 * tips[0] && tips[2] < 0.6 * tips[0], "{tips:?}");
    // Sides face outwards: cabin, canopy and engine, which overlap, enclose some 7 m³; inside out it would be negative.
    let volume = volume(&figure);
    assert!((6.5..7.5).contains(&volume), "{volume}");
}

#[test]
fn the_clump_is_as_made() {
    let shades = clump::clump();
    let mut made = Vec::new();
    let writer = image::codecs::png::PngEncoder::new(&mut made);
    image::ImageEncoder::write_image(writer, &shades, clump::SIDE, clump::SIDE, image::ExtendedColorType::L8).expect("in memory");
    // What a mask reads counts, not how the encoder of the day packs it.
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/clump.png");
    if std::env::var_os("SWARD_ACCEPT").is_some() {
        std::fs::write(&path, &made).expect("the folder can be written to");
    }
    let found =
        image::load_from_memory(&std::fs::read(&path).unwrap_or_default()).expect("assets/clump.png: accept it with SWARD_ACCEPT=1");
    assert!(found.into_luma8().into_raw() == shades, "assets/clump.png is not as made: accept it with SWARD_ACCEPT=1");
    let edges = (0..clump::SIDE).map(|k| shades[k as usize]).max();
    assert!(
        edges == Some(0) && shades[(clump::SIDE * clump::SIDE / 2 + clump::SIDE / 2) as usize] == 255,
        "black at its edge, white in the middle"
    );
}

/// Where the lowest vertex of each foot is at a time of the walk, m: height, and place along its way.
fn feet(figure: &Figure, time: f64) -> [[f64; 2]; 2] {
    let pose = figure.pose(Some(figure.clip("Walk").expect("it walks")), time);
    let mut lowest = [[f64::MAX, 0.0]; 2];
    for vertex in &figure.vertices {
        let at: glam::DVec3 = (0..4)
            .map(|k| {
                let weight = f64::from(vertex.weights[k]);
                pose[usize::from(vertex.frames[k])].transform_point3(glam::DVec3::from(vertex.position.map(f64::from))) * weight
            })
            .sum();
        let foot = &mut lowest[usize::from(at.x < 0.0)];
        if at.y < foot[0] {
            *foot = [at.y, at.z];
        }
    }
    lowest
}

/// A foot is on the ground always, does not slide there where the body goes 1 m/s, and the other one swings free of it.
#[test]
fn the_walker_walks() {
    let figure = figure(&lay_figure::walker().bytes());
    let (mut free, mut lowest, mut highest): (f64, f64, f64) = (0.0, 0.0, 0.0);
    for k in 0..110 {
        let heights = feet(&figure, 0.01 * f64::from(k)).map(|[height, _]| height);
        lowest = lowest.min(heights[0]).min(heights[1]);
        highest = highest.max(heights[0].min(heights[1]));
        free = free.max(heights[0].max(heights[1]));
    }
    println!("soles: {:.1} mm below ground at most, {:.1} mm above it; a swinging one {:.0} mm", -1e3 * lowest, 1e3 * highest, 1e3 * free);
    assert!(lowest > -0.003 && highest < 0.003 && free > 0.04, "{lowest} {highest} {free}");
    // The left foot lies flat from 0.15 to 0.35 of a round.
    let [[_, before], [_, after]] = [0.2, 0.3].map(|round| feet(&figure, round * gait::ROUND)[0]);
    let slides = after - before + 0.1 * gait::ROUND * gait::SPEED;
    println!("slides {:.1} mm", 1e3 * slides);
    assert!(slides.abs() < 0.004, "{slides}");
}
