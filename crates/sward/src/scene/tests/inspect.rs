//! The walk over all parameters: it comes by every field once, may set every number, and may choose everything there is.

use std::collections::{BTreeMap, BTreeSet};

use super::*;
use crate::scene::inspect::{Choice, Group, List, NumberKind, Optional};

/// A scene in which every list has an element and every optional value is there.
fn full() -> Scene {
    filled(Scene::default())
}

fn filled(mut scene: Scene) -> Scene {
    scene.inspect_fields(&mut Filler { depth: 0 });
    scene
}

/// Adds an element to every list and puts every optional value there.
struct Filler {
    depth: u32,
}

impl Filler {
    /// Compounds hold shapes, which are compounds.
    fn deeper(&mut self, inside: impl FnOnce(&mut Self) -> bool) -> bool {
        self.depth += 1;
        if self.depth < 16 {
            inside(self);
        }
        self.depth -= 1;
        true
    }
}

impl Inspector for Filler {
    fn number(&mut self, _: &FieldInfo, _: NumberKind, _: &mut f64) -> bool {
        false
    }
    fn vector(&mut self, _: &FieldInfo, _: NumberKind, _: &mut [f64]) -> bool {
        false
    }
    fn flag(&mut self, _: &FieldInfo, _: &mut bool) -> bool {
        false
    }
    fn text(&mut self, _: &FieldInfo, _: &mut String) -> bool {
        false
    }
    fn list(&mut self, info: &FieldInfo, list: &mut dyn List) -> bool {
        if list.length() == 0 {
            list.add(info);
        }
        self.deeper(|inner| list.inspect_element(0, info, inner))
    }
    fn optional(&mut self, info: &FieldInfo, optional: &mut dyn Optional) -> bool {
        optional.set_present(true, info);
        assert!(!optional.set_present(true, info) && optional.is_present(), "{}", info.name);
        self.deeper(|inner| optional.inspect_inside(info, inner))
    }
    fn group(&mut self, _: &FieldInfo, group: &mut dyn Group) -> bool {
        self.deeper(|inner| group.inspect_fields(inner))
    }
    fn choice(&mut self, info: &FieldInfo, choice: &mut dyn Choice) -> bool {
        self.deeper(|inner| choice.inspect_inside(info, inner))
    }
}

/// Writes down where it has been: in everything there is to choose from.
#[derive(Default)]
struct Census {
    path: Vec<String>,
    /// Where each group begins in the path: its name.
    groups: Vec<&'static str>,
    /// Values met, and how often.
    met: BTreeMap<String, u32>,
    /// Group and field, or choice and name.
    fields: BTreeSet<String>,
    skip: &'static str,
}

impl Census {
    fn meet(&mut self, info: &FieldInfo) -> bool {
        if info.name != self.skip {
            *self.met.entry(self.path.join(".")).or_default() += 1;
        }
        false
    }
    fn at(&mut self, step: String, inside: impl FnOnce(&mut Self) -> bool) {
        self.path.push(step);
        inside(self);
        self.path.pop();
    }
    fn fields_of(&mut self, group: &mut dyn Group) -> bool {
        for info in group.fields().iter().filter(|info| info.name != self.skip) {
            self.fields.insert(format!("{}.{}", group.name(), info.name));
        }
        self.groups.push(group.name());
        for info in group.fields() {
            self.at(info.name.to_owned(), |inner| group.inspect_field(info.name, inner));
        }
        self.groups.pop();
        group.inspect_field("no such field", self)
    }
}

