//! Limits of growth near a place, in f32: what placement and the colour of bare ground reckon with. Twin: `growth.wgsl`.

use bytemuck::{Pod, Zeroable};

use super::image::{Canvas, between};
use super::{Limit, MaskImage, Outline};
use crate::math::{clamped, lower, upper};
use std::sync::Arc;

/// Most limits that a picture's bare ground shows: the nearest ones.
pub const MOST_RECORDS: usize = 64;

/// One limit; the same layout as `GrowthRecord` in WGSL. Metres from the place.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct GrowthRecord {
    /// 0 line, 1 polygon, 2 picture.
    pub kind: u32,
    /// First edge, or first texel.
    pub first: u32,
    /// Edges, or columns of the picture.
    pub count: u32,
    /// Rows of the picture.
    pub rows: u32,
    /// Least x and z of what it touches; of a picture: of itself.
    pub low: [f32; 2],
    /// Greatest.
    pub high: [f32; 2],
    /// Linear RGB of bare ground.
    pub colour: [f32; 3],
    /// Share of all plants that it keeps away.
    pub share: f32,
    /// Of a line, m.
    pub half_width: f32,
    /// Width of the margin, m.
    pub soft: f32,
    /// Cover outside.
    pub outside: f32,
    /// Not used.
    pub unused: f32,
}

/// The limits of one picture; the same layout as `GrowthBlock` in WGSL.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct GrowthBlock {
    /// How many.
    pub count: u32,
    /// Where edges begin in the list of words.
    pub first_edge: u32,
    /// Keeps what follows in place.
    pub unused: [u32; 2],
    /// They.
    pub records: [GrowthRecord; MOST_RECORDS],
}

/// Limits near a place.
#[derive(Clone, Debug, Default)]
pub struct Near {
    /// One a limit.
    pub records: Vec<GrowthRecord>,
    /// From x, z to x, z; m from the place.
    pub edges: Vec<[f32; 4]>,
    /// The picture of each record that has one.
    images: Vec<Option<Arc<MaskImage>>>,
    /// Underside, and how far height follows, of each record.
    plants: Vec<[f32; 2]>,
}

impl Near {
    /// Those of `limits` that touch a rectangle (least, greatest x and z) in metres from `place`.
    pub fn of<'a>(limits: impl Iterator<Item = &'a Limit>, place: [f64; 2], [low, high]: [[f64; 2]; 2]) -> Self {
        let mut near = Self::default();
        for limit in limits {
            let bounds = limit.outline.bounds();
            let margin = f64::from(limit.soft);
            let touches =
                |axis: usize| bounds[0][axis] - margin - place[axis] <= high[axis] && bounds[1][axis] + margin - place[axis] >= low[axis];
            if (touches(0) && touches(1)) || limit.outside < 1.0 {
                near.add(limit, place, bounds);
            }
        }
        near
    }

    fn add(&mut self, limit: &Limit, place: [f64; 2], bounds: [[f64; 2]; 2]) {
        let local = |at: [f64; 2]| [(at[0] - place[0]) as f32, (at[1] - place[1]) as f32];
        let first = self.edges.len() as u32;
        self.edges.extend(limit.outline.edges().iter().map(|[a, b]| {
            let ([ax, az], [bx, bz]) = (local(*a), local(*b));
            [ax, az, bx, bz]
        }));
        let count = self.edges.len() as u32 - first;
        let (kind, half_width, image) = match &limit.outline {
            Outline::Line { half_width, .. } => (0, *half_width, None),
            Outline::Polygon { .. } => (1, 0.0, None),
            Outline::Picture { image, .. } => (2, 0.0, Some(Arc::clone(image))),
        };
        let margin = if image.is_some() { 0.0 } else { f64::from(limit.soft) };
        let size = image.as_ref().map_or([count, 0], |image| [image.columns, image.rows]);
        self.records.push(GrowthRecord {
            kind,
            first: if image.is_some() { 0 } else { first },
            count: size[0],
            rows: size[1],
            low: local(bounds[0].map(|at| at - margin)),
            high: local(bounds[1].map(|at| at + margin)),
            colour: limit.colour,
            share: limit.share,
            half_width,
            soft: limit.soft,
            outside: limit.outside,
            unused: 0.0,
        });
        self.images.push(image);
        self.plants.push([limit.above, limit.height]);
    }

    /// Nothing limits growth here.
    pub fn is_empty(&self) -> bool {
        self.records.is_empty()
    }

    /// Pictures of the records, where they have one.
    pub fn images(&self) -> &[Option<Arc<MaskImage>>] {
        &self.images
    }

    fn cover(&self, index: usize, at: [f32; 2], blur: f32) -> f32 {
        let record = &self.records[index];
        let shade = |texel: u32| self.images[index].as_ref().map_or(1.0, |image| image.shade(texel));
        cover_at(record, at, blur, |edge| self.edges[edge as usize], shade)
    }

    /// Cover and height, 0 to 1, of a plant that would be `tall` \[m\], `at` metres from the place.
    pub fn growth_at(&self, at: [f32; 2], tall: f32) -> [f32; 2] {
        let mut growth = [1.0, 1.0];
        for (index, [above, follows]) in self.plants.iter().enumerate() {
            if *above > 0.0 && tall <= *above {
                continue;
            }
            let cover = self.cover(index, at, 0.0);
            growth = [growth[0] * cover, growth[1] * (1.0 + (cover - 1.0) * follows)];
        }
        growth
    }

    /// Colour of bare ground at a place times its share, and that share, 0 to 1; a pixel is `blur` metres wide. The last limit lies on
    /// top. Twin: `growth_taken`.
    pub fn bare(&self, at: [f32; 2], blur: f32) -> [f32; 4] {
        let mut bare = [0.0; 4];
        for (index, record) in self.records.iter().enumerate().take(MOST_RECORDS) {
            let taken = record.share * (1.0 - self.cover(index, at, blur));
            let [red, green, blue] = record.colour;
            for (all, own) in bare.iter_mut().zip([red, green, blue, 1.0]) {
                *all += (own - *all) * taken;
            }
        }
        bare
    }
}

