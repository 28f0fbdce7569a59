//! What bodies look like from six sides, for responses that push single points out of them.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::BodyModel;
use crate::interaction::distance_map::{Cube, DistanceMap};

/// The maps of all bodies: those of bodies that play a clip as in its first moment, each with a map of its own; of others, bodies of one shape share
/// one.
#[derive(Clone, Debug, Default)]
pub struct BodyMaps {
    /// Texels along a side of a face; 0 where no stand asks for maps.
    pub size: u32,
    /// Cube of each body.
    pub cubes: Vec<Cube>,
    /// First texel of each body.
    pub firsts: Vec<u32>,
    /// Shape of each body: [`BodyModel::shape`].
    shapes: Vec<u64>,
    /// Texels of all.
    pub texels: Arc<Vec<[f32; 4]>>,
}

impl BodyMaps {
    /// Of the bodies of a scene; none if `size` is 0.
    pub(super) fn of(bodies: &[BodyModel], size: u32) -> Self {
        Self { size, ..Self::default() }.after(bodies)
    }

    /// Those of other bodies: shapes that were there before are not drawn again.
    pub(crate) fn after(&self, bodies: &[BodyModel]) -> Self {
        let mut maps = Self { size: self.size, ..Self::default() };
        if self.size == 0 {
            return maps;
        }
        let length = 6 * (self.size * self.size) as usize;
        let known: BTreeMap<u64, usize> = self.shapes.iter().enumerate().map(|(place, shape)| (*shape, place)).collect();
        let (mut texels, mut shared) = (Vec::new(), BTreeMap::new());
        for body in bodies {
            let mut first = texels.len() as u32;
            let old = known.get(&body.shape).and_then(|place| Some((*self.cubes.get(*place)?, *self.firsts.get(*place)? as usize)));
            let cube = match (shared.get(&body.shape), old) {
                (Some((cube, known)), _) if !body.is_animated() => {
                    first = *known;
                    *cube
                }
                (_, Some((cube, place))) if place + length <= self.texels.len() => {
                    texels.extend_from_slice(&self.texels[place..place + length]);
                    cube
                }
                _ => {
                    let map = match &body.figure {
                        Some(figure) => figure.distance_map(figure.cube(self.size), self.size, 0.0),
                        None => DistanceMap::of_pieces(&body.pieces, self.size),
                    };
                    texels.extend(map.texels);
                    map.cube
                }
            };
            shared.entry(body.shape).or_insert((cube, first));
            maps.cubes.push(cube);
            maps.firsts.push(first);
            maps.shapes.push(body.shape);
        }
        maps.texels = if texels == *self.texels { Arc::clone(&self.texels) } else { Arc::new(texels) };
        maps
    }

    /// The map of body number `body`, without its texels: enough to say where it is.
    pub fn place(&self, body: usize) -> Option<(DistanceMap, u32)> {
        let (cube, first) = (*self.cubes.get(body)?, *self.firsts.get(body)?);
        Some((DistanceMap { size: self.size, cube, texels: Vec::new() }, first))
    }
}
