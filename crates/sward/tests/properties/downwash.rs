//! Footprint wind: what it does to plants, and where it must not reach (Chen & Johan 2010, §5.3; methods §1.7a).

use crate::common::world;
use sward::wind::{Flow, Footprint, Images, WindField, equilibrium};
use sward::world::World;

const K_W: f32 = 0.0356;

fn hover(flow: &str, more: &str) -> World {
    world(&format!(
        "field: (patch_side: 16.0), stands: [(species: Meadow, cells: 64, response: Continuum(wind: {K_W}))],
         wind: [Footprint(flow: {flow}, radius: 10.0, speed: 12.0, path: Still(at: (3.0, 5.0)){more})]"
    ))
}

fn bend_of(world: &World, at: [f64; 2]) -> [f32; 2] {
    world.bend_at(0, at).expect("the first stand")
}

fn apart(a: [f32; 2], b: [f32; 2]) -> f32 {
    ((a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2)).sqrt()
}

/// W = S max(0, 1 − r/R) e, written out once more.
fn formula(swirl: bool, at: [f64; 2]) -> [f32; 2] {
    let (x, z) = (at[0] - 3.0, at[1] - 5.0);
    let r = (x * x + z * z).sqrt();
    let speed = 12.0 * (1.0 - r / 10.0).max(0.0);
    let e = if swirl { [-z / r, x / r] } else { [x / r, z / r] };
    [(speed * e[0]) as f32, (speed * e[1]) as f32]
}

#[test]
fn plants_settle_where_the_footprint_blows_them() {
    for (flow, swirl) in [("Outward", false), ("Swirl", true)] {
        let mut world = hover(flow, "");
        (0..600).for_each(|_| world.step());
        assert_eq!(world.state.stands[0].awake.len(), 4, "the square round the circle touches 2 × 2 patches");
        let mut largest = 0.0_f32;
        // Cell centres, away from the kink in the middle and the one at the edge (a wave smooths those).
        for at in [[6.125, 5.125], [3.125, 9.125], [-0.875, 2.125], [7.125, 9.125], [-9.125, -9.125]] {
            let (found, wanted) = (bend_of(&world, at), equilibrium(formula(swirl, at), K_W));
            largest = largest.max(wanted[0].abs().max(wanted[1].abs()));
            assert!(apart(found, wanted) < 0.02, "{flow} at {at:?}: {found:?}, expected {wanted:?}");
            let other = equilibrium(formula(!swirl, at), K_W);
            assert!(wanted == [0.0; 2] || apart(found, other) > 0.1, "control: the other flow");
        }
        assert!(largest > 0.4);
    }
}

#[test]
fn it_fades_with_height_and_ends_at_the_ceiling() {
    let bend = |more: &str| {
        let mut world = hover("Outward", more);
        (0..300).for_each(|_| world.step());
        let bend = bend_of(&world, [6.125, 5.125]);
        (bend[0], world.state.stands[0].awake.len())
    };
    let (low, half, above) = (bend(""), bend(", height: 15.0"), bend(", height: 30.0"));
    let expected = equilibrium(formula(false, [6.125, 5.125]).map(|v| 0.5 * v), K_W)[0];
    assert!((half.0 - expected).abs() < 0.02 && low.0 > half.0 + 0.1, "{low:?} {half:?} {expected}");
    assert_eq!(above, (0.0, 0), "above its ceiling it wakes nothing");
}

