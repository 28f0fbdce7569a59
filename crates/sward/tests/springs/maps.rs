//! Depth cube maps against bodies whose distance is known.

use glam::Vec3;
use sward::interaction::distance_map::{Cube, DistanceMap, DistanceMapHead, contact_at};
use sward::math::{hash, unit};

use crate::Test;
use crate::bodies::{Body, block, egg, prism};
use crate::field::head;

pub(crate) const TESTS: &[Test] = &[
    ("a_ball_is_known_to_a_share_of_a_texel", a_ball_is_known_to_a_share_of_a_texel),
    ("a_box_is_known_exactly", a_box_is_known_exactly),
    ("a_turned_prism_is_known_to_a_texel", a_turned_prism_is_known_to_a_texel),
    ("outside_no_more_than_the_true_distance", outside_no_more_than_the_true_distance),
    ("the_way_out_leads_out", the_way_out_leads_out),
    ("damaged_bodies_stop_nothing", damaged_bodies_stop_nothing),
];

pub(crate) fn random(count: u32, half: f32, centre: Vec3) -> impl Iterator<Item = Vec3> {
    let part = |k, purpose| 2.0 * unit(hash(11, 0, 0, k, purpose)) - 1.0;
    (0..count).map(move |k| centre + half * Vec3::new(part(k, 0), part(k, 1), part(k, 2)))
}

/// Edge of a texel, m.
fn texel(map: &DistanceMap) -> f32 {
    2.0 * map.cube.half / map.size as f32
}

/// How far from the surface a point lies at most that the map takes for inside though it is not, and the other way, m; and the largest error
/// of the depth of points less than `shallow` m inside.
fn errors(body: &Body, shift: Vec3, shallow: f32) -> [f32; 3] {
    let head = head(&body.map, 0, shift, 0.3);
    let turn = glam::Quat::from_rotation_y(0.3);
    let mut errors = [0.0f32; 3];
    for own in random(200_000, body.map.cube.half, Vec3::from(body.map.cube.centre)) {
        let truth = (body.distance)(own);
        let seen = contact_at(&head, &body.map.texels, (turn * own).to_array()).distance;
        if seen < 0.0 && truth > 0.0 {
            errors[0] = errors[0].max(truth);
        }
        if seen >= 0.0 && truth < 0.0 {
            errors[1] = errors[1].max(-truth);
        }
        if seen < 0.0 && truth < 0.0 && truth > -shallow {
            errors[2] = errors[2].max((seen - truth).abs());
        }
    }
    errors
}

fn a_ball_is_known_to_a_share_of_a_texel() {
    for texels in [16, 32, 64, 128] {
        let ball = egg("ball", Vec3::splat(0.5), 0.0, texels, 192);
        let edge = texel(&ball.map);
        let [outside, inside, depth] = errors(&ball, Vec3::ZERO, 0.05).map(|error| error / edge);
        println!(
            "ball of 1 m, {texels} texels of {:.1} mm: taken for inside {outside:.2}, for outside {inside:.2} texels off; depths to 5 cm {depth:.2}",
            edge * 1e3
        );
        assert!(outside < 0.5 && inside < 0.5, "{texels}: {outside} {inside}");
        let shifted = errors(&ball, Vec3::X * edge, 0.05).map(|error| error / edge);
        assert!(shifted[0] > 0.5 && shifted[1] > 0.5, "a map a texel beside must fail: {shifted:?}");
    }
}

fn a_box_is_known_exactly() {
    let body = block("box", Vec3::new(0.5, 1.8, 0.3), 0.1, 64);
    let [outside, inside, depth] = errors(&body, Vec3::ZERO, 0.1);
    println!("box: {:.4} and {:.4} mm, depth {:.4} mm", outside * 1e3, inside * 1e3, depth * 1e3);
    assert!(outside < 1e-5 && inside < 1e-5 && depth < 1e-5);
    let shifted = errors(&body, Vec3::Z * 1e-4, 0.1);
    assert!(shifted[0] > 5e-5, "a tenth of a millimetre must show: {shifted:?}");
    // The box's own pieces and its mesh are one body.
    let mesh = prism(&[[-0.25, -0.15], [0.25, -0.15], [0.25, 0.15], [-0.25, 0.15]], 1.8).distance_map(64);
    assert_eq!(mesh.texels.len(), body.map.texels.len());
    let off = mesh.texels.iter().zip(&body.map.texels).map(|(a, b)| (a[0] - b[0]).abs()).fold(0.0, f32::max);
    assert!(off < 1e-5, "{off}");
}

