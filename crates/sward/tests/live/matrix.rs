//! Everything meets everything: each response with each representation that goes with it, in each wind, under each shape of body.
//!
//! All of them are enumerated from the scene format, so a new variant joins by itself. One world holds all responses and representations as stands on
//! the same ground; there is one world for each source of wind and each shape.

use sward::interaction::solid::WorldSolid;
use sward::model::Folder;
use sward::picture::standing::{StandingPlant, standing};
use sward::placement;
use sward::response::springs::pool;
use sward::scene::inspect::Choice;
use sward::scene::{
    BladeOverrides, Interactor, Key, Keyframes, LayersOverrides, Path, PlantMesh, Representation, Response, Scene, Shape, Species, Stand,
    WindSource, response,
};
use sward::world::World;

/// Steps until the body comes, three while it is there, and until all has settled.
const MOMENTS: [u64; 5] = [20, 30, 40, 50, 200];
/// Those moments while the body is there.
const THERE: std::ops::RangeInclusive<usize> = 1..=3;
/// Where the body is then, m.
const PASSED: [[f64; 2]; 3] = [[2.3, 2.7], [2.7, 2.9], [3.1, 3.1]];
/// What is looked at, m.
const REGION: [[f64; 2]; 2] = [[1.0, 1.0], [5.0, 5.0]];

/// All variants of a choice, as fresh ones.
fn variants<T: Choice + Clone>(first: &T) -> Vec<(&'static str, T)> {
    let fresh = |index: usize| {
        let mut one = first.clone();
        one.choose(index);
        (first.variants()[index].name, one)
    };
    (0..first.variants().len()).map(fresh).collect()
}

/// A stand of a response and a representation; it settles soon. `None` with the reason where the two make no sense together.
fn stand(number: usize, (name, moved): (&str, Response), (shown_as, shown): (&str, Representation)) -> Result<Stand, String> {
    let soon = [
        "Continuum(damping: 0.7)",
        "Oscillator(damping: 0.7)",
        "Springs(recover: 0.7)",
        "Chain(damping: 0.7)",
        "VirtualInertia(damping: 0.7)",
    ];
    let known = soon.iter().chain(&["Harmonic(frequency: 1.5, damping: 0.7)"]).find(|text| text.starts_with(&format!("{name}(")));
    let response = known.map_or(moved, |text| response(text).unwrap());
    let representation = match shown {
        // Small ones: what counts is that they hold.
        Representation::Blade(_) => {
            Representation::Blade(BladeOverrides { blades: Some(2), segments: Some(3), ..BladeOverrides::default() })
        }
        Representation::Layers(_) => {
            let mut grown = Species::Shrub.layers().mesh;
            if let PlantMesh::Grown(grown) = &mut grown {
                grown.triangles = 2000;
            }
            Representation::Layers(LayersOverrides { mesh: Some(grown), ..LayersOverrides::default() })
        }
        other => other,
    };
    let species = if matches!(response, Response::Harmonic(_)) { Species::Shrub } else { Species::Meadow };
    let (cells, cover) = if species == Species::Shrub { (8, 0.7) } else { (16, 1.0) };
    let (response, representation, name) = (Some(response), Some(representation), format!("{name} as {shown_as} {number}"));
    let stand = Stand { name, species, cells: Some(cells), cover, response, representation, ..Stand::default() };
    let scene = Scene { stands: vec![stand.clone()], ..Scene::default() };
    scene.validate().map_err(|error| error.to_string())?;
    Ok(stand)
}

/// Every response with every representation, and why some do not go together.
fn stands() -> (Vec<Stand>, Vec<String>) {
    let (mut found, mut refused) = (Vec::new(), Vec::new());
    for moved in variants(&Response::Continuum(Default::default())) {
        for shown in variants(&Representation::Billboard(Default::default())) {
            match stand(found.len(), (moved.0, moved.1.clone()), (shown.0, shown.1.clone())) {
                Ok(stand) => found.push(stand),
                Err(why) => refused.push(format!("{} as {}: {why}", moved.0, shown.0)),
            }
        }
    }
    (found, refused)
}

