//! Parts of a scene to choose from: winds, lights, ways plants move.

use sward::scene::{Response, Scene, WindSource};

/// Which part of a scene a preset replaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// All sources of wind.
    Wind,
    /// Sun, sky and air.
    Light,
    /// How all stands of grass move.
    Plants,
}

impl Part {
    /// All of them, with what menus say.
    pub const ALL: [(Self, &'static str); 3] = [(Self::Wind, "wind"), (Self::Light, "light"), (Self::Plants, "plants")];
}

/// A part to choose.
#[derive(Clone, Copy, Debug)]
pub struct Preset {
    /// What it replaces.
    pub part: Part,
    /// What menus say.
    pub name: &'static str,
    /// What it is.
    pub about: &'static str,
    /// As a scene writes it; nothing: what each species does by itself.
    ron: &'static str,
}

/// All of them.
pub const PRESETS: [Preset; 19] = [
    Preset { part: Part::Wind, name: "calm", about: "No wind at all", ron: "[]" },
    Preset { part: Part::Wind, name: "breeze", about: "2 m/s, a few soft gusts", ron: "[Natural(velocity: (1.8, 0.9), turbulence: 0.2)]" },
    Preset { part: Part::Wind, name: "fresh", about: "5.5 m/s with gusts", ron: "[Natural(velocity: (4.9, 2.5), turbulence: 0.3)]" },
    Preset { part: Part::Wind, name: "storm", about: "15 m/s, hard gusts", ron: "[Natural(velocity: (13.4, 6.7), turbulence: 0.45)]" },
    Preset { part: Part::Wind, name: "steady", about: "6 m/s without a gust: for measuring", ron: "[Uniform(velocity: (6.0, 0.0))]" },
    Preset {
        part: Part::Wind,
        name: "whirl",
        about: "Air that turns around the origin",
        ron: "[Footprint(flow: Swirl, radius: 14, speed: 11)]",
    },
    Preset {
        part: Part::Wind,
        name: "downwash",
        about: "Under a helicopter that circles",
        ron: "[Natural(velocity: (1.5, 0.8), turbulence: 0.2), Footprint(flow: Outward, radius: 14, speed: 18, height: 6, path: Circle(radius: 9, speed: 5))]",
    },
    Preset { part: Part::Wind, name: "eddies", about: "Air that flows, with eddies", ron: "[Fluid(velocity: (3.0, 1.0))]" },
    Preset {
        part: Part::Light,
        name: "sunrise",
        about: "A low, warm sun",
        ron: "(azimuth: 1.35, elevation: 0.09, haze: 0.45, clouds: 0.25)",
    },
    Preset { part: Part::Light, name: "morning", about: "Clear and soft", ron: "(azimuth: 1.0, elevation: 0.45, haze: 0.25, clouds: 0.2)" },
    Preset {
        part: Part::Light,
        name: "noon",
        about: "High sun, hard shadows",
        ron: "(azimuth: 0.2, elevation: 1.1, haze: 0.12, clouds: 0.1)",
    },
    Preset {
        part: Part::Light,
        name: "evening",
        about: "Low sun from the other side",
        ron: "(azimuth: -1.9, elevation: 0.16, haze: 0.4, clouds: 0.35)",
    },
    Preset {
        part: Part::Light,
        name: "overcast",
        about: "No shadows",
        ron: "(azimuth: 1.0, elevation: 0.6, strength: 0.55, haze: 0.6, clouds: 1.0)",
    },
    Preset {
        part: Part::Light,
        name: "mist",
        about: "The far side is gone",
        ron: "(azimuth: 1.2, elevation: 0.2, strength: 0.8, haze: 0.8, fog: 0.03, clouds: 0.6)",
    },
    Preset { part: Part::Plants, name: "natural", about: "As each species does by itself", ron: "" },
    Preset {
        part: Part::Plants,
        name: "keeps tracks",
        about: "Creeps back over many seconds, as trampled turf does",
        ron: "Continuum(c0: 0.8, mu: 0.02, kappa: 5.0, lambda_theta: 0.65, kappa_omega: 114.0)",
    },
    Preset { part: Part::Plants, name: "lively", about: "Springs back and sways", ron: "Continuum(lambda_theta: 0.15)" },
    Preset { part: Part::Plants, name: "soft", about: "Each plant by itself, slow", ron: "Oscillator(frequency: 0.9, damping: 0.12)" },
    Preset { part: Part::Plants, name: "stiff", about: "Each plant by itself, quick", ron: "Oscillator(frequency: 3.5, damping: 0.3)" },
];

impl Preset {
    /// The scene with this part of it; `None` if the preset itself is no longer valid.
    pub fn put(&self, scene: &Scene) -> Option<Scene> {
        let parse = |text: String| Scene::parse(&text, self.name).ok();
        let mut scene = scene.clone();
        match self.part {
            Part::Wind => {
                // What bodies carry along stays with them.
                let carried = |source: &WindSource| matches!(source, WindSource::Footprint(print) if print.follow.is_some());
                scene.wind.retain(carried);
                scene.wind.extend(parse(format!("(version: 1, wind: {})", self.ron))?.wind);
            }
            Part::Light => {
                let environment = scene.light.environment.clone();
                scene.light = parse(format!("(version: 1, light: {})", self.ron))?.light;
                scene.light.environment = environment;
            }
            Part::Plants => {
                let response: Option<Response> = match self.ron {
                    "" => None,
                    ron => parse(format!("(version: 1, stands: [(species: Meadow, response: {ron})])"))?.stands.pop()?.response,
                };
                scene.stands.iter_mut().filter(|stand| !stand.species.is_mesh()).for_each(|stand| stand.response = response.clone());
            }
        }
        Some(scene)
    }
}

#[cfg(test)]
mod tests {
    use sward::world::World;

    use super::*;

    #[test]
    fn every_preset_fits_and_changes_something() {
        let mut idle = Vec::new();
        for name in ["hello", "downwash"] {
            let shipped = sward_scenes::shipped(name).expect("shipped");
            let scene = Scene::parse(shipped.text, name).expect("valid");
            for preset in PRESETS {
                let changed = preset.put(&scene).unwrap_or_else(|| panic!("{} does not parse", preset.name));
                idle.extend((changed == scene).then_some((name, preset.name)));
                let built = World::new(changed, &sward_scenes::Embedded);
                assert!(built.is_ok(), "{name} {}: {:?}", preset.name, built.err());
            }
        }
        // Around the helicopter that wind blows already.
        assert_eq!(idle, [("downwash", "natural")]);
    }

    #[test]
    fn a_helicopter_keeps_its_wind_in_a_calm() {
        let text =
            "(version: 1, interactors: [(name: \"h\", shape: Sphere(radius: 1))], wind: [Natural(), Footprint(follow: Some(\"h\"))])";
        let scene = Scene::parse(text, "x").expect("valid");
        let calm = PRESETS[0].put(&scene).expect("valid");
        assert_eq!(calm.wind.len(), 1);
    }
}
