//! What bodies look like from six sides, for responses that push single points out of them.

use std::sync::Arc;

use super::BodyModel;
use crate::interaction::distance_map::{Cube, DistanceMap};

/// The maps of all bodies, one after the other: those of bodies that play a clip as in its first moment.
#[derive(Clone, Debug, Default)]
pub struct BodyMaps {
    /// Texels along a side of a face; 0 where no stand asks for maps.
    pub size: u32,
    /// Cube of each body.
    pub cubes: Vec<Cube>,
    /// First texel of each body.
    pub firsts: Vec<u32>,
    /// Texels of all.
    pub texels: Arc<Vec<[f32; 4]>>,
}

impl BodyMaps {
    /// Of the bodies of a scene; none if `size` is 0.
    pub(super) fn of(bodies: &[BodyModel], size: u32) -> Self {
        let mut maps = Self { size, ..Self::default() };
        if size == 0 {
            return maps;
        }
        let mut texels = Vec::new();
        for body in bodies {
            let map = match &body.figure {
                Some(figure) => figure.distance_map(figure.cube(size), size, 0.0),
                None => DistanceMap::of_pieces(&body.pieces, size),
            };
            maps.cubes.push(map.cube);
            maps.firsts.push(texels.len() as u32);
            texels.extend(map.texels);
        }
        maps.texels = Arc::new(texels);
        maps
    }

    /// The map of body number `body`, without its texels: enough to say where it is.
    pub fn place(&self, body: usize) -> Option<(DistanceMap, u32)> {
        let (cube, first) = (*self.cubes.get(body)?, *self.firsts.get(body)?);
        Some((DistanceMap { size: self.size, cube, texels: Vec::new() }, first))
    }
}
