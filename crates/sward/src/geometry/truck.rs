//! The shipped pickup truck: 2.0 m wide, 1.9 m high, 4.8 m long, forward +z, origin on the ground between the wheels.

use glam::{Vec2, Vec3};

use super::mesh::{Material, Mesh, PAINT};
use super::wheel::{WHEEL_RADIUS, wheel};

const GLASS: Material = Material { colour: [0.012, 0.016, 0.018], paint: 0.0, roughness: 0.06, gloss: 0.10 };
const PLASTIC: Material = Material { colour: [0.03, 0.03, 0.032], paint: 0.0, roughness: 0.55, gloss: 0.04 };
pub(super) const DARK: Material = Material { colour: [0.008, 0.008, 0.008], paint: 0.0, roughness: 1.0, gloss: 0.01 };
const CHROME: Material = Material { colour: [0.55, 0.56, 0.57], paint: 0.0, roughness: 0.16, gloss: 0.7 };
const LAMP: Material = Material { colour: [0.75, 0.76, 0.72], paint: 0.0, roughness: 0.12, gloss: 0.25 };
const RED: Material = Material { colour: [0.40, 0.015, 0.012], paint: 0.0, roughness: 0.2, gloss: 0.08 };
const AMBER: Material = Material { colour: [0.65, 0.22, 0.02], paint: 0.0, roughness: 0.2, gloss: 0.08 };

/// Distance of the axles from the middle, metres: rear, front.
const AXLES: [f32; 2] = [-1.42, 1.50];
const ARCH_RADIUS: f32 = 0.47;
/// Half width of the body.
const HALF: f32 = 0.96;
/// Height of the shoulder line and of the sill.
const SHOULDER: f32 = 1.10;
const SILL: f32 = 0.44;

/// Builds the truck.
pub fn truck() -> Mesh {
    let mut mesh = Mesh::default();
    body(&mut mesh);
    bed(&mut mesh);
    cabin(&mut mesh);
    front(&mut mesh);
    rear(&mut mesh);
    sides(&mut mesh);
    for z in AXLES {
        for side in [-1.0, 1.0] {
            wheel(&mut mesh, z, side);
        }
    }
    mesh
}

/// Lower body with its wheel arches; under the bed it ends at the load floor.
fn body(mesh: &mut Mesh) {
    let mut profile = vec![Vec2::new(-2.32, SILL + 0.10)];
    for axle in AXLES {
        let foot = (ARCH_RADIUS * ARCH_RADIUS - (SILL - WHEEL_RADIUS).powi(2)).sqrt();
        let from = (SILL - WHEEL_RADIUS).atan2(-foot);
        let to = (SILL - WHEEL_RADIUS).atan2(foot);
        for step in 0..=10 {
            let (s, c) = (from + (to - from) * step as f32 / 10.0).sin_cos();
            profile.push(Vec2::new(axle + ARCH_RADIUS * c, WHEEL_RADIUS + ARCH_RADIUS * s));
        }
    }
    profile.extend([
        Vec2::new(2.26, SILL + 0.06),
        Vec2::new(2.30, 0.80),
        Vec2::new(2.22, 0.98),
        Vec2::new(1.95, 1.06),
        Vec2::new(1.05, SHOULDER + 0.03),
        Vec2::new(0.80, SHOULDER),
        Vec2::new(-0.62, SHOULDER),
        Vec2::new(-0.64, 0.88),
        Vec2::new(-2.32, 0.88),
    ]);
    mesh.extrude(&profile, [-HALF, HALF], 0.045, PAINT, |_| 1.0);
    // What one sees through the arches and below the sill.
    mesh.chamfered(Vec3::new(-0.70, 0.30, -2.10), Vec3::new(0.70, 0.84, 2.05), 0.05, DARK);
    mesh.chamfered(Vec3::new(-0.88, SILL - 0.06, -0.90), Vec3::new(0.88, SILL + 0.05, 0.98), 0.03, PLASTIC);
}

