//! Few corners instead of many points: the corners of a hull that the others leave by next to nothing.

use glam::DVec3;

use super::hull::{LARGEST, hull, shaken};

/// How far points may lie outside, as a share of the longest side.
const TOLERANCE: f64 = 0.004;
/// Most corners, but for those found in the last round.
const MOST: usize = 128;
/// Most rounds.
const ROUNDS: u32 = 6;

/// Directions in which hulls are begun: the primitive vectors with parts in −2..=2, 98 of them.
pub(super) fn directions() -> Vec<[i32; 3]> {
    let all = (0..125).map(|k| [k % 5 - 2, k / 5 % 5 - 2, k / 25 - 2]);
    all.filter(|d: &[i32; 3]| d.iter().any(|part| part % 2 != 0)).collect()
}

/// The points farthest in each of the directions, each once, in a fixed order.
fn extreme(points: &[DVec3]) -> Vec<DVec3> {
    let mut found: Vec<DVec3> = Vec::new();
    for d in directions() {
        let d = DVec3::from_array(d.map(f64::from));
        let mut best: Option<(f64, DVec3)> = None;
        for &point in points {
            let along = d.dot(point);
            if best.is_none_or(|(most, _)| along > most) {
                best = Some((along, point));
            }
        }
        found.extend(best.map(|(_, point)| point).filter(|point| !found.contains(point)));
    }
    found
}

/// Lowest and highest corner around some points.
pub(super) fn bounds(points: &[DVec3]) -> (DVec3, DVec3) {
    points.iter().fold((DVec3::MAX, DVec3::MIN), |(low, high), point| (low.min(*point), high.max(*point)))
}

/// Triangles of the hull of a few points, counter-clockwise seen from outside; none for flat ones.
fn faces_of(points: &[DVec3]) -> Vec<[u32; 3]> {
    let (low, high) = bounds(points);
    let longest = (high - low).max_element();
    if !(longest > 1e-12 && longest.is_finite()) {
        return Vec::new();
    }
    let units = (LARGEST - 8.0) / longest;
    let whole = |point: &DVec3| ((*point - low) * units).to_array().map(|part| part as i64 + 3);
    let shaken: Vec<[i64; 3]> = points.iter().zip(0..).map(|(point, number)| shaken(whole(point), number)).collect();
    // Slivers between corners that lie in one plane look anywhere; the plane's other triangles do.
    let tolerance = 1e-3 * longest;
    let supports = |face: &[u32; 3]| {
        let [a, b, c] = face.map(|index| points[index as usize]);
        let normal = (b - a).cross(c - a);
        let length = normal.length();
        length > 1e-6 * longest * longest && points.iter().all(|point| normal.dot(*point - a) <= tolerance * length)
    };
    hull(&shaken).into_iter().filter(supports).collect()
}

/// Corners whose hull all points lie in, but for the tolerance, and its triangles.
pub(super) fn thinned(points: &[DVec3]) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let mut corners = extreme(points);
    let mut faces = faces_of(&corners);
    let (low, high) = bounds(points);
    let tolerance = TOLERANCE * (high - low).max_element();
    for _ in 0..ROUNDS {
        // The farthest point outside each face.
        let mut outside: Vec<(DVec3, DVec3, f64, Option<DVec3>)> = Vec::with_capacity(faces.len());
        for face in &faces {
            let [a, b, c] = face.map(|index| corners[index as usize]);
            outside.push((a, (b - a).cross(c - a).normalize_or_zero(), tolerance, None));
        }
        for &point in points {
            for (start, normal, farthest, found) in &mut outside {
                let away = normal.dot(point - *start);
                if away > *farthest {
                    (*farthest, *found) = (away, Some(point));
                }
            }
        }
        let before = corners.len();
        for point in outside.into_iter().filter_map(|(.., found)| found) {
            if corners.len() < MOST && !corners.contains(&point) {
                corners.push(point);
            }
        }
        if corners.len() == before {
            break;
        }
        faces = faces_of(&corners);
    }
    (corners, faces)
}
