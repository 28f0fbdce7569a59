//! One blade of a patch that bodies reach: it gets a state when it is touched, swings by itself, and is handed back once it has settled.
//!
//! Belyaev et al. 2011, §3.4; methods §3.5. Reads wind, moments of virtual blades, bodies. Writes ψ, ω and the hold of a blade: 0 none,
//! it stands by the virtual blades; 1 it stands as its own state says; between them it is on its way back. Twin: `held.wgsl`.
//! Differs from the paper: blades are handed back one by one, over as long as the eye needs (docs/papers.md).

use super::blade::ChainCoefficients;
use super::frame::{Frame, planted};
use super::joint::{Bends, ChainState, count, step};
use super::pressed::felt;
use super::push::{Around, Obstacles, is_pushed, push, tip};
use crate::interaction::reaction::Felt;
use crate::math;
use crate::state::Root;

/// A blade is handed back when no joint is farther from where virtual blades would have it, rad,
const NEAR: f32 = 0.06;
/// nor turns faster against it, rad/s.
const SLOW: f32 = 0.5;
/// Least time in which it is handed back, s.
const FADE: f32 = 0.3;
/// Most that the tip moves because of it in a frame, pixels.
const MOTION: f32 = 0.5;
/// Frames a second for that.
const FRAMES: f32 = 60.0;

/// What a step changes of a blade.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HeldBlade {
    /// ψ and ω.
    pub state: ChainState,
    /// ψ a step before.
    pub before: Bends,
    /// How far it stands as its own state says, 0 to 1.
    pub hold: f32,
    /// The same a step before.
    pub hold_before: f32,
}

/// What a step does with the blades of a patch.
#[derive(Clone, Copy)]
pub struct Holding<'a> {
    /// What moves them.
    pub co: &'a ChainCoefficients,
    /// Bodies.
    pub obstacles: Obstacles<'a>,
    /// Step, s.
    pub dt: f32,
    /// Share of its hold that a fading patch keeps.
    pub keep: f32,
    /// Pixels of a metre where the nearest camera could be.
    pub pixels: f32,
    /// Every blade is held.
    pub all: bool,
    /// Blades are handed back even if they have not settled.
    pub handing: bool,
}

/// `virtual_` + (own − virtual_) · hold.
#[inline(always)]
pub fn mixed(virtual_: &Bends, own: &Bends, hold: f32) -> Bends {
    let mut bends = *virtual_;
    for (bend, own) in bends.iter_mut().zip(own) {
        for axis in 0..2 {
            bend[axis] += (own[axis] - bend[axis]) * hold;
        }
    }
    bends
}

/// Largest difference of a joint, as its square.
#[inline(always)]
fn apart(co: &ChainCoefficients, a: &Bends, b: &Bends) -> f32 {
    let mut most = 0.0;
    for i in 0..count(co) {
        let (x, y) = (a[i][0] - b[i][0], a[i][1] - b[i][1]);
        most = math::upper(most, x * x + y * y);
    }
    most
}

