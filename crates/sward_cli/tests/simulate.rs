//! `sward simulate` on the CPU.

mod support;
use std::collections::BTreeMap;
use std::io::BufReader;

use npyz::{DType, NpyFile};
use serde_json::Value;
use support::Place;

fn manifest(place: &Place, folder: &str) -> Value {
    let text = std::fs::read_to_string(place.0.join(folder).join("manifest.json")).expect("there is a manifest");
    serde_json::from_str(&text).expect("valid JSON")
}

fn open(place: &Place, folder: &str, array: &Value) -> NpyFile<BufReader<std::fs::File>> {
    let file = place.0.join(folder).join(array["file"].as_str().expect("a file name"));
    NpyFile::new(BufReader::new(std::fs::File::open(file).expect("the file exists"))).expect("a NumPy file")
}

fn find<'a>(manifest: &'a Value, name: &str, step: u64) -> &'a Value {
    let mut arrays = manifest["arrays"].as_array().expect("a list").iter();
    arrays.find(|array| array["name"] == name && array["step"] == step).unwrap_or_else(|| panic!("no {name} at {step}"))
}

/// Name and bytes of every file.
fn contents(place: &Place, folder: &str) -> BTreeMap<String, Vec<u8>> {
    let entries = std::fs::read_dir(place.0.join(folder)).expect("readable").map(|entry| entry.expect("readable").path());
    entries
        .map(|path| (path.file_name().unwrap_or_default().to_string_lossy().into_owned(), std::fs::read(path).expect("readable")))
        .collect()
}

#[test]
fn the_manifest_tells_the_truth_about_every_file() {
    let place = Place::with_small("manifest");
    let said = place.sward(&["simulate", "small.ron", "--steps", "10", "--every", "4", "-o", "data"]).done();
    assert!(said.contains("data/manifest.json"), "{said}");
    let manifest = manifest(&place, "data");
    let arrays = manifest["arrays"].as_array().expect("a list");
    // Two stands of three arrays, bodies and wind, at steps 4, 8 and 10.
    assert_eq!(arrays.len(), 3 * (2 * 3 + 2));
    let mut listed: Vec<String> = vec!["manifest.json".to_owned()];
    for array in arrays {
        let npy = open(&place, "data", array);
        assert_eq!(npy.shape(), serde_json::from_value::<Vec<u64>>(array["shape"].clone()).expect("numbers"), "{array}");
        assert_eq!(array["axes"].as_array().map(Vec::len), Some(npy.shape().len()), "{array}");
        match npy.dtype() {
            DType::Plain(kind) => assert_eq!(array["dtype"], kind.to_string(), "{array}"),
            other => panic!("{other:?}"),
        }
        assert!((array["time"].as_f64().expect("s") - array["step"].as_f64().expect("a number") / 60.0).abs() < 1e-12);
        for key in ["meaning", "unit"] {
            assert!(array[key].as_str().is_some_and(|text| !text.is_empty()), "{array}");
        }
        listed.push(array["file"].as_str().expect("a file name").to_owned());
    }
    listed.sort();
    assert_eq!(listed, contents(&place, "data").into_keys().collect::<Vec<_>>());
}

#[test]
fn the_arrays_hold_what_the_world_holds() {
    let place = Place::with_small("values");
    place.sward(&["simulate", "small.ron", "--steps", "20", "-o", "data"]).done();
    let manifest = manifest(&place, "data");
    let mut world =
        sward::world::World::new(sward::scene::Scene::parse(support::SMALL, "").expect("valid"), &sward::model::NoAssets).expect("valid");
    (0..20).for_each(|_| world.step());
    let stand = &world.state.stands[0];
    let patches: Vec<i32> = open(&place, "data", find(&manifest, "meadow/patches", 20)).into_vec().expect("i32");
    assert_eq!(patches, stand.awake.keys().flatten().copied().collect::<Vec<_>>());
    assert!(!patches.is_empty());
    let area = 16 * 16;
    for (name, plane) in [("meadow/beta", 0), ("meadow/omega", 2)] {
        let values: Vec<f32> = open(&place, "data", find(&manifest, name, 20)).into_vec().expect("f32");
        assert!(values.iter().any(|value| *value != 0.0), "{name}");
        for (index, awake) in stand.awake.values().enumerate() {
            let cells = &stand.cells.now[awake.slot as usize];
            for cell in 0..area {
                let expected = [cells[plane * area + cell], cells[(plane + 1) * area + cell]];
                assert_eq!(values[2 * (index * area + cell)..][..2], expected, "{name} {index} {cell}");
            }
        }
    }
    let bodies = find(&manifest, "bodies", 20);
    let values: Vec<f64> = open(&place, "data", bodies).into_vec().expect("f64");
    let columns = bodies["columns"].as_array().expect("a list").len();
    assert_eq!((bodies["rows"][0].as_str(), values.len()), (Some("ball"), 2 * columns));
    // The ball goes round at 4 m/s; the truck has not come yet.
    let speed = (values[columns - 2] * values[columns - 2] + values[columns - 1] * values[columns - 1]).sqrt();
    assert!((values[0], values[columns]) == (1.0, 0.0) && (speed - 4.0).abs() < 0.01, "{values:?}");
    assert!(values[columns + 1].is_nan());
}