impl Inspector for Census {
    fn number(&mut self, info: &FieldInfo, kind: NumberKind, number: &mut f64) -> bool {
        assert!(!kind.is_whole() || number.fract() == 0.0);
        self.meet(info)
    }
    fn vector(&mut self, info: &FieldInfo, _: NumberKind, parts: &mut [f64]) -> bool {
        assert!((2..=3).contains(&parts.len()));
        self.meet(info)
    }
    fn flag(&mut self, info: &FieldInfo, _: &mut bool) -> bool {
        self.meet(info)
    }
    fn text(&mut self, info: &FieldInfo, _: &mut String) -> bool {
        self.meet(info)
    }
    fn list(&mut self, info: &FieldInfo, list: &mut dyn List) -> bool {
        self.meet(info);
        assert!(!list.inspect_element(list.length(), info, self), "there is none behind the last");
        for index in 0..list.length() {
            self.at(format!("[{index}]"), |inner| list.inspect_element(index, info, inner));
        }
        let length = list.length();
        list.add(info);
        assert!(list.length() == length + 1 && list.swap(0, length) && list.swap(0, length) && !list.swap(0, length + 1));
        assert!(list.remove(length) && !list.remove(length));
        false
    }
    fn optional(&mut self, info: &FieldInfo, optional: &mut dyn Optional) -> bool {
        self.meet(info);
        optional.set_present(true, info);
        self.at("?".to_owned(), |inner| optional.inspect_inside(info, inner));
        false
    }
    fn group(&mut self, info: &FieldInfo, group: &mut dyn Group) -> bool {
        self.meet(info);
        self.at("()".to_owned(), |inner| inner.fields_of(group));
        false
    }
    fn choice(&mut self, info: &FieldInfo, choice: &mut dyn Choice) -> bool {
        self.meet(info);
        let inside = self.groups.iter().filter(|group| **group == "Part").count() > 0;
        for (index, variant) in choice.variants().iter().enumerate() {
            self.fields.insert(format!("{}.{}", choice.name(), variant.name));
            choice.choose(index);
            assert_eq!(choice.chosen(), index);
            // Compounds within compounds never end.
            if !(inside && variant.name == "Compound") {
                self.at(variant.name.to_owned(), |inner| choice.inspect_inside(info, inner));
            }
        }
        assert!(!choice.choose(choice.variants().len()), "there is no such variant");
        false
    }
}

/// `Group.field` and `Choice.Name` of every row of the reference page; or only of choices.
fn reference_rows(choices_only: bool) -> BTreeSet<String> {
    let (page, mut section, mut choice, mut rows) = (reference(), "", false, BTreeSet::new());
    for line in page.lines().take_while(|line| !line.starts_with("## What each species gives")) {
        section = line.strip_prefix("## ").unwrap_or(section);
        choice = line.starts_with("| choice |") || choice && !line.starts_with("| field |");
        if let Some(name) = line.strip_prefix("| `").and_then(|row| row.split(['`', '(']).next())
            && (choice || !choices_only)
        {
            rows.insert(format!("{section}.{name}"));
        }
    }
    rows
}

#[test]
fn every_field_of_the_format_is_met_and_each_value_once() {
    let mut census = Census::default();
    assert!(!census.fields_of(&mut full()));
    let expected = reference_rows(false);
    assert!(expected.len() > 250, "{}", expected.len());
    assert_eq!(census.fields, expected);
    assert!(census.met.len() > expected.len(), "{}", census.met.len());
    assert_eq!(census.met.iter().find(|(_, count)| **count != 1), None);
    assert!(census.met.contains_key("stands.[0].().response.?.Continuum.().frequency.?"), "{:?}", census.met.keys());
    let mut blind = Census { skip: "clumping", ..Census::default() };
    blind.fields_of(&mut full());
    assert_ne!(blind.fields, expected, "control: a field that is not met is missed");
}

/// Counts the values directly in fields, and sets numbers to a bound, or beyond it.
struct Bound {
    beyond: f64,
    seen: u32,
}

impl Bound {
    fn bound(&mut self, info: &FieldInfo, kind: NumberKind) -> f64 {
        self.seen += 1;
        info.range.map_or(kind.bounds().1, |(_, high)| high + self.beyond)
    }
}

impl Inspector for Bound {
    fn number(&mut self, info: &FieldInfo, kind: NumberKind, number: &mut f64) -> bool {
        *number = self.bound(info, kind);
        true
    }
    fn vector(&mut self, info: &FieldInfo, kind: NumberKind, parts: &mut [f64]) -> bool {
        parts.fill(self.bound(info, kind));
        true
    }
    fn flag(&mut self, _: &FieldInfo, _: &mut bool) -> bool {
        false
    }
    fn text(&mut self, _: &FieldInfo, _: &mut String) -> bool {
        false
    }
    fn list(&mut self, info: &FieldInfo, list: &mut dyn List) -> bool {
        (0..list.length()).fold(false, |changed, index| list.inspect_element(index, info, self) | changed)
    }
    fn optional(&mut self, info: &FieldInfo, optional: &mut dyn Optional) -> bool {
        optional.inspect_inside(info, self)
    }
    fn group(&mut self, _: &FieldInfo, group: &mut dyn Group) -> bool {
        group.inspect_fields(self)
    }
    fn choice(&mut self, info: &FieldInfo, choice: &mut dyn Choice) -> bool {
        choice.inspect_inside(info, self)
    }
}

