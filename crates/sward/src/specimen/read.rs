//! From a glTF file to triangles with finishes.

use glam::{DMat4, DVec3};

use super::progress::Share;
use super::soup::Soup;
use super::{Kind, MOST_TRIANGLES, Rule, SpecimenError, finishes};
use crate::figure::FigureError;
use crate::figure::container::Opened;
use crate::figure::error::data;
use crate::figure::json::{Primitive, at};
use crate::figure::primitive::same_length;
use crate::figure::tree::{Tree, tree};

/// Farther out, file units, no vertex may lie.
const FARTHEST: f64 = 1e7;
/// Triangles that copies may add to what the file itself holds.
const COPIES: u64 = 4 << 20;

/// A primitive where it stands.
struct Standing<'a> {
    primitive: &'a Primitive,
    place: String,
    matrix: DMat4,
    kind: Kind,
}

/// All primitives of the scene with triangles: those of leaves first, those of one material together.
fn standing<'a>(opened: &'a Opened<'_>, tree: &Tree, rule: &Rule) -> Result<Vec<Standing<'a>>, SpecimenError> {
    let root = &opened.root;
    let (kinds, other) = rule.kinds(&root.materials)?;
    let mut global: Vec<DMat4> = Vec::with_capacity(tree.nodes.len());
    for node in &tree.nodes {
        let matrix = node.rest.matrix();
        global.push(node.parent.map_or(matrix, |parent| global[parent as usize] * matrix));
    }
    let mut all = Vec::new();
    for &node in &tree.shown {
        let Some(mesh) = root.nodes[node].mesh else { continue };
        let matrix = if root.nodes[node].skin.is_some() { DMat4::IDENTITY } else { global[tree.place[node] as usize] };
        for (index, primitive) in at(&root.meshes, mesh, "meshes", &format!("nodes[{node}]"))?.primitives.iter().enumerate() {
            let place = format!("meshes[{mesh}].primitives[{index}]");
            let kind = match primitive.material {
                Some(material) => *at(&kinds, material, "materials", &place)?,
                None => other,
            };
            if primitive.attributes.position.is_some() && matches!(primitive.mode.unwrap_or(4), 4..=6) {
                all.push(Standing { primitive, place, matrix, kind });
            }
        }
    }
    all.sort_by_key(|standing| (standing.kind, standing.primitive.material.map_or(0, |material| material + 1)));
    Ok(all)
}

/// Most vertices and triangles of a primitive, as it announces them.
fn announced(opened: &Opened<'_>, standing: &Standing<'_>) -> Result<[u64; 2], FigureError> {
    let (root, place) = (&opened.root, &standing.place);
    let count = |index: usize| at(&root.accessors, index, "accessors", place).map(|accessor| accessor.count);
    let vertices = standing.primitive.attributes.position.map_or(Ok(0), count)?;
    let corners = standing.primitive.indices.map_or(Ok(vertices), count)?;
    let triangles = if standing.primitive.mode.unwrap_or(4) == 4 { corners / 3 } else { corners.saturating_sub(2) };
    Ok([vertices.min(triangles.saturating_mul(3)), triangles])
}

/// A file's triangles, leaves first.
pub(super) fn soup(opened: &Opened<'_>, rule: &Rule, progress: &mut Share<'_, '_>) -> Result<Soup, SpecimenError> {
    let all = standing(opened, &tree(&opened.root)?, rule)?;
    let held: u64 = opened.buffers.iter().map(|buffer| buffer.len() as u64).sum();
    let [mut vertices, mut leaf_vertices, mut triangles] = [0_u64; 3];
    for standing in &all {
        let [more, faces] = announced(opened, standing)?;
        vertices = vertices.saturating_add(more);
        leaf_vertices = leaf_vertices.saturating_add(if standing.kind == Kind::Leaf { more } else { 0 });
        triangles = triangles.saturating_add(faces);
    }
    // An index takes a byte at least: more triangles than bytes are copies, and a small file must not fill all memory.
    let most = MOST_TRIANGLES.min(held + COPIES);
    if triangles > most {
        let instead = if most < MOST_TRIANGLES { "join copies of meshes before exporting" } else { "simplify it (Blender: Decimate)" };
        return Err(FigureError::TooMany { what: "triangles", found: triangles, most, instead }.into());
    }
    let mut pictures = finishes::decoded(opened)?;
    let mut soup = Soup::with_room(vertices, leaf_vertices, triangles)?;
    let mut last = None;
    for standing in &all {
        let material = standing.primitive.material;
        if last.replace(material) != Some(material) {
            soup.begin(finishes::finish(opened, material, standing.kind)?);
        }
        let before = soup.triangles.len();
        let share = |count: usize| count as f32 / if triangles > 0 { triangles as f32 } else { 1.0 };
        let end = share(before + announced(opened, standing)?[1] as usize);
        primitive(opened, standing, held, &mut soup, &mut progress.part(share(before), end))?;
    }
    if soup.triangles.is_empty() {
        return Err(FigureError::NoTriangles.into());
    }
    soup.drop_empty_parts();
    // Pictures in the order in which finishes use them, each once.
    let mut place = vec![None; pictures.len()];
    for finish in &mut soup.finishes {
        let Some(image) = finish.picture else { continue };
        if let Some(picture) = pictures[image].take() {
            place[image] = Some(soup.pictures.len());
            soup.pictures.push(picture);
        }
        finish.picture = place[image];
    }
    Ok(soup)
}

