//! Terrain from TIFF and GeoTIFF: small ones written here, and those of `../shared/data` where it exists (else their tests are ignored).

mod files;

use std::path::PathBuf;

use libtest_mimic::{Arguments, Trial};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use sward::terrain::{Terrain, TerrainError, is_tiff};

use files::{GEOGRAPHIC, MERCATOR, Tiff, float, whole};

/// The folder of terrains made by others: beside this checkout, or as `SWARD_SHARED` says.
fn shared() -> Option<PathBuf> {
    let beside = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared");
    let folder = std::env::var_os("SWARD_SHARED").map_or_else(|| PathBuf::from(beside), PathBuf::from).join("data/terrain");
    folder.is_dir().then_some(folder)
}

fn load(bytes: &[u8]) -> Result<Terrain, TerrainError> {
    Terrain::from_tiff(bytes, None, 1.0, [0.0; 2])
}

fn good(bytes: &[u8]) -> Terrain {
    load(bytes).unwrap_or_else(|error| panic!("{error}"))
}

fn message(bytes: &[u8]) -> String {
    load(bytes).map_or_else(|error| error.to_string(), |terrain| format!("read: {} samples", terrain.heights().len()))
}

fn all_kinds_of_samples_are_read() {
    let heights = [-3.0, 0.0, 2.0, 100.0, 7.0, 5.0];
    let kinds = Tiff::new(3, 2).pixel(10.0, 20.0).all_kinds(&heights);
    assert_eq!(kinds.len(), 5);
    for (kind, bytes) in kinds {
        assert!(is_tiff(&bytes) && !is_tiff(b"\x89PNG"));
        let terrain = good(&bytes);
        let expected: Vec<f32> =
            if kind.starts_with('u') { vec![0.0, 0.0, 2.0, 100.0, 7.0, 5.0] } else { heights.map(|h| h as f32).to_vec() };
        assert_eq!(terrain.heights(), expected, "{kind}");
        assert_eq!(
            (terrain.columns(), terrain.rows(), terrain.spacing(), terrain.corner()),
            (3, 2, [10.0, 20.0], [-10.0, -10.0]),
            "{kind}"
        );
    }
}

fn scale_and_offset_move_it() {
    let bytes = float(Tiff::new(3, 2).pixel(10.0, 20.0), &[1.0, 2.0, 3.0, 4.0, 5.0, 6.5]);
    let terrain = Terrain::from_tiff(&bytes, None, 0.5, [100.0, -7.0]).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!((terrain.spacing(), terrain.corner()), ([5.0, 10.0], [95.0, -12.0]));
    assert_eq!(terrain.heights(), [0.5, 1.0, 1.5, 2.0, 2.5, 3.25]);
    assert!(Terrain::from_tiff(&bytes, None, 0.0, [0.0; 2]).is_err() && Terrain::from_tiff(&bytes, None, 1.0, [f64::NAN, 0.0]).is_err());
}

fn degrees_become_metres_at_their_latitude() {
    // WGS 84: a degree of latitude is 110.574 km at the equator and 111.132 km at 45°, one of longitude 111.320 and 78.847 km.
    for (latitude, east, north) in [(0.0, 111_319.49, 110_574.28), (45.0, 78_846.81, 111_131.78), (-60.0, 55_800.0, 111_412.24)] {
        let tiff = Tiff::new(4, 4).pixel(0.01, 0.01).tie(7.0, latitude + 0.02).keys(GEOGRAPHIC);
        let spacing = good(&float(tiff, &[0.0; 16])).spacing();
        assert!(
            (spacing[0] / (0.01 * east) - 1.0).abs() < 1e-5 && (spacing[1] / (0.01 * north) - 1.0).abs() < 1e-5,
            "{latitude}: {spacing:?}"
        );
    }
    assert!(message(&float(Tiff::new(4, 4).pixel(0.01, 0.01).keys(GEOGRAPHIC), &[0.0; 16])).contains("at which latitude"));
    let mercator = Tiff::new(4, 4).pixel(30.0, 30.0).tie(0.0, 6e6).keys(MERCATOR);
    assert_eq!(good(&float(mercator, &[0.0; 16])).spacing(), [30.0, 30.0], "as it is");
    let feet = Tiff::new(2, 1).pixel(30.0, 30.0).keys(&[[1024, 1], [3076, 9002], [4099, 9002]]);
    let terrain = good(&float(feet, &[100.0, 200.0]));
    assert!((terrain.spacing()[0] - 9.144).abs() < 1e-12 && (terrain.heights()[0] - 30.48).abs() < 1e-5);
}

