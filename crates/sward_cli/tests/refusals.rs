//! Wrong input: status 2, what to type instead, and nothing written.

mod support;
use support::Place;

const GOOD: &str = "(version: 1, stands: [(species: Meadow)])";

#[test]
fn fails_with_an_unknown_scene_and_names_the_nearest() {
    let place = Place::new("unknown_scene");
    for command in [&["show", "helo"][..], &["render", "helo"], &["compare", "helo"], &["simulate", "helo", "--steps", "1", "-o", "data"]] {
        place.refuses(command, &["no scene called `helo`", "did you mean `hello`?", "lawn, reed"]);
    }
    place.refuses(&["scenes", "lwan"], &["did you mean `lawn`?"]);
    place.refuses(&["show", "zzzzz"], &["shipped scenes: hello"]);
}

#[test]
fn fails_with_a_path_that_is_no_scene() {
    let place = Place::new("no_scene");
    std::fs::create_dir(place.0.join("folder")).expect("writable");
    place.write("binary.ron", [0xff, 0xfe, 0x00]);
    place.refuses(&["show", "hello.ron"], &["hello.ron", "cannot be read", "hello"]);
    place.refuses(&["show", "./nowhere/x.ron"], &["cannot be read", "check the path"]);
    place.refuses(&["show", "folder"], &["is a folder"]);
    place.refuses(&["show", "binary.ron"], &["UTF-8"]);
    place.refuses(&["show", ""], &["no scene"]);
}

#[test]
fn fails_with_a_mistake_in_a_scene_and_points_at_it() {
    let place = Place::new("mistake");
    place.write("dusk.ron", "(\n    version: 1,\n    light: (azimut: 1.0),\n)\n");
    place.refuses(&["show", "dusk.ron"], &["dusk.ron:3:13", "no field `azimut`", "light: (azimut: 1.0),", "did you mean `azimuth`?"]);
    place.refuses(&["render", "dusk.ron"], &["did you mean `azimuth`?"]);
    place.refuses(&["simulate", "dusk.ron", "--steps", "5", "-o", "data"], &["did you mean `azimuth`?"]);
    place.write("empty.ron", "");
    place.refuses(&["show", "empty.ron"], &["empty.ron:1:1"]);
}

#[test]
fn fails_with_a_missing_terrain_file() {
    let place = Place::new("missing_terrain");
    place.write("hills.ron", "(version: 1, terrain: Image(path: \"assets/moon.png\"))");
    place.refuses(&["show", "hills.ron"], &["assets/moon.png"]);
}

#[test]
fn fails_with_exclusions_masks_and_edits_that_cannot_be() {
    let place = Place::new("growth");
    let scene = |more: &str| format!("(\n    version: 1,\n    stands: [(species: Meadow)],\n    {more},\n)\n");
    place.write("maps/text.png", "a picture");
    for (more, words) in [
        ("exclusions: [(area: Road(points: [(0, 0)]))]", &["x.ron:4:", "`points` has 1, allowed 2 to 256"][..]),
        (
            "exclusions: [(area: Disc(radius: 2), stands: [\"medow\"])]",
            &["x.ron:4:", "no stand is called `medow`", "did you mean `meadow`?"],
        ),
        ("exclusions: [(area: Disk(radius: 2))]", &["x.ron:4:", "did you mean `Disc`?"]),
        ("masks: [(path: \"\", size: (9, 9))]", &["x.ron:4:", "this mask has no picture"]),
        ("masks: [(path: \"maps/none.png\", size: (9, 9))]", &["x.ron:4:20: maps/none.png", "cannot be read", "type a path"]),
        (
            "masks: [(path: \"maps/text.png\", size: (9, 9))]",
            &["x.ron:4:20: maps/text.png", "not a readable PNG", "export it as a grey PNG of 8 or 16 bits"],
        ),
        ("edits: [(radius: 0.1, change: Flatten())]", &["x.ron:4:", "`radius` is 0.1 m, allowed 0.5 to 200"]),
        ("edits: [(change: Flatten()), (at: (9000, 9000), change: Flatten())]", &["x.ron:4:", "span 9006 m x 9006 m", "680 m"]),
    ] {
        place.write("x.ron", scene(more));
        place.refuses(&["show", "x.ron"], words);
        place.refuses(&["simulate", "x.ron", "--steps", "2", "-o", "data"], words);
    }
}

