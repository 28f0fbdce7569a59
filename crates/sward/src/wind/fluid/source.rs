//! A plane of air as a source of wind: where it lies at which step, and what pushes it.
//!
//! Chen & Johan 2015, §3.3: sources at borders and inside, with a strength and a frequency.
//! Differs from the paper: the plane travels with a mean wind, and bodies of the scene drag it.

use std::sync::Arc;

use super::field::{FluidBlock, FluidField, FluidState};
use super::force::{Drag, Gust};
use super::plane::{Fluid, FluidModel};
use crate::math::{exp_f64, sin_cos_f64};
use crate::scene::{self, GustFrom};
use crate::wind::noise::{fixed, short};

/// What is left of a difference from a solid body in its middle falls to 1/e in this time, s.
const SOLID: f64 = 0.008;
/// Bodies narrower than this, in cells, drag as wide ones, but more weakly.
const NARROWEST: f32 = 0.75;
/// Bodies up to this high above the ground drag the air on it, m.
const HIGHEST: f64 = 2.5;
/// Share of what a gust makes of air that stays with it, for as long as the pulse lasts, in the mean of place and time.
const MEAN: f64 = 0.3;

/// What a step does to the air of a plane, besides letting it flow.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FluidPlan {
    /// Where it is pushed.
    pub gusts: Vec<Gust>,
    /// Bodies in it.
    pub drags: Vec<Drag>,
}

/// A gust of the scene, compiled.
#[derive(Clone, Debug)]
struct Pulse {
    /// Middle, planes times 2⁶⁴ from the plane's corner.
    at: [u64; 2],
    radius: f32,
    /// Its push at the height of a pulse, m/s a step.
    change: [f64; 2],
    /// Pulses a step, times 2⁶⁴; none: it is even.
    rate: Option<u64>,
    /// Where in a pulse it begins, likewise.
    start: u64,
}

/// A body over a plane at the end of a step.
#[derive(Clone, Copy, Debug)]
pub struct Passing {
    /// Its middle, m from the corner of patch (0, 0).
    pub ground: [f64; 2],
    /// Its velocity, m/s.
    pub velocity: [f64; 2],
    /// Turn about +y, rad.
    pub yaw: f64,
    /// Half width and half length, m.
    pub half: [f64; 2],
    /// Height of its underside above the ground, m.
    pub clearance: f64,
}

/// A plane of air of a scene, compiled.
#[derive(Clone, Debug)]
pub struct FluidSource {
    /// The plane.
    pub model: Arc<FluidModel<f32>>,
    /// Mean velocity, m/s: part of the wind's mean.
    pub velocity: [f32; 2],
    /// Whether bodies drag it.
    pub bodies: bool,
    /// Its number among all sources that ever blew.
    pub number: u32,
    /// Its place among the sources of the scene.
    pub place: usize,
    /// First texel of its flow in what kernels read.
    pub first: u32,
    /// Side of the square, m.
    side: f64,
    /// How far it travels in a step, planes times 2⁶⁴.
    travel: [f64; 2],
    pulses: Vec<Pulse>,
    dt: f64,
    speed: f32,
}

/// An angle as a share of a turn times 2⁶⁴, as radians.
fn radians(turns: u64) -> f64 {
    (turns >> 11) as f64 * (std::f64::consts::TAU / (1_u64 << 53) as f64)
}

