//! Strips: their length, their width, how they lie.

use crate::common::Dice;
use glam::Vec3;
use sward::geometry::blade::{Stance, across, density, piece, piece_bend, profile, raised};

fn chance(dice: &mut Dice) -> (Vec<[f32; 2]>, Stance) {
    let mut number = |low: f64, high: f64| dice.between(low, high) as f32;
    let bends = (0..1 + (number(0.0, 7.99) as usize)).map(|_| [number(-1.5, 1.5), number(-1.5, 1.5)]).collect();
    let turn = number(0.0, std::f64::consts::TAU);
    (bends, Stance { heading: [turn.cos(), turn.sin()], lean: number(0.0, 1.2), curl: number(0.0, 2.0) })
}

/// Whatever bends it, however many pieces it has and wherever it is between two numbers of them. Control: a strip through the joints of the
/// finer one, moved towards those of the coarser one.
#[test]
fn length_is_kept() {
    let (mut dice, mut worst_control) = (Dice(3), 0.0_f32);
    for _ in 0..4000 {
        let (bends, stance) = chance(&mut dice);
        let pieces = 1 + dice.between(0.0, 11.99) as u32;
        let coarse = 1 + dice.between(0.0, f64::from(pieces) - 0.01) as u32;
        let morph = dice.between(-0.2, 1.0) as f32;
        let end = |pieces: u32, coarse: u32, morph: f32, upto: u32| -> Vec3 {
            (0..upto).map(|k| piece(piece_bend(&bends, &stance, k, [pieces, coarse], morph), 1.0 / pieces as f32)).sum()
        };
        let joints: Vec<Vec3> = (0..=pieces).map(|k| end(pieces, coarse, morph, k)).collect();
        let length = |joints: &[Vec3]| joints.windows(2).map(|two| two[0].distance(two[1])).sum::<f32>();
        assert!((length(&joints) - 1.0).abs() < 1e-4, "{} of {pieces} pieces", length(&joints));
        let moved: Vec<Vec3> = (0..=pieces)
            .map(|k| end(pieces, coarse, 0.0, k).lerp(end(coarse, coarse, 0.0, coarse) * (k as f32 / pieces as f32), 0.5))
            .collect();
        worst_control = worst_control.max((length(&moved) - 1.0).abs());
    }
    assert!(worst_control > 0.1, "control: {worst_control}");
}

/// With `morph` 1 the joints that both have lie where those of the coarser strip lie, to a part of the pieces that span its corners.
#[test]
fn finer_strips_end_as_coarser_ones() {
    let mut dice = Dice(5);
    let (mut morphed, mut control) = (0.0_f32, 0.0_f32);
    for _ in 0..2000 {
        // Wind and contact bend neighbouring segments alike.
        let (bends, stance) = chance(&mut dice);
        let bends: Vec<[f32; 2]> =
            bends.iter().enumerate().map(|(k, _)| [0, 1].map(|axis| bends[0][axis] * (0.6 + 0.05 * k as f32))).collect();
        let tip = |pieces: u32, morph: f32| -> Vec3 {
            (0..pieces).map(|k| piece(piece_bend(&bends, &stance, k, [pieces, 4], morph), 1.0 / pieces as f32)).sum()
        };
        morphed = morphed.max(tip(7, 1.0).distance(tip(4, 0.0)));
        control = control.max(tip(7, 0.0).distance(tip(4, 0.0)));
    }
    assert!(morphed < 0.012 && control > 1.5 * morphed, "{morphed} of a length, without morph {control}");
}

#[test]
fn pieces_are_raised_and_keep_their_length() {
    let (mut dice, mut kept) = (Dice(9), 0);
    for _ in 0..4000 {
        let way = Vec3::new(dice.between(-1.0, 1.0) as f32, dice.between(-1.0, 1.0) as f32, dice.between(-1.0, 1.0) as f32);
        let least = dice.between(-1.5, 1.5) as f32;
        let up = raised(way, least);
        assert!(up.y >= least - 1e-6, "{up} is below {least}");
        if least.abs() < way.length() * 0.999 {
            kept += 1;
            assert!((up.length() - way.length()).abs() < 1e-5 && up.x * way.x >= 0.0 && up.z * way.z >= 0.0, "{way} became {up}");
        }
    }
    assert!(kept > 1000);
}

#[test]
fn blades_lie_across_their_stems() {
    let mut dice = Dice(11);
    for _ in 0..4000 {
        let turn = dice.between(0.0, std::f64::consts::TAU) as f32;
        let tangent = Vec3::new(dice.between(-1.0, 1.0) as f32, dice.between(-0.6, 1.0) as f32, dice.between(-1.0, 1.0) as f32).normalize();
        // Beyond a tilt of 155 degrees, which no blade reaches, the way it is carried has no answer.
        if tangent.y < -0.9 {
            continue;
        }
        let across = across([turn.cos(), turn.sin()], tangent, dice.between(-6.0, 6.0) as f32);
        assert!((across.length() - 1.0).abs() < 1e-4 && across.dot(tangent).abs() < 2e-3, "{across} along {tangent}");
    }
    assert!(profile(1.0).abs() < 1e-6 && profile(0.0) > 0.7 && (0..100).all(|k| profile(0.01 * k as f32) <= 1.0));
}

/// 1 − F of the paper in f64, with powers as printed.
#[test]
fn density_is_the_papers() {
    let mut dice = Dice(13);
    for _ in 0..4000 {
        let [facing, distance] = [dice.between(-1.0, 1.0), dice.between(0.0, 300.0)];
        let terms = [dice.between(0.0, 1.0), dice.between(0.0, 0.1), dice.between(0.0, 0.01)];
        let t = (1.0 - facing.abs()).powi(8);
        let paper = (((1.0 - t) * facing.abs() + t) / (terms[0] + terms[1] * distance + terms[2] * distance * distance)).clamp(0.0, 1.0);
        let ours = f64::from(density(terms.map(|term| term as f32), facing as f32, distance as f32));
        assert!((ours - paper).abs() < 1e-5, "{ours} instead of {paper}");
    }
    // Control: without the rim term hills seen edge-on are bald.
    assert!(density([1.0, 0.0, 0.0], 0.0, 1.0) > 0.99 && density([1.0, 0.0, 0.0], 0.35, 1.0) < 0.5);
}
