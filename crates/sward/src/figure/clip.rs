//! Clips: nodes moved by keys over time.
//!
//! glTF 2.0, §3.11 and appendix C. Sampled in f64 with our own functions only.

use super::container::Opened;
use super::error::{FigureError, data};
use super::json::at;
use super::tree::{Stance, Tree, unit};
use crate::math;

/// Most keys of one channel.
const MOST_KEYS: u64 = 1_000_000;

/// How values between two keys come about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Between {
    Step,
    Linear,
    /// Three values a key: tangent in, value, tangent out.
    Cubic,
}

/// What of a node is moved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Target {
    Translation,
    Rotation,
    Scale,
}

#[derive(Clone, Debug, PartialEq)]
struct Channel {
    node: u32,
    target: Target,
    between: Between,
    /// s, increasing.
    times: Vec<f32>,
    values: Vec<[f32; 4]>,
}

/// An animation.
#[derive(Clone, Debug, PartialEq)]
pub struct Clip {
    /// Name in the file, or its number.
    pub name: String,
    /// Time of the first key, s.
    pub begin: f64,
    /// Time of the last key, s.
    pub end: f64,
    channels: Vec<Channel>,
}

fn mixed(a: [f64; 4], b: [f64; 4], s: f64) -> [f64; 4] {
    [0, 1, 2, 3].map(|k| a[k] + (b[k] - a[k]) * s)
}

/// Along the shorter arc between two unit quaternions.
fn turned(a: [f64; 4], b: [f64; 4], s: f64) -> [f64; 4] {
    let dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
    let (dot, b) = if dot < 0.0 { (-dot, b.map(|part| -part)) } else { (dot, b) };
    if dot > 0.9999 {
        return unit(mixed(a, b, s));
    }
    let sine = (1.0 - dot * dot).sqrt();
    let angle = math::atan2_f64(sine, dot);
    let (from, to) = (math::sin_cos_f64((1.0 - s) * angle).0 / sine, math::sin_cos_f64(s * angle).0 / sine);
    unit([0, 1, 2, 3].map(|k| from * a[k] + to * b[k]))
}

impl Channel {
    fn key(&self, key: usize, part: usize) -> [f64; 4] {
        let at = if self.between == Between::Cubic { 3 * key + part } else { key };
        self.values[at].map(f64::from)
    }

    /// The value at a time; the first or last outside the keys.
    fn sample(&self, time: f64) -> [f64; 4] {
        let next = self.times.partition_point(|key| f64::from(*key) <= time);
        let rotation = self.target == Target::Rotation;
        let held = |key: usize| if rotation { unit(self.key(key, 1)) } else { self.key(key, 1) };
        if next == 0 || next == self.times.len() || self.between == Between::Step {
            return held(if next == 0 { 0 } else { next - 1 });
        }
        let (from, to) = (f64::from(self.times[next - 1]), f64::from(self.times[next]));
        let span = to - from;
        let s = (time - from) / span;
        match self.between {
            Between::Cubic => {
                let (s2, s3) = (s * s, s * s * s);
                let (p, m) = (self.key(next - 1, 1), self.key(next - 1, 2));
                let (q, n) = (self.key(next, 1), self.key(next, 0));
                let value = [0, 1, 2, 3].map(|k| {
                    p[k] * (2.0 * s3 - 3.0 * s2 + 1.0)
                        + m[k] * span * (s3 - 2.0 * s2 + s)
                        + q[k] * (3.0 * s2 - 2.0 * s3)
                        + n[k] * span * (s3 - s2)
                });
                if rotation { unit(value) } else { value }
            }
            _ if rotation => turned(held(next - 1), held(next), s),
            _ => mixed(self.key(next - 1, 1), self.key(next, 1), s),
        }
    }
}

