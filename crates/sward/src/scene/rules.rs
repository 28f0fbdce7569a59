//! Checks that no single range can express: what must agree, be unique, or come in order.

mod wind;

use super::error::{Problem, Trail};
use super::explain::suggest;
use super::locate::locate;
use super::{Area, Blade, Camera, FORMAT_VERSION, Interactor, Layered, Path, PlantMesh, Scene, Shape, Stand, Terrain, Value, WindSource};

type Checked = Result<(), Problem>;

/// Tallest grass, m.
const TALLEST: f32 = 5.0;
/// Most parts of a compound.
const MOST_PARTS: usize = 32;

/// All checks over a scene whose single numbers are in range.
pub(super) fn check(scene: &Scene) -> Checked {
    terrain(&scene.terrain)?;
    let stands = Trail::default().key("stands");
    each(&scene.stands, &stands, stand)?;
    unique(scene.stands.iter().map(Stand::label), &stands, "stands")?;
    growth(scene)?;
    edits(scene)?;
    let interactors = Trail::default().key("interactors");
    each(&scene.interactors, &interactors, interactor)?;
    unique(scene.interactors.iter().map(|body| body.name.clone()), &interactors, "interactors")?;
    wind::check(&scene.wind, &scene.interactors)?;
    camera(&scene.camera, &scene.interactors)?;
    surroundings(scene)
}

/// An environment is a file.
fn surroundings(scene: &Scene) -> Checked {
    match &scene.light.environment {
        Some(environment) if environment.file.is_empty() => {
            let place = Trail::default().key("light").key("environment").key("file");
            Err(Problem::at(place, "`file` is empty").help("name a picture, like \"park.hdr\""))
        }
        _ => Ok(()),
    }
}

/// Refuses a file of a newer format before its unknown names are complained about.
pub(super) fn not_newer(text: &str) -> Checked {
    let trail = Trail::default().key("version");
    let value = &text.as_bytes()[locate(text, &trail)..];
    let digits = value.iter().take_while(|byte| byte.is_ascii_digit());
    let version = digits.fold(0_u32, |sum, digit| sum.saturating_mul(10).saturating_add(u32::from(digit - b'0')));
    if version <= FORMAT_VERSION {
        return Ok(());
    }
    let message = format!("this file needs a newer sward: it has format version {version}");
    Err(Problem::at(trail, message).help(format!("this one reads version {FORMAT_VERSION}")))
}

fn each<T>(list: &[T], trail: &Trail, rule: impl Fn(&T, &Trail) -> Checked) -> Checked {
    list.iter().enumerate().try_for_each(|(index, one)| rule(one, &trail.clone().index(index)))
}

fn unique(names: impl Iterator<Item = String>, trail: &Trail, what: &str) -> Checked {
    let mut seen = std::collections::HashSet::new();
    for (index, name) in names.enumerate() {
        if !name.is_empty() && !seen.insert(name.clone()) {
            let message = format!("two {what} are called `{name}`");
            let place = trail.clone().index(index).key("name");
            return Err(Problem::at(place, message).help("give one of them another `name`"));
        }
    }
    Ok(())
}

fn terrain(terrain: &Terrain) -> Checked {
    match terrain {
        Terrain::Image(image) if image.path.is_empty() => {
            let place = Trail::default().key("terrain").key("path");
            Err(Problem::at(place, "`path` is empty").help("name a PNG or TIFF, like \"assets/jacksboro.png\""))
        }
        _ => Ok(()),
    }
}

/// What is said of meshes in layers.
fn layered_stand(layered: &Layered, trail: &Trail) -> Checked {
    let cells = layered.harmonic.cells;
    if !cells.is_power_of_two() {
        let (below, above) = (cells.next_power_of_two() / 2, cells.next_power_of_two());
        let message = format!("`cells` is {cells}, allowed are powers of two");
        return Err(Problem::at(trail.clone().key("response").key("cells"), message).help(format!("{below} or {above}")));
    }
    let layers = trail.clone().key("representation");
    let [near, mid] = layered.layers.bands;
    if near > mid {
        let message = format!("`bands` end at {near} and then at {mid}");
        return Err(Problem::at(layers.key("bands"), message).help(format!("({mid}, {near})")));
    }
    match &layered.layers.mesh {
        PlantMesh::File(file) if file.path.is_empty() => {
            let place = layers.key("mesh").key("path");
            Err(Problem::at(place, "`path` is empty").help("name a file, like \"assets/oak.glb\""))
        }
        _ => Ok(()),
    }
}

