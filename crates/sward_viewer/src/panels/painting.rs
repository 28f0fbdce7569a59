//! A canvas to paint wind on.

use eframe::egui::{self, Color32, Rect, Stroke, pos2, vec2};

use crate::marks::mark;
use crate::painting::{Brush, Painting};

/// Points of the canvas's side.
const CANVAS: f32 = 300.0;
/// Arrows along a side.
const ARROWS: usize = 20;

/// What the canvas holds, and how it blows.
#[derive(Debug)]
pub struct Canvas {
    /// Whether it is shown.
    pub open: bool,
    /// The wind.
    pub painting: Painting,
    /// The brush.
    pub brush: Brush,
    /// Half its side in the world, m.
    pub radius: f32,
    /// Wind where its strength is 1, m/s.
    pub speed: f32,
    before: Option<[f32; 2]>,
}

impl Default for Canvas {
    fn default() -> Self {
        Self { open: false, painting: Painting::outward(), brush: Brush::default(), radius: 10.0, speed: 16.0, before: None }
    }
}

/// What somebody asks of the canvas.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Asked {
    /// It was painted on, or blows otherwise.
    Changed,
    /// It shall blow where the camera looks.
    Blow,
    /// It shall no longer blow.
    Still,
    /// It shall be saved as a picture.
    Save,
    /// Another one shall be opened.
    Open,
}

/// Shows the canvas; `blows`: whether the scene has its wind.
pub fn show(context: &egui::Context, canvas: &mut Canvas, blows: bool) -> Option<Asked> {
    let (mut asked, mut open) = (None, canvas.open);
    egui::Window::new("Paint wind").open(&mut open).resizable(false).default_pos([320.0, 80.0]).show(context, |ui| {
        ui.label("Drag: the air goes along with the brush. -z is up, as on a map.");
        if paint(ui, canvas) {
            asked = Some(Asked::Changed);
        }
        ui.horizontal(|ui| {
            let stamps: [(&str, Stamp); 3] = [("outward", Painting::outward), ("swirl", Painting::swirl), ("nothing", Painting::default)];
            for (name, stamp) in stamps {
                if ui.button(name).clicked() {
                    canvas.painting = stamp();
                    asked = Some(Asked::Changed);
                }
            }
            if ui.button("smooth").clicked() {
                canvas.painting.smooth();
                asked = Some(Asked::Changed);
            }
            ui.toggle_value(&mut canvas.brush.erases, "erase");
        });
        ui.add(egui::Slider::new(&mut canvas.brush.radius, 0.03..=0.5).text("brush, of the side"));
        ui.add(egui::Slider::new(&mut canvas.brush.strength, 0.05..=1.0).text("strength"));
        let radius = ui.add(egui::Slider::new(&mut canvas.radius, 1.0..=100.0).logarithmic(true).suffix(" m").text("half its side"));
        let speed = ui.add(egui::Slider::new(&mut canvas.speed, -40.0..=40.0).suffix(" m/s").text("speed at strength 1"));
        if radius.changed() || speed.changed() {
            asked = Some(Asked::Changed);
        }
        ui.horizontal(|ui| {
            let button = ui.button("blow here").on_hover_text("Where the camera looks");
            mark(ui, "blow", button.rect);
            if button.clicked() {
                asked = Some(Asked::Blow);
            }
            if ui.add_enabled(blows, egui::Button::new("still")).on_hover_text("Take it out of the scene").clicked() {
                asked = Some(Asked::Still);
            }
            let button = ui.button("save…").on_hover_text("As a PNG that scenes name: flow: Image(path: …)");
            mark(ui, "save wind", button.rect);
            if button.clicked() {
                asked = Some(Asked::Save);
            }
            if ui.button("open…").on_hover_text("A PNG of wind").clicked() {
                asked = Some(Asked::Open);
            }
        });
    });
    canvas.open = open;
    asked
}

/// Makes a painting.
type Stamp = fn() -> Painting;

/// The canvas itself; whether it was painted on.
fn paint(ui: &mut egui::Ui, canvas: &mut Canvas) -> bool {
    let (area, response) = ui.allocate_exact_size(vec2(CANVAS, CANVAS), egui::Sense::drag());
    mark(ui, "canvas", area);
    let painter = ui.painter_at(area);
    painter.rect_filled(area, 2.0, Color32::from_rgb(24, 34, 26));
    let place = |at: egui::Pos2| [(at.x - area.left()) / CANVAS, (at.y - area.top()) / CANVAS];
    for row in 0..ARROWS {
        for column in 0..ARROWS {
            let at = [column, row].map(|k| (k as f32 + 0.5) / ARROWS as f32);
            let air = canvas.painting.at(at);
            let strength = air[0].hypot(air[1]);
            let middle = area.min + vec2(at[0], at[1]) * CANVAS;
            if strength < 0.02 {
                painter.circle_filled(middle, 1.0, Color32::from_white_alpha(40));
                continue;
            }
            let way = vec2(air[0], air[1]) * (0.9 * CANVAS / ARROWS as f32);
            let (from, to) = (middle - way * 0.5, middle + way * 0.5);
            let heat = (strength * 255.0) as u8;
            let stroke = Stroke::new(1.6, Color32::from_rgb(90 + heat / 2, 220 - heat / 3, 255 - heat));
            painter.line_segment([from, to], stroke);
            let back = (from - to) * 0.35;
            painter.line_segment([to, to + back + back.rot90() * 0.5], stroke);
            painter.line_segment([to, to + back - back.rot90() * 0.5], stroke);
        }
    }
    if let Some(at) = response.hover_pos() {
        painter.circle_stroke(at, canvas.brush.radius * CANVAS, Stroke::new(1.0, Color32::from_white_alpha(120)));
    }
    painter.rect_stroke(
        Rect::from_center_size(pos2(area.center().x, area.center().y), area.size()),
        2.0,
        Stroke::new(1.0, Color32::from_white_alpha(60)),
        egui::StrokeKind::Inside,
    );
    let Some(at) = response.interact_pointer_pos().filter(|_| response.dragged()) else {
        canvas.before = None;
        return false;
    };
    let now = place(at);
    let before = canvas.before.unwrap_or(now);
    // So short a way has no direction yet.
    if !canvas.brush.erases && (now[0] - before[0]).hypot(now[1] - before[1]) < 0.004 {
        canvas.before = canvas.before.or(Some(now));
        return false;
    }
    canvas.painting.stroke(before, now, &canvas.brush);
    canvas.before = Some(now);
    true
}