fn other_ways_to_say_the_size() {
    let matrix = |a: f64, b: f64, d: f64| [a, b, 0.0, 500.0, 0.0, d, 0.0, 900.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    let heights = [1.0, 2.0, 3.0, 4.0];
    let north_up = good(&float(Tiff::new(2, 2).matrix(matrix(5.0, 0.0, -6.0)), &heights));
    assert_eq!((north_up.spacing(), north_up.heights()), ([5.0, 6.0], &[1.0, 2.0, 3.0, 4.0][..]));
    let south_up = good(&float(Tiff::new(2, 2).matrix(matrix(5.0, 0.0, 6.0)), &heights));
    assert_eq!(south_up.heights(), [3.0, 4.0, 1.0, 2.0], "its first row is the south edge");
    assert!(message(&float(Tiff::new(2, 2).matrix(matrix(5.0, 1.0, -6.0)), &heights)).contains("lies askew"));
    let plain = float(Tiff::new(2, 2), &heights);
    assert!(message(&plain).contains("no ModelPixelScale") && message(&plain).contains("metres_per_pixel_x = 30"));
    let beside = |text| Terrain::from_tiff(&plain, Some(text), 1.0, [0.0; 2]);
    assert_eq!(beside("metres_per_pixel_x = 3\nmetres_per_pixel_y = 4.5").map(|terrain| terrain.spacing()), Ok([3.0, 4.5]));
    assert!(beside("metres_per_pixel_x = 3").is_err_and(|error| error.to_string().contains("lacks `metres_per_pixel_y`")));
}

fn samples_without_data_take_their_neighbours_height() {
    let holes = Tiff::new(4, 2).pixel(1.0, 1.0).missing("-9999 ");
    let terrain = good(&float(holes, &[5.0, -9999.0, -9999.0, 8.0, 5.5, f32::NAN, 7.0, 8.0]));
    assert_eq!(terrain.filled(), 3);
    assert_eq!(terrain.heights(), [5.0, 5.0, 8.0, 8.0, 5.5, 5.5, 7.0, 8.0]);
    assert_eq!(good(&float(Tiff::new(2, 1).pixel(1.0, 1.0), &[1.0, 2.0])).filled(), 0);
    assert!(message(&float(Tiff::new(2, 1).pixel(1.0, 1.0).missing("7"), &[7.0, 7.0])).contains("no data at all"));
    let unmarked = message(&float(Tiff::new(2, 1).pixel(1.0, 1.0), &[1.0, -3.4e38]));
    assert!(unmarked.contains("-a_nodata"), "{unmarked}");
}

fn wrong_files_are_explained() {
    for (bytes, words) in [
        (b"II*\0".to_vec(), "not a readable TIFF"),
        (files::colour(), "needed is one channel"),
        (files::bomb(16384, 2048), "cannot hold"),
        (files::bomb(100_000, 100_000), "at most 16384 a side"),
        (float(Tiff::new(1, 1).pixel(0.0, 1.0), &[0.0]), "`pixel width` is 0"),
        (float(Tiff::new(1, 1).pixel(f64::NAN, 1.0), &[0.0]), "`pixel width` is NaN"),
        (float(Tiff::new(1, 1).pixel(1.0, 1e9), &[0.0]), "`pixel height` is 1000000000"),
    ] {
        let found = message(&bytes);
        assert!(found.contains(words), "wanted {words}: {found}");
    }
}

fn mutated_files_never_panic() {
    let heights: Vec<f32> = (0..300).map(|k| (k % 17) as f32).collect();
    let whole_heights: Vec<i16> = (0..300).map(|k| k % 23).collect();
    let files = [
        float(Tiff::new(20, 15).pixel(1.0, 1.0).tie(0.0, 30.0).keys(GEOGRAPHIC).missing("3"), &heights),
        whole(Tiff::new(20, 15).pixel(5.0, 5.0), &whole_heights),
        files::compressed(Tiff::new(20, 15).pixel(5.0, 5.0), &whole_heights),
    ];
    assert!(files.iter().all(|file| load(file).is_ok()), "control: unharmed files are read");
    let strategy = (0..3_usize, prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..5), any::<prop::sample::Index>());
    let (read, refused) = (std::cell::Cell::new(0), std::cell::Cell::new(0));
    TestRunner::new(Config { cases: 3000, failure_persistence: None, ..Config::default() })
        .run(&strategy, |(file, changes, cut)| {
            let mut bytes = files[file].clone();
            changes.iter().for_each(|(at, value)| bytes[at.index(files[file].len())] = *value);
            if cut.index(8) == 0 {
                bytes.truncate(cut.index(files[file].len()));
            }
            let counter = if load(&bytes).is_ok() { &read } else { &refused };
            counter.set(counter.get() + 1);
            Ok(())
        })
        .unwrap_or_else(|error| panic!("{error}"));
    println!("{} mutated files were read, {} refused", read.get(), refused.get());
    assert!(read.get() > 100 && refused.get() > 100);
}