fn stand(stand: &Stand, trail: &Trail) -> Checked {
    if let Some(cells) = stand.cells.filter(|cells| !cells.is_multiple_of(8)) {
        let (below, above) = (cells / 8 * 8, cells / 8 * 8 + 8);
        let message = format!("`cells` is {cells}, allowed are multiples of 8");
        return Err(Problem::at(trail.clone().key("cells"), message).help(format!("{below} or {above}")));
    }
    let model = stand.resolve_at(trail)?;
    if let Some(layered) = &model.layered {
        layered_stand(layered, trail)?;
    }
    if model.layered.is_none() && model.height[1] > TALLEST {
        let message = format!("`height` is {} m, allowed 0.01 to {TALLEST}", model.height[1]);
        return Err(Problem::at(trail.clone().key("height"), message).help("taller plants are meshes: `species: Shrub` or `Tree`"));
    }
    if model.height[0] > model.height[1] {
        let [low, high] = model.height;
        let message = format!("`height` runs from {low} down to {high}");
        return Err(Problem::at(trail.clone().key("height"), message).help(format!("({high}, {low})")));
    }
    if let Some(blade) = &model.blade {
        blades(blade, &trail.clone().key("representation"))?;
    }
    if let Some([low, high]) = stand.slope.filter(|[low, high]| low > high) {
        let message = format!("`slope` runs from {low} down to {high}");
        return Err(Problem::at(trail.clone().key("slope"), message).help(format!("({high}, {low})")));
    }
    Ok(())
}

/// Numbers of pieces fall with distance, and distances rise.
fn blades(blade: &Blade, trail: &Trail) -> Checked {
    let [near, middle, far] = blade.pieces;
    if near < middle || middle < far {
        let mut falling = blade.pieces;
        falling.sort_by(|a, b| b.cmp(a));
        let message = format!("`pieces` rise with distance: {near}, {middle}, {far}");
        return Err(Problem::at(trail.clone().key("pieces"), message).help(format!("{falling:?}").replace('[', "(").replace(']', ")")));
    }
    let [second, third] = blade.piece_distances;
    if second > third {
        let message = format!("`piece_distances` run from {second} down to {third}");
        return Err(Problem::at(trail.clone().key("piece_distances"), message).help(format!("({third}, {second})")));
    }
    if blade.thinning.iter().all(|term| *term == 0.0) {
        let message = "all of `thinning` is 0";
        return Err(Problem::at(trail.clone().key("thinning"), message).help("(0.15, 0.006, 0.0012)"));
    }
    Ok(())
}

/// Most points of a road or an outline.
const MOST_POINTS: usize = 256;
/// Most masks: together they stay far below what one binding of a GPU holds.
const MOST_MASKS: usize = 8;

fn growth(scene: &Scene) -> Checked {
    let trail = Trail::default().key("exclusions");
    each(&scene.exclusions, &trail, |exclusion, trail| {
        let points = |points: &[[f64; 2]], least: usize| {
            let place = trail.clone().key("area").key("points");
            match points.len() {
                count if (least..=MOST_POINTS).contains(&count) => Ok(()),
                count => Err(Problem::at(place, format!("`points` has {count}, allowed {least} to {MOST_POINTS}"))),
            }
        };
        match &exclusion.area {
            Area::Polygon(outline) => points(&outline.points, 3)?,
            Area::Road(road) => points(&road.points, 2)?,
            Area::Box(_) | Area::Disc(_) => (),
        }
        known_stands(&exclusion.stands, &scene.stands, trail)
    })?;
    let trail = Trail::default().key("masks");
    if scene.masks.len() > MOST_MASKS {
        let message = format!("this is one mask more than {MOST_MASKS}");
        return Err(Problem::at(trail.index(MOST_MASKS), message).help("paint several into one picture"));
    }
    each(&scene.masks, &trail, |mask, trail| {
        if mask.path.is_empty() && mask.direction.is_empty() && mask.messiness.is_empty() {
            let help = "name a PNG of how much grows, like path: \"assets/clearing.png\", or a `direction`, or a `messiness`";
            return Err(Problem::at(trail.clone(), "this mask has no picture").help(help));
        }
        known_stands(&mask.stands, &scene.stands, trail)
    })
}

