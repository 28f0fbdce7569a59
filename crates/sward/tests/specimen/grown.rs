//! Plants grown by code.

use sward::specimen::grow::{Form, Grow};
use sward::specimen::{Kind, Order, Size, Specimen};

use crate::soups::whole;
use crate::{Test, bits, ready};

pub(crate) const TESTS: &[Test] = &[
    ("grown_plants_have_as_many_triangles_as_asked", grown_plants_have_as_many_triangles_as_asked),
    ("every_leaf_that_grew_is_found_with_its_root_at_its_foot", every_leaf_that_grew_is_found_with_its_root_at_its_foot),
    ("written_and_read_it_is_the_same_specimen", written_and_read_it_is_the_same_specimen),
    ("the_same_bits_on_one_thread_and_on_many", the_same_bits_on_one_thread_and_on_many),
    ("grown_plants_have_the_shape_of_their_kind", grown_plants_have_the_shape_of_their_kind),
    ("what_cannot_grow_is_refused", what_cannot_grow_is_refused),
];

const FORMS: [Form; 3] = [Form::Bush, Form::Tree, Form::WaterPlant];

fn grow(form: Form, triangles: u32, seed: u32) -> Grow {
    Grow { triangles, seed, ..Grow::new(form) }
}

fn plant(form: Form, triangles: u32, seed: u32) -> Specimen {
    grow(form, triangles, seed).specimen(&mut |_| ()).expect("in range")
}

fn grown_plants_have_as_many_triangles_as_asked() {
    for form in FORMS {
        for (triangles, seed) in [(2000, 0), (2500, 3), (6000, 5), (20_000, 0), (20_000, 1), (80_000, 2), (300_000, 0), (2_500_000, 1)] {
            let grown = grow(form, triangles, seed).mesh().expect("in range");
            let share = grown.triangles() as f64 / f64::from(triangles);
            assert!((0.9..=1.1).contains(&share), "{form:?} of {triangles}, seed {seed}: {}", grown.triangles());
            let leaf: usize = grown.pieces.iter().filter(|piece| piece.finish.kind == Kind::Leaf).map(|piece| piece.triangles.len()).sum();
            assert!(2 * leaf as u64 >= grown.triangles(), "{form:?} of {triangles}: {leaf} of leaves");
        }
    }
}

fn every_leaf_that_grew_is_found_with_its_root_at_its_foot() {
    for form in FORMS {
        for triangles in [20_000, 300_000] {
            let grown = grow(form, triangles, 7).mesh().expect("in range");
            let leaves = grown.leaves;
            let plant = grown.specimen(Size::Scale(1.0), &mut |_| ()).expect("a plant");
            assert_eq!(u64::from(plant.leaves), leaves, "{form:?}");
            assert!(whole(&plant));
            // A root is the vertex of its leaf at which texture coordinates begin.
            let feet = plant.vertices.iter().filter(|vertex| vertex.uv()[0] + vertex.uv()[1] == 0.0 && vertex.root != [0.0; 3]);
            if form != Form::WaterPlant {
                assert!(feet.clone().count() as u64 >= leaves && feet.clone().all(|vertex| vertex.root == vertex.position));
            }
        }
    }
}

fn written_and_read_it_is_the_same_specimen() {
    for form in FORMS {
        let mut bytes = Vec::new();
        let grown = grow(form, 30_000, 4).mesh().expect("in range");
        grown.write(&mut bytes).expect("in memory");
        let read = ready(&bytes, &Order::default()).unwrap_or_else(|error| panic!("{form:?}: {error}"));
        let own = grown.specimen(Size::Scale(1.0), &mut |_| ()).expect("a plant");
        assert_eq!(bits(&read), bits(&own), "{form:?}");
        assert_eq!(read, own);
        assert_ne!(bits(&read), bits(&plant(form, 30_000, 5)), "control");
    }
}

fn the_same_bits_on_one_thread_and_on_many() {
    for form in FORMS {
        let on = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            pool.install(|| bits(&plant(form, 20_000, 9)))
        };
        assert_eq!(on(1), on(4), "{form:?}");
    }
}

fn grown_plants_have_the_shape_of_their_kind() {
    for seed in 0..4 {
        for (form, height, wide) in [(Form::Bush, 1.5, 0.8..2.0), (Form::Tree, 7.5, 0.4..1.0), (Form::WaterPlant, 0.5, 0.5..2.6)] {
            let plant = plant(form, 20_000, seed);
            assert!((plant.high[1] - height).abs() < 1e-4, "{form:?}: {}", plant.high[1]);
            assert!(plant.low[1] > -0.03 * height, "{form:?} reaches {} m below the ground", plant.low[1]);
            for axis in [0, 2] {
                let share = (plant.high[axis] - plant.low[axis]) / height;
                assert!(wide.contains(&share), "{form:?}, seed {seed}: {share} times as wide as high");
            }
        }
        // Leaves of a bush begin at the ground, those of a tree on its branches.
        let lowest = |plant: &Specimen| {
            let leaf = plant.vertices.iter().zip(0..).filter(|(_, index)| *index < plant.triangles[plant.count(Kind::Leaf) as usize][0]);
            let mut heights: Vec<f32> = leaf.map(|(vertex, _)| vertex.root[1] / plant.high[1]).collect();
            heights.sort_by(f32::total_cmp);
            heights[heights.len() / 50]
        };
        let [bush, tree] = [Form::Bush, Form::Tree].map(|form| lowest(&plant(form, 20_000, seed)));
        assert!(bush < 0.15 && tree > 0.15 && tree < 0.45, "bush {bush}, tree {tree}");
    }
}

fn what_cannot_grow_is_refused() {
    let refused = |plant: Grow| plant.mesh().map_or_else(|error| error.to_string(), |_| "grown".to_owned());
    let bush = Grow::new(Form::Bush);
    assert!(refused(Grow { triangles: 10, ..bush }).contains("number of triangles is 10, allowed 2000 to 64000000"));
    assert!(refused(Grow { triangles: u32::MAX, ..bush }).contains("allowed"));
    for height in [0.0, -1.0, 61.0, f32::NAN, f32::INFINITY] {
        assert!(refused(Grow { height, ..bush }).contains("the height is"), "{height}");
    }
    assert_eq!(refused(Grow { triangles: 2000, height: 0.05, ..bush }), "grown", "control");
}
