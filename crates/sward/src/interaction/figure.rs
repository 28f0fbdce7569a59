//! A figure as a body: where its parts are while a clip plays.

use std::sync::Arc;

use glam::{DMat4, DVec3, DVec4};

use super::piece::{Piece, Underside};
use crate::figure::{Figure, FigureError, Posed};
use crate::math;
use crate::scene::MeshShape;

/// Moments of a clip at which its lowest point is looked for.
const MOMENTS: u32 = 48;
/// A clip whose end is farther from its beginning, as a share of the body's size, jumps when it starts again.
const SEAM: f64 = 0.05;

/// A figure, scaled and placed in a body's frame, with the clip it plays.
#[derive(Clone, Debug)]
pub struct FigureBody {
    /// The figure; bodies of one file share it.
    pub figure: Arc<Figure>,
    /// From file units to the body's frame, m.
    pub place: DMat4,
    clip: Option<usize>,
    speed: f64,
    start: f64,
    repeat: bool,
    /// The clip ends as it begins.
    seamless: bool,
}

impl FigureBody {
    /// A body as a scene asks for it.
    ///
    /// # Errors
    /// An unknown clip, or a body that is far too small or large as scaled.
    pub fn new(figure: Arc<Figure>, shape: &MeshShape) -> Result<Self, FigureError> {
        let clip = shape.clip.as_ref().map(|name| figure.clip(name)).transpose()?;
        let (sine, cosine) = math::sin_cos_f64(f64::from(shape.yaw));
        let s = shape.scale;
        let place = DMat4::from_cols(
            DVec4::new(cosine * s, 0.0, -sine * s, 0.0),
            DVec4::new(0.0, s, 0.0, 0.0),
            DVec4::new(sine * s, 0.0, cosine * s, 0.0),
            DVec4::W,
        );
        let (speed, start) = (f64::from(shape.clip_speed), f64::from(shape.clip_start));
        let mut body = Self { figure, place, clip, speed, start, repeat: shape.repeat, seamless: true };
        let (low, high) = body.bounds();
        let size = (high - low).max_element();
        if !(0.01..=200.0).contains(&size) {
            let fitting = if size > 0.0 && size.is_finite() { 2.0 * s / size } else { 1.0 };
            return Err(FigureError::Size { size: format!("{size:.3}"), scale: format!("{fitting:.3e}") });
        }
        let shift = DVec3::from_array(shape.offset.map(f64::from));
        let lift = if shape.grounded { -low.y } else { 0.0 };
        body.place.w_axis += (shift + DVec3::Y * lift).extend(0.0);
        body.seamless = body.repeats_smoothly(size);
        Ok(body)
    }

    /// Whether anything but the body as a whole moves.
    pub fn is_animated(&self) -> bool {
        self.clip.is_some() && self.speed != 0.0
    }

    /// Seconds in which its clip plays once; 0 where it plays none.
    pub fn period(&self) -> f64 {
        let Some(clip) = self.clip.map(|clip| &self.figure.clips[clip]).filter(|_| self.speed != 0.0) else { return 0.0 };
        ((clip.end - clip.begin) / self.speed).abs()
    }

    /// From each frame's vertices to the body's frame, m, `elapsed` seconds after the body appeared.
    pub fn pose(&self, elapsed: f64) -> Vec<DMat4> {
        let time = self.clip.map_or(0.0, |clip| self.figure.clips[clip].time(elapsed, self.speed, self.start, self.repeat));
        self.at(time)
    }

    fn at(&self, time: f64) -> Vec<DMat4> {
        self.figure.pose(self.clip, time).into_iter().map(|matrix| self.place * matrix).collect()
    }

    /// The parts at one moment, in order.
    fn parts_at(&self, time: f64) -> Vec<Option<Posed>> {
        let frames = self.at(time);
        self.figure.parts.iter().map(|part| part.posed(&frames[part.frame as usize])).collect()
    }

    /// Lowest and highest corner over the clip; infinite where a part is out of bounds.
    fn bounds(&self) -> (DVec3, DVec3) {
        let (mut low, mut high) = (DVec3::MAX, DVec3::MIN);
        let span = self.clip.map_or([0.0; 2], |clip| [self.figure.clips[clip].begin, self.figure.clips[clip].end]);
        let moments = if self.clip.is_some() { MOMENTS } else { 0 };
        for moment in 0..=moments {
            let share = f64::from(moment) / f64::from(moments.max(1));
            let frames = self.at(span[0] + (span[1] - span[0]) * share);
            for part in &self.figure.parts {
                for point in &part.points {
                    let point = frames[part.frame as usize].transform_point3(*point);
                    (low, high) = (low.min(point), high.max(point));
                    if !point.is_finite() {
                        return (DVec3::ZERO, DVec3::splat(f64::INFINITY));
                    }
                }
            }
        }
        (low, high)
    }

    fn repeats_smoothly(&self, size: f64) -> bool {
        let Some(clip) = self.clip.map(|clip| &self.figure.clips[clip]) else { return true };
        let (first, last) = (self.parts_at(clip.begin), self.parts_at(clip.end));
        first.iter().zip(&last).all(|pair| match pair {
            (Some(a), Some(b)) => {
                let way = [0, 1, 2].map(|axis| b.under[axis] - a.under[axis]);
                way.iter().map(|part| part * part).sum::<f64>() < (SEAM * size) * (SEAM * size)
            }
            _ => true,
        })
    }

    /// The convex pieces `elapsed` seconds after the body appeared; `None` for one out of bounds. Always of the same number and order.
    pub fn pieces(&self, elapsed: f64) -> Vec<Option<Piece>> {
        let frames = self.pose(elapsed);
        let piece = |posed: Posed| Piece {
            outline: posed.outline,
            underside: Underside::Slope { gradient: posed.gradient },
            offset: posed.under,
            rise: posed.highest - posed.under[1],
            yaw: 0.0,
        };
        self.figure.parts.iter().map(|part| part.posed(&frames[part.frame as usize]).map(piece)).collect()
    }

    /// Whether the body goes smoothly from one moment to another: not where a clip that ends elsewhere than it begins starts again.
    pub fn is_smooth(&self, from: f64, to: f64) -> bool {
        let Some(clip) = self.clip.map(|clip| &self.figure.clips[clip]) else { return true };
        let length = clip.end - clip.begin;
        let round = |elapsed: f64| ((self.start + self.speed * elapsed) / length).floor();
        self.seamless || !self.repeat || length <= 0.0 || round(from) == round(to)
    }
}
