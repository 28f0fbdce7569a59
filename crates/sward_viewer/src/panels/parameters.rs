//! Every parameter of a scene: sliders with units, what each means, lists that grow, choices that switch.

use eframe::egui;
use sward::scene::FieldInfo;
use sward::scene::inspect::{Choice, Group, Inspector, List, NumberKind, Optional};

use crate::marks::mark;

/// Ranges that span more than so many times their least number move by ratios.
const RATIO: f64 = 300.0;
/// Fields that are not for sliders: what a scene is called, and how its format is numbered.
const HIDDEN: [&str; 2] = ["version", "title"];

/// Puts parameters into a panel.
pub struct Sliders<'a> {
    ui: &'a mut egui::Ui,
    /// What an element of a list is called instead of its field.
    name: Option<String>,
    /// Where it lies in the scene: `wind 1 `.
    trail: String,
    /// Whether a group is shown as it is, without a fold: inside a choice, which has a line of its own.
    bare: bool,
}

/// Shows a whole scene; the answer is whether something was changed.
pub fn show(ui: &mut egui::Ui, scene: &mut dyn Group) -> bool {
    scene.inspect_fields(&mut Sliders { ui, name: None, trail: String::new(), bare: false })
}

impl Sliders<'_> {
    fn label(&mut self, info: &FieldInfo) -> String {
        self.name.take().unwrap_or_else(|| info.name.replace('_', " "))
    }

    /// A number's slider, or a number to drag where it has no range.
    fn slide(ui: &mut egui::Ui, trail: &str, info: &FieldInfo, kind: NumberKind, number: &mut f64) -> bool {
        let suffix = if info.unit.is_empty() { String::new() } else { format!(" {}", info.unit) };
        let (low, high) = info.range.unwrap_or_else(|| kind.bounds());
        let wide = high - low > 1e5;
        let response = if wide {
            let speed = (number.abs() * 0.01).max(if kind.is_whole() { 0.2 } else { 0.01 });
            let drag = egui::DragValue::new(number).range(low..=high).speed(speed).suffix(suffix);
            ui.add(if kind.is_whole() { drag.max_decimals(0) } else { drag.max_decimals(4) })
        } else {
            let ratio =
                low >= 0.0 && high > RATIO * low.max(high / 1e6).min(high / RATIO) && high / low.max(1e-9) > RATIO && !kind.is_whole();
            let slider =
                egui::Slider::new(number, low..=high).suffix(suffix).logarithmic(ratio).smallest_positive(high / 1e5).max_decimals(4);
            ui.add(if kind.is_whole() { slider.integer() } else { slider })
        };
        mark(ui, &format!("{trail}{}", info.name), response.rect);
        response.on_hover_text(info.doc).changed()
    }

    /// A fold with something inside.
    fn fold(&mut self, info: &FieldInfo, title: &str, inside: impl FnOnce(&mut egui::Ui) -> bool) -> bool {
        let whole = format!("{}{}", self.trail, info.name);
        let id = self.ui.id().with((info.name, title));
        let fold = egui::CollapsingHeader::new(title).id_salt(id).show(self.ui, inside);
        mark(self.ui, &whole, fold.header_response.rect);
        fold.header_response.on_hover_text(info.doc);
        fold.body_returned.unwrap_or(false)
    }
}