/// A body of a shape that passes, and is gone after a second.
fn body(mut shape: Shape) -> Interactor {
    if let Shape::Mesh(mesh) = &mut shape {
        mesh.file = "assets/torus.glb".to_owned();
    }
    let key = |moment: usize| Key { time: MOMENTS[moment] as f64 / 60.0, at: PASSED[moment - 1], ..Key::default() };
    let keys = THERE.map(key).collect();
    let path = Path::Keyframes(Keyframes { keys, repeat: false });
    Interactor { shape, path, from: 0.34, until: 0.95, ..Interactor::default() }
}

fn world(stands: &[Stand], wind: Option<WindSource>, shape: Option<&Shape>) -> World {
    let text = "(version: 1, field: (patch_side: 8, patches: (2, 1)), camera: (eye: (3, 2, 1), target: (3, 0.5, 4)),
                 budget: (patches: 9, focus_distance: 7, lag_distance: 10))";
    let mut scene = Scene::parse(text, "matrix.ron").unwrap();
    scene.stands = stands.to_vec();
    scene.wind = wind.into_iter().collect();
    scene.interactors = shape.into_iter().map(|shape| body(shape.clone())).collect();
    World::new(scene, &Folder(concat!(env!("CARGO_MANIFEST_DIR"), "/../..").into())).unwrap_or_else(|error| panic!("{error}"))
}

/// How a stand looks at a moment.
struct Look {
    /// Its plants; of meshes none.
    plants: Vec<StandingPlant>,
    /// All points of them; of meshes the cells of their waves.
    points: Vec<f64>,
}

impl Look {
    fn of(world: &World, stand: usize) -> Self {
        if let Some(grass) = world.model.stands.iter().position(|model| model.index == stand) {
            let plants = standing(world, grass, REGION, 400);
            let points = plants.iter().flat_map(|plant| plant.points.iter().flatten().copied()).collect();
            return Self { plants, points };
        }
        let number = world.model.layered.iter().position(|model| model.index == stand).unwrap();
        let state = &world.state.layered[number];
        let touched = state.pool.taken().filter_map(|(_, place)| state.touches.get(place as usize));
        let cells = state.waves.now.iter().chain(touched.flat_map(|waves| &waves.now));
        Self { plants: Vec::new(), points: cells.flatten().map(|value| f64::from(*value)).collect() }
    }

    /// Mean height of the tips of plants rooted within 0.6 m of a place; `None` without plants.
    fn height_at(&self, place: [f64; 2]) -> Option<f64> {
        let near = |plant: &&StandingPlant| (plant.points[0][0] - place[0]).hypot(plant.points[0][2] - place[1]) < 0.6;
        let tips: Vec<f64> = self.plants.iter().filter(near).filter_map(|plant| plant.points.last()).map(|tip| tip[1]).collect();
        (!tips.is_empty()).then(|| tips.iter().sum::<f64>() / tips.len() as f64)
    }
}

/// How all stands look at all moments, and the bodies then.
struct Run {
    looks: Vec<Vec<Look>>,
    bodies: Vec<Vec<WorldSolid>>,
    /// How deep the deepest point that bodies push is in one, m.
    depths: Vec<Vec<f64>>,
}

impl Run {
    fn of(mut world: World, step: &mut dyn FnMut(&mut World, u64)) -> Self {
        let mut run = Self { looks: Vec::new(), bodies: Vec::new(), depths: Vec::new() };
        for moment in MOMENTS {
            step(&mut world, moment);
            run.looks.push((0..world.scene.stands.len()).map(|stand| Look::of(&world, stand)).collect());
            let bodies = world.solids_now();
            let deepest = |stand: usize| {
                let points = pushed_points(&world, stand, &bodies).into_iter();
                points.flat_map(|point| bodies.iter().map(move |body| body.depth(point))).fold(0.0, f64::max)
            };
            run.depths.push((0..world.scene.stands.len()).map(deepest).collect());
            run.bodies.push(bodies);
        }
        run
    }
}

fn apart(a: &Look, b: &Look) -> f64 {
    let (a, b) = (&a.points, &b.points);
    let more = a.iter().skip(b.len()).chain(b.iter().skip(a.len())).fold(0.0, |most: f64, x| most.max(x.abs()));
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(more, f64::max)
}

