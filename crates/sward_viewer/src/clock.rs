//! How time passes: at its own pace, slowly, in single steps, or not at all.

/// How time passes in the window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clock {
    /// Whether it stands still.
    pub paused: bool,
    /// Seconds of the scene for each of the wall's, 0.05 to 2.
    pub pace: f64,
    /// Steps asked for while it stands still.
    pub single: u32,
    /// Steps for every picture, whatever the wall's clock says: for scripts.
    pub fixed: Option<u32>,
}

impl Default for Clock {
    fn default() -> Self {
        Self { paused: false, pace: 1.0, single: 0, fixed: None }
    }
}

/// What passes before the next picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Passing {
    /// So many whole steps.
    Steps(u32),
    /// So many seconds of the scene.
    Seconds(f64),
}

impl Clock {
    /// What passes in `seconds` of the wall's time.
    pub fn pass(&mut self, seconds: f64) -> Passing {
        if self.paused {
            return Passing::Steps(std::mem::take(&mut self.single));
        }
        self.single = 0;
        match self.fixed {
            Some(steps) => Passing::Steps(steps),
            None => Passing::Seconds(seconds.clamp(0.0, 0.25) * self.pace),
        }
    }
}

impl Clock {
    /// Single steps that could not be taken are still asked for.
    pub fn give_back(&mut self, steps: u32) {
        if self.paused {
            self.single += steps;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_passes_as_asked() {
        let mut clock = Clock::default();
        assert_eq!(clock.pass(0.1), Passing::Seconds(0.1));
        assert_eq!(clock.pass(60.0), Passing::Seconds(0.25), "a minute's sleep is not caught up with");
        clock.pace = 0.5;
        assert_eq!(clock.pass(0.1), Passing::Seconds(0.05));
        clock.fixed = Some(3);
        assert_eq!(clock.pass(0.1), Passing::Steps(3));
        clock.paused = true;
        clock.single = 2;
        assert_eq!([clock.pass(0.1), clock.pass(0.1)], [Passing::Steps(2), Passing::Steps(0)]);
        clock.give_back(1);
        assert_eq!([clock.pass(0.1), clock.pass(0.1)], [Passing::Steps(1), Passing::Steps(0)]);
    }
}