/// Room that one edit takes beyond its own square, m.
const EDIT_MARGIN: f64 = 36.0;
/// Largest rectangle round all edits, m².
const EDITED: f64 = 524_288.0;

fn edits(scene: &Scene) -> Checked {
    let trail = Trail::default().key("edits");
    each(&scene.edits, &trail, |edit, trail| known_stands(&edit.stands, &scene.stands, trail))?;
    let (mut low, mut high) = ([f64::MAX; 2], [f64::MIN; 2]);
    for (index, edit) in scene.edits.iter().enumerate().filter(|(_, edit)| edit.change.is_of_ground()) {
        for axis in 0..2 {
            low[axis] = low[axis].min(edit.at[axis] - f64::from(edit.radius));
            high[axis] = high[axis].max(edit.at[axis] + f64::from(edit.radius));
        }
        let [x, z] = [0, 1].map(|axis| high[axis] - low[axis]);
        if (x + EDIT_MARGIN) * (z + EDIT_MARGIN) > EDITED {
            let place = trail.index(index).key("at");
            let message = format!("the edits up to this one span {x} m x {z} m");
            return Err(Problem::at(place, message).help("keep them within 680 m x 680 m of each other"));
        }
    }
    Ok(())
}

/// Every name is that of a stand.
fn known_stands(names: &[String], stands: &[Stand], trail: &Trail) -> Checked {
    let labels: Vec<String> = stands.iter().map(Stand::label).collect();
    let known: Vec<&str> = labels.iter().map(String::as_str).collect();
    match names.iter().enumerate().find(|(_, name)| !known.contains(&name.as_str())) {
        Some((index, name)) => {
            let place = trail.clone().key("stands").index(index);
            Err(Problem::at(place, format!("no stand is called `{name}`")).help(suggest(name, &known)))
        }
        None => Ok(()),
    }
}

/// Whether a body may take place `place` (or the next one) of a scene's.
pub(super) fn body_in(scene: &Scene, place: usize, body: &Interactor) -> Checked {
    let trail = Trail::default().key("interactors").index(place);
    body.check(&trail)?;
    interactor(body, &trail)?;
    let named = |other: &(usize, &Interactor)| other.0 != place && !body.name.is_empty() && other.1.name == body.name;
    match scene.interactors.iter().enumerate().find(named) {
        Some(_) => {
            let message = format!("two interactors are called `{}`", body.name);
            Err(Problem::at(trail.key("name"), message).help("give one of them another `name`"))
        }
        None => Ok(()),
    }
}

/// Whether a path may be that of body number `place`.
pub(super) fn path_of(place: usize, given: &Path) -> Checked {
    let trail = Trail::default().key("interactors").index(place);
    given.check(&trail.clone().key("path"))?;
    path(given, &trail)
}

/// Whether the wind of a scene may be these sources.
pub(super) fn winds_in(sources: &Vec<WindSource>, interactors: &[Interactor]) -> Checked {
    sources.check(&Trail::default().key("wind"))?;
    wind::check(sources, interactors)
}

/// Whether a stand of a scene may be so.
pub(super) fn stand_in(place: usize, given: &Stand) -> Checked {
    let trail = Trail::default().key("stands").index(place);
    given.check(&trail)?;
    stand(given, &trail)
}

fn interactor(body: &Interactor, trail: &Trail) -> Checked {
    shape(&body.shape, &trail.clone().key("shape"))?;
    if body.from >= body.until {
        let message = format!("`until` is {} s, but `from` is {} s", body.until, body.from);
        return Err(Problem::at(trail.clone().key("until"), message).help("`until` is later than `from`"));
    }
    path(&body.path, trail)
}

fn path(path: &Path, trail: &Trail) -> Checked {
    if let Path::Keyframes(keyframes) = path {
        let keys = trail.clone().key("path").key("keys");
        if keyframes.keys.is_empty() {
            return Err(Problem::at(keys, "`keys` is empty").help("give a place at a time: (time: 0, at: (0, 0))"));
        }
        if keyframes.repeat && keyframes.keys.len() < 2 {
            return Err(Problem::at(keys, "`repeat` needs at least two keys"));
        }
        return increasing(keyframes.keys.iter().map(|key| key.time), &keys);
    }
    Ok(())
}

