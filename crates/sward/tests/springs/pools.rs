//! Sheets only where something is touched, and what happens when there are not enough of them.

use sward::math::{hash, unit};
use sward::response::springs::pool::{Billboard, SheetPool, bytes, load, sheets_within, store, words};
use sward::response::springs::{HeldSheet, pose};

use crate::Test;
use crate::field::{coefficients, root};

pub(crate) const TESTS: &[Test] = &[
    ("sixty_thousand_billboards_fit", sixty_thousand_billboards_fit),
    ("a_stored_sheet_is_the_same_sheet", a_stored_sheet_is_the_same_sheet),
    ("a_full_pool_keeps_its_rule", a_full_pool_keeps_its_rule),
    ("the_order_of_contacts_does_not_matter", the_order_of_contacts_does_not_matter),
];

/// The paper's: 60 000 billboards in 12 MB, 200 bytes each.
fn sixty_thousand_billboards_fit() {
    for side in [2, 3, 4, 5, 9] {
        let co = coefficients(side, side);
        let sheets = sheets_within(&co, 60_000, 12_000_000);
        let all = bytes(&co, 60_000, 60_000);
        println!(
            "{side} × {side}: {} bytes a sheet, {sheets} of 60000 at once in 12 MB; all of them {:.1} MB",
            4 * words(&co),
            all as f64 / 1e6
        );
        assert!(bytes(&co, 60_000, sheets) <= 12_000_000);
        assert!(sheets == 60_000 || bytes(&co, 60_000, sheets + 1) > 12_000_000, "one more must not fit");
        assert!(side > 3 || sheets == 60_000, "{side}");
    }
}

fn a_stored_sheet_is_the_same_sheet() {
    for side in [2, 3, 5, 9] {
        let (co, root) = (coefficients(side, side), root(3.0, 4.0, 0.3, 0.4));
        let mut held = HeldSheet::new(&pose(&co, &root, [[0.3, 0.1], [0.2, 0.4]]));
        held.steps = 77;
        let (columns, rows) = co.sides();
        for vertex in columns..columns * rows {
            held.faces[vertex] = (vertex % 8) as u8;
        }
        let mut stored = vec![0; words(&co)];
        store(&co, &held, &mut stored);
        assert!(load(&co, &root, &stored) == held, "{side}");
        stored[0] ^= 1;
        assert!(load(&co, &root, &stored) != held, "a bit must show");
    }
}

fn a_full_pool_keeps_its_rule() {
    let who = |k: u32| ([k as i32 / 10, 0], k);
    let mut pool = SheetPool::new(3);
    let contacts = |list: &[(u32, f32)]| list.iter().map(|(k, far)| (who(*k), *far)).collect::<Vec<_>>();
    let given = pool.request(&contacts(&[(5, 3.0), (2, 9.0), (7, 1.0)]), |_| 0);
    assert_eq!(given, [(who(7), 0), (who(5), 1), (who(2), 2)], "the nearest first, lowest places first");
    // All in contact: the farthest new ones are refused.
    assert!(pool.request(&contacts(&[(8, 0.1), (9, 0.2)]), |_| 0).is_empty());
    assert_eq!((pool.refused, pool.evicted), (2, 0));
    // One recovers, one nearly has: that one goes, for the nearer of two; the other one goes for the second.
    let steps = |place: u32| [40, 0, 100][place as usize];
    assert_eq!(pool.request(&contacts(&[(8, 0.2), (9, 0.1), (10, 5.0)]), steps), [(who(9), 2), (who(8), 0)]);
    assert_eq!((pool.refused, pool.evicted), (3, 2));
    // Who is touched again does not make room, however long ago that was.
    assert!(pool.request(&contacts(&[(5, 1.0), (8, 1.0), (9, 1.0), (11, 0.0)]), |_| 100).is_empty());
    pool.release(who(5));
    assert_eq!(pool.request(&contacts(&[(11, 0.0)]), |_| 0), [(who(11), 1)]);
    assert_eq!(pool.place(who(5)), None);
}

fn the_order_of_contacts_does_not_matter() {
    let run = |turn: usize| {
        let mut pool = SheetPool::new(50);
        let mut log = Vec::new();
        for round in 0..40u32 {
            let random = |k: u32, purpose| unit(hash(9, round as i32, 0, k, purpose));
            let mut contacts: Vec<(Billboard, f32)> =
                (0..30).map(|k| (([(random(k, 0) * 4.0) as i32, 0], (random(k, 1) * 40.0) as u32), (random(k, 2) * 5.0).floor())).collect();
            let count = contacts.len();
            contacts.rotate_left(turn % count);
            // The distance belongs to the billboard.
            contacts.iter_mut().for_each(|((patch, number), far)| *far = ((patch[0] * 7 + *number as i32) % 5) as f32);
            log.push(pool.request(&contacts, |place| (place * 7 + round) % 11 / 9));
            if round % 3 == 0 {
                let first = pool.taken().next();
                first.into_iter().for_each(|(who, _)| pool.release(who));
            }
        }
        assert!(pool.refused > 0 && pool.evicted > 0, "the pool must have been full");
        log
    };
    assert!(run(0) == run(13));
    let other = run(0).len();
    assert_eq!(other, 40);
}
