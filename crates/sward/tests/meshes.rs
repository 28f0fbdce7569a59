//! Meshes are closed enough, face outwards, and have the promised size; clump pictures keep their coverage.

use glam::{Vec2, Vec3};
use sward::geometry::mesh::{Mesh, PAINT};
use sward::geometry::truck::truck;
use sward::shading::clump::{KINDS, LEVELS, SIDE, VARIANTS, paint};

fn position(mesh: &Mesh, index: u32) -> Vec3 {
    Vec3::from(mesh.vertices[index as usize].position)
}

/// Six times the enclosed volume; positive for a closed mesh that faces outwards.
fn volume(mesh: &Mesh) -> f32 {
    mesh.indices.chunks_exact(3).map(|t| position(mesh, t[0]).dot(position(mesh, t[1]).cross(position(mesh, t[2])))).sum::<f32>() / 6.0
}

/// Share of triangles whose corners turn the way their normals point.
fn agreeing(mesh: &Mesh) -> f32 {
    let mut good = 0;
    let mut all = 0;
    for t in mesh.indices.chunks_exact(3) {
        let [a, b, c] = [t[0], t[1], t[2]].map(|index| position(mesh, index));
        let face = (b - a).cross(c - a);
        if face.length() > 1e-9 {
            all += 1;
            let normal = Vec3::from(mesh.vertices[t[0] as usize].normal);
            good += usize::from(face.dot(normal) > 0.0);
        }
    }
    good as f32 / all as f32
}

#[test]
fn simple_bodies_enclose_their_volume() {
    let cube = Mesh::cuboid(Vec3::new(2.0, 1.0, 3.0), 0.0, PAINT);
    assert!((volume(&cube) - 6.0).abs() < 1e-4, "{}", volume(&cube));
    let rounded = Mesh::cuboid(Vec3::new(2.0, 1.0, 3.0), 0.05, PAINT);
    assert!(volume(&rounded) < 6.0 && volume(&rounded) > 5.8);
    let ball = Mesh::ellipsoid(Vec3::new(1.0, 2.0, 0.5), 32, PAINT);
    assert!((volume(&ball) - 4.19).abs() < 0.05, "{}", volume(&ball));
    for points in [[[0.0, 0.0], [2.0, 0.0], [0.0, 2.0]], [[0.0, 0.0], [0.0, 2.0], [2.0, 0.0]]] {
        let prism = Mesh::prism(&points.map(Vec2::from), 1.5, PAINT);
        assert!((volume(&prism) - 3.0).abs() < 1e-4, "{}", volume(&prism));
    }
    for mesh in [cube, rounded, ball] {
        assert!(agreeing(&mesh) == 1.0);
    }
}

#[test]
fn the_truck_has_the_promised_size() {
    let truck = truck();
    let triangles = truck.indices.len() / 3;
    assert!((1000..5000).contains(&triangles), "{triangles}");
    let (mut low, mut high) = (Vec3::MAX, Vec3::MIN);
    for vertex in &truck.vertices {
        low = low.min(vertex.position.into());
        high = high.max(vertex.position.into());
        assert!((Vec3::from(vertex.normal).length() - 1.0).abs() < 1e-3);
    }
    let size = high - low;
    assert!(low.y.abs() < 0.01 && (size.y - 1.9).abs() < 0.05, "{low} {size}");
    assert!((1.9..2.4).contains(&size.x) && (4.7..5.0).contains(&size.z), "{size}");
    assert!(agreeing(&truck) > 0.995, "{}", agreeing(&truck));
}

#[test]
fn degenerate_meshes_do_not_panic() {
    Mesh::prism(&[], 1.0, PAINT);
    Mesh::prism(&[Vec2::ZERO], 1.0, PAINT);
    Mesh::ellipsoid(Vec3::ZERO, 0, PAINT);
    Mesh::cuboid(Vec3::ZERO, 1.0, PAINT);
}

#[test]
fn clumps_are_deterministic_distinct_and_keep_their_coverage() {
    for kind in KINDS {
        let first = paint(kind, 0);
        assert_eq!(first, paint(kind, 0));
        assert_ne!(first, paint(kind, 1));
        assert_eq!(first.rgba.len(), SIDE * SIDE);
        for variant in 0..VARIANTS {
            let clump = paint(kind, variant);
            let cover = clump.mean()[3];
            assert!((0.1..0.9).contains(&cover), "{kind:?} {variant}: {cover}");
            let levels = clump.levels();
            assert_eq!(levels.len(), LEVELS);
            let share = |bytes: &[u8]| bytes.chunks_exact(4).filter(|t| t[3] >= 128).count() as f32 / (bytes.len() / 4) as f32;
            let own = share(&levels[0]);
            for level in &levels[1..5] {
                assert!((share(level) - own).abs() < 0.06, "{kind:?}: {} instead of {own}", share(level));
            }
        }
    }
}