/// Deepest that a point may be in a body, m, where points are pushed out of it one by one: joints of blades, vertices of sheets. The body appears among
/// plants all at once, and what stands in its corners finds out of them later.
fn depth_allowed(stand: &Stand, shape: &Shape) -> Option<f64> {
    match (&stand.response, &stand.representation) {
        // Sheets meet the true shape of a mesh, these depths are in its convex pieces.
        (Some(Response::Springs(_)), _) if matches!(shape, Shape::Mesh(_)) => None,
        // Surfaces through joints are smooth, and blades have more points than joints.
        (Some(Response::Chain(_) | Response::VirtualInertia(_)), Some(Representation::Billboard(_) | Representation::Blade(_))) => {
            Some(0.030)
        }
        (Some(Response::Springs(_)), _) => Some(0.020),
        _ => None,
    }
}

/// Whether a body stands on a place of the ground.
fn stood_on(bodies: &[WorldSolid], [x, z]: [f64; 2]) -> bool {
    bodies.iter().any(|body| body.depth([x, 0.02, z]) > 0.0)
}

/// Points of a stand that bodies push, of plants on whose roots none stands: what does lies down under it.
fn pushed_points(world: &World, stand: usize, bodies: &[WorldSolid]) -> Vec<[f64; 3]> {
    let Some(index) = world.model.stands.iter().position(|model| model.index == stand) else { return Vec::new() };
    let (model, state) = (&world.model.stands[index], &world.state.stands[index]);
    let Some(springs) = &model.springs else {
        let plants = standing(world, index, REGION, 400);
        let free = plants.into_iter().filter(|plant| !stood_on(bodies, [plant.points[0][0], plant.points[0][2]]));
        return free.flat_map(|plant| plant.points.into_iter().skip(1)).collect();
    };
    let (words, (columns, rows)) = (pool::words(&springs.coefficients), springs.coefficients.sides());
    let mut points = Vec::new();
    for ((patch, cell), place) in state.sheets.pool.taken() {
        let corner = patch.map(|along| f64::from(along) * model.patch_side);
        let at = [cell % model.cells, cell / model.cells];
        let Some(plant) = placement::plant(&model.placement, patch, at) else { continue };
        let (sine, cosine) = plant.yaw.sin_cos();
        let foot = |share: f32| {
            let half = share * 0.5 * springs.width;
            [corner[0] + f64::from(plant.root[0] + half * cosine), corner[1] + f64::from(plant.root[1] + half * sine)]
        };
        if [-1.0, 0.0, 1.0].into_iter().any(|share| stood_on(bodies, foot(share))) {
            continue;
        }
        let sheet = &state.cells.sheets[place as usize * words..][..3 * columns * (rows - 1)];
        let number = |word: u32| f64::from(f32::from_bits(word));
        points.extend(sheet.chunks_exact(3).map(|v| [corner[0] + number(v[0]), number(v[1]), corner[1] + number(v[2])]));
    }
    points
}

/// All cells of one wind and one shape, against the same without either; what does not hold.
fn wrong_of(stands: &[Stand], shape: &Shape, run: &Run, [calm, alone]: [&Run; 2]) -> Vec<String> {
    let mut wrong = Vec::new();
    for (index, stand) in stands.iter().enumerate() {
        let mut refuse = |why: String| wrong.push(format!("{}: {why}", stand.label()));
        let by_wind = apart(&run.looks[0][index], &calm.looks[0][index]);
        let by_body: Vec<f64> = (0..MOMENTS.len()).map(|moment| apart(&run.looks[moment][index], &alone.looks[moment][index])).collect();
        let peak = by_body[THERE].iter().copied().fold(0.0, f64::max);
        if by_wind < 1e-3 {
            refuse(format!("wind moves nothing, {by_wind}"));
        }
        if by_body[0] > 1e-6 || peak < 0.02 {
            refuse(format!("before the body comes {}, while it is there {peak}", by_body[0]));
        }
        if by_body[MOMENTS.len() - 1] > 0.2 * peak + 2e-3 {
            refuse(format!("it does not settle, {} of {peak}", by_body[MOMENTS.len() - 1]));
        }
        // Smooth surfaces through bent chains are a little longer.
        let longest = if matches!(stand.representation, Some(Representation::Sheet(_))) { 1.01 } else { 1.002 };
        for (moment, looks) in run.looks.iter().enumerate() {
            let look = &looks[index];
            if look.points.is_empty() || !look.points.iter().all(|value| value.is_finite()) {
                refuse(format!("nothing there, or not finite, at step {}", MOMENTS[moment]));
            }
            for plant in &look.plants {
                // Less only where the ground holds it up.
                let (stretch, lowest) = (plant.stretch(), plant.points.iter().map(|point| point[1]).fold(f64::MAX, f64::min));
                if !(0.90..longest).contains(&stretch) || lowest < -1e-3 {
                    refuse(format!("at step {} {stretch} times as long, or below ground: {lowest} m", MOMENTS[moment]));
                    break;
                }
            }
        }
        for moment in THERE {
            let (own, free, bodies) = (&run.looks[moment][index], &alone.looks[moment][index], &run.bodies[moment]);
            let deepest = run.depths[moment][index];
            if depth_allowed(stand, shape).is_some_and(|allowed| deepest > allowed) {
                refuse(format!("{deepest} m deep in the body at step {}", MOMENTS[moment]));
            }
            // What stands under the body stands no higher than without it.
            let middle = PASSED[moment - 1];
            let stands = bodies.iter().any(|body| body.depth([middle[0], 0.05, middle[1]]) > 0.0);
            let heights = own.height_at(middle).zip(free.height_at(middle)).filter(|_| stands);
            if let Some((own, free)) = heights.filter(|(own, free)| *own > 1.05 * free) {
                refuse(format!("at step {} plants stand {own} m high under the body, {free} m without it", MOMENTS[moment]));
            }
        }
    }
    wrong
}