impl Clip {
    /// Moves the nodes the clip moves to where they stand at `time` \[s\].
    pub(super) fn apply(&self, time: f64, local: &mut [Stance]) {
        for channel in &self.channels {
            let value = channel.sample(time);
            let Some(stance) = local.get_mut(channel.node as usize) else { continue };
            if let Stance::Matrix(_) = stance {
                *stance = Stance::IDENTITY;
            }
            if let Stance::Parts { translation, rotation, scale } = stance {
                match channel.target {
                    Target::Translation => *translation = [value[0], value[1], value[2]],
                    Target::Rotation => *rotation = value,
                    Target::Scale => *scale = [value[0], value[1], value[2]],
                }
            }
        }
    }

    /// The time of the clip `elapsed` seconds after the body appeared: played at `speed` from `start` \[s\], over and over or once.
    pub fn time(&self, elapsed: f64, speed: f64, start: f64, repeat: bool) -> f64 {
        let (along, length) = (start + speed * elapsed, self.end - self.begin);
        if repeat && length > 0.0 {
            return self.begin + math::wrapped(along, length);
        }
        let within = if along > 0.0 { along } else { 0.0 };
        self.begin + if within < length { within } else { length }
    }

    /// Reads all clips of a file. Channels that move nothing we draw (weights of morph targets) are left out.
    pub(super) fn all(opened: &Opened<'_>, tree: &Tree) -> Result<Vec<Self>, FigureError> {
        let root = &opened.root;
        let mut clips = Vec::new();
        for (number, animation) in root.animations.iter().enumerate() {
            let mut channels = Vec::new();
            for (index, channel) in animation.channels.iter().enumerate() {
                let place = format!("animations[{number}].channels[{index}]");
                let target = match channel.target.path.as_str() {
                    "translation" => Target::Translation,
                    "rotation" => Target::Rotation,
                    "scale" => Target::Scale,
                    _ => continue,
                };
                let Some(node) = channel.target.node else { continue };
                let sampler = at(&animation.samplers, channel.sampler, "samplers", &place)?;
                at(&root.nodes, node, "nodes", &place)?;
                channels.push(read_channel(opened, sampler, tree.place[node], target, &place)?);
            }
            let ends = |pick: fn(&Channel) -> Option<&f32>| channels.iter().filter_map(pick).copied().map(f64::from);
            let begin = ends(|channel| channel.times.first()).fold(f64::MAX, |a, b| if b < a { b } else { a });
            let end = ends(|channel| channel.times.last()).fold(f64::MIN, |a, b| if b > a { b } else { a });
            let (begin, end) = if channels.is_empty() { (0.0, 0.0) } else { (begin, end) };
            let name = if animation.name.is_empty() { number.to_string() } else { animation.name.clone() };
            clips.push(Self { name, begin, end, channels });
        }
        Ok(clips)
    }
}

fn read_channel(
    opened: &Opened<'_>,
    sampler: &super::json::Sampler,
    node: u32,
    target: Target,
    place: &str,
) -> Result<Channel, FigureError> {
    let between = match sampler.interpolation.as_str() {
        "" | "LINEAR" => Between::Linear,
        "STEP" => Between::Step,
        "CUBICSPLINE" => Between::Cubic,
        other => return Err(data(place, format!("has interpolation `{other}`; known: LINEAR, STEP, CUBICSPLINE"))),
    };
    let times: Vec<f32> = opened.vectors::<1>(sampler.input, &[1], 0.0, MOST_KEYS, place)?.into_iter().map(|[time]| time).collect();
    let width = if target == Target::Rotation { 4 } else { 3 };
    let values = opened.vectors::<4>(sampler.output, &[width], 0.0, 3 * MOST_KEYS, place)?;
    let needed = times.len() * if between == Between::Cubic { 3 } else { 1 };
    if times.is_empty() || values.len() != needed {
        return Err(data(place, format!("has {} keys and {} values, needed are {needed}, at least 1", times.len(), values.len())));
    }
    if times.windows(2).any(|pair| pair[1] <= pair[0]) || times.iter().any(|time| !(0.0..=1e6).contains(time)) {
        return Err(data(place, "has keys that do not follow each other in time, from 0 s on"));
    }
    if values.iter().flatten().any(|value| !(-1e9..=1e9).contains(value)) {
        return Err(data(place, "moves its node beyond ±1e9"));
    }
    Ok(Channel { node, target, between, times, values })
}
