//! Plants in layers: what must not move, what must not be seen, and motion that leads where things were.

use std::sync::Arc;

use sward::model::NoAssets;
use sward::picture::Picture;
use sward::picture::aov::Aov;
use sward::picture::past::Past;
use sward::scene::Scene;
use sward::specimen::Kind;
use sward::world::World;
use sward_raster::Studio;

const SIZE: [u32; 2] = [240, 160];

fn world(text: &str, steps: u32) -> World {
    let mut world = World::new(Scene::parse(text, "layers.ron").expect("valid"), &NoAssets).expect("it compiles");
    (0..steps).for_each(|_| world.step());
    world
}

/// A shrub and a tree in a gale, `x` metres aside.
fn gale(x: f64) -> String {
    format!(
        "(version: 1, stands: [(species: Shrub, places: [(at: ({x}, 1.0), height: 1.5)], representation: Layers(mesh: Grown(triangles: 6000))),
            (species: Tree, places: [(at: ({}, 7.0), height: 6)], representation: Layers(mesh: Grown(form: Tree, triangles: 6000)))],
        wind: [Natural(velocity: (9.0, 3.0), turbulence: 0.5)], camera: (eye: ({x}, 1.4, -2.6), target: ({x}, 1.2, 2.0)), light: (clouds: 0))",
        x + 2.0
    )
}

/// Outputs of a moment, and how it got there from `before`.
fn outputs(world: &World, before: &World) -> (Picture, Aov) {
    Studio::new(world).draw_aov(world, &Past::of(before, 0.0), 0.0, SIZE)
}

/// Leafless plants: not a pixel of trunks and branches moves, in whatever wind. Control: with their leaves on.
#[test]
fn no_pixel_of_a_trunk_moves() {
    for leafless in [true, false] {
        let mut before = world(&gale(0.0), 30);
        if leafless {
            for stand in &mut before.model.layered {
                let specimen = Arc::make_mut(&mut stand.specimen);
                let finishes = specimen.finishes.clone();
                specimen.parts.retain(|part| finishes[part.finish].kind == Kind::Wood);
            }
        }
        let mut now = before.clone();
        (0..9).for_each(|_| now.step());
        let (picture, aov) = outputs(&now, &before);
        let earlier = outputs(&before, &before).0;
        let plants: Vec<usize> = (0..aov.plant.len()).filter(|at| aov.plant[*at] != 0).collect();
        let moved = plants.iter().filter(|at| aov.motion[**at].iter().any(|way| way.abs() > 1e-3)).count();
        let changed = plants.iter().filter(|at| picture.rgba8[4 * **at..4 * **at + 3] != earlier.rgba8[4 * **at..4 * **at + 3]).count();
        println!("leafless: {leafless}; of {} pixels {moved} move and {changed} change", plants.len());
        if leafless {
            assert!(plants.len() > 300 && moved == 0 && changed == 0, "{moved} {changed}");
        } else {
            assert!(moved > plants.len() / 2 && changed > plants.len() / 4, "control: {moved} {changed}");
        }
    }
}

/// Mean difference of the pixels that show plants in both pictures, of 255.
fn apart([(a, x), (b, y)]: [&(Picture, Aov); 2]) -> f64 {
    let both: Vec<usize> = (0..x.plant.len()).filter(|at| x.plant[*at] != 0 && y.plant[*at] != 0).collect();
    assert!(both.len() > 5000, "{}", both.len());
    let off = |at: &usize| (0..3).map(|k| f64::from(a.rgba8[4 * at + k].abs_diff(b.rgba8[4 * at + k]))).sum::<f64>();
    both.iter().map(off).sum::<f64>() / (3 * both.len()) as f64
}

/// The plane repeats without a seam: a plant across its border looks like one in its middle that sees the same waves. Control: other waves.
#[test]
fn where_the_plane_repeats_nothing_is_seen() {
    let text = |x: f64| {
        format!(
            "(version: 1, stands: [(species: Shrub, places: [(at: ({x}, 1.0), height: 1.5)], response: Harmonic(heading: 0),
            representation: Layers(mesh: Grown(triangles: 6000)))], wind: [Natural(velocity: (9, 0), turbulence: 0.5)],
            camera: (eye: ({x}, 1.4, -1.2), target: ({x}, 0.8, 2.0)), light: (clouds: 0, strength: 0))"
        )
    };
    let border = world(&text(0.0), 90);
    let draw = |world: &World| outputs(world, world);
    let mut middle = world(&text(4.0), 90);
    let n = middle.model.layered[0].harmonic.cells as usize;
    let other = draw(&middle);
    for note in &mut middle.state.layered[0].notes {
        let rolled: Vec<[f32; 2]> = (0..n * n).map(|cell| note[cell / n * n + (cell % n + n / 2) % n]).collect();
        *note = rolled;
    }
    let (here, there) = (draw(&border), draw(&middle));
    let (seam, control) = (apart([&here, &there]), apart([&here, &other]));
    println!("across the border {seam:.3} of 255, other waves {control:.3}");
    assert!(seam < 1.0, "{seam}");
    assert!(control > 3.0 * seam.max(0.3), "control: {control}");
}

