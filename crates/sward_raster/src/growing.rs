//! The blades of a picture: which there are, and how they are bent.

use sward::picture::blade_plan::{self, BladePlan, BladeUniform, LEVELS};
use sward::picture::blades::Blades;
use sward::picture::frame::FrameUniform;
use sward::picture::plan::Seen;
use sward::picture::prepare::{PrepareUniform, Preparing};
use sward::picture::subject::Frame;
use sward::response::continuum::NODE_CELLS;
use sward::shading::blade::BladeStyle;
use sward::state::Cells;
use sward::wind::WindField;
use sward::world::World;

use crate::blades::{self, Strips};
use crate::studio::Studio;

/// How blades thin out in a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thinning {
    /// As seen from here, m from the corner of the scene's origin patch.
    pub eye: [f64; 3],
    /// Share of the blades drawn that are on their way in or out, above 0: a picture's own is [`sward::picture::blade_plan::BAND`].
    pub band: f32,
}

impl Thinning {
    pub(crate) fn within(self, frame: &Frame) -> ([f32; 4], f32) {
        let [x, y, z] = self.eye;
        ([(x - frame.corner[0]) as f32, y as f32, (z - frame.corner[1]) as f32, 0.0], self.band)
    }
}

impl Studio {
    /// The blades of all stands of them, and what was decided of each.
    pub(crate) fn grow(
        &self,
        world: &World,
        seen: &Seen,
        frame: &FrameUniform,
        thinning: Option<([f32; 4], f32)>,
    ) -> (Vec<(usize, BladePlan)>, Vec<[Strips; LEVELS]>) {
        let plans = blade_plan::plan(world, seen, &self.looks, &frame.view_projection, false).into_iter().enumerate();
        let mut plans: Vec<(usize, BladePlan)> = plans.filter_map(|(stand, plan)| Some((stand, plan?))).collect();
        for (_, plan) in &mut plans {
            let numbers = &mut plan.uniform;
            (numbers.eye, numbers.shape[2]) = thinning.unwrap_or((numbers.eye, numbers.shape[2]));
        }
        let solve = |(index, plan): &(usize, BladePlan)| {
            let stand = &world.model.stands[*index];
            let prepare = PrepareUniform::new(world, stand, false, seen, &self.looks[*index]);
            let wind = world.wind_before(stand, seen.behind);
            let blades = self.blades(world, &world.state.stands[*index].cells, *index, prepare, &wind, plan.uniform);
            let style = |level: usize| {
                let shape = [plan.uniform.pieces[level], 0, 0, level as u32];
                stand.species.blade.as_ref().map(|blade| BladeStyle::new(blade, &self.looks[*index], shape))
            };
            Some(blades::solve(&blades, plan, [style(0)?, style(1)?, style(2)?]))
        };
        let strips = plans.iter().filter_map(solve).collect();
        (plans, strips)
    }

    /// What solves the blades of a stand, bent as `cells` say, on the ground of a world.
    pub(crate) fn blades<'a>(
        &self,
        world: &'a World,
        cells: &'a Cells,
        index: usize,
        prepare: PrepareUniform,
        wind: &'a WindField,
        uniform: BladeUniform,
    ) -> Blades<'a> {
        let stand = &world.model.stands[index];
        let intervals = stand.cells / NODE_CELLS;
        Blades { preparing: Preparing { uniform: prepare, cells, terrain: &world.model.terrain, stand, wind, intervals }, uniform }
    }
}
