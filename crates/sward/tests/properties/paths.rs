//! Where bodies head on their paths.

use sward::interaction::station;
use sward::scene::{Key, Keyframes, Path};

/// A way along +x, then along +z, that looks along −z from the third key to the fourth.
fn path(looks: bool) -> Path {
    let yaw = looks.then_some(3.0);
    let key = |time: f64, at: [f64; 2], yaw: Option<f64>| Key { time, at, yaw, clearance: None };
    let keys = vec![
        key(0.0, [0.0, 0.0], None),
        key(2.0, [6.0, 0.0], None),
        key(4.0, [12.0, 1.0], yaw),
        key(6.0, [14.0, 6.0], yaw),
        key(8.0, [14.0, 14.0], None),
        key(9.0, [14.0, 18.0], None),
    ];
    Path::Keyframes(Keyframes { keys, repeat: false })
}

/// The most that a heading changes within a millisecond, rad.
fn jump(heading: impl Fn(f64) -> f64) -> f64 {
    let change = |k: u32| {
        let [before, after] = [k, k + 1].map(|k| heading(0.001 * f64::from(k)));
        sward::math::wrapped_angle(after - before).abs()
    };
    (0..9000).map(change).fold(0.0, f64::max)
}

#[test]
fn a_heading_never_jumps_where_some_keys_say_one() {
    let heading = |looks: bool, time: f64| station(&path(looks), 0.0, time).yaw;
    let most = jump(|time| heading(true, time));
    assert!(most < 0.01, "{most} rad");
    // Where keys say one it holds, between two of them too; where none do it is the motion's.
    for time in [4.0, 5.0, 6.0] {
        assert!((heading(true, time) - 3.0).abs() < 1e-9, "{time}");
    }
    for time in [0.5, 1.9, 8.5] {
        assert_eq!(heading(true, time), heading(false, time), "{time}");
    }
    // Control: along the motion up to the very key jumps.
    let until = |time: f64| heading((4.0..=6.0).contains(&time), time);
    assert!(jump(until) > 1.0);
}
