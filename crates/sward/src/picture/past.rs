//! What is remembered of a picture, for the motion in the next one: where everything was then.
//!
//! The two time levels of a solver are not the two pictures: there may be any number of steps between these.
//!
//! The ground is taken as unmoved: where it was edited between the pictures, its pixels and the plants on it were where the present
//! ground is, and all that grow now grew then.

use super::aov::AovUniform;
use super::blade_plan::{self, BladePlan};
use super::frame::BodyDraw;
use super::identity::Identity;
use super::layers::{self, CutPlan, Origin};
use super::plan::{BatchPlan, Seen, plan, plan_then, share};
use super::prepare::PrepareUniform;
use super::subject::{self, Frame};
use crate::geometry::layers::LayerDraw;
use crate::geometry::mesh::Mesh;
use crate::response::StandModel;
use crate::shading::look::Look;
use crate::state::PatchKey;
use crate::terrain::Terrain;
use crate::view::View;
use crate::wind::WindField;
use crate::world::World;

/// The moment of a picture.
#[derive(Clone, Debug)]
pub struct Past {
    /// The world of that moment; its cells only where the CPU holds them.
    pub world: World,
    /// Steps, 0 to 1, that the picture lay before the world's state.
    pub behind: f64,
    view: View,
    /// Share of plants drawn, per stand.
    fullness: Vec<f64>,
    looks: Vec<Look>,
    identity: Identity,
}

impl Past {
    /// The moment `behind` steps (0 to 1) before the state of a world, as a picture of it is drawn.
    pub fn of(world: &World, behind: f64) -> Self {
        let behind = behind.clamp(0.0, 1.0);
        let (view, looks) = (world.camera_before(behind), subject::looks(world));
        let (_, origin) = Frame::of(world, &view, behind);
        let seen = Seen { view: &view, origin, fullness: 1.0, near: 1.0, behind };
        let share = share(world);
        let fullness = looks.iter().enumerate().map(|(index, look)| plan(world, index, &seen, look, share).1).collect();
        Self { world: world.clone(), behind, view, fullness, looks, identity: Identity::of(world) }
    }

    /// A stand then.
    pub fn stand(&self, index: usize) -> &StandModel {
        &self.world.model.stands[index]
    }

    /// The plants of a batch of the present picture, whose frame begins at the patch `origin`, as they were then.
    pub fn plan(&self, index: usize, origin: PatchKey, now: &BatchPlan) -> BatchPlan {
        plan_then(&self.world, index, origin, now)
    }

    /// The blades of the present picture as they were then.
    pub fn blades(&self, index: usize, origin: PatchKey, now: &BladePlan) -> Option<BladePlan> {
        let seen = Seen { view: &self.view, origin, fullness: 1.0, near: 1.0, behind: self.behind };
        blade_plan::plan_then(&self.world, index, &seen, &self.looks[index], now)
    }

    /// The layers of cuts of the present picture, whose frame lies at `origin`, as they were then.
    pub fn layers(&self, plans: &[CutPlan], origin: Origin) -> Vec<Vec<LayerDraw>> {
        plans.iter().map(|plan| layers::then(&self.world, self.behind, plan, origin)).collect()
    }

    /// Numbers of a stand's plants, for [`super::identity::number`].
    pub fn identity(&self, index: usize) -> [u32; 4] {
        self.identity.of_stand(index)
    }

    /// What those plants are prepared with, on the `ground` of the present.
    pub fn uniform(&self, index: usize, origin: PatchKey, plain: bool, ground: &Terrain) -> PrepareUniform {
        let seen = Seen { view: &self.view, origin, fullness: self.fullness[index], near: 1.0, behind: self.behind };
        let identity = self.identity.of_stand(index);
        let grid = ground.grid();
        PrepareUniform { identity, grid, ..PrepareUniform::new(&self.world, self.stand(index), plain, &seen, &self.looks[index]) }
    }

    /// The wind on the nodes of a stand.
    pub fn wind(&self, index: usize) -> WindField {
        self.world.wind_before(self.stand(index), self.behind)
    }

    /// The camera then, for a present picture of `size` pixels.
    pub fn camera(&self, now: &Frame, size: [u32; 2]) -> AovUniform {
        let view = self.frame(now).view(&self.view);
        let [width, height] = size.map(|side| side.max(1) as f32);
        AovUniform { then: view.projection(size), eye: view.position.extend(0.0), size: glam::Vec4::new(width, height, 0.0, 0.0) }
    }

    /// Where the bodies of the present picture, of `world`, were; those that were away stand where they are now.
    pub fn bodies(&self, world: &World, now: &Frame, draws: &[BodyDraw], meshes: &[Option<usize>]) -> Vec<BodyDraw> {
        let then = subject::bodies(&self.world, &self.frame(now), meshes);
        let was = |draw: &BodyDraw| then.iter().find(|then| then.number == draw.number && self.knew(world, draw.number as usize - 1));
        draws.iter().map(|draw| *was(draw).unwrap_or(draw)).collect()
    }

    /// Whether a body of `world` was the same one then.
    fn knew(&self, world: &World, body: usize) -> bool {
        let serial = |world: &World| world.model.bodies.get(body).map(|body| body.serial);
        serial(world) == serial(&self.world)
    }

    /// The mesh of a body that plays a clip, as it was; `None` for others, and for one that was away.
    pub fn moved(&self, world: &World, body: usize) -> Option<Mesh> {
        subject::moved(&self.world, body, self.behind).filter(|_| self.knew(world, body))
    }

    /// That moment in the space of the present frame.
    fn frame(&self, now: &Frame) -> Frame {
        Frame { corner: now.corner, behind: self.behind }
    }
}
