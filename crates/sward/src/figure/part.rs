//! Convex parts that follow a frame, and what grass meets of them: an outline and an underside.

use glam::{DMat4, DVec3};

use super::split::split;
use super::thin::thinned;
use super::{Figure, FigureError, MOST_PARTS};

/// Steepest slope of an underside: a plane far from its part must not run into the ground.
const STEEPEST: f64 = 1.0;

/// A convex part of a figure, in the space of its frame's vertices.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Index of the frame it follows.
    pub frame: u32,
    /// Corners of its hull, about 100 at most.
    pub points: Vec<DVec3>,
    /// Triangles of its hull, counter-clockwise seen from outside; none for a flat part.
    pub faces: Vec<[u32; 3]>,
}

/// A part as it stands at one moment.
#[derive(Clone, Debug, PartialEq)]
pub struct Posed {
    /// Its corners seen from above (x, z), m.
    pub outline: Vec<[f64; 2]>,
    /// A point on its underside, m: below the middle of the corners.
    pub under: [f64; 3],
    /// Slope of the plane through `under` that no corner lies below, along x and z.
    pub gradient: [f64; 2],
    /// Height of the lowest corner, m.
    pub lowest: f64,
    /// Height of the highest corner, m.
    pub highest: f64,
}

impl Part {
    fn new(frame: u32, points: &[DVec3]) -> Self {
        let (points, faces) = thinned(points);
        Self { frame, points, faces }
    }

    /// The part moved by a matrix.
    ///
    /// Its underside becomes one plane: the face of its hull below the middle of its corners, at most 45° steep, lowered until no corner
    /// is below it, or a level one where that is higher. Of all planes below a convex part that face is highest in the middle. `None` if it is out of all bounds.
    pub fn posed(&self, matrix: &DMat4) -> Option<Posed> {
        let points: Vec<DVec3> = self.points.iter().map(|point| matrix.transform_point3(*point)).collect();
        if points.is_empty() || points.iter().any(|point| !point.to_array().iter().all(|part| (-1e3..=1e3).contains(part))) {
            return None;
        }
        let middle = points.iter().fold(DVec3::ZERO, |sum, point| sum + *point) / points.len() as f64;
        let (x, y, z) = (matrix.x_axis.truncate(), matrix.y_axis.truncate(), matrix.z_axis.truncate());
        let mirrored = x.cross(y).dot(z) < 0.0;
        let (mut gradient, mut highest) = ([0.0; 2], f64::MIN);
        for face in &self.faces {
            let [a, b, c] = face.map(|index| points[index as usize]);
            let normal = (b - a).cross(c - a) * if mirrored { -1.0 } else { 1.0 };
            if normal.y < -1e-9 * normal.length() {
                let slope = [-normal.x / normal.y, -normal.z / normal.y];
                let height = a.y + slope[0] * (middle.x - a.x) + slope[1] * (middle.z - a.z);
                if height > highest {
                    (highest, gradient) = (height, slope);
                }
            }
        }
        let steep = (gradient[0] * gradient[0] + gradient[1] * gradient[1]).sqrt();
        if steep > STEEPEST {
            gradient = gradient.map(|slope| slope * STEEPEST / steep);
        }
        let (mut height, mut lowest, mut top) = (f64::MAX, f64::MAX, f64::MIN);
        for point in &points {
            let above = point.y - gradient[0] * (point.x - middle.x) - gradient[1] * (point.z - middle.z);
            height = if above < height { above } else { height };
            lowest = if point.y < lowest { point.y } else { lowest };
            top = if point.y > top { point.y } else { top };
        }
        // Made less steep, it may be worse than a level one.
        if lowest > height {
            (height, gradient) = (lowest, [0.0; 2]);
        }
        let outline = points.iter().map(|point| [point.x, point.z]).collect();
        Some(Posed { outline, under: [middle.x, height, middle.z], gradient, lowest, highest: top })
    }
}

/// Splits the rigid frames of a figure, and gathers the vertices of its joints: each belongs to the joint of its largest weight.
pub(super) fn parts(figure: &Figure, pieces: usize) -> Result<Vec<Part>, FigureError> {
    let followed: Vec<usize> = figure.vertices.iter().map(|vertex| strongest(vertex.frames, vertex.weights)).collect();
    let mut points: Vec<Vec<DVec3>> = vec![Vec::new(); figure.frames.len()];
    // Where each vertex went among its frame's points.
    let mut places = Vec::with_capacity(followed.len());
    for (vertex, &frame) in figure.vertices.iter().zip(&followed) {
        places.push(points[frame].len() as u32);
        points[frame].push(DVec3::from_array(vertex.position.map(f64::from)));
    }
    let mut triangles: Vec<Vec<[u32; 3]>> = vec![Vec::new(); figure.frames.len()];
    for triangle in &figure.triangles {
        let frame = followed[triangle[0] as usize];
        if triangle.iter().all(|corner| followed[*corner as usize] == frame) {
            triangles[frame].push(triangle.map(|corner| places[corner as usize]));
        }
    }
    let mut parts = Vec::new();
    for (number, frame) in figure.frames.iter().enumerate().filter(|(number, _)| !points[*number].is_empty()) {
        let most = if frame.joint { 1 } else { pieces };
        let bodies = split(&points[number], &triangles[number], most);
        parts.extend(bodies.iter().map(|points| Part::new(number as u32, points)));
        if parts.len() as u64 > MOST_PARTS {
            let instead = "lower `pieces`, or join objects before exporting";
            return Err(FigureError::TooMany { what: "convex parts", found: parts.len() as u64, most: MOST_PARTS, instead });
        }
    }
    Ok(parts)
}

/// The frame of the largest weight; the first of equals.
fn strongest(frames: [u16; 4], weights: [f32; 4]) -> usize {
    let mut best = 0;
    for k in 1..4 {
        if weights[k] > weights[best] {
            best = k;
        }
    }
    usize::from(frames[best])
}