/// Load bed: four walls around a dark floor.
fn bed(mesh: &mut Mesh) {
    let (low, high) = (0.86, SHOULDER + 0.02);
    for side in [-1.0f32, 1.0] {
        let x = [side * HALF, side * (HALF - 0.11)];
        mesh.chamfered(Vec3::new(x[0].min(x[1]), low, -2.32), Vec3::new(x[0].max(x[1]), high, -0.60), 0.03, PAINT);
        let rail = [side * (HALF - 0.005), side * (HALF - 0.105)];
        mesh.chamfered(Vec3::new(rail[0].min(rail[1]), high, -2.30), Vec3::new(rail[0].max(rail[1]), high + 0.022, -0.66), 0.01, PLASTIC);
        mesh.chamfered(Vec3::new(side * 0.72 - 0.13, 0.88, -1.80), Vec3::new(side * 0.72 + 0.13, 1.02, -1.04), 0.04, PLASTIC);
    }
    mesh.chamfered(Vec3::new(-HALF + 0.04, 0.62, -2.345), Vec3::new(HALF - 0.04, high, -2.27), 0.025, PAINT);
    mesh.chamfered(Vec3::new(-0.86, 0.85, -2.28), Vec3::new(0.86, 0.895, -0.62), 0.005, PLASTIC);
    // Roll bar behind the cabin.
    for side in [-1.0, 1.0] {
        mesh.chamfered(Vec3::new(side * 0.74 - 0.035, 1.05, -0.86), Vec3::new(side * 0.74 + 0.035, 1.72, -0.79), 0.03, PLASTIC);
    }
    mesh.chamfered(Vec3::new(-0.775, 1.66, -0.86), Vec3::new(0.775, 1.73, -0.79), 0.03, PLASTIC);
}

/// The cabin narrows towards the roof.
fn narrow(y: f32) -> f32 {
    1.0 - 0.24 * (y - SHOULDER).max(0.0)
}

fn cabin(mesh: &mut Mesh) {
    let profile = [
        Vec2::new(-0.64, SHOULDER - 0.05),
        Vec2::new(1.12, SHOULDER - 0.05),
        Vec2::new(1.12, SHOULDER + 0.02),
        Vec2::new(0.44, 1.76),
        Vec2::new(0.30, 1.84),
        Vec2::new(-0.02, 1.885),
        Vec2::new(-0.40, 1.86),
        Vec2::new(-0.52, 1.80),
        Vec2::new(-0.64, 1.62),
    ];
    mesh.extrude(&profile, [-0.925, 0.925], 0.05, PAINT, narrow);
    side_windows(mesh);
    // Windscreen and rear window lie a little proud of the sheet metal.
    let pane = |z: f32, y: f32, x: f32| Vec3::new(x * narrow(y), y, z);
    mesh.polygon(&[pane(1.085, 1.155, -0.80), pane(1.085, 1.155, 0.80), pane(0.495, 1.735, 0.80), pane(0.495, 1.735, -0.80)], GLASS);
    mesh.polygon(&[pane(-0.650, 1.22, 0.72), pane(-0.650, 1.22, -0.72), pane(-0.650, 1.60, -0.72), pane(-0.650, 1.60, 0.72)], GLASS);
    for side in [-1.0, 1.0] {
        mesh.chamfered(
            Vec3::new(side * 0.45 - 0.26, SHOULDER + 0.005, 1.10),
            Vec3::new(side * 0.45 + 0.26, SHOULDER + 0.03, 1.13),
            0.008,
            PLASTIC,
        );
    }
}

fn side_windows(mesh: &mut Mesh) {
    let panes: [&[Vec2]; 2] = [
        &[Vec2::new(0.06, 1.16), Vec2::new(0.92, 1.16), Vec2::new(0.42, 1.66), Vec2::new(0.30, 1.74), Vec2::new(0.06, 1.76)],
        &[Vec2::new(-0.54, 1.16), Vec2::new(-0.02, 1.16), Vec2::new(-0.02, 1.765), Vec2::new(-0.36, 1.745), Vec2::new(-0.54, 1.58)],
    ];
    for pane in panes {
        for side in [-1.0f32, 1.0] {
            let mut corners: Vec<Vec3> = pane.iter().map(|p| Vec3::new(side * 0.930 * narrow(p.y), p.y, p.x)).collect();
            if side > 0.0 {
                corners.reverse();
            }
            mesh.polygon(&corners, GLASS);
        }
    }
}