/// Following the motion of leaves back finds their colours in the picture before. Control: staying where they are.
#[test]
fn motion_leads_to_where_leaves_were() {
    let before = world(&gale(0.0), 60);
    let mut now = before.clone();
    (0..4).for_each(|_| now.step());
    let (picture, aov) = outputs(&now, &before);
    let earlier = outputs(&before, &before).0;
    let [width, height] = SIZE.map(|side| side as i64);
    let colour = |picture: &Picture, x: f64, y: f64| {
        let (x, y) = ((x.round() as i64).clamp(0, width - 1), (y.round() as i64).clamp(0, height - 1));
        let at = 4 * (y * width + x) as usize;
        [0, 1, 2].map(|k| f64::from(picture.rgba8[at + k]))
    };
    let (mut led, mut stayed, mut count) = (0.0, 0.0, 0);
    for at in (0..aov.plant.len()).filter(|at| aov.plant[*at] != 0) {
        let [dx, dy] = aov.motion[at].map(f64::from);
        if dx.hypot(dy) < 0.7 {
            continue;
        }
        let (x, y) = ((at as i64 % width) as f64, (at as i64 / width) as f64);
        let own = colour(&picture, x, y);
        let off = |there: [f64; 3]| (0..3).map(|k| (own[k] - there[k]).abs()).sum::<f64>();
        led += off(colour(&earlier, x + dx, y + dy));
        stayed += off(colour(&earlier, x, y));
        count += 1;
    }
    println!("{count} pixels: followed {:.1}, in place {:.1}", led / f64::from(count), stayed / f64::from(count));
    assert!(count > 500 && led < 0.75 * stayed, "{count} {led} {stayed}");
}

/// Nothing pops: while new layers take over from older ones, pictures differ from the ones before hardly more than those of a camera that moves do anyway.
/// Control: layers that are exchanged at once.
#[test]
fn layers_that_are_cut_anew_do_not_pop() {
    let largest = |fade: f64| {
        let text = format!(
            "(version: 1, stands: [(species: Shrub, places: [(at: (0.0, 1.0), height: 1.5)], representation: Layers(fade: {fade}, mesh: Grown(triangles: 6000)))],
            camera: (keys: [(time: 0, eye: (-0.3, 1.4, -2.6), target: (0, 0.8, 1)), (time: 6, eye: (0.3, 1.4, -2.6), target: (0, 0.8, 1))]), light: (clouds: 0))"
        );
        let start = world(&text, 60);
        // When it is cut anew.
        let mut scout = start.clone();
        while scout.state.layered[0].cut < 2 {
            scout.step();
            assert!(scout.state.step < 400, "nothing was cut anew");
        }
        let turned = scout.state.step;
        let mut world = start;
        while world.state.step < turned - 12 {
            world.step();
        }
        let studio = Studio::new(&world);
        let (mut quiet, mut turning, mut last) = (0.0_f64, 0.0_f64, studio.draw(&world, SIZE));
        while world.state.step < turned + 16 {
            world.step();
            let picture = studio.draw(&world, SIZE);
            let off: u64 = picture.rgba8.iter().zip(&last.rgba8).map(|(a, b)| u64::from(a.abs_diff(*b)).pow(2)).sum();
            let off = (off as f64 / picture.rgba8.len() as f64).sqrt();
            if world.state.step >= turned {
                turning = turning.max(off)
            } else {
                quiet = quiet.max(off)
            }
            last = picture;
        }
        (quiet, turning)
    };
    let (quiet, turning) = largest(0.2);
    let (_, popping) = largest(0.0);
    println!("rms from picture to picture: a moving camera {quiet:.2}, while layers take over {turning:.2}, at once {popping:.2}");
    assert!(turning < 2.5 * quiet && turning < 0.4 * popping, "{turning} {quiet}");
    assert!(popping > 4.0 * quiet, "control: {popping}");
}
