//! Hills and walls.

use sward::scene::Scene;
use sward::shading::volume::Spot;
use sward::terrain::Terrain;

use crate::Test;
use crate::level::volume;
use crate::scenes::{dome, near, small, world};

pub(crate) const TESTS: &[Test] = &[("a_wall_takes_half_of_the_sky", wall), ("a_slope_sees_less_of_the_sky", slope)];

/// A cliff of 400 m along z, close to the middle of the volume: half of the sky is gone, and the side of a leaf that faces it is dark.
fn wall() {
    let mut cliff = world("stands: []", dome(), small());
    let heights: Vec<f32> = (0..400 * 4).map(|at| if at % 400 < 200 { 0.0 } else { 400.0 }).collect();
    cliff.model.terrain = Terrain::new(heights, 400, 4, [4.0, 400.0], [-800.0, -600.0]).expect("a terrain");
    // Looking along the cliff from 10 m before it: it is a bicubic step 4 m wide, with ripples beside it.
    cliff.scene.camera.eye = [-12.0, 1.7, 0.0];
    cliff.scene.camera.target = [-12.0, 1.0, 10.0];
    let seen = volume(&cliff);
    let x = ((-12.0 - seen.corner[0]) / seen.extent[0]) as f32;
    let faces = seen.faces(Spot { across: [x, 0.4], up: 1.0 });
    assert!(near(faces[2].w, 0.5, 0.12), "{faces:?}");
    assert!(faces[0].w < 0.1 && near(faces[1].w, 0.5, 0.1), "{faces:?}");
    assert!(faces[0].x < faces[1].x / 2.0, "{faces:?}");
    // Control: the same place without the cliff.
    let mut level = cliff.clone();
    level.model.terrain = Terrain::flat(0.0);
    let open = volume(&level).faces(Spot { across: [x, 0.4], up: 1.0 });
    assert!(near(open[2].w, 1.0, 0.01) && near(open[0].w, 0.5, 0.02), "{open:?}");
}

/// On a plane that rises at 45 degrees to one side, (1 + cos 45°) / 2 of what level ground sees is left at the very least.
fn slope() {
    let text = "stands: [], camera: (eye: (0, 1.7, -4), target: (0, 1, 8))";
    let mut steep = world(text, dome(), small());
    let heights: Vec<f32> = (0..400 * 4).map(|at| (at % 400) as f32).collect();
    steep.model.terrain = Terrain::new(heights, 400, 4, [1.0, 400.0], [-200.0, -600.0]).expect("a terrain");
    let seen = volume(&steep).faces(Spot { across: [0.5; 2], up: 1.0 });
    // Of level irradiance the plane takes (1 − cos 45°) / 2.
    let wanted = 0.5 + 0.5 * std::f32::consts::FRAC_1_SQRT_2;
    assert!(near(seen[2].w, wanted, 0.05), "{} instead of {wanted}", seen[2].w);
    assert!(Scene::parse("(version: 1)", "control.ron").is_ok());
}