fn given_terrains_match_their_pictures() {
    let folder = shared().expect("ignored without it");
    let bytes = |name: &str| std::fs::read(folder.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    // Web mercator is taken as it is: longer than on the ground by 1 / cos 40.4°… of the grid's middle.
    for (name, stretch) in [("jacksboro", 1.0), ("vancouver_island", 3710.6858 / 2434.1022)] {
        let sidecar = String::from_utf8(bytes(&format!("{name}.toml"))).expect("text");
        let png = Terrain::from_image(&bytes(&format!("{name}.png")), &sidecar, 1.0, [0.0; 2]).unwrap_or_else(|error| panic!("{error}"));
        let tiff = good(&bytes(&format!("{name}.tif")));
        assert_eq!((tiff.columns(), tiff.rows()), (png.columns(), png.rows()));
        let worst = tiff.heights().iter().zip(png.heights()).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        let ratio = [0, 1].map(|axis| tiff.spacing()[axis] / png.spacing()[axis] / stretch);
        println!("{name}: heights differ by at most {worst} m, pixels by {:.5} and {:.5}", ratio[0], ratio[1]);
        assert!(worst <= 0.03 && ratio.iter().all(|ratio| (ratio - 1.0).abs() < 1e-4));
        let turned: f32 = tiff.heights().iter().rev().zip(png.heights()).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(turned > 100.0, "control: turned by 180 degrees it is another ground");
    }
}

fn main() -> std::process::ExitCode {
    let arguments = Arguments::from_args();
    let tests: [(&str, fn(), bool); 8] = [
        ("all_kinds_of_samples_are_read", all_kinds_of_samples_are_read, false),
        ("scale_and_offset_move_it", scale_and_offset_move_it, false),
        ("degrees_become_metres_at_their_latitude", degrees_become_metres_at_their_latitude, false),
        ("other_ways_to_say_the_size", other_ways_to_say_the_size, false),
        ("samples_without_data_take_their_neighbours_height", samples_without_data_take_their_neighbours_height, false),
        ("wrong_files_are_explained", wrong_files_are_explained, false),
        ("mutated_files_never_panic", mutated_files_never_panic, false),
        ("given_terrains_match_their_pictures", given_terrains_match_their_pictures, shared().is_none()),
    ];
    let trials = tests.map(|(name, test, ignored)| {
        Trial::test(name, move || {
            test();
            Ok(())
        })
        .with_ignored_flag(ignored)
    });
    libtest_mimic::run(&arguments, trials.into()).exit_code()
}
