//! Fingers: a stick to drive with, and buttons, where there is no keyboard. Turning, moving and pinching are the camera's: see [`super::input`].

use std::collections::BTreeMap;

use eframe::egui::{self, Color32, Pos2, Rect, Stroke, TouchPhase, Vec2, vec2};

use super::Viewer;
use crate::camera::Kind;
use crate::drive::{Asked, Vehicle};
use crate::marks::mark;

/// Radius of the stick, and of a button, points.
const STICK: f32 = 62.0;
const BUTTON: f32 = 30.0;
/// From the picture's corner to the middle of the stick, points.
const INSET: f32 = 92.0;

/// What a finger rests on.
#[derive(Clone, Copy, Debug, PartialEq)]
enum On {
    Stick,
    Button(&'static str),
    Picture,
}

/// Fingers on the picture.
#[derive(Debug, Default)]
pub(super) struct Touch {
    /// Whether there ever was one: only then is there a stick.
    seen: bool,
    /// What each is on, and where it is now.
    fingers: BTreeMap<u64, (On, Pos2)>,
    /// How far free fingers have moved since the last look, while others hold the stick or a button.
    turned: Vec2,
    /// Middle of the stick.
    middle: Pos2,
}

impl Touch {
    /// Whether a finger is on the stick or a button: then none of them moves the camera as the mouse does.
    pub(super) fn holds(&self) -> bool {
        self.fingers.values().any(|(on, _)| *on != On::Picture)
    }

    /// How far the camera shall be turned by fingers beside the stick, points.
    pub(super) fn turned(&mut self) -> Vec2 {
        std::mem::take(&mut self.turned)
    }

    /// What the fingers ask for.
    fn asked(&self) -> Asked {
        let mut asked = Asked::default();
        for (on, at) in self.fingers.values() {
            match on {
                On::Stick => {
                    let [right, down] = <[f32; 2]>::from((*at - self.middle) / STICK).map(|part| f64::from(part.clamp(-1.0, 1.0)));
                    (asked.right, asked.ahead) = (right, -down);
                }
                On::Button("brake") => asked.brake = true,
                On::Button("up") => asked.up = 1.0,
                On::Button("down") => asked.up = -1.0,
                _ => {}
            }
        }
        asked
    }

    fn follow(&mut self, events: &[egui::Event], places: &[(On, Pos2, f32)]) {
        for event in events {
            let egui::Event::Touch { id, phase, pos, .. } = event else { continue };
            self.seen = true;
            match phase {
                TouchPhase::Start => {
                    let on = places.iter().find(|(_, middle, radius)| middle.distance(*pos) < 1.25 * radius);
                    self.fingers.insert(id.0, (on.map_or(On::Picture, |(on, ..)| *on), *pos));
                }
                TouchPhase::Move => {
                    let holds = self.holds();
                    if let Some((on, at)) = self.fingers.get_mut(&id.0) {
                        if holds && *on == On::Picture {
                            self.turned += *pos - *at;
                        }
                        *at = *pos;
                    }
                }
                TouchPhase::End | TouchPhase::Cancel => _ = self.fingers.remove(&id.0),
            }
        }
    }
}

impl Viewer {
    /// Keys and fingers together.
    pub(super) fn asked_of_all(&self, context: &egui::Context) -> Asked {
        let (keys, fingers) = (self.asked(context), self.touch.asked());
        let both = |a: f64, b: f64| (a + b).clamp(-1.0, 1.0);
        Asked {
            ahead: both(keys.ahead, fingers.ahead),
            right: both(keys.right, fingers.right),
            up: both(keys.up, fingers.up),
            brake: keys.brake || fingers.brake,
        }
    }