/// The sources of wind, each strong enough to be seen.
fn winds() -> Vec<(&'static str, WindSource)> {
    let mut winds = variants(&WindSource::Uniform(Default::default()));
    for (_, wind) in &mut winds {
        match wind {
            WindSource::Footprint(print) => (print.speed, print.radius) = (8.0, 9.0),
            // Air that forgets the body before the last moment.
            WindSource::Fluid(fluid) => (fluid.cells, fluid.side, fluid.fade) = (32, 16.0, 0.5),
            WindSource::Uniform(_) | WindSource::Natural(_) => (),
        }
    }
    winds
}

/// The shapes of bodies.
fn shapes() -> Vec<(&'static str, Shape)> {
    variants(&Shape::Truck)
}

fn on_cpu(world: &mut World, last: u64) {
    while world.state.step < last {
        world.step();
    }
}

/// Runs all cells and their controls; prints how many hold and returns what does not. `run` steps a world, which it sees for the first time, until
/// a step. Unless `every` wind meets every shape, each shape meets one wind.
pub(crate) fn all(run: &mut dyn FnMut(&mut World, u64), every: bool) -> Vec<String> {
    let (stands, refused) = stands();
    println!("{} stands; refused, with reasons:", stands.len());
    refused.iter().for_each(|why| println!("  {}", why.replace('\n', ";")));
    let (winds, shapes) = (winds(), shapes());
    let calm: Vec<Run> = shapes.iter().map(|(_, shape)| Run::of(world(&stands, None, Some(shape)), run)).collect();
    let (mut cells, mut wrong) = (0, Vec::new());
    for (first, (wind, source)) in winds.iter().enumerate() {
        let alone = Run::of(world(&stands, Some(source.clone()), None), run);
        for (second, (shape, body)) in shapes.iter().enumerate().filter(|(second, _)| every || second % winds.len() == first) {
            let own = Run::of(world(&stands, Some(source.clone()), Some(body)), run);
            let found = wrong_of(&stands, body, &own, [&calm[second], &alone]);
            cells += stands.len();
            wrong.extend(found.into_iter().map(|why| format!("{wind}, {shape}: {why}")));
        }
    }
    println!("{} of {cells} cells hold", cells - wrong.len().min(cells));
    // Control: where neither wind nor body does anything, every cell is found wrong twice.
    let control = wrong_of(&stands, &shapes[0].1, &calm[0], [&calm[0], &calm[0]]);
    assert!(control.len() >= 2 * stands.len(), "{control:#?}");
    wrong
}

#[test]
fn what_makes_no_sense_is_refused_with_a_reason() {
    let (stands, refused) = stands();
    // Whoever adds a variant says with what it goes.
    assert!(
        stands.len() >= 16 && refused.len() <= 8 && stands.len() + refused.len() == Response::NAMES.len() * Representation::NAMES.len(),
        "{refused:#?}"
    );
    assert!(refused.iter().all(|why| why.len() > 40), "{refused:#?}");
}

#[test]
fn everything_meets_everything() {
    let wrong = all(&mut on_cpu, !cfg!(debug_assertions));
    assert!(wrong.is_empty(), "{wrong:#?}");
}
