//! A gamepad: sticks drive and look, buttons do what keys do.
//!
//! Left stick: steering, and walking or flying ahead. Triggers: pedals, and a helicopter's height. Right stick: the camera. South: hand brake. North: the wheel.
//! East: the next camera. West: the next body. Start: pause.

use gilrs::{Axis, Button, EventType, Gilrs};

use crate::drive::Asked;

/// Sticks nearer to their middle than this say nothing.
const DEAD: f32 = 0.12;

/// What was pressed since the last picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Pressed {
    /// Take the wheel, or leave it.
    pub wheel: bool,
    /// The next camera.
    pub camera: bool,
    /// The next body.
    pub body: bool,
    /// Pause, or go on.
    pub pause: bool,
}

/// All gamepads that are there.
pub struct Gamepad {
    gilrs: Gilrs,
}

/// What a stick asks for once its dead middle is taken out, -1 to 1.
fn stick(value: f32) -> f64 {
    let beyond = (value.abs() - DEAD).max(0.0) / (1.0 - DEAD);
    f64::from(beyond.min(1.0) * value.signum())
}

/// The stronger of two wishes.
fn stronger(a: f64, b: f64) -> f64 {
    if b.abs() > a.abs() { b } else { a }
}

impl Gamepad {
    /// Listens; `None` where the system has no way to.
    pub fn new() -> Option<Self> {
        Gilrs::new().ok().map(|gilrs| Self { gilrs })
    }

    /// Hears what was pressed.
    pub fn pressed(&mut self) -> Pressed {
        let mut pressed = Pressed::default();
        while let Some(event) = self.gilrs.next_event() {
            if let EventType::ButtonPressed(button, _) = event.event {
                match button {
                    Button::North => pressed.wheel = true,
                    Button::East => pressed.camera = true,
                    Button::West => pressed.body = true,
                    Button::Start => pressed.pause = true,
                    _ => {}
                }
            }
        }
        pressed
    }

    /// What sticks and pedals ask for, beside the keys.
    pub fn asked(&self, keys: Asked) -> Asked {
        self.gilrs.gamepads().fold(keys, |asked, (_, pad)| {
            let pedal = |button| pad.button_data(button).map_or(0.0, |data| f64::from(data.value()));
            let pedals = pedal(Button::RightTrigger2) - pedal(Button::LeftTrigger2);
            let ahead = stronger(pedals, stick(pad.value(Axis::LeftStickY)));
            let up = f64::from(u8::from(pad.is_pressed(Button::RightTrigger))) - f64::from(u8::from(pad.is_pressed(Button::LeftTrigger)));
            Asked {
                ahead: stronger(asked.ahead, ahead),
                right: stronger(asked.right, stick(pad.value(Axis::LeftStickX))),
                up: stronger(asked.up, up),
                brake: asked.brake || pad.is_pressed(Button::South),
            }
        })
    }

    /// How the right stick turns the camera, -1 to 1: to the right, up.
    pub fn look(&self) -> [f64; 2] {
        self.gilrs.gamepads().fold([0.0; 2], |look, (_, pad)| {
            [(0, Axis::RightStickX), (1, Axis::RightStickY)].map(|(axis, of): (usize, Axis)| stronger(look[axis], stick(pad.value(of))))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sticks_have_a_dead_middle_and_reach_the_end() {
        assert_eq!([stick(0.0), stick(0.1), stick(-0.1), stick(1.0), stick(-1.0)], [0.0, 0.0, -0.0, 1.0, -1.0]);
        assert!(stick(0.5) > 0.3 && stick(0.5) < 0.5);
        assert_eq!([stronger(0.2, -0.7), stronger(1.0, 0.3)], [-0.7, 1.0]);
    }
}