#[test]
fn fails_with_bodies_and_terrains_that_cannot_be_read() {
    let place = Place::new("bodies");
    let triangle = r#"{"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36,
            "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAAAAAIA/"}]}"#;
    place.write("bodies/triangle.gltf", triangle);
    place.write("bodies/cut.glb", "glTF\x02\0\0\0\0\x10\0\0");
    place.write("bodies/empty.gltf", r#"{"asset": {"version": "2.0"}}"#);
    place.write("maps/cut.tif", "II*\0\x08\0\0\0");
    let body = |shape: &str| format!("(version: 1, interactors: [(shape: Mesh({shape}))])");
    for (shape, words) in [
        ("file: \"bodies/gone.glb\"", &["bodies/gone.glb", "cannot be read"][..]),
        ("file: \"bodies/cut.glb\"", &["bodies/cut.glb", "announces 4096 bytes", "copy or export it again"]),
        ("file: \"bodies/empty.gltf\"", &["no triangles", "export meshes"]),
        ("file: \"bodies/triangle.gltf\", clip: \"Walk\"", &["no clip is called `Walk`", "leave `clip` out"]),
        ("file: \"bodies/triangle.gltf\", scale: 1000", &["allowed 0.01 to 200 m", "type scale:"]),
    ] {
        place.write("body.ron", body(shape));
        place.refuses(&["show", "body.ron"], words);
        place.refuses(&["simulate", "body.ron", "--steps", "1", "-o", "data"], words);
    }
    place.write("body.ron", body("file: \"bodies/triangle.gltf\""));
    assert!(place.sward(&["show", "body.ron"]).done().contains("mesh bodies/triangle.gltf"), "control");
    place.write("hills.ron", "(version: 1, terrain: Image(path: \"maps/cut.tif\"))");
    place.refuses(&["show", "hills.ron"], &["maps/cut.tif", "not a readable TIFF"]);
}

#[test]
fn fails_with_plants_that_cannot_be_read_or_cut() {
    let place = Place::new("layers");
    place.sward(&["grow", "bush", "--triangles", "2000"]).done();
    let whole = std::fs::read(place.0.join("bush.glb")).expect("just written");
    place.write("plants/bush.glb", &whole);
    place.write("plants/cut.glb", &whole[..5000]);
    place.write("plants/text.glb", "no plant");
    let scene = |layers: &str| {
        format!("(\n version: 1,\n stands: [(species: Shrub, places: [(at: (0, 2), height: 1.5)],\n  representation: Layers({layers}))])")
    };
    let file = |more: &str| format!("mesh: File(path: \"plants/{more})");
    for (layers, words) in [
        (file("gone.glb\""), &["plant.ron:4:", "plants/gone.glb", "cannot be read", "type a path from the scene's folder"][..]),
        (file("cut.glb\""), &["plants/cut.glb", "its header announces", "there are 5000", "copy or export it again"]),
        (file("text.glb\""), &["plants/text.glb", "not a whole glTF 2.0 file"]),
        (file("bush.glb\", leaves: [\"Leves\"]"), &["no material is called `Leves`", "known: leaves"]),
        (file("bush.glb\", leaves: [\"bark\"], wood: [\"bark\"]"), &["`bark` is said to be both leaves and wood", "leave it in one list"]),
        ("mesh: Grown(triangles: 10)".into(), &["`triangles` is 10, allowed 2000 to 64000000"]),
        ("mesh: Grown(form: Bsh)".into(), &["`Bsh`", "did you mean `Bush`?"]),
        ("bands: (0.9, 0.2)".into(), &["`bands` end at 0.9 and then at 0.2", "(0.2, 0.9)"]),
        ("near: 0".into(), &["`near` is 0, allowed 1 to 8"]),
        ("turn: 0".into(), &["`turn` is 0 rad, allowed 0.01 to 0.5"]),
    ] {
        place.write("plant.ron", scene(&layers));
        place.refuses(&["show", "plant.ron"], words);
        place.refuses(&["simulate", "plant.ron", "--steps", "1", "-o", "data"], words);
    }
    place.write("plant.ron", scene(&file("bush.glb\"")));
    assert!(place.sward(&["show", "plant.ron"]).done().contains("1 plant, 1.5 m high"), "control");
}

#[test]
fn finds_terrain_beside_the_scene_above_it_and_among_the_shipped() {
    let place = Place::new("terrain");
    let assets = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets");
    for file in ["jacksboro.png", "jacksboro.toml"] {
        let bytes = std::fs::read(assets.join(file)).expect("shipped");
        place.write(&format!("maps/{file}"), bytes);
    }
    let scene = |path: &str| format!("(version: 1, terrain: Image(path: \"{path}\"))");
    place.write("beside.ron", scene("maps/jacksboro.png"));
    place.write("scenes/above.ron", scene("maps/jacksboro.png"));
    place.write("copied.ron", scene("assets/jacksboro.png"));
    place.write("wrong.ron", scene("jacksboro.png"));
    for path in ["beside.ron", "scenes/above.ron", "copied.ron"] {
        assert!(place.sward(&["show", path]).done().contains("jacksboro.png"), "{path}");
    }
    place.refuses(&["show", "wrong.ron"], &["jacksboro.png"]);
}