fn front(mesh: &mut Mesh) {
    mesh.chamfered(Vec3::new(-0.97, 0.42, 2.16), Vec3::new(0.97, 0.66, 2.42), 0.05, PLASTIC);
    mesh.chamfered(Vec3::new(-0.55, 0.46, 2.36), Vec3::new(0.55, 0.53, 2.435), 0.02, CHROME);
    mesh.chamfered(Vec3::new(-0.56, 0.70, 2.24), Vec3::new(0.56, 0.93, 2.325), 0.02, DARK);
    for bar in 0..3 {
        let y = 0.735 + 0.07 * bar as f32;
        mesh.chamfered(Vec3::new(-0.54, y, 2.30), Vec3::new(0.54, y + 0.025, 2.34), 0.008, CHROME);
    }
    for side in [-1.0, 1.0] {
        mesh.chamfered(Vec3::new(side * 0.75 - 0.17, 0.73, 2.20), Vec3::new(side * 0.75 + 0.17, 0.91, 2.325), 0.03, LAMP);
        mesh.chamfered(Vec3::new(side * 0.93 - 0.03, 0.76, 2.12), Vec3::new(side * 0.93 + 0.035, 0.88, 2.26), 0.02, AMBER);
        mesh.chamfered(Vec3::new(side * 0.72 - 0.09, 0.52, 2.36), Vec3::new(side * 0.72 + 0.09, 0.60, 2.43), 0.02, LAMP);
    }
}

fn rear(mesh: &mut Mesh) {
    mesh.chamfered(Vec3::new(-0.92, 0.44, -2.46), Vec3::new(0.92, 0.60, -2.26), 0.04, CHROME);
    for side in [-1.0, 1.0] {
        mesh.chamfered(Vec3::new(side * 0.90 - 0.065, 0.66, -2.355), Vec3::new(side * 0.90 + 0.065, 1.04, -2.24), 0.02, RED);
    }
    mesh.chamfered(Vec3::new(-0.13, 0.93, -2.36), Vec3::new(0.13, 0.99, -2.33), 0.01, PLASTIC);
    mesh.chamfered(Vec3::new(-0.26, 0.64, -2.356), Vec3::new(0.26, 0.75, -2.335), 0.005, LAMP);
}

/// Mirrors, door handles, door seams and arch trims.
fn sides(mesh: &mut Mesh) {
    for side in [-1.0f32, 1.0] {
        let span = |z: [f32; 2], y: [f32; 2], x: [f32; 2], chamfer: f32, material: Material, mesh: &mut Mesh| {
            let (a, b) = (side * x[0], side * x[1]);
            mesh.chamfered(Vec3::new(a.min(b), y[0], z[0]), Vec3::new(a.max(b), y[1], z[1]), chamfer, material);
        };
        span([0.84, 0.98], [1.16, 1.34], [0.97, 1.17], 0.035, PAINT, mesh);
        span([0.832, 0.845], [1.18, 1.32], [0.99, 1.15], 0.004, GLASS, mesh);
        span([0.88, 0.94], [1.14, 1.19], [0.86, 1.00], 0.02, PLASTIC, mesh);
        for z in [0.10, -0.50] {
            span([z, z + 0.17], [0.97, 1.00], [0.95, 0.985], 0.01, PLASTIC, mesh);
        }
        for z in [0.98, 0.02, -0.62] {
            span([z - 0.006, z + 0.006], [0.50, 1.06], [0.95, 0.9635], 0.001, DARK, mesh);
        }
        span([-0.90, 0.98], [0.60, 0.64], [0.95, 0.972], 0.01, PLASTIC, mesh);
    }
}
