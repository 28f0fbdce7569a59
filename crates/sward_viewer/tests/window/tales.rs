//! What people do in the window.

use libtest_mimic::Failed;
use serde_json::Value;

use crate::desk::Desk;
use crate::pictures::{difference, part, variety};

/// Three steps a picture, few pixels, fewer plants far away, cells on the processor: the same on every machine.
const USUAL: [&str; 7] = ["--steps", "3", "--pixels", "0.3", "--plants", "0.5", "--cpu"];

fn open(name: &str, scene: &str) -> Result<Desk, Failed> {
    Desk::open(name, &[&[&*scenes(scene)?], &USUAL[..]].concat(), &[])
}

/// A shipped scene with few plants, as a file.
pub(crate) fn scenes(name: &str) -> Result<String, Failed> {
    let Some(shipped) = sward_scenes::shipped(name) else { return Ok(name.to_owned()) };
    let mut scene = sward::scene::Scene::parse(shipped.text, name)?;
    (scene.budget.visible_plants, scene.budget.visible_blades) = (8_000, 8_000);
    for stand in &mut scene.stands {
        stand.cells = Some(48);
    }
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("few plants");
    std::fs::create_dir_all(&folder)?;
    let path = folder.join(format!("{name}.ron"));
    std::fs::write(&path, scene.to_ron())?;
    Ok(path.to_string_lossy().into_owned())
}

fn length(vector: &Value) -> f64 {
    vector[0].as_f64().unwrap_or(0.0).hypot(vector[1].as_f64().unwrap_or(0.0))
}

fn place(body: &Value) -> [f64; 2] {
    [0, 1].map(|axis| body["at"][axis].as_f64().unwrap_or(0.0))
}

