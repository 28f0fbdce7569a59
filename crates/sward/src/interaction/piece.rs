//! Convex pieces of a body, in the body's own frame: +x to its left, +z forward (glTF), origin on the ground below its centre.

use crate::math;
use crate::scene::{Part, Shape};

/// Lower side of a piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Underside {
    /// Parallel to the body's base.
    Plane,
    /// A plane that rises in the body's frame.
    Slope {
        /// Rise along x and z, m/m.
        gradient: [f64; 2],
    },
    /// Lower half of an ellipsoid with these radii along x, y, z of the piece, m; the piece's offset is its centre.
    Ellipsoid {
        /// Radii, m.
        radii: [f64; 3],
    },
}

/// One convex piece.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// Convex outline seen from above, m, in the body's frame (x, z).
    pub outline: Vec<[f64; 2]>,
    /// Underside.
    pub underside: Underside,
    /// Reference point, m: on a plane underside, centre of an ellipsoid.
    pub offset: [f64; 3],
    /// Height of its upper side above the reference point, m; of an ellipsoid as its radii say.
    pub rise: f64,
    /// Turn of the piece in the body, rad about +Y.
    pub yaw: f64,
}

impl Piece {
    /// Half of its narrower extent along x or z, m.
    pub fn narrowest(&self) -> f64 {
        let extent = |axis: usize| {
            let (mut low, mut high) = (f64::MAX, f64::MIN);
            for point in &self.outline {
                low = if point[axis] < low { point[axis] } else { low };
                high = if point[axis] > high { point[axis] } else { high };
            }
            high - low
        };
        let (x, z) = (extent(0), extent(1));
        0.5 * if x < z { x } else { z }
    }
}

/// Corners of the regular polygon around a round footprint. Outside its ellipse the underside is out of reach anyway.
const ROUND: u32 = 16;

fn rectangle(x: f64, z: f64) -> Vec<[f64; 2]> {
    vec![[-x, -z], [x, -z], [x, z], [-x, z]]
}

fn round(x: f64, z: f64) -> Vec<[f64; 2]> {
    let step = std::f64::consts::TAU / f64::from(ROUND);
    let grown = 1.0 / math::sin_cos_f64(step / 2.0).1;
    (0..ROUND)
        .map(|k| {
            let (sine, cosine) = math::sin_cos_f64(f64::from(k) * step);
            [x * grown * cosine, z * grown * sine]
        })
        .collect()
}

fn placed(outline: Vec<[f64; 2]>, underside: Underside, offset: [f64; 3], rise: f64, yaw: f64) -> Piece {
    let (sine, cosine) = math::sin_cos_f64(yaw);
    let place = |p: [f64; 2]| [offset[0] + cosine * p[0] + sine * p[1], offset[2] - sine * p[0] + cosine * p[1]];
    Piece { outline: outline.into_iter().map(place).collect(), underside, offset, rise, yaw }
}

fn simple(shape: &Shape, offset: [f64; 3], yaw: f64) -> Option<Piece> {
    let raised = |rise: f64| [offset[0], offset[1] + rise, offset[2]];
    let ellipsoid = |radii: [f64; 3]| placed(round(radii[0], radii[2]), Underside::Ellipsoid { radii }, raised(radii[1]), radii[1], yaw);
    Some(match shape {
        Shape::Box(block) => {
            let [x, rise, z] = block.size.map(f64::from);
            placed(rectangle(x / 2.0, z / 2.0), Underside::Plane, offset, rise, yaw)
        }
        Shape::Polygon(polygon) => {
            let outline = polygon.points.iter().map(|p| p.map(f64::from)).collect();
            placed(outline, Underside::Plane, offset, f64::from(polygon.height), yaw)
        }
        Shape::Sphere(sphere) => ellipsoid([f64::from(sphere.radius); 3]),
        Shape::Ellipsoid(body) => ellipsoid(body.radii.map(f64::from)),
        Shape::Truck | Shape::Compound(_) | Shape::Mesh(_) => return None,
    })
}

/// Our pickup: a chassis 0.32 m above the ground and four wheels on it.
fn truck() -> Vec<Piece> {
    let mut pieces = vec![placed(rectangle(0.95, 2.35), Underside::Plane, [0.0, 0.32, 0.0], 1.4, 0.0)];
    for (x, z) in [(-0.8, 1.45), (0.8, 1.45), (-0.8, -1.45), (0.8, -1.45)] {
        pieces.push(placed(rectangle(0.16, 0.24), Underside::Plane, [x, 0.0, z], 0.7, 0.0));
    }
    pieces
}

/// The pieces of a shape; none of a mesh, whose are [`super::FigureBody::pieces`].
pub fn pieces_of(shape: &Shape) -> Vec<Piece> {
    let part = |part: &Part| simple(&part.shape, part.offset.map(f64::from), f64::from(part.yaw));
    match shape {
        Shape::Truck => truck(),
        Shape::Compound(compound) => compound.parts.iter().filter_map(part).collect(),
        other => simple(other, [0.0; 3], 0.0).into_iter().collect(),
    }
}
