//! All plants of a patch at once are each of them by itself, to the bit, on every set of instructions.

use sward::lanes::Lanes;
use sward::placement;
use sward::response::oscillator::{Own, Poses, Record};

use super::field::{coefficients, field};
use crate::common::Dice;

#[test]
fn all_at_once_is_each_by_itself() {
    for stand in ["response: Oscillator()", "response: Oscillator(damping: 1)", "response: Oscillator(damping: 6)"] {
        let world = field(stand, "");
        let (co, placement, area, now) = (coefficients(&world), &world.model.stands[0].placement, 64 * 64, 9000_u32);
        let mut dice = Dice(5);
        let mut records = vec![0.0; 4 * area];
        let mut heights = vec![0.0; area];
        for cell in 0..area {
            let mut number = |low: f64, high: f64| dice.between(low, high) as f32;
            heights[cell] = number(-0.1, 0.6).max(0.0);
            let deviation = [number(-1.0, 1.0), number(-1.0, 1.0)];
            let (rate, ago, byte) = (number(-9.0, 9.0), number(-1.0, 200.0), number(0.0, 256.0));
            let byte = if cell % 3 == 0 { 128 } else { byte as u32 };
            let record = Record { deviation, rate, stamp: ((now.wrapping_add_signed(-(ago.round() as i32))) << 8) | byte };
            record.store(&mut records, area, cell);
        }
        let mut seen = 0;
        for behind in [0.0, 0.37] {
            for lanes in Lanes::available() {
                let (mut x, mut z) = (vec![0.0; area], vec![0.0; area]);
                let poses = Poses { co: &co, placement, patch: [3, -4], records: &records, heights: &heights, now, behind };
                poses.write(lanes, [&mut x, &mut z]);
                for cell in 0..area {
                    let own = Own::of(&co, placement::variety(placement, [3, -4], cell as u32), heights[cell]);
                    let alone = Record::load(&records, area, cell).at(&co, &own, now, behind);
                    assert_eq!([x[cell], z[cell]].map(f32::to_bits), alone.map(f32::to_bits), "{lanes:?} {cell} {alone:?}");
                    seen += u32::from(alone[0].abs() > 0.01);
                }
            }
        }
        assert!(seen > 4_000, "{seen}");
    }
}