    /// What there is for fingers to rest on: name, middle, radius.
    fn rests(&self, half: Rect) -> Vec<(On, Pos2, f32)> {
        let flies = self.camera.kind == Kind::Fly && self.drive.is_none();
        if !self.touch.seen || (self.drive.is_none() && !flies) {
            return Vec::new();
        }
        let names: &[&str] = match self.drive.map(|drive| drive.vehicle) {
            Some(Vehicle::Truck) => &["brake"],
            Some(Vehicle::Walker) => &[],
            Some(Vehicle::Helicopter) | None => &["down", "up"],
        };
        let mut rests = vec![(On::Stick, half.left_bottom() + vec2(INSET, -INSET), STICK)];
        for (index, name) in names.iter().enumerate() {
            let middle = half.right_bottom() - vec2(0.6 * INSET, 0.6 * INSET + 2.4 * BUTTON * index as f32);
            rests.push((On::Button(name), middle, BUTTON));
        }
        rests
    }

    /// Follows the fingers.
    pub(super) fn follow_fingers(&mut self, ui: &egui::Ui, half: Rect) {
        let rests = self.rests(half);
        self.touch.middle = half.left_bottom() + vec2(INSET, -INSET);
        ui.input(|input| self.touch.follow(&input.events, &rests));
    }

    /// Draws what fingers rest on.
    pub(super) fn show_stick(&self, ui: &egui::Ui, half: Rect) {
        let painter = ui.painter_at(half);
        let edge = Stroke::new(2.0, Color32::from_white_alpha(140));
        for (on, middle, radius) in self.rests(half) {
            let finger = self.touch.fingers.values().find(|(other, _)| *other == on).map(|(_, at)| *at);
            let fill = Color32::from_black_alpha(if finger.is_some() { 130 } else { 80 });
            painter.circle(middle, radius, fill, edge);
            let name = if let On::Button(name) = on { name } else { "stick" };
            mark(ui, name, Rect::from_center_size(middle, Vec2::splat(2.0 * radius)));
            match on {
                On::Button(name) => {
                    painter.text(middle, egui::Align2::CENTER_CENTER, name, egui::FontId::proportional(14.0), Color32::WHITE);
                }
                _ => {
                    let away = finger.map_or(Vec2::ZERO, |at| at - middle);
                    let knob = middle + away * (radius / away.length().max(radius));
                    painter.circle(knob, 0.4 * radius, Color32::from_white_alpha(120), edge);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn touch(id: u64, phase: TouchPhase, pos: [f32; 2]) -> egui::Event {
        egui::Event::Touch { device_id: egui::TouchDeviceId(0), id: egui::TouchId(id), phase, pos: pos.into(), force: None }
    }

    #[test]
    fn one_finger_drives_while_another_turns() {
        let middle = Pos2::new(100.0, 500.0);
        let places = [(On::Stick, middle, STICK), (On::Button("brake"), Pos2::new(600.0, 500.0), BUTTON)];
        let mut fingers = Touch { middle, ..Touch::default() };
        fingers.follow(&[touch(3, TouchPhase::Start, [300.0, 100.0]), touch(3, TouchPhase::Move, [340.0, 100.0])], &places);
        assert_eq!((fingers.asked(), fingers.turned()), (Asked::default(), Vec2::ZERO), "control: that is the camera's");
        fingers.follow(&[touch(7, TouchPhase::Start, [100.0, 480.0]), touch(7, TouchPhase::Move, [131.0, 438.0])], &places);
        fingers.follow(&[touch(3, TouchPhase::Move, [350.0, 95.0])], &places);
        let asked = fingers.asked();
        assert!((asked.right - 0.5).abs() < 1e-6 && (asked.ahead - 1.0).abs() < 1e-6 && !asked.brake, "{asked:?}");
        assert_eq!(fingers.turned(), vec2(10.0, -5.0));
        fingers.follow(&[touch(7, TouchPhase::End, [131.0, 438.0]), touch(9, TouchPhase::Start, [605.0, 505.0])], &places);
        assert_eq!(fingers.asked(), Asked { brake: true, ..Asked::default() });
        fingers.follow(&[touch(9, TouchPhase::Cancel, [0.0; 2]), touch(3, TouchPhase::End, [0.0; 2])], &places);
        assert!(!fingers.holds() && fingers.seen);
    }
}
