//! Every scene that can be built can be written and read back.

mod inspect;

use super::*;
use proptest::prelude::*;

/// Random numbers for building arbitrary scenes, and a limit to their nesting.
pub struct Source {
    state: u64,
    depth: u32,
}

impl Source {
    fn new(seed: u64) -> Self {
        Self { state: seed, depth: 0 }
    }

    fn next(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.state ^ (self.state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// A whole number from 0 up to, not including, `limit`.
    pub(super) fn below(&mut self, limit: u64) -> u64 {
        self.next() % limit
    }

    /// A number in [0, 1).
    pub(super) fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Builds a list, given how many elements there is room for.
    pub(super) fn nested<T>(&mut self, build: impl FnOnce(&mut Self, u64) -> T) -> T {
        let room = if self.depth < 4 { self.below(4) } else { 0 };
        self.depth += 1;
        let list = build(self, room);
        self.depth -= 1;
        list
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn writing_and_reading_gives_the_same_scene(seed: u64) {
        let scene = Scene::arbitrary(None, &mut Source::new(seed));
        prop_assert!(scene.check(&Trail::default()).is_ok());
        let text = scene.to_ron();
        let back = Scene::read(&text);
        prop_assert_eq!(back.as_ref(), Ok(&scene), "{}", text);
        let spare = options().to_string(&scene).unwrap();
        let back = Scene::read(&spare);
        prop_assert_eq!(back.as_ref(), Ok(&scene), "{}", spare);
    }

    /// A number just outside its range is found wherever it stands, in the text and in a scene built in code.
    #[test]
    fn a_number_out_of_range_is_found(seed: u64, above: bool) {
        let mut scene = Scene::arbitrary(None, &mut Source::new(seed));
        scene.camera.field_of_view = if above { 2.500_001 } else { f32::NAN };
        let problem = scene.check(&Trail::default()).unwrap_err();
        prop_assert_eq!(problem.trail.to_string(), "camera.field_of_view");
        let error = Scene::read(&scene.to_ron()).unwrap_err();
        prop_assert!(error.to_string().contains("`field_of_view` is"), "{}", error);
    }
}

#[test]
fn arbitrary_scenes_reach_every_choice() {
    let texts: String = (0..400).map(|seed| Scene::arbitrary(None, &mut Source::new(seed)).to_ron()).collect();
    let choices =
        [Terrain::NAMES, Species::NAMES, WindSource::NAMES, Shape::NAMES, Path::NAMES, Response::NAMES, Area::NAMES, Change::NAMES];
    for name in choices.concat() {
        // Flat and Meadow may be left out as defaults, but not with other values inside.
        assert!(texts.contains(name), "{name}");
    }
    assert!(!texts.contains("Swamp"));
}

#[test]
fn defaults_are_in_range() {
    let scene = Scene { stands: vec![Stand::default()], interactors: vec![Interactor::default()], ..Scene::default() };
    assert_eq!(scene.validate(), Ok(()));
    assert!(scene.to_ron().lines().count() < 20, "{}", scene.to_ron());
}

#[test]
fn a_problem_in_a_scene_built_in_code_names_the_path() {
    let stand = Stand { cells: Some(100), ..Stand::default() };
    let error = Scene { stands: vec![Stand::default(), stand], ..Scene::default() }.validate().unwrap_err();
    assert_eq!(error.to_string(), "stands[1].cells: `cells` is 100, allowed are multiples of 8\n  help: 96 or 104");
    assert_eq!((error.line, error.span()), (0, 0..0));
}