impl Holding<'_> {
    /// One step of one blade. `stands` gives its pose by the virtual blades, now (`false`) and a step before (`true`); `wind` the air at its root,
    /// (x, z) m/s.
    ///
    /// Returns which of the bodies holds it, and what that one feels about the middle of the box around it.
    #[inline(always)]
    pub fn step(
        &self,
        root: &Root,
        blade: &mut HeldBlade,
        stands: impl Fn(&Frame, bool) -> Bends,
        wind: impl Fn() -> [f32; 2],
    ) -> Option<(u32, Felt)> {
        let pushed = self.obstacles.reach(root);
        let all = self.all && !self.handing;
        if root.length <= 0.0 || (blade.hold <= 0.0 && !pushed && !all) {
            blade.hold_before = 0.0;
            return None;
        }
        let base = planted(root.yaw, root.lean);
        let around = self.obstacles.around(root);
        let virtual_ = stands(&base, false);
        let shown = self.swing(root, &base, blade, &virtual_, wind);
        let touched = pushed && is_pushed(self.co, root, &base, &self.obstacles, &around, &shown);
        if blade.hold <= 0.0 {
            if touched || all {
                self.take(blade, &virtual_, &stands(&base, true));
            }
        } else if touched || all {
            self.stay(blade, &shown);
        }
        let mut felt = None;
        if blade.hold >= 1.0 {
            let obstacles = if touched { self.obstacles } else { Obstacles::NONE };
            felt = self.push_out((root, &base), &obstacles, &around, blade);
        }
        if blade.hold > 0.0 && !touched && !all {
            self.go_back((root, &base), blade, &virtual_, || stands(&base, true));
        }
        blade.hold *= self.keep;
        felt
    }

    /// A blade with a state swings. Returns how it would be drawn then.
    #[inline(always)]
    fn swing(&self, root: &Root, base: &Frame, blade: &mut HeldBlade, virtual_: &Bends, wind: impl Fn() -> [f32; 2]) -> Bends {
        blade.hold_before = blade.hold;
        if blade.hold <= 0.0 {
            return *virtual_;
        }
        blade.before = blade.state.bends();
        let [x, z] = wind();
        blade.state = step(self.co, base, root.curl, [x, 0.0, z], self.dt, &blade.state);
        if blade.hold < 1.0 { mixed(virtual_, &blade.state.bends(), blade.hold) } else { blade.state.bends() }
    }

    /// Gives a blade its state, as it stands.
    #[inline(always)]
    fn take(&self, blade: &mut HeldBlade, now: &Bends, before: &Bends) {
        for i in 0..count(self.co) {
            let rate = [0, 1].map(|axis: usize| (now[i][axis] - before[i][axis]) / self.dt);
            blade.state.joints[i] = [now[i][0], now[i][1], rate[0], rate[1]];
        }
        (blade.before, blade.hold, blade.hold_before) = (*before, 1.0, 1.0);
    }

    /// A blade that nothing touches goes back to the virtual ones, once it has settled.
    #[inline(always)]
    fn go_back(&self, (root, base): (&Root, &Frame), blade: &mut HeldBlade, virtual_: &Bends, virtual_before: impl Fn() -> Bends) {
        if blade.hold >= 1.0 && !self.handing && !self.is_settled(root, base, blade, virtual_, virtual_before) {
            return;
        }
        let (a, b) = (tip(self.co, root, base, &blade.state.bends()), tip(self.co, root, base, virtual_));
        let way = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
        let pixels = self.pixels * (way[0] * way[0] + way[1] * way[1] + way[2] * way[2]).sqrt();
        let share = math::lower(self.dt / FADE, MOTION * FRAMES * self.dt / math::upper(pixels, 1e-6));
        blade.hold = math::upper(blade.hold - share, 0.0);
    }

    /// What is shown becomes the blade's own state.
    #[inline(always)]
    fn stay(&self, blade: &mut HeldBlade, shown: &Bends) {
        if blade.hold < 1.0 {
            for i in 0..count(self.co) {
                (blade.state.joints[i][0], blade.state.joints[i][1]) = (shown[i][0], shown[i][1]);
            }
            blade.hold = 1.0;
        }
    }

    /// Whether a blade keeps to the virtual ones; what the ground keeps up is settled too.
    #[inline(always)]
    fn is_settled(&self, root: &Root, base: &Frame, blade: &HeldBlade, virtual_: &Bends, virtual_before: impl Fn() -> Bends) -> bool {
        let own = blade.state.bends();
        let off_the_ground = |mut bends: Bends| {
            push(self.co, root, base, &Obstacles::NONE, &Obstacles::NONE.around(root), &mut bends);
            bends
        };
        let virtual_ = off_the_ground(*virtual_);
        if apart(self.co, &own, &virtual_) > NEAR * NEAR {
            return false;
        }
        let before = off_the_ground(virtual_before());
        let mut fastest = 0.0;
        for i in 0..count(self.co) {
            let rate = [0, 1].map(|axis: usize| own[i][axis] - virtual_[i][axis] - blade.before[i][axis] + before[i][axis]);
            fastest = math::upper(fastest, rate[0] * rate[0] + rate[1] * rate[1]);
        }
        fastest <= SLOW * SLOW * self.dt * self.dt
    }

    /// Out of bodies and off the ground; joints that were turned stand still.
    #[inline(always)]
    fn push_out(
        &self,
        (root, base): (&Root, &Frame),
        obstacles: &Obstacles,
        around: &Around,
        blade: &mut HeldBlade,
    ) -> Option<(u32, Felt)> {
        let mut bends = blade.state.bends();
        let (turned, pressed) = push(self.co, root, base, obstacles, around, &mut bends);
        for i in 0..count(self.co) {
            let [_, _, wx, wy] = blade.state.joints[i];
            let still = turned >> i & 1 == 1;
            blade.state.joints[i] = [bends[i][0], bends[i][1], if still { 0.0 } else { wx }, if still { 0.0 } else { wy }];
        }
        let solid = obstacles.heads.get(pressed.solid as usize)?;
        let about = [0, 1, 2].map(|axis: usize| 0.5 * (solid.low[axis] + solid.high[axis]));
        Some((pressed.solid, felt(self.co, root, base, &pressed, &blade.before, &bends, about)))
    }
}
