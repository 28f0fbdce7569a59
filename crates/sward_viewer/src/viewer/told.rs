//! What scripts are told.

use super::Viewer;
use crate::marks::Marks;
use crate::stage::Stage;
use crate::status::{Body, Status, Wheel};

impl Viewer {
    /// What scripts are told.
    pub(super) fn told(&self, marks: Marks) -> Status {
        let world = self.stage.as_ref().map(|stage| &stage.world);
        let bend = |at: [f64; 2]| world.and_then(|world| (0..world.model.stands.len()).find_map(|stand| world.bend_at(stand, at)));
        let at = |body: usize| world.and_then(|world| world.pose_before(body, 0.0)).map(|pose| pose.ground);
        let body = |(index, name): (usize, String)| {
            let [track, beside] = self.trails.places(index).map(|place| place.and_then(bend));
            Body { name, at: at(index), bend: at(index).and_then(bend), track, beside }
        };
        Status {
            scene: self.stage.as_ref().map_or_else(String::new, |stage| stage.source.name()),
            step: world.map_or(0, |world| world.state.step),
            drawn: self.stage.as_ref().and_then(Stage::drawn),
            camera: self.camera.kind.name(),
            away: self.camera.away(),
            backend: self.stage.as_ref().map_or(self.backend, Stage::backend).name(),
            paused: self.clock.paused,
            driving: self.drive.and_then(|drive| self.names().get(drive.body).cloned()),
            wheel: self.drive.map(|drive| Wheel { yaw: drive.yaw, speed: drive.speed[0], drift: drive.drift() }),
            bodies: self.names().into_iter().enumerate().map(body).collect(),
            busy: self.busy,
            longest: self.longest,
            problem: self.problem.clone(),
            notice: self.notice.clone(),
            pictures: self.pictures,
            loading: self.loading.is_some() || self.beside.loading.is_some(),
            split: self.beside.stage.is_some(),
            looked: self.overlays.said.iter().map(|(kind, said)| format!("{kind:?}: {said}")).collect(),
            probe: self.probe.lean(),
            marks,
        }
    }
}