impl FluidSource {
    /// Compiles what an author wrote; a step is `dt` \[s\].
    pub fn new(fluid: &scene::Fluid, dt: f64, first: u32) -> Self {
        let side = f64::from(fluid.side);
        let cell = fluid.side / fluid.cells as f32;
        let model = FluidModel::new(fluid.cells as usize, cell, f64::from(fluid.viscosity), f64::from(fluid.fade), dt);
        let pulse = |gust: &scene::Gust| {
            let along = f64::from(gust.along);
            let (place, ahead) = match &gust.from {
                GustFrom::West => ([0.0, along], [1.0, 0.0]),
                GustFrom::East => ([0.0, along], [-1.0, 0.0]),
                GustFrom::North => ([along, 0.0], [0.0, 1.0]),
                GustFrom::South => ([along, 0.0], [0.0, -1.0]),
                GustFrom::Place(place) => (place.at.map(|metres| metres / side), [1.0, 0.0]),
            };
            let (sine, cosine) = sin_cos_f64(f64::from(gust.turn));
            let strength = f64::from(gust.strength) * dt;
            Pulse {
                at: place.map(fixed),
                radius: if gust.radius > cell { gust.radius } else { cell },
                change: [strength * (ahead[0] * cosine - ahead[1] * sine), strength * (ahead[0] * sine + ahead[1] * cosine)],
                rate: (gust.frequency > 0.0).then(|| fixed(f64::from(gust.frequency) * dt)),
                start: fixed(f64::from(gust.phase)),
            }
        };
        Self {
            model: Arc::new(model),
            velocity: fluid.velocity,
            bodies: fluid.bodies,
            number: 0,
            place: 0,
            first,
            side,
            travel: fluid.velocity.map(|speed| f64::from(speed) * dt / side),
            pulses: fluid.gusts.iter().map(pulse).collect(),
            dt,
            speed: usual_speed(fluid),
        }
    }

    /// Whether anything but bodies ever moves it.
    pub fn is_gusty(&self) -> bool {
        self.pulses.iter().any(|pulse| pulse.change != [0.0; 2])
    }

    /// Texels that its flow takes: now and before.
    pub fn texels(&self) -> usize {
        2 * self.model.side * self.model.side
    }

    /// The place of the flow after step number `step` in what kernels read; the one before is the other of two.
    pub fn texel(&self, step: u64) -> u32 {
        self.first + (step % 2) as u32 * (self.texels() / 2) as u32
    }

    /// How far the plane has travelled after `step` steps, planes times 2⁶⁴.
    fn travelled(&self, step: u64) -> [u64; 2] {
        self.travel.map(|planes| fixed(planes).wrapping_mul(step))
    }

    /// A place \[planes times 2⁶⁴, of the ground\] on the plane after `step` steps, m from its corner.
    fn on_plane(&self, at: [u64; 2], step: u64) -> [f32; 2] {
        let travelled = self.travelled(step);
        [0, 1].map(|axis: usize| (self.side * ((at[axis].wrapping_sub(travelled[axis]) >> 11) as f64 / (1_u64 << 53) as f64)) as f32)
    }

    /// The flow as it is read `behind` steps before the one with number `step`, on nodes `node_spacing` \[m\] apart.
    pub fn field(&self, flow: &FluidState, step: u64, behind: f64, node_spacing: f64) -> FluidField {
        let travelled = self.travelled(step);
        let half_cell = fixed(0.5 / self.model.side as f64);
        let phase = [0, 1].map(|axis: usize| {
            let earlier = fixed(self.travel[axis] * behind);
            short(earlier.wrapping_sub(travelled[axis]).wrapping_sub(half_cell))
        });
        let block = FluidBlock {
            phase,
            step: short(fixed(node_spacing / self.side)),
            per_metre: (1.0 / self.side) as f32,
            now: self.texel(step),
            before: self.texel(step + 1),
            bits: self.model.side.trailing_zeros(),
            behind: behind as f32,
        };
        FluidField { block, flow: flow.clone(), speed: self.speed }
    }

    /// The flow turned up into an upright plane along which the mean wind blows at `along` \[m/s\]: its x is that plane's right, its z up.
    pub fn field_on(&self, flow: &FluidState, step: u64, node_spacing: f64, along: f32) -> FluidField {
        let travelled = fixed(f64::from(along) * self.dt / self.side).wrapping_mul(step);
        let half_cell = fixed(0.5 / self.model.side as f64);
        let mut field = self.field(flow, step, 0.0, node_spacing);
        field.block.phase = [travelled.wrapping_add(half_cell), half_cell].map(|passed| short(0_u64.wrapping_sub(passed)));
        field
    }