/// It rises away on keys, follows a body where it is told to, and leaves everything asleep behind it.
#[test]
fn it_moves_and_what_it_leaves_comes_to_rest() {
    let mut world = world(
        "field: (patch_side: 16.0), stands: [(species: Meadow, cells: 64)],
         interactors: [(name: \"craft\", shape: Sphere(radius: 0.5), follow_ground: false, clearance: 6.0,
            path: Keyframes(keys: [(time: 0.0, at: (-4.0, 4.0)), (time: 2.0, at: (4.0, 4.0)), (time: 4.0, at: (12.0, 4.0), clearance: 60.0)]))],
         wind: [Footprint(radius: 8.0, speed: 20.0, ceiling: 40.0, follow: \"craft\")]",
    );
    (0..120).for_each(|_| world.step());
    let (under, ahead) = (bend_of(&world, [6.125, 4.125]), bend_of(&world, [1.125, 4.125]));
    assert!(under[0] > 0.3 && ahead[0] < -0.3, "it blows away from the body: {under:?} {ahead:?}");
    (0..720).for_each(|_| world.step());
    assert_eq!(world.state.stands[0].awake.len(), 0, "everything sleeps again");
    assert_eq!(bend_of(&world, [6.125, 4.125]), [0.0; 2]);
}

fn printed(images: &Images, flow: Flow, centre: [f64; 2], turn: [f32; 2]) -> WindField {
    let mut field = WindField::at(&[], 0, 1.0 / 60.0, 0.5);
    field.footprints.extend(Footprint::new(flow, images, centre, turn, 6.0, 10.0, 32, 0.5));
    field.images = std::sync::Arc::new(images.clone());
    field
}

/// Neighbours see the same bits on the nodes they share, and no ghost of it blows far away.
#[test]
fn patches_agree_on_shared_nodes() {
    let mut images = Images::default();
    let texels: Vec<[f32; 2]> = (0..49).map(|k| [0.02 * k as f32, 0.5 - 0.01 * k as f32]).collect();
    let painted = Flow::Image(images.add(7, &texels));
    for flow in [Flow::Outward, Flow::Swirl, painted] {
        for home in [0, 8000 * 16] {
            let centre = [f64::from(home) + 15.3, 0.7 - f64::from(home)];
            let field = printed(&images, flow, centre, [0.8, 0.6]);
            let patch = [home / 16, -home / 16];
            let (left, right) = (field.patch_phases(patch, 32), field.patch_phases([patch[0] + 1, patch[1]], 32));
            let mut moved = 0;
            for z in -1..=33 {
                let (a, b) = (field.velocity(&left, [32, z]), field.velocity(&right, [0, z]));
                assert_eq!(a.map(f32::to_bits), b.map(f32::to_bits));
                moved += u32::from(a != [0.0; 2]);
                assert_ne!(field.velocity(&left, [31, 3]), field.velocity(&right, [0, 3]), "control: another node");
            }
            assert!(moved > 10);
            for away in [5, 1023, 1 << 18, 1 << 26] {
                let far = field.patch_phases([patch[0].wrapping_add(away), patch[1]], 32);
                assert_eq!(field.velocity(&far, [16, 16]), [0.0; 2]);
            }
        }
    }
}

/// A picture of one direction blows that way wherever it lies, and turns with its path.
#[test]
fn images_blow_as_painted() {
    let mut picture = Vec::new();
    let pixels: Vec<u8> = (0..16 * 16).flat_map(|_| [255, 128, 128]).collect();
    let encoder = image::codecs::png::PngEncoder::new(&mut picture);
    image::ImageEncoder::write_image(encoder, &pixels, 16, 16, image::ExtendedColorType::Rgb8).unwrap();
    let mut images = Images::default();
    let painted = Flow::Image(images.add_png(&picture).unwrap());
    let near = |a: [f32; 2], b: [f32; 2]| apart(a, b) < 0.03;
    let at = |turn: [f32; 2], local: [f32; 2]| {
        let field = printed(&images, painted, [8.0, 8.0], turn);
        field.velocity_local(&field.patch_phases([0, 0], 32), local)
    };
    assert!(near(at([1.0, 0.0], [9.0, 6.0]), [5.02, 0.02]), "{:?}", at([1.0, 0.0], [9.0, 6.0]));
    // A quarter turn brings +z to +x, and +x to −z.
    assert!(near(at([0.0, 1.0], [9.0, 6.0]), [0.02, -5.02]), "{:?}", at([0.0, 1.0], [9.0, 6.0]));
    assert_eq!(at([1.0, 0.0], [15.0, 8.0]), [0.0; 2], "it ends at its edge");
    for bad in [&b"no picture"[..], &picture[..picture.len() / 2], &[]] {
        assert!(Images::default().add_png(bad).is_err());
    }
}