#[test]
fn fails_with_sizes_times_and_frames_out_of_range() {
    let place = Place::new("numbers");
    place.write("good.ron", GOOD);
    let cases: [(&[&str], &str); 15] = [
        (&["--size", "0x540"], "960x540"),
        (&["--size", "960x0"], "960x540"),
        (&["--size", "16385x16"], "16384"),
        (&["--size", "big"], "960x540"),
        (&["--time", "-1"], "0 to 1000000 seconds"),
        (&["--time", "NaN"], "0 to 1000000 seconds"),
        (&["--time", "inf"], "0 to 1000000 seconds"),
        (&["--frames", "9..3"], "type 3..9"),
        (&["--frames", "5..5"], "type 5..6"),
        (&["--frames", "5"], "like 0..90"),
        (&["--frames", "0..5", "--fps", "0"], "1..=1000"),
        (&["--frames", "0..5", "--time", "1"], "cannot be used with"),
        (&["--fps", "30"], "--frames"),
        (&["--on", "moon"], "auto, cpu, gpu"),
        (&["--draw", "crayon"], "auto, gpu, cpu"),
    ];
    for (options, advice) in cases {
        place.refuses(&[&["render", "good.ron"], options].concat(), &[advice]);
    }
}

#[test]
fn fails_with_wrong_steps() {
    let place = Place::with_small("steps");
    let simulate = |options: &[&'static str]| [&["simulate", "small.ron", "-o", "data"], options].concat();
    place.refuses(&simulate(&[]), &["--steps"]);
    place.refuses(&simulate(&["--steps", "0"]), &["1..="]);
    place.refuses(&simulate(&["--steps", "-5"]), &["-5"]);
    place.refuses(&simulate(&["--steps", "5", "--every", "0"]), &["1..="]);
    place.refuses(&simulate(&["--steps", "5", "--every", "6"]), &["type --every 5"]);
    place.refuses(&["simulate", "small.ron", "--steps", "5"], &["--output"]);
    place.refuses(&["compare", "small.ron", "--steps", "0"], &["1..="]);
}

#[test]
fn fails_with_a_place_that_cannot_be_written_to() {
    let place = Place::with_small("places");
    std::fs::create_dir(place.0.join("folder")).expect("writable");
    place.write("file", "x");
    let cases: [(&[&str], &[&str]); 9] = [
        (&["render", "small.ron", "-o", "folder"], &["is a folder", "folder/small.png"]),
        (&["render", "small.ron", "-o", "new/"], &["is a folder", "small.png"]),
        (&["render", "small.ron", "-o", "missing/a.png"], &["the folder missing does not exist", "mkdir -p missing"]),
        (&["render", "small.ron", "-o", "a.jpg"], &["PNG", "-o a.png"]),
        (&["render", "small.ron", "-o", "a"], &["PNG", "-o a.png"]),
        (&["render", "small.ron", "-o", "a.png", "--frames", "0..2"], &["is a file", "-o a/"]),
        (&["render", "small.ron", "-o", "missing/clip/", "--frames", "0..2"], &["mkdir -p missing"]),
        (&["simulate", "small.ron", "--steps", "2", "-o", "missing/data"], &["mkdir -p missing"]),
        (&["simulate", "small.ron", "--steps", "2", "-o", "file"], &["is a file", "-o file_files/"]),
    ];
    for (arguments, words) in cases {
        place.refuses(arguments, words);
    }
}

#[test]
fn fails_with_plants_that_cannot_grow_or_be_read() {
    let place = Place::new("plants");
    std::fs::create_dir(place.0.join("folder")).expect("writable");
    place.write("cut.glb", "glTF\x02\0\0\0\0\x10\0\0");
    place.write("empty.gltf", r#"{"asset": {"version": "2.0"}}"#);
    let cases: [(&[&str], &[&str]); 11] = [
        (&["grow"], &["<FORM>"]),
        (&["grow", "cactus"], &["bush, tree, water-plant"]),
        (&["grow", "bush", "--triangles", "10"], &["2000..=64000000"]),
        (&["grow", "bush", "--height", "-1"], &["0.05 to 60 m high"]),
        (&["grow", "bush", "--height", "tall"], &["type metres, like 1.5"]),
        (&["grow", "bush", "-o", "folder"], &["is a folder", "folder/bush.glb"]),
        (&["grow", "bush", "-o", "bush.obj"], &["glTF", "-o bush.glb"]),
        (&["grow", "bush", "-o", "missing/bush.glb"], &["mkdir -p missing"]),
        (&["show", "gone.glb"], &["gone.glb: cannot be read", "check the path"]),
        (&["show", "cut.glb"], &["cut.glb", "announces 4096 bytes", "copy or export it again"]),
        (&["show", "empty.gltf"], &["no triangles", "export meshes"]),
    ];
    for (arguments, words) in cases {
        place.refuses(arguments, words);
    }
}

#[test]
fn fails_with_an_unknown_command() {
    let place = Place::new("unknown_command");
    place.refuses(&["rendr", "hello"], &["render"]);
    place.refuses(&["completions", "cmd.exe"], &["bash"]);
    place.refuses(&["show"], &["<SCENE>"]);
}

#[test]
fn fails_with_recordings_that_cannot_be_read() {
    let place = Place::new("recordings");
    std::fs::create_dir(place.0.join("folder")).expect("writable");
    let rows = |with: &str| (0..20).map(|k| format!("a,{k},{}\n", f64::from(k % 3))).collect::<String>() + with;
    let expected = "expected are columns recording,time,value or time,value";
    for (text, words) in [
        (String::new(), &["has no samples", expected][..]),
        ("time,strain\n".to_owned(), &["has no samples", expected]),
        ("1\n2\n".to_owned(), &["bad.csv:1: 1 column", expected]),
        ("a,b,c,d\n".to_owned(), &["bad.csv:1: 4 columns", expected]),
        (rows("a,20\n"), &["bad.csv:21: 2 columns, the first row has 3", expected]),
        (rows("a,20,\n"), &["bad.csv:21: a number is missing", "leave the row out"]),
        (rows("a,20,high\n"), &["bad.csv:21: `high` is no number", "leave the row out"]),
        (rows("a,20,NaN\n"), &["bad.csv:21: recording a: NaN is no number", "leave the row out"]),
        (rows("a,inf,1\n"), &["bad.csv:21: recording a: inf is no number", "leave the row out"]),
        (rows("a,7,1\n"), &["bad.csv:21: recording a: the time 7 s does not come after 19 s", "sort the rows"]),
        (rows("b,0,1\n"), &["recording b: 1 samples, at least 12", expected]),
    ] {
        place.write("bad.csv", &text);
        place.refuses(&["fit", "bad.csv"], words);
    }
    place.write("bad.csv", [rows("").as_bytes(), b"a,20,\xff\n"].concat());
    place.refuses(&["fit", "bad.csv"], &["bad.csv:21: this is not UTF-8 text", "save the file as UTF-8"]);
    place.write("good.csv", rows(""));
    assert!(place.sward(&["fit", "good.csv"]).done().contains("recording"), "control");
    place.refuses(&["fit", "good.csv", "--recording", "A1"], &["has no recording called `A1`", "did you mean `a`?"]);
    place.refuses(&["fit", "gone.csv"], &["gone.csv cannot be read", "check the path"]);
    place.refuses(&["fit", "folder"], &["folder is a folder"]);
    place.refuses(&["fit", "good.csv", "--to", "springs"], &["do not swing", "harmonic"]);
}

#[test]
fn fails_with_responses_that_cannot_be_fitted() {
    let place = Place::new("translations");
    place.write("bare.ron", "(version: 1)");
    for (arguments, words) in [
        (&["fit"][..], &["RECORDING.csv"][..]),
        (&["fit", "--from", "chain"], &["--to"]),
        (&["fit", "x.csv", "--from", "chain", "--to", "continuum"], &["cannot be used with"]),
        (&["fit", "--from", "springs", "--to", "continuum"], &["`Springs` do not swing", "sward fit --help"]),
        (&["fit", "--from", "chain", "--to", "springs"], &["do not swing"]),
        (&["fit", "--from", "chain", "--to", "continuum", "--species", "tree"], &["plants in layers sway as a whole"]),
        (&["fit", "--from", "continuum", "--to", "harmonic", "--species", "lawn"], &["`damping` is", "allowed 0 to 2"]),
        (&["fit", "--scene", "helo", "--to", "chain"], &["did you mean `hello`?"]),
        (&["fit", "--scene", "hello", "--stand", "reeds", "--to", "chain"], &["no stand of hello is called `reeds`", "its stands: "]),
        (&["fit", "--scene", "bare.ron", "--to", "chain"], &["nothing grows in bare"]),
    ] {
        place.refuses(arguments, words);
    }
}