/// 0 below `low`, 1 above `high`, smooth between.
fn ramp(low: f32, high: f32, at: f32) -> f32 {
    if high <= low {
        return if at > low { 1.0 } else { 0.0 };
    }
    let t = clamped((at - low) / (high - low), 0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Distance \[m\] to an edge.
fn to_edge(edge: [f32; 4], at: [f32; 2]) -> f32 {
    let along = [edge[2] - edge[0], edge[3] - edge[1]];
    let way = [at[0] - edge[0], at[1] - edge[1]];
    let length = upper(along[0] * along[0] + along[1] * along[1], 1e-12);
    let t = clamped((way[0] * along[0] + way[1] * along[1]) / length, 0.0, 1.0);
    let off = [way[0] - t * along[0], way[1] - t * along[1]];
    (off[0] * off[0] + off[1] * off[1]).sqrt()
}

/// Share of plants that a limit leaves at a place, 0 to 1; its rim is blurred over `blur` metres.
pub fn cover_at(record: &GrowthRecord, at: [f32; 2], blur: f32, edge: impl Fn(u32) -> [f32; 4], shade: impl Fn(u32) -> f32) -> f32 {
    let outside = (0..2).any(|axis| at[axis] < record.low[axis] - blur || at[axis] > record.high[axis] + blur);
    if outside {
        return record.outside;
    }
    if record.kind == 2 {
        return between_texels(record, at, shade);
    }
    let (mut distance, mut inside) = (1e9, false);
    for index in record.first..record.first + record.count {
        let edge = edge(index);
        distance = lower(distance, to_edge(edge, at));
        // A line to +x crosses the rim an odd number of times from inside.
        if record.kind == 1 && (edge[1] > at[1]) != (edge[3] > at[1]) {
            let crossing = edge[0] + (at[1] - edge[1]) / (edge[3] - edge[1]) * (edge[2] - edge[0]);
            inside ^= at[0] < crossing;
        }
    }
    let away = if inside { -distance } else { distance - record.half_width };
    ramp(-blur, record.soft + blur, away)
}

/// Bilinear between the middles of pixels.
fn between_texels(record: &GrowthRecord, at: [f32; 2], shade: impl Fn(u32) -> f32) -> f32 {
    let at = [0, 1].map(|axis: usize| (at[axis] - record.low[axis]) / (record.high[axis] - record.low[axis]));
    let (texels, f) = Canvas { columns: record.count, rows: record.rows }.around(at);
    between(texels.map(|texel| shade(record.first + texel)), f)
}
