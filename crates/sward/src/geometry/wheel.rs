//! A wheel of the shipped truck: tyre, rim, dish, hub and spokes.

use glam::{Vec2, Vec3};

use super::mesh::{Material, Mesh};
use super::truck::DARK;

const RUBBER: Material = Material { colour: [0.018, 0.017, 0.016], paint: 0.0, roughness: 0.9, gloss: 0.03 };
const RIM: Material = Material { colour: [0.50, 0.50, 0.49], paint: 0.0, roughness: 0.32, gloss: 0.45 };
/// Outer radius of the tyre, metres.
pub(super) const WHEEL_RADIUS: f32 = 0.39;

/// Appends the wheel whose axle is at `z`, on the side of the sign of `side`.
pub(super) fn wheel(mesh: &mut Mesh, z: f32, side: f32) {
    let centre = Vec3::new(side * 0.82, WHEEL_RADIUS, z);
    let half = 0.125;
    let rim = 0.60 * WHEEL_RADIUS;
    let tyre = [
        Vec2::new(-half, rim),
        Vec2::new(-half - 0.008, 0.80 * WHEEL_RADIUS),
        Vec2::new(-half + 0.02, 0.955 * WHEEL_RADIUS),
        Vec2::new(-half + 0.06, WHEEL_RADIUS),
        Vec2::new(half - 0.06, WHEEL_RADIUS),
        Vec2::new(half - 0.02, 0.955 * WHEEL_RADIUS),
        Vec2::new(half + 0.008, 0.80 * WHEEL_RADIUS),
        Vec2::new(half, rim),
    ];
    mesh.lathe(&tyre, centre, 24, RUBBER);
    let face = |profile: &[[f32; 2]], out: f32| {
        let mut line: Vec<Vec2> = profile.iter().map(|&[inwards, radius]| Vec2::new(out * (half - inwards), radius)).collect();
        if out < 0.0 {
            line.reverse();
        }
        line
    };
    // Rim: a lip, a dish behind the spokes, a hub; the hidden side has only the dish.
    let (lip, dish) = ([[0.0, rim], [0.02, rim - 0.03], [0.06, rim - 0.035]], [[0.06, rim - 0.035], [0.07, 0.0]]);
    mesh.lathe(&face(&lip, side), centre, 24, RIM);
    mesh.lathe(&face(&dish, side), centre, 16, DARK);
    mesh.lathe(&face(&[[0.05, 0.075], [0.012, 0.055], [0.005, 0.0]], side), centre, 10, RIM);
    mesh.lathe(&face(&[[0.0, rim], [0.04, 0.0]], -side), centre, 16, DARK);
    spokes(mesh, centre + Vec3::X * (side * (half - 0.03)), rim - 0.03, side);
}

fn spokes(mesh: &mut Mesh, centre: Vec3, radius: f32, side: f32) {
    for spoke in 0..6 {
        let (s, c) = (std::f32::consts::TAU * spoke as f32 / 6.0).sin_cos();
        let out = Vec3::new(0.0, c, s);
        let across = Vec3::new(0.0, -s, c) * 0.036;
        let top = Vec3::X * (side * 0.012);
        let mut face = vec![
            centre + out * 0.05 - across + top,
            centre + out * radius - 0.7 * across,
            centre + out * radius + 0.7 * across,
            centre + out * 0.05 + across + top,
        ];
        if side < 0.0 {
            face.reverse();
        }
        mesh.polygon(&face, RIM);
    }
}
