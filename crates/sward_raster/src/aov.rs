//! The outputs beside a picture: depth, motion and plant of each pixel.

use sward::picture::aov::{Aov, AovPixel, AovUniform};
use sward::picture::blade_plan::LEVELS;
use sward::picture::layers::Origin;
use sward::picture::past::Past;
use sward::world::World;

use crate::blades;
use crate::bodies::Bodies;
use crate::each::each;
use crate::layers::Layers;
use crate::plants::Batch;
use crate::sight::Sight;
use crate::studio::{Layout, Moment, Studio};
use crate::trace::Trace;

/// The things of a picture as they were in the one before.
pub(crate) struct Before {
    camera: AovUniform,
    bodies: Bodies,
    batches: Vec<Batch>,
    /// In the order of [`Moment::strips`].
    strips: Vec<blades::Past>,
    /// Corners of the pieces of layers.
    layers: Vec<[glam::Vec3; 3]>,
}

impl Studio {
    /// Solves what a picture of `world` shows as it was, on the ground of now.
    pub(crate) fn before(&self, world: &World, past: &Past, moment: &Moment) -> Before {
        let solve = |drawn: &crate::studio::Drawn| {
            let plan = past.plan(drawn.stand, moment.origin, &drawn.plan);
            let uniform = past.uniform(drawn.stand, moment.origin, drawn.plain, &world.model.terrain);
            let cells = &past.world.state.stands[drawn.stand].cells;
            self.solve(world, cells, drawn.stand, &plan, uniform, &past.wind(drawn.stand))
        };
        let solved: Vec<[blades::Past; LEVELS]> = (moment.blade_plans.iter().zip(&moment.strips))
            .filter_map(|((stand, plan), strips)| {
                let then = past.blades(*stand, moment.origin, plan)?;
                let uniform = past.uniform(*stand, moment.origin, false, &world.model.terrain);
                let wind = past.wind(*stand);
                let cells = &past.world.state.stands[*stand].cells;
                let blades = self.blades(world, cells, *stand, uniform, &wind, then.uniform);
                Some([0, 1, 2].map(|level: usize| strips[level].past(level, &blades, &then, past.identity(*stand))))
            })
            .collect();
        let mut by_level: [Vec<blades::Past>; LEVELS] = Default::default();
        for stand in solved {
            by_level.iter_mut().zip(stand).for_each(|(all, own)| all.push(own));
        }
        let draws = past.bodies(world, &moment.frame, &moment.draws, &moment.worn.dressing.meshes);
        // A body that was away has not moved.
        let moved: Vec<_> = moment.moved.iter().enumerate().map(|(body, now)| past.moved(world, body).or_else(|| now.clone())).collect();
        Before {
            camera: past.camera(&moment.frame, moment.size),
            bodies: Bodies::new(&moment.worn.posed(&moved), &draws),
            batches: moment.plans.iter().map(solve).collect(),
            strips: by_level.into_iter().flatten().collect(),
            layers: Layers::places(&past.world, &moment.cuts[0], &past.layers(&moment.cuts[0], Origin(moment.frame.corner))),
        }
    }

    /// Draws the outputs of a picture.
    pub(crate) fn trace(&self, sight: &Sight<'_>, layout: &Layout, moment: &Moment, before: &Before) -> Aov {
        let [columns, rows] = layout.tiles;
        let tiles = each((0..columns * rows).collect(), |index| {
            let mut tile = Trace::new(layout.corner(index), &before.camera);
            moment.bodies.trace(sight, &mut tile, layout.bodies.of(index), &before.bodies);
            for ((batch, then), bins) in moment.batches.iter().zip(&before.batches).zip(&layout.batches) {
                batch.trace(sight, &self.clumps, &mut tile, bins.of(index), then);
            }
            for ((strips, then), bins) in moment.strips().zip(&before.strips).zip(&layout.strips) {
                strips.trace(sight, &mut tile, bins.of(index), then);
            }
            layout.layers.trace(sight, &mut tile, layout.layer_bins.of(index), &before.layers);
            layout.ground.trace(&mut tile, index);
            tile.fill(sight);
            tile.finish()
        });
        let [width, height] = sight.size;
        let pixels = layout.join(&tiles, sight.size, AovPixel { depth: f32::INFINITY, motion: [0.0; 2], plant: 0 });
        Aov {
            width,
            height,
            depth: pixels.iter().map(|pixel| pixel.depth).collect(),
            motion: pixels.iter().map(|pixel| pixel.motion).collect(),
            plant: pixels.iter().map(|pixel| pixel.plant).collect(),
        }
    }
}
