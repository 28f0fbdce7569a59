//! The drawn surface goes through the sheet's vertices, smoothly.

use glam::Vec3;
use sward::response::springs::surface::point;
use sward::response::springs::{Sheet, pose};

use crate::Test;
use crate::field::{coefficients, root};

pub(crate) const TESTS: &[Test] = &[("the_surface_is_smooth_and_meets_its_vertices", the_surface_is_smooth_and_meets_its_vertices)];

/// Largest turn between pieces of a twelfth of a segment up the middle column, rad.
fn kink(at: impl Fn(f32) -> Vec3, rows: usize) -> f32 {
    let points: Vec<Vec3> = (0..=12 * (rows - 1)).map(|k| at(k as f32 / 12.0)).collect();
    points.windows(3).map(|p| (p[1] - p[0]).angle_between(p[2] - p[1])).fold(0.0, f32::max)
}

fn the_surface_is_smooth_and_meets_its_vertices() {
    for side in [2, 3, 5, 9] {
        let (co, root) = (coefficients(side, side), root(0.2, 0.1, 0.4, 0.4));
        let sheet = pose(&co, &root, [[1.2, 0.1], [0.9, 0.6]]);
        let (columns, rows) = co.sides();
        let mut off = 0.0f32;
        for vertex in 0..columns * rows {
            let at = point(&co, &root, &sheet, (vertex % columns) as f32, (vertex / columns) as f32);
            off = off.max(Vec3::from(at).distance(Vec3::from(sheet.at[vertex])));
        }
        let middle = (columns - 1) as f32 / 2.0;
        let smooth = kink(|up| point(&co, &root, &sheet, middle, up).into(), rows);
        let straight = |up: f32| {
            let row = (up.floor() as usize).min(rows - 2);
            let at = |row: usize| Vec3::from(point(&co, &root, &sheet, middle, row as f32));
            at(row).lerp(at(row + 1), up - row as f32)
        };
        let edged = kink(straight, rows);
        println!("{side} × {side}: vertices met to {off:.0e} m; kinks {smooth:.3} rad, straight between vertices {edged:.3}");
        assert!(off < 1e-6, "{side}: {off}");
        assert!(side == 2 || smooth < 0.5 * edged, "{side}: {smooth} {edged}");
    }
    let (co, root) = (coefficients(3, 3), root(0.0, 0.0, 0.0, 0.4));
    let nowhere = Sheet { at: [[f32::NAN; 3]; 81] };
    assert!(point(&co, &root, &nowhere, f32::NAN, 1e30)[0].is_nan(), "no input stops it");
}
