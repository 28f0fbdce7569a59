//! Assets that code makes: each file is what its code says, bit for bit. `SWARD_ACCEPT=1` writes them.

#[path = "../figures/glb.rs"]
#[allow(dead_code)] // Only the file in the making is used.
mod glb;

mod gait;
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
    let volume: f64 = figure
        .triangles
        .iter()
        .map(|corners| {
            let [a, b, c] = corners.map(|corner| glam::Vec3::from(figure.vertices[corner as usize].position).as_dvec3());
            a.dot(b.cross(c)) / 6.0
        })
        .sum();
    let [ring, section] = torus::RADII;
    let whole = 2.0 * std::f64::consts::PI.powi(2) * ring * section * section;
    assert!((0.97..1.0).contains(&(volume / whole)), "{volume} of {whole}");
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
