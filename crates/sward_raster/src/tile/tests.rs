//! Coverage, weights, depth.

use super::*;
use crate::sight::mix;
use crate::triangle::{clipped, to_pixels};
use glam::Vec4;

/// How many of some triangles cover each sample of a tile. `spoil` changes each before it is drawn.
fn counts(triangles: &[[Vec2; 3]], spoil: fn(&mut Triangle)) -> Vec<u32> {
    let mut counts = vec![0; QUADS * QUADS * 16];
    for corners in triangles {
        let mut triangle = Triangle::new(corners.map(|corner| corner.extend(0.5)), [1.0; 3]).expect("it has an area");
        spoil(&mut triangle);
        let mut tile: Tile = Tile::new([0, 0]);
        tile.draw(&triangle, |quad| Shaded { samples: quad.visible, ..Shaded::default() });
        let covered = tile.depths.iter().flatten().map(|depth| u32::from(*depth > 0.0));
        counts.iter_mut().zip(covered).for_each(|(count, covered)| *count += covered);
    }
    counts
}

/// Eight triangles around a sample, with edges along rows and columns of samples, turning either way.
fn fan() -> Vec<[Vec2; 3]> {
    let middle = Vec2::new(20.375, 30.125);
    let rim = [[-9.0, -9.0], [20.375, -9.0], [80.0, -9.0], [80.0, 30.125], [80.0, 90.0], [20.375, 90.0], [-9.0, 90.0], [-9.0, 30.125]];
    let corner = |k: usize| Vec2::from(rim[k % 8]);
    (0..8).map(|k| if k % 2 == 0 { [middle, corner(k), corner(k + 1)] } else { [middle, corner(k + 1), corner(k)] }).collect()
}

#[test]
fn every_sample_belongs_to_one_triangle() {
    assert!(counts(&fan(), |_| ()).iter().all(|count| *count == 1));
    // Without the top-left rule, samples on shared edges are drawn twice.
    let twice = counts(&fan(), |triangle| triangle.rule = [0; 3]).iter().filter(|count| **count > 1).count();
    assert!(twice > 100, "{twice}");
}

/// Corners weighted as a quad says, projected: the pixel's own centre. Also for triangles that pass the near plane,
/// or reach very far aside.
#[test]
fn weights_are_in_perspective() {
    let size = Vec2::splat(64.0);
    let corner = |x: f32, y: f32, w: f32| Vec4::new(x * w, y * w, sward::picture::frame::NEAR, w);
    for last in [corner(0.2, 0.9, 9.0), Vec4::new(3.0, 2.0, 0.05, -2.0), corner(1e5, 3e5, 0.05)] {
        let clip = [corner(-0.9, -0.8, 1.0), corner(0.8, -0.7, 4.0), last];
        let place = |weights: Vec3| clip[0] * weights.x + clip[1] * weights.y + clip[2] * weights.z;
        let off = |weights: Vec3| (to_pixels(place(weights), size).truncate().fract() - 0.5).abs().max_element();
        let mut tile: Tile = Tile::new([0, 0]);
        let (mut lanes, mut worst, mut straight) = (0, 0.0_f32, 0.0_f32);
        clipped(clip, size, |triangle| {
            let mut flat = triangle.clone();
            flat.inverse_w = [1.0; 3];
            tile.draw(triangle, |quad| {
                for lane in (0..4).filter(|lane| quad.visible >> (4 * lane) & 15 == 15) {
                    lanes += 1;
                    worst = worst.max(off(quad.weights[lane]));
                }
                Shaded { samples: quad.visible, ..Shaded::default() }
            });
            Tile::<Vec3>::new([0, 0]).draw(&flat, |quad| {
                straight = straight.max(off(quad.weights[0]));
                Shaded::default()
            });
        });
        assert!(lanes > 200 && worst < 0.03, "{lanes} lanes, {worst} pixels off");
        assert!(straight > 0.2, "weights that are straight on the picture pass too: {straight}");
    }
}

#[test]
fn what_is_in_front_stays() {
    let all = |depth: f32| [Vec2::new(-99.0, -99.0), Vec2::new(300.0, -99.0), Vec2::new(-99.0, 300.0)].map(|at| at.extend(depth));
    let mut tile: Tile = Tile::new([0, 0]);
    for (depth, colour) in [(0.5, Vec3::X), (0.2, Vec3::Y), (0.7, Vec3::Z)] {
        let triangle = Triangle::new(all(depth), [1.0; 3]).expect("it has an area");
        // The last one leaves out every other sample.
        let samples = if depth > 0.6 { 0x5555 } else { 0xffff };
        tile.draw(&triangle, |_| Shaded { colours: [colour; 4], samples });
    }
    assert_eq!(tile.colours[7][0], mix(Vec3::Z, &Vec3::AXES));
    assert_eq!(tile.colours[7][1], Vec3::X);
}

#[test]
fn nothing_strange_is_drawn() {
    let draw = |corners: [Vec4; 3]| {
        let mut drawn = 0;
        clipped(corners, Vec2::splat(64.0), |_| drawn += 1);
        drawn
    };
    let fine = [Vec4::new(0.0, 0.0, 0.05, 1.0), Vec4::new(1.0, 0.0, 0.05, 1.0), Vec4::new(0.0, 1.0, 0.05, 1.0)];
    assert_eq!(draw(fine), 1);
    assert_eq!(draw([fine[0]; 3]), 0, "no area");
    assert_eq!(draw(fine.map(|corner| -corner)), 0, "behind the eye");
    assert_eq!(draw([fine[0], fine[1], Vec4::NAN]), 0);
    assert_eq!(draw([fine[0], fine[1], Vec4::new(0.0, 1.0, 0.05, -1.0)]), 2, "cut at the near plane");
    assert_eq!(draw([fine[0] * 1e30, fine[1], fine[2] * 1e30]), 1, "far away");
    let aside = Vec4::new(1e6, 3e6, 0.05, 0.05);
    assert!(draw([fine[0], fine[1], aside]) > 0, "far aside");
}
