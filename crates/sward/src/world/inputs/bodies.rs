//! Bodies that come, go and jump while a world runs.

use std::sync::Arc;

use crate::model::Assets;
use crate::scene::{Camera, Driven, Interactor, Path, SceneError, WindSource};
use crate::state::BodyState;
use crate::world::{FARTHEST, Input, World};

/// When a body that has been removed comes back, s: never.
const NEVER: [f64; 2] = [999_999_999.0, 1e9];

impl World {
    /// Adds a body, between two steps; returns its number, by which it is driven, moved and removed: that of one that was removed, the lowest
    /// first, or the next. It is there at once, where its path has it now, unless it comes later (`from`). Positions are metres from the corner of the
    /// origin patch. A shape and a glTF file that were there before cost nothing.
    ///
    /// # Errors
    /// What a scene with this body would be refused for, or a file that cannot be read; the world is as it was.
    pub fn add_body(&mut self, body: Interactor, assets: &dyn Assets) -> Result<usize, SceneError> {
        let place = self.state.vacant.first().map_or(self.scene.interactors.len(), |place| *place as usize);
        self.scene.check_body(place, &body)?;
        let model = self.model.wardrobe.body(&body, place, assets)?;
        self.note(|| Input::AddBody(body.clone()));
        self.state.vacant.remove(&(place as u32));
        if place == self.scene.interactors.len() {
            self.scene.interactors.push(body);
            self.model.bodies.push(model);
            self.state.bodies.push(BodyState::default());
        } else {
            (self.scene.interactors[place], self.model.bodies[place]) = (body, model);
        }
        self.look_at_bodies();
        let (time, elapsed) = (self.time(), self.time() - self.scene.interactors[place].from);
        let pose = self.pose(place, time);
        self.state.bodies[place] = BodyState { pose, before: pose, clock: [elapsed; 2], ..BodyState::default() };
        Ok(place)
    }

    /// Removes a body, between two steps: what it held down stands up again, wind that stayed with it is gone, and a camera that followed it stays where
    /// it is. Its number is that of the next body that is added. Returns whether there was such a body.
    pub fn remove_body(&mut self, body: usize) -> bool {
        if body >= self.scene.interactors.len() || self.state.vacant.contains(&(body as u32)) {
            return false;
        }
        self.note(|| Input::RemoveBody(body));
        self.leave(body);
        self.leave_camera(body);
        let name = std::mem::take(&mut self.scene.interactors[body].name);
        let stays = |source: &WindSource| matches!(source, WindSource::Footprint(print) if print.follow.as_ref() == Some(&name));
        for wind in (0..self.scene.wind.len()).filter(|_| !name.is_empty()).collect::<Vec<_>>() {
            if stays(&self.scene.wind[wind]) {
                self.still_wind(wind);
            }
        }
        let gone = Interactor { from: NEVER[0], until: NEVER[1], ..Interactor::default() };
        self.model.bodies[body] = self.model.wardrobe.nobody();
        self.scene.interactors[body] = gone;
        self.state.bodies[body] = BodyState::default();
        self.state.vacant.insert(body as u32);
        self.look_at_bodies();
        true
    }

    /// Gives a body another path, from the next step on; one on it is somewhere else jumps there if it would be faster than 150 m/s.
    ///
    /// # Errors
    /// No such body, or no path; the world is as it was.
    pub fn lead(&mut self, body: usize, path: Path) -> Result<(), SceneError> {
        self.known_body(body)?;
        self.scene.check_path(body, &path)?;
        self.note(|| Input::Lead { body, path: path.clone() });
        self.scene.interactors[body].path = path;
        self.state.bodies[body].driven = None;
        Ok(())
    }

    /// Puts a body somewhere else, from the next step on, without sweeping what lies between: ground position \[m\], yaw \[rad\], clearance \[m\]. From
    /// then on it is driven from code ([`World::drive`]). Returns whether it was moved: unknown bodies are left alone, and so are all at numbers beyond
    /// ±1e8.
    pub fn teleport(&mut self, body: usize, ground: [f64; 2], yaw: f64, clearance: f64) -> bool {
        let near = ground.iter().chain([&yaw, &clearance]).all(|value| (-FARTHEST..=FARTHEST).contains(value));
        if !near || self.known_body(body).is_err() {
            return false;
        }
        self.note(|| Input::Teleport { body, at: ground, yaw, clearance });
        self.scene.interactors[body].path = Path::Driven(Driven { at: ground.map(within), yaw: crate::math::wrapped_angle(yaw) as f32 });
        let state = &mut self.state.bodies[body];
        (state.driven, state.jumps) = (Some((ground, yaw, clearance)), true);
        true
    }

    fn known_body(&self, body: usize) -> Result<(), SceneError> {
        if body < self.scene.interactors.len() && !self.state.vacant.contains(&(body as u32)) {
            return Ok(());
        }
        let bodies = self.scene.interactors.len() - self.state.vacant.len();
        Err(SceneError::in_file("", format!("there is no body number {body} among {bodies}")))
    }

    /// Looks at bodies that have changed, for those who push single points out of them.
    fn look_at_bodies(&mut self) {
        self.model.maps = self.model.maps.after(&self.model.bodies);
        self.texels = Arc::clone(&self.model.maps.texels);
        self.model.revision.bodies += 1;
    }

    /// A camera that follows a body stays where it is now.
    fn leave_camera(&mut self, body: usize) {
        let name = &self.scene.interactors[body].name;
        if name.is_empty() || self.scene.camera.follow.as_ref() != Some(name) {
            return;
        }
        let view = self.scene_camera(0.0);
        let above = |at: [f64; 3]| [at[0], at[1] - self.model.terrain.height_at(at[0], at[2]), at[2]].map(within);
        let (eye, target) = (above(view.eye), above(view.target));
        self.scene.camera = Camera { eye, target, follow: None, keys: Vec::new(), ..self.scene.camera.clone() };
    }
}

/// Metres within what a scene may say.
fn within(metres: f64) -> f64 {
    let low = if metres > -1e6 { metres } else { -1e6 };
    if low < 1e6 { low } else { 1e6 }
}
