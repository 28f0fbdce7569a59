//! Responses that change while a world runs: parameters glide from what they were to what they shall be, and no plant jumps.

use crate::model::tuning;
use crate::scene::{Response, SceneError, Stand, Value};
use crate::state::Tuning;
use crate::world::inputs::steps_of;
use crate::world::{Input, World};

impl World {
    /// Gives a stand other parameters of its response, which it glides to within `over` seconds; between 0.25 and 1 s nobody sees a jump, and 0 is at
    /// once. `stand` is its number in the scene; the response is the same method with other numbers.
    ///
    /// Plants go on from where they are, as fast as they are. Where patches sleep, what is shown follows the wind by the numbers of the moment.
    ///
    /// # Errors
    /// Another method, or numbers that store a state in another way: then [`World::rescene`] begins the stand anew. Numbers out of range, or plants that
    /// could not stand. The world is as it was.
    pub fn tune(&mut self, stand: usize, response: Response, over: f64) -> Result<(), SceneError> {
        let Some(declared) = self.scene.stands.get(stand) else {
            return Err(SceneError::in_file("", format!("there is no stand number {stand} among {}", self.scene.stands.len())));
        };
        let wanted = Stand { response: Some(response.clone()), ..declared.clone() };
        self.scene.check_stand(stand, &wanted)?;
        let now = self.tuned_now(stand)?;
        // All that can fail is tried before anything changes.
        self.model.tuned(&self.scene, stand, wanted.resolve()?)?;
        self.note(|| Input::Tune { stand, response: response.clone(), over });
        let steps = steps_of(over, self.model.dt);
        self.scene.stands[stand] = wanted;
        self.state.tunings.retain(|tuning| tuning.stand != stand);
        self.state.tunings.push(Tuning { stand, from: now, begin: self.state.step, steps });
        Ok(())
    }

    /// A stand's response as it is now, all said.
    fn tuned_now(&self, stand: usize) -> Result<Response, SceneError> {
        let wanted = tuning::said(&self.scene.stands[stand].resolve()?);
        let glide = self.state.tunings.iter().find(|tuning| tuning.stand == stand);
        Ok(glide.map_or_else(|| wanted.clone(), |tuning| tuning.from.towards(&wanted, share(tuning, self.state.step))))
    }

    /// Brings responses that glide to where they are in the coming step. Returns the stands of plants that swing by themselves whose numbers have changed.
    pub(in crate::world) fn glide(&mut self) -> Vec<usize> {
        let next = self.state.step + 1;
        let retuned = self.glide_to(next);
        self.state.tunings.retain(|tuning| next < tuning.begin + tuning.steps);
        retuned
    }

    /// The same as of step `next`, whatever is over by then.
    pub(crate) fn glide_to(&mut self, next: u64) -> Vec<usize> {
        let mut retuned = Vec::new();
        for tuning in &self.state.tunings {
            let over = next >= tuning.begin + tuning.steps;
            let wanted = &self.scene.stands[tuning.stand];
            let species = match over {
                true => wanted.resolve(),
                false => wanted.resolve().and_then(|species| {
                    let response = Some(tuning.from.towards(&tuning::said(&species), share(tuning, next)));
                    Stand { response, ..wanted.clone() }.resolve()
                }),
            };
            // Both ends could stand; if something between them cannot, it is left out.
            if let Ok(tuned) = species.and_then(|species| self.model.tuned(&self.scene, tuning.stand, species)) {
                retuned.extend(self.model.put(tuned));
            }
        }
        retuned
    }
}

/// How far a glide has come after `step` steps, 0 to 1.
fn share(tuning: &Tuning, step: u64) -> f64 {
    let share = step.saturating_sub(tuning.begin) as f64 / tuning.steps.max(1) as f64;
    if share < 1.0 { share * share * (3.0 - 2.0 * share) } else { 1.0 }
}
