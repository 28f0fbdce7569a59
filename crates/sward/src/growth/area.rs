//! The outlines of exclusions and masks on the ground, in f64.

use std::sync::Arc;

use super::MaskImage;
use crate::math;
use crate::scene::{Area, Mask};

/// A piece of ground; positions are metres from the scene's origin.
#[derive(Clone, Debug, PartialEq)]
pub enum Outline {
    /// All within `half_width` \[m\] of a line.
    Line {
        /// Its points; one: a disc.
        points: Vec<[f64; 2]>,
        /// m.
        half_width: f32,
    },
    /// All inside a polygon.
    Polygon {
        /// Its corners.
        points: Vec<[f64; 2]>,
    },
    /// Where a picture lies.
    Picture {
        /// The shades.
        image: Arc<MaskImage>,
        /// Its corner of least x and z.
        corner: [f64; 2],
        /// m.
        size: [f32; 2],
    },
}

impl Outline {
    /// The outline of a scene's area.
    pub fn of(area: &Area) -> Self {
        match area {
            Area::Box(rectangle) => {
                let (sine, cosine) = math::sin_cos_f64(f64::from(rectangle.yaw));
                let corner = |[x, z]: [f64; 2]| {
                    let [x, z] = [x * f64::from(rectangle.size[0]), z * f64::from(rectangle.size[1])];
                    [rectangle.at[0] + cosine * x + sine * z, rectangle.at[1] - sine * x + cosine * z]
                };
                Self::Polygon { points: [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]].map(corner).to_vec() }
            }
            Area::Disc(disc) => Self::Line { points: vec![disc.at], half_width: disc.radius },
            Area::Polygon(outline) => Self::Polygon { points: outline.points.clone() },
            Area::Road(road) => Self::Line { points: road.points.clone(), half_width: 0.5 * road.width },
        }
    }

    /// The outline of a scene's mask.
    pub fn of_mask(mask: &Mask, image: Arc<MaskImage>) -> Self {
        Self::Picture { image, corner: mask.at, size: mask.size }
    }

    /// Least and greatest x and z.
    pub fn bounds(&self) -> [[f64; 2]; 2] {
        let (points, margin) = match self {
            Self::Line { points, half_width } => (&points[..], f64::from(*half_width)),
            Self::Polygon { points } => (&points[..], 0.0),
            Self::Picture { corner, size, .. } => {
                return [*corner, [corner[0] + f64::from(size[0]), corner[1] + f64::from(size[1])]];
            }
        };
        let ends = |axis: usize| {
            let along = points.iter().map(|point| point[axis]);
            along.fold([f64::MAX, f64::MIN], |[low, high], at| [if at < low { at } else { low }, if at > high { at } else { high }])
        };
        let ([x0, x1], [z0, z1]) = (ends(0), ends(1));
        [[x0 - margin, z0 - margin], [x1 + margin, z1 + margin]]
    }

    /// The straight pieces of the line or the polygon, from point to point.
    pub fn edges(&self) -> Vec<[[f64; 2]; 2]> {
        match self {
            Self::Line { points, .. } if points.len() == 1 => vec![[points[0], points[0]]],
            Self::Line { points, .. } => points.windows(2).map(|pair| [pair[0], pair[1]]).collect(),
            Self::Polygon { points } => (0..points.len()).map(|at| [points[at], points[(at + 1) % points.len()]]).collect(),
            Self::Picture { .. } => Vec::new(),
        }
    }
}