fn a_turned_prism_is_known_to_a_texel() {
    let corners = [[0.3, 0.1], [-0.1, 0.35], [-0.32, -0.2], [0.12, -0.3]];
    let map = prism(&corners, 0.6).distance_map(64);
    let sides: Vec<(f32, f32, f32)> = (0..4)
        .map(|k| {
            let ([ax, az], [bx, bz]) = (corners[k], corners[(k + 1) % 4]);
            let (nx, nz) = (bz - az, ax - bx);
            let long = (nx * nx + nz * nz).sqrt();
            (nx / long, nz / long, (nx * ax + nz * az) / long)
        })
        .collect();
    let distance = move |p: Vec3| sides.iter().map(|(x, z, d)| x * p.x + z * p.z - d).fold((-p.y).max(p.y - 0.6), f32::max);
    let body = Body { name: "prism", map, distance: Box::new(distance), half_length: 0.3 };
    let edge = texel(&body.map);
    let [outside, inside, _] = errors(&body, Vec3::ZERO, 0.05).map(|error| error / edge);
    println!("turned prism, texels of {:.1} mm: {outside:.2} and {inside:.2} texels off", edge * 1e3);
    assert!(outside < 1.0 && inside < 1.0, "{outside} {inside}");
    let shifted = errors(&body, Vec3::Z * 2.0 * edge, 0.05).map(|error| error / edge);
    assert!(shifted[0] > 1.0, "a map two texels beside must fail: {shifted:?}");
}

fn outside_no_more_than_the_true_distance() {
    let ball = egg("ball", Vec3::splat(0.5), 0.0, 64, 96);
    let head = head(&ball.map, 0, Vec3::ZERO, 0.0);
    let (mut over, mut far) = (0.0f32, 0.0f32);
    for p in random(100_000, 2.0, Vec3::Y * 0.5) {
        let (truth, seen) = ((p - Vec3::Y * 0.5).length() - 0.5, contact_at(&head, &ball.map.texels, p.to_array()));
        if truth > 0.0 {
            over = over.max(seen.distance - truth);
            far = far.max(seen.distance);
        }
        assert!((Vec3::from(seen.normal).length() - 1.0).abs() < 1e-3, "{seen:?}");
    }
    println!("outside: {over:.1e} m more than the true distance at most; up to {far:.2} m");
    assert!(over < 1e-4 && far > 1.0);
}

fn the_way_out_leads_out() {
    for body in [egg("ball", Vec3::new(0.25, 0.9, 0.25), 0.0, 64, 48), block("box", Vec3::new(0.5, 1.8, 0.3), 0.0, 64)] {
        let head = head(&body.map, 0, Vec3::new(0.1, 0.0, -0.2), 0.7);
        let (mut left, mut half, mut count) = (0.0f32, 0.0f32, 0);
        for p in random(50_000, body.map.cube.half, Vec3::from(body.map.cube.centre)) {
            let seen = contact_at(&head, &body.map.texels, p.to_array());
            if seen.distance < 0.0 {
                let out =
                    |share: f32| contact_at(&head, &body.map.texels, (p - share * seen.distance * Vec3::from(seen.normal)).to_array());
                left = left.max(-out(1.0).distance);
                half = half.max(-out(0.5).distance);
                count += 1;
            }
        }
        println!("{}: {count} points pushed out, {:.2} mm left at most", body.name, left * 1e3);
        assert!(count > 1000 && left < 0.005, "{}: {left}", body.name);
        assert!(half > 0.05, "half the way must not do: {half}");
    }
}

fn damaged_bodies_stop_nothing() {
    let bad = [[f32::NAN, 0.0, 0.0], [f32::INFINITY, 1.0, 0.0], [1e30, -1e30, 1e30], [0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let triangles = [[0, 1, 2], [3, 4, 5], [3, 3, 3], [7, 8, 9], [u32::MAX, 0, 1], [2, 3, 4]];
    for size in [0, 1, 64, u32::MAX] {
        let small = if size > 64 { 9 } else { size };
        for cube in [Cube::around(&bad, size), Cube::around(&[], size), Cube { centre: [f32::NAN; 3], half: 0.0 }] {
            let map = DistanceMap::new(cube, small, &bad, triangles);
            let head = DistanceMapHead::new(&map, 0, (0, 0), [0.0; 3], [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
            for p in [[0.0; 3], [f32::NAN; 3], [1e30; 3], [0.2, 0.2, 0.0]] {
                contact_at(&head, &map.texels, p);
                contact_at(&head, &[], p);
                contact_at(&DistanceMapHead::default(), &map.texels, p);
            }
        }
    }
    let map = DistanceMap::new(Cube::around(&bad[3..], 64), 64, &bad[3..], [[0, 1, 2]]);
    assert!(map.texels.iter().any(|texel| texel[0] < 10.0), "a sound triangle is seen");
}
