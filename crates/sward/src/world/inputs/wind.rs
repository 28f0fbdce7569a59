//! Sources of wind that come, go and change while a world runs. They fade in and out, so that nothing jumps, and gusts travel on as they did.

use crate::model::Assets;
use crate::scene::{SceneError, Uniform, WindSource};
use crate::state::WindState;
use crate::wind::fluid::FluidState;
use crate::world::inputs::steps_of;
use crate::world::{Input, World};

/// Times by which eddies have faded to a thousandth.
const REST: f64 = 7.0;

/// What is left of a source that has gone.
const CALM: WindSource = WindSource::Uniform(Uniform { velocity: [0.0, 0.0] });

impl World {
    /// Adds a source of wind, which grows to its strength within `fade` seconds (0: at once, and then plants that rest in the wind jump). Returns its
    /// number: that of one that has gone, the lowest first, or the next. One that moves follows a body, which is driven.
    ///
    /// # Errors
    /// What a scene with this source would be refused for, or a picture that cannot be read; the world is as it was. Sources that fade out count.
    pub fn add_wind(&mut self, source: WindSource, fade: f64, assets: &dyn Assets) -> Result<usize, SceneError> {
        let place = self.place_wind(&source, assets)?;
        self.note(|| Input::AddWind { source: source.clone(), fade });
        self.begin_wind(place, source, fade);
        Ok(place)
    }

    /// Puts another source in place of one: the one fades out while the other fades in, `fade` seconds long. Returns the number of the other.
    ///
    /// # Errors
    /// As [`World::add_wind`]; or there is no such source.
    pub fn change_wind(&mut self, wind: usize, source: WindSource, fade: f64, assets: &dyn Assets) -> Result<usize, SceneError> {
        if !self.blows(wind) {
            return Err(SceneError::in_file("", format!("there is no source of wind number {wind}")));
        }
        let place = if steps_of(fade, self.model.dt) == 0 {
            let mut sources = self.scene.wind.clone();
            sources[wind] = source.clone();
            self.scene.check_wind(&sources)?;
            self.model.paint_wind(&source, wind, assets)?;
            wind
        } else {
            self.place_wind(&source, assets)?
        };
        self.note(|| Input::ChangeWind { wind, source: source.clone(), fade });
        if place != wind {
            self.end_wind(wind, fade);
        }
        self.begin_wind(place, source, fade);
        Ok(place)
    }

    /// Takes a source of wind away, within `fade` seconds. Returns whether there was such a source.
    pub fn remove_wind(&mut self, wind: usize, fade: f64) -> bool {
        if !self.blows(wind) {
            return false;
        }
        self.note(|| Input::RemoveWind { wind, fade });
        self.end_wind(wind, fade);
        true
    }

    /// Whether there is a source of this number, and it does not fade out.
    fn blows(&self, wind: usize) -> bool {
        self.state.winds.get(wind).is_some_and(|state| !state.vacant && state.levels[1] > 0.0)
    }

    /// Where a source would be, if it may be there.
    fn place_wind(&mut self, source: &WindSource, assets: &dyn Assets) -> Result<usize, SceneError> {
        let place = self.state.winds.iter().position(|state| state.vacant).unwrap_or(self.scene.wind.len());
        let mut sources = self.scene.wind.clone();
        sources.resize(sources.len().max(place + 1), CALM);
        sources[place] = source.clone();
        self.scene.check_wind(&sources)?;
        self.model.paint_wind(source, place, assets)?;
        Ok(place)
    }

    fn begin_wind(&mut self, place: usize, source: WindSource, fade: f64) {
        let number = self.state.winds.iter().map(|state| state.number + 1).max().unwrap_or(0);
        let steps = steps_of(fade, self.model.dt);
        let state = WindState { number, levels: [0.0, 1.0], begin: self.state.step, steps, vacant: false };
        if place < self.scene.wind.len() {
            (self.scene.wind[place], self.state.winds[place]) = (source, state);
        } else {
            self.scene.wind.push(source);
            self.state.winds.push(state);
        }
        self.look_at_wind();
    }

    fn end_wind(&mut self, wind: usize, fade: f64) {
        let level = self.state.winds[wind].level(self.state.step as f64);
        let steps = steps_of(fade, self.model.dt);
        let state = &mut self.state.winds[wind];
        (state.levels, state.begin, state.steps) = ([level, 0.0], self.state.step, steps);
        if steps + self.rest_of(wind) == 0 {
            self.still_wind(wind);
        } else {
            self.look_at_wind();
        }
    }

    /// A source is gone.
    pub(super) fn still_wind(&mut self, wind: usize) {
        self.scene.wind[wind] = CALM;
        self.state.winds[wind].vacant = true;
        self.look_at_wind();
    }

    /// Takes away what has faded out, before a step is planned; while something fades, whoever reads the mean wind learns of it.
    pub(in crate::world) fn fade_winds(&mut self) {
        let step = self.state.step;
        let ends = |wind: usize| self.state.winds[wind].begin + self.state.winds[wind].steps + self.rest_of(wind);
        let there = |wind: &usize| !self.state.winds[*wind].vacant;
        let moves = |wind: usize| self.state.winds[wind].levels[0] != self.state.winds[wind].levels[1] && step <= ends(wind);
        if !(0..self.state.winds.len()).filter(there).any(moves) {
            return;
        }
        let over = |wind: &usize| self.state.winds[*wind].levels[1] == 0.0 && step >= ends(*wind);
        let gone: Vec<usize> = (0..self.state.winds.len()).filter(there).filter(over).collect();
        for wind in gone {
            self.scene.wind[wind] = CALM;
            self.state.winds[wind].vacant = true;
        }
        self.look_at_wind();
    }

    /// Steps for which a source still moves air when its strength is 0: eddies fade by themselves.
    fn rest_of(&self, wind: usize) -> u64 {
        match &self.scene.wind[wind] {
            WindSource::Fluid(fluid) if self.state.winds[wind].levels[1] == 0.0 => (REST * f64::from(fluid.fade) / self.model.dt) as u64,
            _ => 0,
        }
    }

    /// Compiles the sources of wind anew. Planes of air flow on; new ones are still.
    pub(crate) fn look_at_wind(&mut self) {
        let before: Vec<u32> = self.model.fluids.iter().map(|fluid| fluid.number).collect();
        self.model.blow(&self.scene, &self.state.winds, self.state.step);
        let flows = std::mem::take(&mut self.state.fluids);
        for fluid in &self.model.fluids {
            let known = before.iter().position(|number| *number == fluid.number).and_then(|place| flows.get(place));
            self.state.fluids.push(known.cloned().unwrap_or_else(|| FluidState::still(fluid.model.side)));
        }
    }
}