/// Which vertices triangles use, renumbered in order.
fn used(corners: &mut [[u32; 3]], count: usize) -> Vec<u32> {
    let mut number = vec![u32::MAX; count];
    corners.iter().flatten().for_each(|corner| number[*corner as usize] = 0);
    let mut kept = Vec::with_capacity(number.iter().filter(|number| **number == 0).count());
    for (vertex, number) in number.iter_mut().enumerate().filter(|(_, number)| **number == 0) {
        *number = kept.len() as u32;
        kept.push(vertex as u32);
    }
    corners.iter_mut().flatten().for_each(|corner| *corner = number[*corner as usize]);
    kept
}

fn primitive(
    opened: &Opened<'_>,
    standing: &Standing<'_>,
    held: u64,
    soup: &mut Soup,
    progress: &mut Share<'_, '_>,
) -> Result<(), SpecimenError> {
    let (attributes, place) = (&standing.primitive.attributes, &standing.place);
    let Some(position) = attributes.position else { return Ok(()) };
    // Elements take at least a byte each, so no accessor has more of them than the file has bytes.
    let most = held.min(3 * MOST_TRIANGLES);
    let count = at(&opened.root.accessors, position, "accessors", place)?.count.min(most) as usize;
    let mut corners = opened.corners(standing.primitive, count, most, place)?;
    let kept = used(&mut corners, count);
    progress.done(1, 4);
    if standing.matrix.determinant() < 0.0 {
        corners.iter_mut().for_each(|corner| corner.swap(1, 2));
    }
    let base = soup.vertices.len();
    let first = base as u32;
    let matrix = standing.matrix;
    let plain = matrix == DMat4::IDENTITY;
    let positions = opened.vectors::<3>(position, &[3], 0.0, most, &format!("{place}.POSITION"))?;
    same_length(positions.len(), count, "POSITION", place)?;
    let mut placing = progress.part(0.3, 0.5);
    for (number, vertex) in kept.iter().enumerate() {
        placing.item(number, kept.len());
        let own = positions[*vertex as usize];
        let moved = matrix.transform_point3(DVec3::from_array(own.map(f64::from)));
        if !moved.to_array().iter().all(|part| (-FARTHEST..=FARTHEST).contains(part)) {
            return Err(data(format!("{place}.POSITION"), "has vertices beyond ±1e7 units").into());
        }
        soup.push(if plain { own } else { moved.to_array().map(|part| part as f32) }, [0.0, 1.0, 0.0], None);
    }
    drop(positions);
    soup.triangles(first, corners.into_iter());
    progress.done(2, 4);
    normals(opened, standing, &kept, base, most, soup, &mut progress.part(0.55, 0.75))?;
    progress.done(3, 4);
    let set =
        standing.primitive.material.and_then(|material| opened.root.materials[material].pbr_metallic_roughness.base_color_texture.as_ref());
    let coordinates = if set.is_some_and(|used| used.tex_coord == 1) { attributes.texcoord_1 } else { attributes.texcoord_0 };
    if let Some(accessor) = coordinates {
        let uvs = opened.vectors::<2>(accessor, &[2], 0.0, most, &format!("{place}.TEXCOORD"))?;
        same_length(uvs.len(), count, "TEXCOORD", place)?;
        let mut painting = progress.part(0.8, 1.0);
        for (number, vertex) in kept.iter().enumerate() {
            painting.item(number, kept.len());
            soup.texture(base + number, uvs[*vertex as usize]);
        }
    }
    progress.done(4, 4);
    Ok(())
}

/// Normals of the vertices from `base` on: the file's, or means over triangles.
fn normals(
    opened: &Opened<'_>,
    standing: &Standing<'_>,
    kept: &[u32],
    base: usize,
    most: u64,
    soup: &mut Soup,
    progress: &mut Share<'_, '_>,
) -> Result<(), SpecimenError> {
    let place = &standing.place;
    let Some(accessor) = standing.primitive.attributes.normal else {
        soup.smooth(base);
        return Ok(());
    };
    let given = opened.vectors::<3>(accessor, &[3], 0.0, most, &format!("{place}.NORMAL"))?;
    let position = standing.primitive.attributes.position.and_then(|index| opened.root.accessors.get(index));
    same_length(given.len(), position.map_or(0, |accessor| accessor.count as usize), "NORMAL", place)?;
    let matrix = standing.matrix;
    let plain = matrix == DMat4::IDENTITY;
    let (x, y, z) = (matrix.x_axis.truncate(), matrix.y_axis.truncate(), matrix.z_axis.truncate());
    let sign = if matrix.determinant() < 0.0 { -1.0 } else { 1.0 };
    // The columns of the inverse transpose, but for a factor.
    let turned = [y.cross(z) * sign, z.cross(x) * sign, x.cross(y) * sign];
    for (number, vertex) in kept.iter().enumerate() {
        progress.item(number, kept.len());
        let own = given[*vertex as usize];
        let [a, b, c] = own.map(f64::from);
        let moved = (turned[0] * a + turned[1] * b + turned[2] * c).normalize_or_zero().to_array().map(|part| part as f32);
        soup.turn(base + number, if plain { own } else { moved });
    }
    Ok(())
}