impl Inspector for Sliders<'_> {
    fn number(&mut self, info: &FieldInfo, kind: NumberKind, number: &mut f64) -> bool {
        if HIDDEN.contains(&info.name) {
            return false;
        }
        let (label, trail) = (self.label(info), self.trail.clone());
        let row = self.ui.horizontal(|ui| {
            let changed = Self::slide(ui, &trail, info, kind, number);
            ui.label(label).on_hover_text(info.doc);
            changed
        });
        row.inner
    }

    fn vector(&mut self, info: &FieldInfo, kind: NumberKind, parts: &mut [f64]) -> bool {
        let (label, trail) = (self.label(info), self.trail.clone());
        let (low, high) = info.range.unwrap_or_else(|| kind.bounds());
        let suffix = if info.unit.is_empty() { String::new() } else { format!(" {}", info.unit) };
        let row = self.ui.horizontal(|ui| {
            let mut changed = false;
            let colour = parts.len() == 3 && info.name.contains("colour");
            if colour {
                let mut rgb = [parts[0] as f32, parts[1] as f32, parts[2] as f32];
                if ui.color_edit_button_rgb(&mut rgb).changed() {
                    parts.iter_mut().zip(rgb).for_each(|(part, new)| *part = f64::from(new));
                    changed = true;
                }
            } else {
                for (number, part) in parts.iter_mut().enumerate() {
                    let speed = ((high - low).min(100.0) / 400.0).max(0.001);
                    let drag = egui::DragValue::new(part).range(low..=high).speed(speed).max_decimals(3).suffix(&suffix);
                    let response = ui.add(drag).on_hover_text(info.doc);
                    mark(ui, &format!("{trail}{} {}", info.name, number + 1), response.rect);
                    changed |= response.changed();
                }
            }
            ui.label(label).on_hover_text(info.doc);
            changed
        });
        row.inner
    }

    fn flag(&mut self, info: &FieldInfo, flag: &mut bool) -> bool {
        let label = self.label(info);
        self.ui.checkbox(flag, label).on_hover_text(info.doc).changed()
    }

    fn text(&mut self, info: &FieldInfo, text: &mut String) -> bool {
        if HIDDEN.contains(&info.name) {
            return false;
        }
        let label = self.label(info);
        let row = self.ui.horizontal(|ui| {
            let edit = ui.add(egui::TextEdit::singleline(text).desired_width(140.0));
            ui.label(label).on_hover_text(info.doc);
            edit.changed()
        });
        row.inner
    }

    fn list(&mut self, info: &FieldInfo, list: &mut dyn List) -> bool {
        let (title, trail) = (format!("{} ({})", self.label(info), list.length()), self.trail.clone());
        self.fold(info, &title, |ui| {
            let (mut changed, mut gone) = (false, None);
            for index in 0..list.length() {
                ui.push_id(index, |ui| {
                    ui.horizontal_top(|ui| {
                        if ui.small_button("×").on_hover_text("Take it away").clicked() {
                            gone = Some(index);
                        }
                        ui.vertical(|ui| {
                            let name = Some(format!("{} {}", info.name.trim_end_matches('s'), index + 1));
                            let trail = format!("{trail}{} {} ", info.name, index + 1);
                            changed |= list.inspect_element(index, info, &mut Sliders { ui, name, trail, bare: false });
                        });
                    });
                });
            }
            if let Some(index) = gone {
                list.remove(index);
                changed = true;
            }
            if ui.small_button("+").on_hover_text("One more").clicked() {
                list.add(info);
                changed = true;
            }
            changed
        })
    }

    fn optional(&mut self, info: &FieldInfo, optional: &mut dyn Optional) -> bool {
        let mut present = optional.is_present();
        let label = self.label(info);
        if !present {
            let whole = format!("{}{}", self.trail, info.name);
            let row = self.ui.checkbox(&mut present, egui::RichText::new(label).weak()).on_hover_text(info.doc);
            mark(self.ui, &whole, row.rect);
            let there = row.changed();
            if there {
                optional.set_present(true, info);
            }
            return there;
        }
        let trail = self.trail.clone();
        let row = self.ui.horizontal_top(|ui| {
            let gone = ui.checkbox(&mut present, "").on_hover_text("Leave it to the species, or out").changed();
            if gone {
                optional.set_present(false, info);
                return true;
            }
            ui.vertical(|ui| optional.inspect_inside(info, &mut Sliders { ui, name: Some(label), trail, bare: false })).inner
        });
        row.inner
    }

    fn group(&mut self, info: &FieldInfo, group: &mut dyn Group) -> bool {
        if self.bare {
            self.bare = false;
            return group.inspect_fields(self);
        }
        let title = self.label(info);
        // An element of a list is named by its place already.
        let trail = if title.replace(' ', "_") == info.name { format!("{}{} ", self.trail, info.name) } else { self.trail.clone() };
        self.fold(info, &title, |ui| group.inspect_fields(&mut Sliders { ui, name: None, trail, bare: false }))
    }

    fn choice(&mut self, info: &FieldInfo, choice: &mut dyn Choice) -> bool {
        let label = self.label(info);
        let (id, trail) = (self.ui.id().with((info.name, &label, "choice")), self.trail.clone());
        let mut changed = false;
        self.ui.horizontal(|ui| {
            let (now, variants) = (choice.chosen(), choice.variants());
            let shown = variants.get(now).map_or("", |variant| variant.name);
            let mut wanted = now;
            let combo = egui::ComboBox::from_id_salt(id).selected_text(shown).show_ui(ui, |ui| {
                for (index, variant) in variants.iter().enumerate() {
                    let value = ui.selectable_value(&mut wanted, index, variant.name).on_hover_text(variant.doc);
                    mark(ui, &format!("choose {}", variant.name), value.rect);
                }
            });
            mark(ui, &format!("{trail}{}", info.name), combo.response.rect);
            ui.label(&label).on_hover_text(info.doc);
            if wanted != now {
                changed = choice.choose(wanted);
            }
        });
        let inner = self.trail.clone();
        let inside = self.ui.indent(id, |ui| {
            ui.push_id(id.with(choice.chosen()), |ui| {
                choice.inspect_inside(info, &mut Sliders { ui, name: None, trail: inner, bare: true })
            })
            .inner
        });
        changed | inside.inner
    }
}
