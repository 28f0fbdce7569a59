//! Which way a place of such a stand bends, for anyone who asks.

use super::meadow;

/// Far from a body all answers are the wind's; where it lies, they are not.
#[test]
fn bend_at_answers_for_billboards() {
    let length = |[x, z]: [f32; 2]| (x * x + z * z).sqrt();
    let body = "interactors: [(shape: Sphere(radius: 0.5), path: Still(at: (4, 4)))]";
    let breeze = "wind: [Natural(velocity: (3, 1))]";
    let mut worlds = [format!("{breeze}, {body}"), breeze.to_owned(), body.to_owned()].map(|rest| meadow("", &rest));
    let (mut bent, mut alike) = (0.0f32, 0);
    for world in &mut worlds {
        (0..60).for_each(|_| world.step());
    }
    for cell in 0..1024 {
        let ground = [cell % 32, cell / 32].map(|along| 0.25 + 0.5 * f64::from(along));
        let [both, wind, still] = worlds.each_ref().map(|world| world.bend_at(0, ground).expect("there is such a stand"));
        assert!(both.iter().chain(&wind).chain(&still).all(|tilt| tilt.is_finite()), "{ground:?}");
        assert!(length(wind) > 0.01 && wind[0] > 0.0, "{ground:?}: {wind:?}");
        if (ground[0] - 4.0).hypot(ground[1] - 4.0) > 1.5 {
            assert!(both == wind && still == [0.0; 2], "{ground:?}: {both:?} {wind:?} {still:?}");
            alike += 1;
        } else {
            bent = bent.max(length(still)).max(length([both[0] - wind[0], both[1] - wind[1]]));
        }
    }
    println!("{alike} answers of the wind; {bent:.2} rad under the body");
    assert!(alike > 900 && bent > 0.3, "{alike} {bent}");
    assert_eq!(worlds[0].bend_at(1, [0.0; 2]), None);
}