    /// What happens to the air in the step after `step` of them.
    ///
    /// `level`: its gusts push with so much of their strength; at 0 bodies do not, either.
    pub fn plan(&self, step: u64, level: f32, passing: impl Iterator<Item = Passing>) -> FluidPlan {
        let gust = |pulse: &Pulse| {
            let height =
                pulse.rate.map_or(1.0, |rate| 0.5 - 0.5 * sin_cos_f64(radians(rate.wrapping_mul(step).wrapping_add(pulse.start))).1);
            let change = pulse.change.map(|change| level * (change * height) as f32);
            Gust { at: self.on_plane(pulse.at, step), change, radius: pulse.radius, unused: [0.0; 3] }
        };
        let gusts = self.pulses.iter().map(gust).filter(|gust| gust.change != [0.0; 2]).collect();
        let drags = passing.filter(|_| self.bodies && level > 0.0).filter_map(|body| self.drag(step, &body)).collect();
        FluidPlan { gusts, drags }
    }

    /// How a body drags the air; none that flies too high.
    fn drag(&self, step: u64, body: &Passing) -> Option<Drag> {
        let height = 1.0 - body.clearance / HIGHEST;
        let high = if height < 1.0 { height } else { 1.0 };
        let half = body.half.map(|metres| metres as f32);
        let least = NARROWEST * self.model.cell;
        // Wider than half the plane it would meet itself.
        let most = 0.5 * self.side as f32;
        let wide = half.map(|metres| crate::math::clamped(metres, least, most));
        let share = [0, 1].map(|axis: usize| if half[axis] < wide[axis] { half[axis] / wide[axis] } else { 1.0 });
        let held = (1.0 - exp_f64(-self.dt / SOLID)) * high * f64::from(share[0] * share[1]);
        let (sine, cosine) = sin_cos_f64(body.yaw);
        (held > 0.0).then(|| Drag {
            at: self.on_plane(body.ground.map(|metres| fixed(metres / self.side)), step),
            half: wide,
            velocity: [0, 1].map(|axis: usize| (body.velocity[axis] - f64::from(self.velocity[axis])) as f32),
            turn: [cosine as f32, sine as f32],
            leaves: (1.0 - held) as f32,
            unused: [0.0; 3],
        })
    }

    /// One step of the flow.
    pub fn step(&self, flow: &mut FluidState, plan: &FluidPlan) {
        let mut fluid = Fluid::from_flow(flow.now.to_vec());
        fluid.step(&self.model, &plan.gusts, &plan.drags);
        flow.before = std::mem::replace(&mut flow.now, Arc::new(fluid.flow));
    }
}

/// A speed beside the mean that is seldom exceeded, m/s: twice the root mean square of what gusts make of the air, about. A gust pushes air for as long as
/// that is over it and remembers; what it made is found where the wind has carried it.
fn usual_speed(fluid: &scene::Fluid) -> f32 {
    let (side, fade) = (f64::from(fluid.side), f64::from(fluid.fade));
    let wind = fluid.velocity.map(f64::from);
    let wind = (wind[0] * wind[0] + wind[1] * wind[1]).sqrt();
    let squares = fluid.gusts.iter().map(|gust| {
        let (strength, width) = (f64::from(gust.strength), 2.0 * f64::from(gust.radius));
        // The time that air is pushed for; without wind it leaves by its own speed.
        let pace = 0.5 * (wind + (wind * wind + 4.0 * strength.abs() * width).sqrt());
        let time = fade * width / (pace * fade + width);
        let made = MEAN * strength * time;
        let share = width * (width + pace * fade) / (side * side);
        made * made * if share < 1.0 { share } else { 1.0 }
    });
    (2.0 * squares.sum::<f64>().sqrt()) as f32
}