#[test]
fn the_wind_lies_on_its_grid() {
    let place = Place::with_small("wind");
    place.sward(&["simulate", "small.ron", "--steps", "3", "-o", "data"]).done();
    let manifest = manifest(&place, "data");
    let wind = find(&manifest, "wind", 3);
    let values: Vec<f32> = open(&place, "data", wind).into_vec().expect("f32");
    let (first, spacing) = (&wind["grid"]["first"], wind["grid"]["spacing"].as_f64().expect("m"));
    let side = wind["shape"][0].as_u64().expect("a number") as f64;
    // The default eye (0, -8) is the focus; it lies in the middle.
    for (axis, focus) in [(0, 0.0), (1, -8.0)] {
        let middle = first[axis].as_f64().expect("m") + spacing * (side - 1.0) / 2.0;
        assert!((middle - focus).abs() <= spacing, "{wind}");
    }
    let mean = values.iter().step_by(2).sum::<f32>() / (values.len() / 2) as f32;
    assert!((mean - 4.0).abs() < 1.0, "{mean}");
    assert!(values.iter().any(|value| *value != values[0]));
}

#[test]
fn two_runs_write_the_same_bits() {
    let place = Place::with_small("twice");
    let run = |folder: &str, steps: &str| place.sward(&["simulate", "small.ron", "--steps", steps, "-o", folder, "--quiet"]).done();
    assert_eq!((run("one", "30"), run("two", "30"), run("three", "31")), (String::new(), String::new(), String::new()));
    let one = contents(&place, "one");
    assert!(one.len() > 8 && one == contents(&place, "two"));
    // The control: another state is seen.
    let other = contents(&place, "three");
    assert_ne!(one["0_meadow_beta_000030.npy"], other["0_meadow_beta_000031.npy"]);
}

#[test]
fn a_second_run_replaces_the_first() {
    let place = Place::with_small("again");
    for steps in ["5", "3"] {
        place.sward(&["simulate", "small.ron", "--steps", steps, "-o", "data/"]).done();
    }
    let manifest = manifest(&place, "data");
    assert!(manifest["arrays"].as_array().is_some_and(|arrays| arrays.iter().all(|array| array["step"] == 3)));
}

#[test]
fn a_scene_without_plants_or_bodies_is_written_too() {
    let place = Place::new("nothing");
    place.write("empty.ron", "(version: 1)");
    place.sward(&["simulate", "empty.ron", "--steps", "2", "-o", "data"]).done();
    let manifest = manifest(&place, "data");
    assert_eq!(find(&manifest, "bodies", 2)["shape"], serde_json::json!([0, 9]));
    assert!(open(&place, "data", find(&manifest, "bodies", 2)).into_vec::<f64>().expect("f64").is_empty());
}

#[test]
fn fails_with_status_1_when_a_file_cannot_be_written() {
    let place = Place::with_small("unwritable");
    std::fs::create_dir_all(place.0.join("data/bodies_000002.npy/in_the_way")).expect("writable");
    let ran = place.sward(&["simulate", "small.ron", "--steps", "2", "-o", "data"]);
    assert_eq!((ran.status, ran.text.as_str()), (1, ""), "{}", ran.errors);
    assert!(ran.errors.contains("cannot write data/bodies_000002.npy"), "{}", ran.errors);
    // No manifest promises what is not there, and nothing half-written stays.
    let files = place.files();
    assert!(!files.iter().any(|file| file.contains("manifest") || file.contains(".part")), "{files:?}");
}