fn apart(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// W drives the truck; where it was, plants lie, and beside its way they stand.
pub(crate) fn drive() -> Result<(), Failed> {
    let mut desk = open("drive", "hello")?;
    let idle = desk.shot("drive before")?;
    let picture = desk.pictures(1)?["marks"]["picture"].clone();
    assert!(variety(&part(&idle, &picture)) > 15.0, "the picture is empty");
    desk.key("e")?;
    let begun = desk.wait("somebody at the wheel", |now| now["driving"] == "pickup")?;
    let from = place(&begun["bodies"][0]);
    let still = desk.steps(20)?;
    assert!(apart(from, place(&still["bodies"][0])) < 0.05, "control: nobody pressed a pedal");
    desk.hold("w", true)?;
    let gone = desk.wait("the truck to drive", |now| apart(from, place(&now["bodies"][0])) > 12.0)?;
    desk.hold("d", true)?;
    let before = desk.steps(1)?["wheel"]["yaw"].as_f64().unwrap_or(0.0);
    let turned = desk.steps(60)?;
    desk.hold("d", false)?;
    desk.hold("w", false)?;
    let body = &gone["bodies"][0];
    let (track, beside) = (length(&body["track"]), length(&body["beside"]));
    assert!(track > 0.6 && track > 2.0 * beside, "on its track plants lean {track:.2} rad, beside it {beside:.2}");
    assert!((turned["wheel"]["yaw"].as_f64().unwrap_or(0.0) - before).abs() > 0.2, "it does not steer: {}", turned["wheel"]);
    let after = desk.shot("drive after")?;
    assert!(difference(&part(&idle, &picture), &part(&after, &picture)) > 4.0, "the picture has not changed");
    println!("track {track:.2} rad, beside {beside:.2}");
    Ok(())
}

/// A dragged number and a preset change how far plants lean; undo takes it back.
pub(crate) fn sliders() -> Result<(), Failed> {
    // Plants take a while to settle: more steps a picture.
    let mut desk = Desk::open("sliders", &[&*scenes("reed")?, "--steps", "8", "--pixels", "0.3", "--plants", "0.5", "--cpu"], &[])?;
    desk.key("t")?;
    let middle = desk.place("picture")?;
    desk.click_at([middle[0], middle[1] + 120])?;
    let calm = desk.wait("the probe", |now| now["probe"].is_number())?["probe"].as_f64().unwrap_or(0.0);
    desk.click("presets wind")?;
    desk.click("preset storm")?;
    let bent = desk.wait("plants that lean in the storm", |now| now["probe"].as_f64() > Some(calm + 0.25))?;
    desk.shot("sliders storm")?;
    desk.click("undo")?;
    desk.wait("plants that rise again", |now| now["probe"].as_f64() < Some(calm + 0.15))?;
    // The same with a number that is dragged.
    desk.click("presets wind")?;
    desk.click("preset steady")?;
    desk.click("wind")?;
    desk.click("wind 1 velocity 1")?;
    let before = desk.steps(240)?["probe"].as_f64().unwrap_or(0.0);
    let settled = desk.steps(60)?["probe"].as_f64().unwrap_or(0.0);
    assert!((settled - before).abs() < 0.02, "control: nothing was changed, and yet {before} became {settled}");
    let at = desk.place("wind 1 velocity 1")?;
    desk.key("Escape")?;
    desk.drag(&[at, [at[0] + 20, at[1]], [at[0] + 60, at[1]]])?;
    desk.wait("plants that lean farther", |now| now["probe"].as_f64() > Some(before + 0.1))?;
    desk.shot("sliders dragged")?;
    println!("calm {calm:.3}, storm {}, steady {before:.3}", bent["probe"]);
    Ok(())
}

/// A scene file is edited while it is shown; a mistake in it is told with its place, and what was there goes on.
pub(crate) fn edits() -> Result<(), Failed> {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("edited scene");
    std::fs::create_dir_all(&folder)?;
    let path = folder.join("mine.ron");
    let scene = |name: &str| {
        format!(
            "(\n    version: 1,\n    stands: [(species: Meadow)],\n    interactors: [(name: \"{name}\", shape: Sphere(radius: 0.4), path: Still(at: (0, 6)))],\n    camera: (eye: (0, 2, 0), target: (0, 0.5, 6)),\n)\n"
        )
    };
    std::fs::write(&path, scene("first"))?;
    let mut desk = open("edits", &path.to_string_lossy())?;
    desk.wait("the first scene", |now| now["bodies"][0]["name"] == "first")?;
    std::thread::sleep(std::time::Duration::from_millis(30));
    std::fs::write(&path, scene("second"))?;
    desk.wait("the edited scene", |now| now["bodies"][0]["name"] == "second")?;
    std::thread::sleep(std::time::Duration::from_millis(30));
    std::fs::write(&path, scene("third").replace("radius: 0.4", "radios: 0.4"))?;
    let broken = desk.wait("the mistake", |now| now["problem"].is_string())?;
    let problem = broken["problem"].as_str().unwrap_or_default().to_owned();
    assert!(problem.contains("mine.ron:4:") && problem.contains("radius"), "{problem}");
    let later = desk.steps(20)?;
    assert_eq!(later["bodies"][0]["name"], "second", "the last good scene goes on");
    desk.shot("edits broken")?;
    std::fs::write(&path, scene("third"))?;
    let mended = desk.wait("the mended scene", |now| now["bodies"][0]["name"] == "third")?;
    assert!(mended["problem"].is_null());
    println!("{problem}");
    Ok(())
}

/// The mouse takes a body and drags it; it stays where it was put, and plants lie where it went.
pub(crate) fn hand() -> Result<(), Failed> {
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("in one's hand.ron");
    let text = "(version: 1, stands: [(species: Meadow)], interactors: [(name: \"ball\", shape: Sphere(radius: 0.5), path: Still(at: (0, 7)))], camera: (eye: (0, 2.6, 0), target: (0, 0.3, 7)), budget: (visible_plants: 8000))";
    std::fs::write(&path, text)?;
    let mut desk = open("hand", &path.to_string_lossy())?;
    let still = desk.steps(30)?;
    let from = place(&still["bodies"][0]);
    assert_eq!(from, [0.0, 7.0], "control: nobody has touched it");
    let [x, y] = desk.place("body ball")?;
    desk.point([x, y])?;
    desk.button(true)?;
    for way in 1..=4 {
        desk.point([x + 25 * way, y + 12 * way])?;
    }
    desk.wait("the ball to follow", |now| apart(from, place(&now["bodies"][0])) > 0.8)?;
    desk.shot("hand")?;
    let held = desk.steps(90)?;
    desk.button(false)?;
    let after = desk.steps(60)?;
    let (held, put) = (place(&held["bodies"][0]), place(&after["bodies"][0]));
    assert!(apart(held, put) < 0.05, "it stays where it was put: {held:?} {put:?}");
    assert!(length(&after["bodies"][0]["bend"]) > 0.3, "plants lie under it: {}", after["bodies"][0]);
    println!("from {from:?} to {put:?}");
    Ok(())
}

/// The window is split: the same truck in two responses.
pub(crate) fn compare() -> Result<(), Failed> {
    let mut desk = open("compare", "crossing")?;
    desk.steps(60)?;
    desk.click("compare oscillator")?;
    let split = desk.wait("two pictures", |now| now["split"] == true && now["loading"] == false)?;
    let step = split["step"].as_u64();
    let later = desk.steps(60)?;
    assert!(later["step"].as_u64() > step);
    let shot = desk.shot("compare")?;
    let picture = &later["marks"]["picture"];
    let mut other = picture.clone();
    other[0] = (picture[0].as_f64().unwrap_or(0.0) + picture[2].as_f64().unwrap_or(0.0) + 2.0).into();
    let (left, right) = (part(&shot, picture), part(&shot, &other));
    assert!(variety(&right) > 15.0, "the other half is empty");
    let width = left.width().min(right.width());
    let cut = |half: &image::RgbImage| image::imageops::crop_imm(half, 0, 0, width, half.height()).to_image();
    let apart = difference(&cut(&left), &cut(&right));
    assert!(apart > 0.3, "both halves show the same: {apart}");
    desk.click("compare off")?;
    desk.wait("one picture", |now| now["split"] == false)?;
    println!("halves differ by {apart:.2} code values");
    Ok(())
}

/// Every overlay says something that is true, and draws it.
pub(crate) fn look() -> Result<(), Failed> {
    let mut desk = open("look", "crossing")?;
    desk.steps(90)?;
    desk.key("p")?;
    desk.wait("a pause", |now| now["paused"] == true)?;
    let plain = desk.shot("look nothing")?;
    let again = desk.shot("look nothing")?;
    let picture = desk.pictures(1)?["marks"]["picture"].clone();
    assert_eq!(difference(&part(&plain, &picture), &part(&again, &picture)), 0.0, "control: nothing is drawn over it");
    for (name, kind) in [
        ("bend", "Bend"),
        ("wind", "Wind"),
        ("patches", "Patches"),
        ("contacts", "Contacts"),
        ("lengths", "Lengths"),
        ("penetration", "Penetration"),
    ] {
        desk.click(&format!("look {name}"))?;
        desk.point([2, 2])?;
        let said = desk.wait(name, |now| {
            now["looked"].as_array().is_some_and(|all| all.len() == 1 && all[0].as_str().is_some_and(|said| said.starts_with(kind)))
        })?;
        let shot = desk.shot(&format!("look {name}"))?;
        assert!(difference(&part(&plain, &picture), &part(&shot, &picture)) > 0.05, "{name} draws nothing");
        println!("{}", said["looked"][0]);
        desk.click(&format!("look {name}"))?;
    }
    desk.click("look ω")?;
    desk.key("p")?;
    desk.steps(8)?;
    let said = desk.pictures(1)?["looked"][0].as_str().unwrap_or_default().to_owned();
    assert!(said.starts_with("Rate") && !said.ends_with(" 0.000"), "{said}");
    desk.click("milliseconds")?;
    desk.pictures(8)?;
    desk.shot("look rates and milliseconds")?;
    Ok(())
}

/// Wind is painted with the mouse, and blows.
pub(crate) fn paint() -> Result<(), Failed> {
    let mut desk = open("paint", "lawn")?;
    desk.click("presets wind")?;
    desk.click("preset calm")?;
    desk.key("t")?;
    let middle = desk.place("picture")?;
    desk.click_at([middle[0], middle[1] + 100])?;
    let calm = desk.steps(240)?["probe"].as_f64().unwrap_or(1.0);
    assert!(calm < 0.05, "control: no wind, {calm}");
    desk.click("paint wind")?;
    let [x, y] = desk.place("canvas")?;
    let before = desk.shot("paint before")?;
    desk.drag(&[[x - 110, y + 60], [x - 40, y - 30], [x + 40, y + 30], [x + 110, y - 60]])?;
    desk.click("blow")?;
    desk.wait("plants that lean in painted wind", |now| now["probe"].as_f64() > Some(calm + 0.02))?;
    let after = desk.shot("paint")?;
    assert!(difference(&before, &after) > 0.3, "the canvas shows nothing");
    Ok(())
}

/// F9 records a clip.
pub(crate) fn record() -> Result<(), Failed> {
    let mut desk = Desk::open("record", &[&*scenes("lawn")?, "--pixels", "0.2", "--cpu", "--steps", "2"], &[])?;
    desk.key("F9")?;
    desk.pictures(8)?;
    desk.key("F9")?;
    let done = desk.wait("the clip", |now| now["notice"].is_string())?;
    let clip = std::fs::read(desk.folder.join("lawn.mp4"))?;
    assert!(clip.len() > 1000 && clip.windows(4).any(|four| four == b"av01"), "{} bytes", clip.len());
    println!("{}", done["notice"]);
    Ok(())
}

/// On a screen of twice as many pixels everything has twice as many.
pub(crate) fn fine() -> Result<(), Failed> {
    let mut desk =
        Desk::open("fine", &[&*scenes("hello")?, "--pixels", "0.2", "--cpu", "--steps", "1"], &[("WINIT_X11_SCALE_FACTOR", "2")])?;
    let now = desk.wait("a mark", |now| now["marks"]["pause"].is_array())?;
    desk.shot("fine")?;
    let height = now["marks"]["pause"][3].as_f64().unwrap_or(0.0);
    drop(desk);
    let mut desk =
        Desk::open("coarse", &[&*scenes("hello")?, "--pixels", "0.2", "--cpu", "--steps", "1"], &[("WINIT_X11_SCALE_FACTOR", "1")])?;
    let once = desk.wait("a mark", |now| now["marks"]["pause"].is_array())?["marks"]["pause"][3].as_f64().unwrap_or(0.0);
    assert!((height - 2.0 * once).abs() < 2.0 && once > 14.0, "{once} and {height} pixels");
    Ok(())
}
