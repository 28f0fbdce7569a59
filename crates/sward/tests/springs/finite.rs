//! Whatever stands and whatever comes: finite vertices, lengths kept, nothing below the ground.

use glam::Vec3;
use sward::interaction::distance_map::DistanceMapHead;
use sward::math::{hash, unit};
use sward::response::springs::{CLEAR, Maps, SheetRoot, SpringsCoefficients};

use crate::Test;
use crate::bodies::{Body, block, egg};
use crate::field::{Plant, head};

pub(crate) const TESTS: &[Test] =
    &[("random_fields_stay_finite", random_fields_stay_finite), ("damaged_numbers_stop_nothing", damaged_numbers_stop_nothing)];

fn random_fields_stay_finite() {
    let bodies: Vec<Body> = vec![
        egg("egg", Vec3::new(0.3, 0.6, 0.2), -0.1, 32, 16),
        block("slab", Vec3::new(1.5, 0.1, 1.5), 0.02, 32),
        block("needle", Vec3::new(0.03, 2.0, 0.03), -0.5, 32),
    ];
    let (mut stretch, mut lowest, mut touched) = (0.0f32, 1.0f32, 0);
    for seed in 0..150 {
        let random = |purpose: u32| unit(hash(seed, 0, 0, 0, purpose));
        let side = |purpose| 2 + (8.0 * random(purpose)) as u32;
        let iterations = (17.0 * random(2)) as u32;
        let co = SpringsCoefficients::new([side(0), side(1)], iterations, random(3), 0.05 + random(4), 1.0 / 60.0);
        let signed = |purpose: u32, most: f32| most * (2.0 * random(purpose) - 1.0);
        let root = SheetRoot {
            at: [signed(5, 0.3), signed(6, 2.0), signed(7, 0.3)],
            length: 0.05 + 1.2 * random(8),
            half_width: [signed(9, 0.4), signed(10, 0.4)],
            slope: [signed(11, 0.8), signed(12, 0.8)],
            lean: [signed(13, 0.5), signed(14, 0.5)],
            ..SheetRoot::default()
        };
        let mut plant = Plant::new(&co, root);
        for frame in 0..60u32 {
            let body = &bodies[(seed as usize + frame as usize / 30) % bodies.len()];
            // Bodies appear anywhere, anyhow turned, from one frame to the next.
            let part = |purpose: u32| unit(hash(seed, 1, 0, frame, purpose)) - 0.5;
            let heads: Vec<DistanceMapHead> = (0..2)
                .map(|moment| {
                    let off = Vec3::new(part(3 * moment), 0.5 * part(3 * moment + 1), part(3 * moment + 2));
                    head(&body.map, moment, Vec3::from(root.at) + off, 7.0 * part(9))
                })
                .collect();
            let maps = if frame < 50 { Maps { heads: &heads, texels: &body.map.texels } } else { Maps::NONE };
            plant.step(&co, &maps, [0.0, 1.0]);
            touched += u32::from(plant.held.steps == 0);
            stretch = stretch.max(plant.shown.stretch(&co, &root));
            let (columns, rows) = co.sides();
            for at in &plant.shown.at[columns..columns * rows] {
                assert!(at.iter().all(|part| part.is_finite()), "{seed}");
                lowest = lowest.min(root.height(*at));
            }
        }
    }
    println!("random fields: lengths {stretch:.0e}, lowest {:.3} mm, touched {touched}", lowest * 1e3);
    assert!(touched > 2000 && stretch < 1e-3 && lowest > 0.9 * CLEAR);
}

fn damaged_numbers_stop_nothing() {
    let body = block("box", Vec3::ONE, 0.0, 16);
    for bad in [f32::NAN, f32::INFINITY, -1.0, 0.0, 1e38] {
        let co = SpringsCoefficients::new([0, u32::MAX], u32::MAX, bad, bad, bad);
        let root = SheetRoot { at: [bad; 3], length: bad, half_width: [bad; 2], slope: [bad; 2], lean: [bad; 2], ..SheetRoot::default() };
        for root in [root, SheetRoot { at: [0.0; 3], ..root }, SheetRoot { length: 0.4, slope: [0.0; 2], ..root }] {
            let mut plant = Plant::new(&co, root);
            let heads = [head(&body.map, 0, Vec3::splat(bad), bad), DistanceMapHead::default(), head(&body.map, u32::MAX, Vec3::ZERO, 0.0)];
            for heads in [&heads[..2], &heads[..1]] {
                plant.step(&co, &Maps { heads, texels: &body.map.texels }, [bad; 2]);
            }
        }
    }
}
