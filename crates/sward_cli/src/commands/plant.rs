//! What a plant's file holds, as `sward show FILE.glb` says it.

use std::path::Path;

use sward::specimen::{Finish, Kind, Order, Specimen};

use super::show::{grouped, line};
use crate::console::Console;
use crate::failure::Failure;
use crate::output::ends_in;
use crate::progress::Progress;

/// Parts in which progress is told.
const PARTS: u64 = 100;

/// The page of a file named like glTF; `None` for anything else.
pub(crate) fn page(file: &str, console: &Console) -> Result<Option<String>, Failure> {
    let path = Path::new(file);
    if !ends_in(path, "glb") && !ends_in(path, "gltf") {
        return Ok(None);
    }
    let cannot = |error: std::io::Error| Failure::input(format!("{file}: cannot be read: {error}"), "check the path");
    let bytes = std::fs::read(path).map_err(cannot)?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let neighbour = |name: &str| std::fs::read(folder.join(name)).map_err(|error| format!("{name}: {error}"));
    let mut progress = Progress::new(PARTS, "parts of the plant", console);
    let mut done = 0;
    let mut tell = |share: f32| {
        while done < (share * PARTS as f32) as u64 {
            progress.advance();
            done += 1;
        }
    };
    let specimen = Specimen::read(&bytes, &neighbour, &Order::default(), &mut tell);
    drop(progress);
    let specimen = specimen.map_err(|error| {
        let text = error.to_string();
        // Most errors end with what to do.
        let (what, help) = text.split_once("; ").unwrap_or((&text, "export it again"));
        Failure::input(format!("{file}: {what}"), help)
    })?;
    Ok(Some(written(file, &specimen)))
}

fn written(file: &str, specimen: &Specimen) -> String {
    let mut text = String::new();
    let [width, height, depth] = [0, 1, 2].map(|axis| specimen.high[axis] - specimen.low[axis]);
    line(&mut text, "plant", &format!("{file}, {width:.2} x {height:.2} x {depth:.2} m, {:.2} m above its root", specimen.high[1]));
    let [leaf, wood] = [Kind::Leaf, Kind::Wood].map(|kind| grouped(specimen.count(kind)));
    let vertices = grouped(specimen.vertices.len() as u64);
    line(
        &mut text,
        "",
        &format!("{} triangles, {leaf} of leaves and {wood} of wood; {vertices} vertices", grouped(specimen.triangles.len() as u64)),
    );
    line(&mut text, "leaves", &format!("{}, each with a root", grouped(specimen.leaves.into())));
    for part in &specimen.parts {
        let finish = &specimen.finishes[part.finish];
        let triangles = grouped(u64::from(part.triangles.end - part.triangles.start));
        let kind = if finish.kind == Kind::Leaf { "leaf" } else { "wood" };
        line(&mut text, "material", &format!("{}: {kind}, {triangles} triangles{}", finish.name, look(finish, specimen)));
    }
    text
}

fn look(finish: &Finish, specimen: &Specimen) -> String {
    let picture = finish.picture.map(|picture| specimen.pictures[picture].size);
    let picture = picture.map_or_else(String::new, |[width, height]| format!(", picture of {width} x {height}"));
    let cut = if finish.cutoff > 0.0 { format!(", cut at {}", finish.cutoff) } else { String::new() };
    let sides = if finish.two_sided { ", two-sided" } else { "" };
    picture + &cut + sides
}
