//! Looking inside: what the engine knows, drawn over the picture.
//!
//! Everything is asked of the world in world space and then seen through [`Sight`], so it lies where the plants stand whatever draws them.

mod arrows;
mod bodies;
mod lattice;
mod patches;
mod plants;
mod ramp;

use eframe::egui;
use sward::world::World;

use crate::sight::Sight;
use arrows::Rates;

/// Something that can be looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// How far plants lean.
    Bend,
    /// How fast they move.
    Rate,
    /// How the air moves.
    Wind,
    /// Which patches are awake, and why.
    Patches,
    /// What bodies sweep.
    Contacts,
    /// How long plants are, of how long they should be.
    Lengths,
    /// How deep plants are in bodies.
    Penetration,
}

impl Kind {
    /// All of them, with what menus say, and what it is.
    pub const ALL: [(Self, &'static str, &'static str); 7] = [
        (Self::Bend, "bend", "β: how far plants lean, rad"),
        (Self::Rate, "ω", "How fast they move, rad/s: from step to step"),
        (Self::Wind, "wind", "Velocity of the air, m/s"),
        (Self::Patches, "patches", "Awake patches: pushed, kept awake by the wind near the eye, fading, handing their blades back"),
        (Self::Contacts, "contacts", "What the bodies swept in the last step, on the ground"),
        (Self::Lengths, "lengths", "How long plants are, of how long they should be"),
        (Self::Penetration, "penetration", "How deep plants are in bodies, mm"),
    ];

    fn bit(self) -> u8 {
        1 << self as u8
    }
}

/// What is looked at.
#[derive(Debug, Default)]
pub struct Overlays {
    shown: u8,
    rates: Rates,
    /// What the last picture said of each, in words.
    pub said: Vec<(Kind, String)>,
    /// What was drawn last over each half.
    drawn: [Vec<egui::epaint::ClippedShape>; 2],
}

/// Asks a painter's layer of what is drawn on it.
fn shapes<T: Default>(painter: &egui::Painter, ask: impl FnOnce(&egui::layers::PaintList) -> T) -> T {
    painter.ctx().graphics(|graphics| graphics.get(painter.layer_id()).map(ask)).unwrap_or_default()
}

/// Where plants are looked at one by one: around a point (x, z), m.
#[derive(Clone, Copy, Debug)]
pub struct Closely {
    /// The middle.
    pub at: [f64; 2],
    /// Half its side, m.
    pub radius: f64,
}

impl Overlays {
    /// Whether one is shown.
    pub fn shows(&self, kind: Kind) -> bool {
        self.shown & kind.bit() > 0
    }

    /// Whether any is shown.
    pub fn any(&self) -> bool {
        self.shown > 0
    }

    /// Shows one, or no longer.
    pub fn toggle(&mut self, kind: Kind) {
        self.shown ^= kind.bit();
        self.said.clear();
        self.drawn = Default::default();
    }

    /// Draws what is looked at over half 0 or 1 of the picture.
    pub fn draw(&mut self, painter: &egui::Painter, half: usize, sight: &Sight, world: &World, closely: Closely) {
        let begun = shapes(painter, |list| list.next_idx().0);
        self.said.clear();
        for (kind, ..) in Kind::ALL.into_iter().filter(|(kind, ..)| self.shown & kind.bit() > 0) {
            let said = match kind {
                Kind::Patches => patches::draw(painter, sight, world),
                Kind::Bend => arrows::bend(painter, sight, world),
                Kind::Rate => self.rates.draw(painter, sight, world),
                Kind::Wind => arrows::wind(painter, sight, world),
                Kind::Contacts => bodies::swept(painter, sight, world),
                Kind::Lengths => plants::lengths(painter, sight, world, closely),
                Kind::Penetration => plants::penetration(painter, sight, world, closely),
            };
            self.said.push((kind, said));
        }
        self.legend(painter, sight.area());
        self.drawn[half] = shapes(painter, |list| list.all_entries().skip(begun).cloned().collect());
    }

    /// Draws once more what was drawn last: while cells are on their way, nothing newer is known.
    pub fn again(&self, painter: &egui::Painter, half: usize) {
        self.drawn[half].iter().for_each(|drawn| {
            painter.with_clip_rect(drawn.clip_rect).add(drawn.shape.clone());
        });
    }

    /// What colours mean, and the largest that was found.
    fn legend(&self, painter: &egui::Painter, area: egui::Rect) {
        let font = egui::FontId::proportional(13.0);
        let mut corner = area.left_bottom() + egui::vec2(12.0, -12.0);
        for (kind, said) in self.said.iter().rev() {
            let name = Kind::ALL.iter().find(|(other, ..)| other == kind).map_or("", |(_, name, _)| name);
            let galley = painter.layout_no_wrap(format!("{name}: {said}"), font.clone(), egui::Color32::WHITE);
            let size = galley.size() + egui::vec2(128.0, 8.0);
            let room = egui::Rect::from_min_size(corner - egui::vec2(0.0, size.y), size);
            painter.rect_filled(room, 4.0, egui::Color32::from_black_alpha(150));
            ramp::bar(painter, egui::Rect::from_min_size(room.min + egui::vec2(6.0, 7.0), egui::vec2(108.0, size.y - 14.0)), *kind);
            painter.galley(room.min + egui::vec2(122.0, 4.0), galley, egui::Color32::WHITE);
            corner.y -= size.y + 4.0;
        }
    }
}
