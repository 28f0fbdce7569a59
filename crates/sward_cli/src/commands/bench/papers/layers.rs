//! Chen & Johan 2015, §4, Table 1: plants of 80 thousand and of 50 million faces, in 3 and in 5 layers.

use sward::scene::Scene;

use super::super::measure::Interval;
use super::film::{Film, Machine, free_memory, pairs};
use super::table::{Column, Line, Ratio, Table};
use crate::failure::Failure;

/// Faces of the paper's two.
const FACES: [u32; 2] = [80_000, 50_000_000];
/// Printed.
const SIZE: [u32; 2] = [1024, 768];
/// How far the viewer goes from frame to frame where plants are cut anew in each, rad.
const TURN: f64 = 0.05;
/// Bytes that a face takes while two trees are held, made ready and on a software adapter: 15.2 GB for 50 million.
const FACE_BYTES: u64 = 320;
/// A tree of more is drawn few times.
const MANY: u32 = 1_000_000;

/// A tree before the eye, in 64 by 64 cells of flowing air; every turn of the view cuts it anew.
fn scene(faces: u32, near: u32) -> Result<Scene, Failure> {
    let text = format!(
        "(version: 1, stands: [(species: Tree, places: [(at: (0, 9), height: 7)],
            representation: Layers(near: {near}, mid: 1, far: 1, turn: 0.03, fade: 0, mesh: Grown(form: Tree, triangles: {faces})))],
        wind: [Fluid(cells: 64)], camera: (eye: (0, 2, 0), target: (0, 3.2, 9)))"
    );
    Ok(Scene::parse(&text, "layers.ron")?)
}

/// Frames a second of 3 and of 5 layers, and their ratio: with a viewer who stands, and with one who goes round.
type Found = [([f64; 2], Option<Interval>); 2];

/// Runs both trees of so many faces, by turns.
fn trees(machine: &Machine<'_>, faces: u32, progress: &mut dyn FnMut()) -> Result<Found, Failure> {
    let size = machine.size(SIZE);
    let film = |near: u32| -> Result<Film<'_>, Failure> { machine.film(machine.world(scene(faces, near)?)?, size) };
    let (mut three, mut five) = (film(1)?, film(3)?);
    let count = if faces > MANY { machine.pairs.min(2) } else { machine.pairs };
    let mut found = [([0.0; 2], None); 2];
    for (turn, found) in [0.0, TURN].into_iter().zip(&mut found) {
        three.go_round(turn);
        five.go_round(turn);
        let measured = pairs(count, [&mut three, &mut five], progress)?;
        *found = (measured.seconds.map(|seconds| 1.0 / seconds), measured.ratio);
    }
    Ok(found)
}

/// Runs it.
pub(super) fn run(machine: &Machine<'_>, progress: &mut dyn FnMut()) -> Result<Table, Failure> {
    let size = machine.size(SIZE);
    let faces = FACES.map(|faces| machine.count(faces, 2000));
    let mut notes = vec![
        "a viewer who stands sees cuts that are kept; for one who goes round, 3° a frame, the plant is cut anew in each, as in the paper"
            .to_owned(),
    ];
    let mut found: [Option<Found>; 2] = [None, None];
    for (faces, found) in faces.into_iter().zip(&mut found) {
        let (wanted, free) = (FACE_BYTES * u64::from(faces), free_memory());
        if free.is_some_and(|free| free < wanted) {
            let gigabytes = |bytes: u64| bytes as f64 / 1e9;
            let free = gigabytes(free.unwrap_or(0));
            notes
                .push(format!("{faces} faces were not run: two trees of them take {:.1} GB, and {free:.1} GB are free", gigabytes(wanted)));
            continue;
        }
        if faces > MANY {
            machine.console.note(&format!("two trees of {faces} faces grow and are made ready, which takes a minute or two"));
        }
        *found = Some(trees(machine, faces, progress)?);
    }
    let line = |which: usize, viewer: &str| {
        let of = |at: usize| found[at].map(|found| found[which]);
        let values = [0, 1].into_iter().flat_map(|at| [0, 1].map(|layers: usize| of(at).map(|(fps, _)| fps[layers])));
        let intervals = [0, 1].into_iter().map(|at| of(at).and_then(|(_, ratio)| ratio));
        Line::ours(format!("{}, {viewer}", machine.name()), values.collect(), intervals.collect())
    };
    let column = |faces: u32, layers: &str| Column::new(format!("{} faces, {layers}", short(faces)), "fps");
    Ok(Table {
        paper: "Chen & Johan 2015, Animating 3D Vegetation in Real-time Using a 2D Approach",
        place: "§4, Table 1",
        scene: format!("a plant in near, middle and far layers, air of 64 × 64 cells, {}x{}", size[0], size[1]),
        columns: faces.into_iter().flat_map(|faces| [column(faces, "3 (1-1-1)"), column(faces, "5 (3-1-1)")]).collect(),
        ratios: vec![
            Ratio { what: "5/3", of: [0, 1] },
            Ratio { what: "5/3 of more faces", of: [2, 3] },
            Ratio { what: "more/fewer faces, 3", of: [0, 2] },
            Ratio { what: "more/fewer faces, 5", of: [1, 3] },
        ],
        lines: vec![
            Line::printed("Xeon E5520, GeForce GTX 275", [Some(70.0), Some(65.0), Some(40.0), Some(34.0)]),
            line(0, "the viewer stands"),
            line(1, "the viewer goes round"),
        ],
        notes,
    })
}

/// A count of faces as the paper writes it.
fn short(faces: u32) -> String {
    if faces >= MANY { format!("{}M", faces / MANY) } else { format!("{}K", faces / 1000) }
}