#[test]
fn every_number_may_be_set_to_its_upper_bound() {
    let mut scenes: Vec<Scene> = (0..20).map(|seed| Scene::arbitrary(None, &mut Source::new(seed))).collect();
    scenes.push(full());
    for scene in scenes {
        let (mut within, mut beyond) = (scene.clone(), scene.clone());
        let mut inspector = Bound { beyond: 0.0, seen: 0 };
        assert!(within.inspect_fields(&mut inspector) && inspector.seen > 40 && within != scene);
        assert_eq!(within.check(&Trail::default()).map_err(|problem| problem.trail.to_string()), Ok(()));
        beyond.inspect_fields(&mut Bound { beyond: 1.0, seen: 0 });
        assert!(beyond.check(&Trail::default()).is_err(), "control: beyond the bounds it is refused");
    }
}

/// Switches one choice to one name: number `target` of all that could be.
struct Switch {
    target: usize,
    seen: usize,
    chosen: Option<String>,
}

impl Inspector for Switch {
    fn number(&mut self, _: &FieldInfo, _: NumberKind, _: &mut f64) -> bool {
        false
    }
    fn vector(&mut self, _: &FieldInfo, _: NumberKind, _: &mut [f64]) -> bool {
        false
    }
    fn flag(&mut self, _: &FieldInfo, _: &mut bool) -> bool {
        false
    }
    fn text(&mut self, _: &FieldInfo, _: &mut String) -> bool {
        false
    }
    fn list(&mut self, info: &FieldInfo, list: &mut dyn List) -> bool {
        (0..list.length()).fold(false, |changed, index| list.inspect_element(index, info, self) | changed)
    }
    fn optional(&mut self, info: &FieldInfo, optional: &mut dyn Optional) -> bool {
        optional.inspect_inside(info, self)
    }
    fn group(&mut self, _: &FieldInfo, group: &mut dyn Group) -> bool {
        group.inspect_fields(self)
    }
    fn choice(&mut self, info: &FieldInfo, choice: &mut dyn Choice) -> bool {
        let others = choice.variants().len() - 1;
        let own = self.target.checked_sub(self.seen).filter(|own| *own < others);
        self.seen += others;
        match own {
            Some(own) => {
                let index = (choice.chosen() + 1 + own) % choice.variants().len();
                self.chosen = Some(format!("{}.{}", choice.name(), choice.variants()[index].name));
                choice.choose(index)
            }
            None => choice.inspect_inside(info, self),
        }
    }
}

#[test]
fn every_choice_can_be_switched_written_and_read_back() {
    // What has just been chosen may hold other choices: they are switched too.
    let (mut open, mut met) = (vec![full()], BTreeSet::new());
    while let Some(scene) = open.pop() {
        for target in 0.. {
            let mut switched = scene.clone();
            let mut inspector = Switch { target, seen: 0, chosen: None };
            let changed = switched.inspect_fields(&mut inspector);
            let Some(name) = inspector.chosen else {
                assert!(!changed && switched == scene && target > 20, "{target}");
                break;
            };
            assert!(changed && switched != scene, "{name}");
            let text = switched.to_ron();
            let back = Scene::read(&text);
            assert_eq!(back.as_ref(), Ok(&switched), "{text}");
            assert_ne!(back.as_ref(), Ok(&scene), "control: another choice is another scene");
            if met.insert(name) {
                open.push(filled(switched));
            }
        }
    }
    assert!(met.len() > 50 && !met.contains("Species.Swamp"), "{}", met.len());
    assert_eq!(met, reference_rows(true));
}

#[test]
fn an_optional_value_begins_within_its_range_or_as_written() {
    let mut frequency: Option<f32> = None;
    let info = ContinuumOverrides::FIELDS.iter().find(|info| info.name == "frequency").unwrap();
    let optional: &mut dyn Optional = &mut frequency;
    assert!(optional.set_present(true, info) && !optional.write("fast") && optional.is_present());
    assert_eq!(frequency.map(f64::from).map(|value| value as f32), info.range.map(|(low, _)| low as f32));
    let optional: &mut dyn Optional = &mut frequency;
    assert!(optional.write("1.75"));
    assert_eq!(frequency, Some(1.75));
}
