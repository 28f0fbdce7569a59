//! What a page's address says after the question mark, as the command line of a window does: `?scene=reed&steps=2&status`.

use crate::source::Source;
use crate::stage::Backend;

/// What was asked for.
#[derive(Clone, Debug, Default)]
pub struct Address {
    /// `scene=NAME`
    pub scene: Option<Source>,
    /// `steps=N`: so many steps for every picture.
    pub steps: Option<u32>,
    /// `pixels=SHARE`, 0.2 to 1.
    pub pixels: Option<f32>,
    /// `plants=SHARE`, 0.05 to 1: of the distance up to which every plant is drawn.
    pub plants: Option<f32>,
    /// `gpu` or `cpu`: where cells move.
    pub backend: Option<Backend>,
    /// `raster`: the processor draws.
    pub raster: bool,
    /// `plain`: without WebGL as well.
    pub plain: bool,
    /// `status`: `window.sward_status` says what the page shows.
    pub status: bool,
    /// What could not be understood.
    pub problem: Option<String>,
}

/// What one may write.
const KNOWN: &str = "scene=NAME, steps=N, pixels=0.2…1, plants=0.05…1, cpu, gpu, raster, plain, status";

impl Address {
    /// Reads what follows the address, with or without its question mark. What it does not understand it says, and goes on.
    pub fn of(search: &str) -> Self {
        let mut address = Self::default();
        for part in search.trim_start_matches('?').split('&').filter(|part| !part.is_empty()) {
            let (name, value) = part.split_once('=').unwrap_or((part, ""));
            let understood = match name {
                "scene" => Self::put(&mut address.scene, Some(Source::named(value)).filter(|_| !value.is_empty())),
                "steps" => Self::put(&mut address.steps, value.parse().ok().filter(|steps| *steps <= 1000)),
                "pixels" => Self::put(&mut address.pixels, value.parse().ok().filter(|share| (0.2..=1.0).contains(share))),
                "plants" => Self::put(&mut address.plants, value.parse().ok().filter(|share| (0.05..=1.0).contains(share))),
                "gpu" => Self::put(&mut address.backend, Some(Backend::Gpu)),
                "cpu" => Self::put(&mut address.backend, Some(Backend::Cpu)),
                "raster" => Self::raise(&mut address.raster),
                "plain" => Self::raise(&mut address.plain),
                "status" => Self::raise(&mut address.status),
                _ => false,
            };
            if !understood {
                address.problem = Some(format!("the page's address says \"{part}\", which is not understood; it may say: {KNOWN}"));
            }
        }
        address
    }

    /// Whether there is a value; it is put into its place.
    fn put<T>(place: &mut Option<T>, value: Option<T>) -> bool {
        let understood = value.is_some();
        *place = value.or(place.take());
        understood
    }

    fn raise(flag: &mut bool) -> bool {
        *flag = true;
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_address_is_a_command_line() {
        let address = Address::of("?scene=reed&steps=2&pixels=0.5&plants=0.3&gpu&raster&status");
        assert!(matches!(address.scene, Some(Source::Shipped(scene)) if scene.name == "reed"));
        assert_eq!((address.steps, address.backend), (Some(2), Some(Backend::Gpu)));
        assert_eq!((address.pixels, address.plants), (Some(0.5), Some(0.3)));
        assert!(address.raster && address.status && !address.plain && address.problem.is_none());
        let nothing = Address::of("");
        assert!(nothing.scene.is_none() && !nothing.status && nothing.problem.is_none(), "control");
    }

    #[test]
    fn mistakes_are_told() {
        for mistake in ["steps=many", "steps=9999999", "pixels=7", "plants=0", "wind", "scene="] {
            let problem = Address::of(&format!("status&{mistake}")).problem;
            assert!(problem.is_some_and(|problem| problem.contains(mistake) && problem.contains("scene=NAME")), "{mistake}");
        }
    }
}