fn increasing(times: impl Iterator<Item = f64>, trail: &Trail) -> Checked {
    let mut last = None;
    for (index, time) in times.enumerate() {
        if let Some(before) = last
            && time <= before
        {
            let message = format!("`time` is {time} s, but the key before it is at {before} s");
            let place = trail.clone().index(index).key("time");
            return Err(Problem::at(place, message).help("order the keys by increasing time"));
        }
        last = Some(time);
    }
    Ok(())
}

fn shape(shape: &Shape, trail: &Trail) -> Checked {
    match shape {
        Shape::Polygon(polygon) => convex(&polygon.points, &trail.clone().key("points")),
        Shape::Compound(compound) => {
            let parts = trail.clone().key("parts");
            if compound.parts.is_empty() || compound.parts.len() > MOST_PARTS {
                let message = format!("`parts` has {}, allowed 1 to {MOST_PARTS}", compound.parts.len());
                return Err(Problem::at(parts, message));
            }
            each(&compound.parts, &parts, |part, trail| simple(&part.shape, &trail.clone().key("shape")))
        }
        Shape::Mesh(mesh) if mesh.file.is_empty() => {
            let place = trail.clone().key("file");
            Err(Problem::at(place, "`file` is empty").help("name a glTF file, like \"bodies/fox.glb\""))
        }
        _ => Ok(()),
    }
}

/// The shape of a part: anything that is not made of parts itself.
fn simple(part: &Shape, trail: &Trail) -> Checked {
    match part {
        Shape::Truck | Shape::Compound(_) | Shape::Mesh(_) => {
            let message = "a part is neither a `Truck` nor a `Mesh` nor a `Compound`";
            Err(Problem::at(trail.clone(), message).help("known: Box, Polygon, Sphere, Ellipsoid"))
        }
        other => shape(other, trail),
    }
}

/// A polygon is convex if it turns the same way at every corner, and once round in all.
fn convex(points: &[[f32; 2]], trail: &Trail) -> Checked {
    if !(3..=16).contains(&points.len()) {
        let message = format!("`points` has {}, allowed 3 to 16", points.len());
        return Err(Problem::at(trail.clone(), message));
    }
    let corner = |index: usize| points[index % points.len()].map(f64::from);
    let edge = |index| {
        let ([ax, az], [bx, bz]) = (corner(index), corner(index + 1));
        [bx - ax, bz - az]
    };
    let turns: Vec<f64> = (0..points.len())
        .map(|index| {
            let ([ax, az], [bx, bz]) = (edge(index), edge(index + 1));
            ax * bz - az * bx
        })
        .collect();
    let one_way = turns.iter().all(|&turn| turn > 0.0) || turns.iter().all(|&turn| turn < 0.0);
    // A star turns one way at every corner too, but its edges change between left and right more than twice.
    let rightward = |index| edge(index)[0] > 0.0 || (edge(index)[0] == 0.0 && edge(index)[1] > 0.0);
    let changes = (0..points.len()).filter(|&index| rightward(index) != rightward(index + 1)).count();
    if one_way && changes == 2 {
        return Ok(());
    }
    let help = "list the corners in order round a convex outline; make a concave body a `Compound`";
    Err(Problem::at(trail.clone(), "`points` is not a convex polygon").help(help))
}

fn camera(camera: &Camera, interactors: &[Interactor]) -> Checked {
    let trail = Trail::default().key("camera");
    let target = trail.clone().key("target");
    looks_somewhere(camera.eye, camera.target, target)?;
    let keys = trail.clone().key("keys");
    increasing(camera.keys.iter().map(|key| key.time), &keys)?;
    each(&camera.keys, &keys, |key, trail| looks_somewhere(key.eye, key.target, trail.clone().key("target")))?;
    match &camera.follow {
        Some(follow) => known(follow, interactors, trail.key("follow")),
        None => Ok(()),
    }
}

/// `follow` is the name of an interactor.
fn known(follow: &str, interactors: &[Interactor], place: Trail) -> Checked {
    let names: Vec<&str> = interactors.iter().map(|body| body.name.as_str()).filter(|name| !name.is_empty()).collect();
    if names.contains(&follow) {
        return Ok(());
    }
    let help = if names.is_empty() { "give an interactor a `name`".to_owned() } else { suggest(follow, &names) };
    Err(Problem::at(place, format!("no interactor is called `{follow}`")).help(help))
}

fn looks_somewhere(eye: [f64; 3], target: [f64; 3], trail: Trail) -> Checked {
    if eye == target {
        return Err(Problem::at(trail, "`target` is where the eye is").help("move one of them"));
    }
    Ok(())
}
